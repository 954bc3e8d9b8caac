// Progress on a terminal.
#ifndef TOOL_VERBS_PROGRESS_H
#define TOOL_VERBS_PROGRESS_H

#include <CGAL/Bspline_shell_3/Support/Progress.h>

#include <unistd.h>

#include <iostream>
#include <string>

namespace Tool {

// Shows the current step and its percentage in one line of a terminal, and prints nothing if errors are redirected. It
// is a visitor of the construction of shells, whose steps have no known length.
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
    show(std::string("shell: ") + name(step), double(step) / steps);
    return true;
  }
  void show(const std::string& step, double fraction)
  {
    if(!m_is_on_terminal) return;
    clear();
    std::cerr << step << " " << int(100 * fraction) << " %" << std::flush;
  }
  void clear() const
  {
    if(m_is_on_terminal) std::cerr << "\r\033[K" << std::flush;
  }

private:
  const bool m_is_on_terminal = isatty(STDERR_FILENO);
};

} // namespace Tool

#endif // TOOL_VERBS_PROGRESS_H
