// Exit codes of the program.
#ifndef TOOL_COMMANDS_EXIT_CODE_H
#define TOOL_COMMANDS_EXIT_CODE_H

namespace Tool {

enum Exit_code
{
  DONE = 0,
  WRONG_INPUT = 1,
  WRONG_USAGE = 2,
  CANNOT_WRITE = 3,
  NOT_CERTIFIED = 4
};

constexpr const char* exit_codes = "Exit codes\n"
                                   "  0   success\n"
                                   "  1   the input cannot be used\n"
                                   "  2   wrong usage\n"
                                   "  3   an output file cannot be written\n"
                                   "  4   the claims are not proved, or the tolerance is not kept; transfer: nothing "
                                   "is one-to-one\n";

} // namespace Tool

#endif // TOOL_COMMANDS_EXIT_CODE_H
