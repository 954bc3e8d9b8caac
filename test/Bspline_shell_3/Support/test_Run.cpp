// Run.h: runs end at their first poll after a limit was reached or a visitor canceled, and leave no state behind.
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <CGAL/tags.h>

#include <catch2/catch.hpp>

#include <atomic>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <thread>

namespace test_Run {
namespace BS = CGAL::Bspline_shells;
using BS::internal::Run;
typedef Run::End End;

namespace {

constexpr double forever = std::numeric_limits<double>::infinity();

// Returns how the run ends, or that a function was executed to its end.
template <typename Function>
End end_of(Run& run, const Function& f)
{
  return run(
    [&] {
      f();
      return End::NONE;
    },
    [](End end) { return end; });
}

// Polls the given number of times.
End poll(Run& run, int times)
{
  return end_of(run, [times] {
    for(int n = 0; n < times; ++n) Run::poll();
  });
}

} // namespace

TEST_CASE("Runs: a poll outside of a run, or in a run without limits, does nothing")
{
  Run::poll();
  for(double limit : { forever, 1e300, 1e6 }) {
    Run run(limit);
    CHECK(poll(run, 3) == End::NONE);
    CHECK(run.end() == End::NONE);
  }
}

TEST_CASE("Runs: the first poll after the time limit ends the run, and no thread has a run afterwards")
{
  Run run(0);
  CHECK(poll(run, 0) == End::NONE);
  CHECK(poll(run, 1) == End::OUT_OF_TIME);
  CHECK(Run::current() == nullptr);
  Run::poll();
}

TEST_CASE("Runs: the visitor is called at each poll until it stops the run")
{
  int calls = 0;
  Run run(forever, [&] { return ++calls < 3; });
  CHECK(poll(run, 2) == End::NONE);
  CHECK(calls == 2);
  CHECK(poll(run, 5) == End::CANCELED);
  CHECK(calls == 3);
  CHECK(poll(run, 1) == End::CANCELED);
  CHECK(calls == 3);
}

TEST_CASE("Runs: a visitor may call functions that poll, and may throw")
{
  int calls = 0;
  Run run(forever, [&] {
    ++calls;
    Run::poll();
    return true;
  });
  CHECK(poll(run, 2) == End::NONE);
  CHECK(calls == 2);
  Run thrown(forever, []() -> bool { throw std::runtime_error("enough"); });
  CHECK_THROWS_AS(poll(thrown, 1), std::runtime_error);
  CHECK(Run::current() == nullptr);
}

TEST_CASE("Runs: an inner run ends with the outer one, even if its own limit is longer")
{
  Run outer(0);
  const Run::Scope scope(&outer);
  Run inner(1e6);
  CHECK(poll(inner, 1) == End::OUT_OF_TIME);
  int calls = 0;
  Run visited(forever, [&] { return ++calls < 2; });
  {
    const Run::Scope visited_scope(&visited);
    Run innermost(forever);
    CHECK(poll(innermost, 2) == End::OUT_OF_TIME);
  }
  CHECK(calls == 1);
}

TEST_CASE("Runs: chunks are skipped after the end of the run, for any number of threads")
{
  const auto chunks_until = [](auto tag, int most) {
    std::atomic<int> done(0);
    int calls = 0;
    Run run(forever, [&] { return ++calls <= most; });
    const End end = end_of(
      run, [&] { BS::internal::for_each_chunk<decltype(tag)>(1000, 10, [&](std::size_t, std::size_t) { ++done; }); });
    CHECK(end == (most < 100 ? End::CANCELED : End::NONE));
    CHECK(Run::current() == nullptr);
    return done.load();
  };
  CHECK(chunks_until(CGAL::Sequential_tag(), 0) == 0);
  CHECK(chunks_until(CGAL::Sequential_tag(), 7) == 7);
  CHECK(chunks_until(CGAL::Sequential_tag(), 100) == 100);
  CHECK(chunks_until(CGAL::Parallel_if_available_tag(), 100) == 100);
  // All threads respect the limit.
  std::atomic<int> done(0);
  Run late(0);
  const End end = end_of(late, [&] {
    BS::internal::for_each_chunk<CGAL::Parallel_if_available_tag>(1000, 1, [&](std::size_t, std::size_t) { ++done; });
  });
  CHECK(end == End::OUT_OF_TIME);
  CHECK(done == 0);
}

TEST_CASE("Runs: only the thread that began the run calls the visitor, and polls of all threads belong to the run")
{
  const std::thread::id here = std::this_thread::get_id();
  int elsewhere = 0;
  std::atomic<int> outside(0);
  Run run(forever, [&] {
    elsewhere += std::this_thread::get_id() != here;
    return true;
  });
  const End end = end_of(run, [&] {
    BS::internal::for_each_chunk<CGAL::Parallel_if_available_tag>(1000, 1, [&](std::size_t, std::size_t) {
      if(Run::current() != &run) ++outside;
      // also in nested chunks
      BS::internal::for_each_chunk<CGAL::Parallel_if_available_tag>(4, 1, [&](std::size_t, std::size_t) {
        if(Run::current() != &run) ++outside;
      });
    });
  });
  CHECK(end == End::NONE);
  CHECK(elsewhere == 0);
  CHECK(outside == 0);
}

TEST_CASE("Runs: polls of another thread do not call the visitor, but end with the run")
{
  int calls = 0;
  Run run(forever, [&] { return ++calls < 2; });
  const auto poll_elsewhere = [&] {
    bool has_ended = false;
    std::thread([&] {
      const Run::Scope scope(&run);
      try {
        for(int n = 0; n < 3; ++n) Run::poll();
      } catch(const Run::Ended&) {
        has_ended = true;
      }
    }).join();
    return has_ended;
  };
  CHECK_FALSE(poll_elsewhere());
  CHECK(calls == 0);
  CHECK(poll(run, 2) == End::CANCELED);
  CHECK(poll_elsewhere());
  CHECK(calls == 2);
}

TEST_CASE("Runs: a visitor without go_on() is never called")
{
  struct Old_visitor
  {
    bool start_step(BS::Shell_step) { return true; }
  };
  Old_visitor old;
  CHECK_FALSE(BS::internal::Go_on<Old_visitor>::of(old));
  BS::Default_shell_visitor visitor;
  REQUIRE(BS::internal::Go_on<BS::Default_shell_visitor>::of(visitor));
  CHECK(BS::internal::Go_on<BS::Default_shell_visitor>::of(visitor)());
}
} // namespace test_Run
