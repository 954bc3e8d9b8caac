// checksum.h: the published check value, and checksums of texts and numbers.
#include <CGAL/Bspline_shell_3/IO/checksum.h>
#include "shell_files.h"

#include <cstdint>
#include <string>

namespace test_checksum {
TEST_CASE("Checksum: the checksum is the CRC-64/XZ of a text")
{
  BS::Checksum checksum;
  CHECK(checksum.value() == 0);
  checksum.add("123456789");
  CHECK(checksum.value() == 0x995DC9BBDF1939FAull); // the published check value
  CHECK(BS::Checksum::text(checksum.value()) == "995dc9bbdf1939fa");
  CHECK(BS::Checksum::text(10) == "000000000000000a");

  // Numbers are added as little-endian bytes.
  BS::Checksum numbers;
  numbers.add(-1.75);
  numbers.add(std::uint32_t(0x01020304));
  CHECK(numbers.value() == slow_checksum(as_bytes(-1.75) + "\x04\x03\x02\x01"));
}
} // namespace test_checksum
