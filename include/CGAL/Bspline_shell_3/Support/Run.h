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

// A call of a public function, which ends early if its time limit is reached or its visitor cancels it.
//
// Algorithms call `Run::poll()` between pieces of work of at most about a millisecond; `for_each_chunk()` calls it
// before each chunk. Once the run has ended, `poll()` throws `Run::Ended`, so that no code sees an incomplete result.
// The public function catches the exception, so its caller never sees it. Time has no other influence on a result.
//
// The run of a thread is not passed as an argument. `Run::Scope` sets it, and `for_each_chunk()` sets it in its worker
// threads.
class Run
{
  typedef std::chrono::steady_clock Clock;
public:
  // Thrown by `poll()`.
  struct Ended
  {};

  enum class End
  {
    NONE,
    OUT_OF_TIME,
    CANCELED
  };

  // `go_on` may be empty. It is called by polls of the thread that constructs this object. A nested run ends no later
  // than the outer run. If the nested run has no `go_on` and is on the same thread, it uses that of the outer run.
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

  // Returns the run of this thread; null if there is none.
  static Run*& current()
  {
    static thread_local Run* run = nullptr;
    return run;
  }

  // Sets the current run of this thread during its own lifetime.
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

  // Throws `Ended` if the current run has ended.
  static void poll()
  {
    if(current() != nullptr && !current()->goes_on()) throw Ended();
  }

  // Returns f(), or ended(end) if the run ends first.
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

  // Ends the run as canceled, and throws `Ended`.
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

  // Only the first reason is kept.
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

// Wraps `visitor.go_on()` in a function, which is empty if the visitor has no such member.
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
