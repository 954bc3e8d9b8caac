// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SUPPORT_RUN_H
#define CGAL_BSPLINE_SHELL_3_SUPPORT_RUN_H

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <thread>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// A call of a front door, which ends early when its time is over or its visitor cancels it.
//
// Passes call `Run::poll()` between pieces of work of about a millisecond or less; `for_each_chunk()` does so before
// each chunk. Once the run has ended, `poll()` throws `Run::Ended`, so that no code sees a result that is not complete.
// The front door catches the exception; it never reaches the caller. Time has no other influence on a result.
//
// The run of a thread is found without being passed down: `Run::Scope` sets it, and `for_each_chunk()` sets it in its
// worker threads.
class Run
{
  typedef std::chrono::steady_clock Clock;
public:
  // thrown by `poll()`
  struct Ended
  {};

  enum class End
  {
    NONE,
    OUT_OF_TIME,
    CANCELED
  };

  // `go_on` is called by polls of the thread that constructs this object, and may be empty. A run within another one
  // ends no later than that, and has its `go_on` unless it has its own.
  explicit Run(double max_seconds, std::function<bool()> go_on = std::function<bool()>())
    : m_go_on(std::move(go_on)), m_thread(std::this_thread::get_id())
  {
    constexpr double forever = 1e9; // seconds; more may overflow
    if(max_seconds < forever)
      m_deadline = Clock::now()
                   + std::chrono::duration_cast<Clock::duration>(
                     std::chrono::duration<double>((std::max)(0., max_seconds)));
    if(const Run* outer = current()) {
      m_deadline = (std::min)(m_deadline, outer->m_deadline);
      if(!m_go_on && outer->m_thread == m_thread) m_go_on = outer->m_go_on;
    }
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  End end() const { return m_end; }

  // the run that polls of this thread belong to; null for none
  static Run*& current()
  {
    static thread_local Run* run = nullptr;
    return run;
  }

  // sets the current run of this thread as long as it exists
  class Scope
  {
  public:
    explicit Scope(Run* run) : m_before(std::exchange(current(), run)) {}
    ~Scope() { current() = m_before; }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

  private:
    Run* m_before;
  };

  // throws `Ended` if the current run has ended
  static void poll()
  {
    if(current() != nullptr && !current()->goes_on()) throw Ended();
  }

  // Returns f(), or ended(end) if the run ends before.
  template <typename Function, typename OnEnd>
  auto operator()(const Function& f, const OnEnd& ended)
  {
    try {
      const Scope scope(this);
      return f();
    } catch(const Ended&) {
      return ended(m_end.load());
    }
  }

  // ends the run
  [[noreturn]] void cancel()
  {
    stop(End::CANCELED);
    throw Ended();
  }

private:
  bool goes_on()
  {
    if(m_end != End::NONE) return false;
    if(m_go_on && std::this_thread::get_id() == m_thread) {
      const Scope none(nullptr); // the visitor may call functions that poll
      if(!m_go_on()) stop(End::CANCELED);
    }
    if(m_deadline != Clock::time_point::max() && Clock::now() >= m_deadline) stop(End::OUT_OF_TIME);
    return m_end == End::NONE;
  }

  // the first reason stays
  void stop(End end)
  {
    End none = End::NONE;
    m_end.compare_exchange_strong(none, end);
  }

  std::function<bool()> m_go_on;
  std::thread::id m_thread;
  Clock::time_point m_deadline = Clock::time_point::max();
  std::atomic<End> m_end{ End::NONE };
};

// `visitor.go_on()`, or an empty function if the visitor has no such member
template <typename Visitor, typename = void>
struct Go_on
{
  static std::function<bool()> of(Visitor&) { return std::function<bool()>(); }
};
template <typename Visitor>
struct Go_on<Visitor, std::void_t<decltype(bool(std::declval<Visitor&>().go_on()))> >
{
  static std::function<bool()> of(Visitor& visitor)
  {
    return [&visitor] { return bool(visitor.go_on()); };
  }
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SUPPORT_RUN_H
