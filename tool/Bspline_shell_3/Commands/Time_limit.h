// The time that a command may take.
#ifndef TOOL_COMMANDS_TIME_LIMIT_H
#define TOOL_COMMANDS_TIME_LIMIT_H

#include <chrono>

namespace Tool {

class Time_limit
{
public:
  explicit Time_limit(double seconds) : m_limit(seconds) {}

  double limit() const { return m_limit; }
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count(); }
  double left() const { return m_limit - seconds(); }
  // Returns whether edits should end, such that time remains for the proofs.
  bool ends_edits() const
  {
    constexpr double share = 0.7; // proofs and distances take less time than the edit on most models
    return seconds() > share * m_limit;
  }

private:
  std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
  double m_limit; // infinite if there is none
};

} // namespace Tool

#endif // TOOL_COMMANDS_TIME_LIMIT_H
