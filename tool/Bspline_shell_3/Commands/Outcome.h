// How a command ends.
#ifndef TOOL_COMMANDS_OUTCOME_H
#define TOOL_COMMANDS_OUTCOME_H

#include "Exit_code.h"

#include <CGAL/Bspline_shell_3/Support/Status.h>

#include <string>

namespace Tool {

namespace BS = CGAL::Bspline_shells;

// An exit code and, unless the code is `DONE`, the reason: a file, a sentence, and the facets and vertices concerned.
struct Outcome
{
  Outcome(Exit_code code = DONE, const std::string& file = "", const std::string& message = "",
          const BS::Offending_simplices& offenders = BS::Offending_simplices())
    : code(code), file(file), message(message), offenders(offenders)
  {}
  explicit operator bool() const { return code == DONE; }

  Exit_code code;
  std::string file, message;
  BS::Offending_simplices offenders;
};

// Prints the reason to the error stream; as JSON, to the output stream. A command that has printed its result gives no
// reason. Returns the exit code.
int report(const Outcome& outcome, bool writes_json);

// Replaces names of the library's parameters, which its messages give in parentheses, by those of options. Names
// without an option are left out.
std::string with_options(std::string message);

} // namespace Tool

#endif // TOOL_COMMANDS_OUTCOME_H
