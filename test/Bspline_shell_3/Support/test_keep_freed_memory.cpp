// keep_freed_memory.h: what glibc does with large blocks.
#include <CGAL/Bspline_shell_3/Support/keep_freed_memory.h>

#include <catch2/catch.hpp>

#include <cstddef>
#include <cstdlib>
#include <memory>

#ifdef __GLIBC__
#if __GLIBC_PREREQ(2, 33)
#define HAVE_MALLINFO2
#endif
#endif

namespace test_keep_freed_memory {
namespace BS = CGAL::Bspline_shells;

TEST_CASE("Kept memory: blocks between 32 MB and 256 MB come from the heap, larger ones from the system")
{
#ifdef HAVE_MALLINFO2
  const auto comes_from_system = [](std::size_t bytes) {
    const std::size_t before = mallinfo2().hblks;
    const std::unique_ptr<char, void (*)(void*)> block(static_cast<char*>(std::malloc(bytes)), std::free);
    REQUIRE(block);
    return mallinfo2().hblks > before;
  };
  constexpr std::size_t MB = 1 << 20;
  CHECK(comes_from_system(200 * MB)); // the heap may have smaller free blocks
  BS::keep_freed_memory();
  CHECK_FALSE(comes_from_system(40 * MB));
  CHECK_FALSE(comes_from_system(200 * MB));
  CHECK(comes_from_system(300 * MB));
#else
  BS::keep_freed_memory();
#endif
}

} // namespace test_keep_freed_memory
