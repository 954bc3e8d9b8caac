// Progress on a terminal.
#ifndef TOOL_COMMANDS_PROGRESS_H
#define TOOL_COMMANDS_PROGRESS_H

#include <CGAL/Bspline_shell_3/Support/Progress.h>

#include <unistd.h>

#include <chrono>
#include <iostream>
#include <string>

namespace Tool {

// Shows the current step, its percentage, and its remaining time in one line of a terminal, and prints nothing if
// errors are redirected. It is a visitor of the construction of shells, whose steps have no known length.
class Progress : public CGAL::Bspline_shells::Default_shell_visitor
{
public:
  Progress() = default;
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { clear(); }

  bool start_step(CGAL::Bspline_shells::Shell_step step)
  {
    constexpr double steps = 6;
    print(std::string("shell: ") + name(step), double(step) / steps, "");
    return true;
  }
  void show(const std::string& step, double fraction)
  {
    const auto now = std::chrono::steady_clock::now();
    if(step != m_step) {
      m_step = step;
      m_start = now;
    }
    // An estimate from less than this would be wrong by far.
    constexpr double least_fraction = 0.05, least_seconds = 2;
    const double seconds = std::chrono::duration<double>(now - m_start).count();
    const bool is_known = fraction >= least_fraction && seconds >= least_seconds;
    print(step, fraction,
          is_known ? ", " + std::to_string(int(seconds * (1 - fraction) / fraction) + 1) + " s left" : "");
  }
  void clear() const
  {
    if(m_is_on_terminal) std::cerr << "\r\033[K" << std::flush;
  }

private:
  void print(const std::string& step, double fraction, const std::string& remaining) const
  {
    if(!m_is_on_terminal) return;
    clear();
    std::cerr << step << " " << int(100 * fraction) << " %" << remaining << std::flush;
  }

  std::string m_step;
  std::chrono::steady_clock::time_point m_start;
  const bool m_is_on_terminal = isatty(STDERR_FILENO);
};

} // namespace Tool

#endif // TOOL_COMMANDS_PROGRESS_H
