// checksum.h: the published check value, and checksums of texts, numbers and streams.
#include <CGAL/Bspline_shell_3/IO/checksum.h>
#include "shell_files.h"

#include <cstdint>
#include <ostream>
#include <sstream>
#include <string>

namespace test_checksum {
TEST_CASE("Checksum: the checksum is the CRC-64/XZ of a text or of the output to a stream")
{
  BS::Checksum checksum;
  CHECK(checksum.value() == 0);
  checksum.add("123456789");
  CHECK(checksum.value() == 0x995DC9BBDF1939FAull); // the published check value
  CHECK(BS::Checksum::text(checksum.value()) == "995dc9bbdf1939fa");
  CHECK(BS::Checksum::text(10) == "000000000000000a");

  std::ostringstream target;
  BS::Checksum_streambuf passing(target.rdbuf()), counting;
  std::ostream summed(&passing), nowhere(&counting);
  for(std::ostream* out : { &summed, &nowhere }) *out << "12" << 3 << '4' << std::string("56789") << std::flush;
  CHECK(target.str() == "123456789");
  CHECK(passing.checksum() == 0x995DC9BBDF1939FAull);
  CHECK(counting.checksum() == 0x995DC9BBDF1939FAull);

  // Numbers are added as little-endian bytes.
  BS::Checksum numbers;
  numbers.add(-1.75);
  numbers.add(std::uint32_t(0x01020304));
  CHECK(numbers.value() == slow_checksum(as_bytes(-1.75) + "\x04\x03\x02\x01"));
  Full_disk disk(4);
  BS::Checksum_streambuf full(&disk);
  std::ostream stopped(&full);
  stopped << "1234"
          << "56";
  CHECK_FALSE(stopped);
  CHECK(full.checksum() == slow_checksum("1234"));
}
} // namespace test_checksum
