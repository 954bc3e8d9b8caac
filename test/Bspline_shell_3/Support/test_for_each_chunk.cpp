// for_each_chunk.h: chunks on all threads belong to the run of the caller, and cover each index once.
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <CGAL/tags.h>

#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <limits>
#include <numeric>
#include <thread>
#include <vector>

namespace test_for_each_chunk {
namespace BS = CGAL::Bspline_shells;
using BS::internal::Run;

TEST_CASE("Chunks: each index is in one chunk, and results are in the order of the indices")
{
  for(std::size_t size : { 0, 1, 9, 10, 11, 1000 })
    for(std::size_t chunk : { 1, 3, 10, 2000 }) {
      std::atomic<bool> are_small(true);
      const std::vector<std::size_t> found =
        BS::internal::collect_from_chunks<CGAL::Parallel_if_available_tag, std::size_t>(
          size, chunk, [&](std::size_t begin, std::size_t end, std::vector<std::size_t>& part) {
            if(end - begin > chunk) are_small = false;
            for(std::size_t n = begin; n < end; ++n) part.push_back(n);
          });
      std::vector<std::size_t> expected(size);
      std::iota(expected.begin(), expected.end(), std::size_t(0));
      CHECK(found == expected);
      CHECK(are_small);
    }
}

TEST_CASE("Chunks: those on other threads belong to the run of the caller")
{
  const std::thread::id here = std::this_thread::get_id();
  std::atomic<int> elsewhere(0), strangers(0);
#ifdef CGAL_LINKED_WITH_TBB
  int waits = std::thread::hardware_concurrency() > 1 ? 2000 : 0; // until another thread takes a chunk
#else
  int waits = 0;
#endif
  Run run(std::numeric_limits<double>::infinity());
  const bool is_done = run(
    [&] {
      BS::internal::for_each_chunk<CGAL::Parallel_if_available_tag>(1000, 1, [&](std::size_t, std::size_t) {
        if(Run::current() != &run) ++strangers;
        if(std::this_thread::get_id() != here) ++elsewhere;
        else
          for(; elsewhere == 0 && waits > 0; --waits) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      });
      return true;
    },
    [](Run::End) { return false; });
  CHECK(is_done);
  CHECK(strangers == 0);
}
} // namespace test_for_each_chunk
