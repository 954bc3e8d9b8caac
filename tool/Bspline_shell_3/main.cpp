// The command-line program: simplifies meshes in files with everything that is in them, and proves the result.
#include "Files/Words.h"
#include "Verbs/Exit_code.h"
#include "Verbs/verbs.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <functional>
#include <iostream>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace {

std::size_t edit_distance(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for(std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for(std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = (std::min)({ row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1]) });
      diagonal = above;
    }
  }
  return row.back();
}

// Names the option or verb that is most similar to an unknown one.
std::string nearest(const std::string& word, const CLI::App& app)
{
  std::string best;
  const auto consider = [&](const std::string& name) {
    if(best.empty() || edit_distance(word, name) < edit_distance(word, best)) best = name;
  };
  if(word.compare(0, 1, "-") == 0) {
    for(const CLI::Option* option : app.get_options())
      for(const std::string& name : option->get_lnames()) consider("--" + name);
  } else
    for(const CLI::App* verb : app.get_subcommands(nullptr)) consider(verb->get_name());
  return best;
}

int refuse(const CLI::App& program, const CLI::ParseError& error)
{
  const auto verbs = program.get_subcommands();
  const CLI::App& app = verbs.empty() ? program : *verbs.front();
  const std::vector<std::string> unknown = app.remaining();
  if(unknown.empty()) std::cerr << error.what() << "\n";
  else {
    const bool is_option = unknown.front().compare(0, 1, "-") == 0;
    const std::string similar = nearest(unknown.front(), app);
    std::cerr << "There is no "
              << (is_option       ? "option "
                  : verbs.empty() ? "verb "
                                  : "further argument ")
              << unknown.front();
    if(similar.empty()) std::cerr << ".\n";
    else std::cerr << ": did you mean " << similar << "?\n";
  }
  std::cerr << "See bspline_shell " << (verbs.empty() ? "" : app.get_name() + " ") << "--help." << std::endl;
  return Tool::WRONG_USAGE;
}

void add_length(CLI::App& verb, const std::string& name, std::optional<Tool::Length>& length, const std::string& text)
{
  verb
    .add_option_function<std::string>(
      name,
      [name, &length](const std::string& value) {
        length = Tool::read_length(value);
        if(!length)
          throw CLI::ValidationError(name, "cannot be " + value + ": give a positive number, or a percentage.");
      },
      text)
    ->type_name("LENGTH");
}

void add_common(CLI::App& verb, bool& writes_json)
{
  verb.add_flag("--json", writes_json, "Print the result as JSON");
  verb.footer(Tool::exit_codes);
}

// Replaces a validator of CLI11 whose message has the largest number, with all of its digits.
const CLI::Validator positive(
  [](std::string& text) {
    double x = 0;
    return Tool::read_number(text, x) && x > 0 ? std::string() : text + " is not a positive number.";
  },
  "POSITIVE");

void add_time_limit(CLI::App& verb, double& seconds)
{
  verb.add_option("--time-limit", seconds, "Time limit in seconds")->check(positive);
}

} // namespace

int main(int argc, char** argv)
{
  CLI::App program("Simplifies triangle meshes and keeps everything that is attached to them: colors, texture\n"
                   "coordinates, materials, groups, labels, and other properties. The distance and the one-to-one map\n"
                   "between the original and the result are proved. Files: PLY, OBJ with MTL, OFF,\n"
                   "STL, glTF, GLB.",
                   "bspline_shell");
  program.set_version_flag("--version", std::string("bspline_shell ") + BSPLINE_SHELL_3_VERSION);
  program.require_subcommand(1);
  program.footer(Tool::exit_codes);
  program.get_formatter()->column_width(32);
  int code = Tool::DONE;
  const std::string lengths =
    "\nA LENGTH is in the unit of the file, or in percent of the longest side of its box: 0.5%";

  Tool::Simplify_options simplify;
  CLI::App* verb = program.add_subcommand("simplify", "Simplify a mesh, and keep its attributes." + lengths);
  verb->add_option("IN", simplify.input, "The mesh; - is the standard input")->required();
  verb
    ->add_option("-o,--output", simplify.output,
                 "The result; its extension selects the format; - is the standard output, in the format of IN")
    ->required();
  add_length(*verb, "--tolerance", simplify.tolerance,
             "No point of either surface is farther from the other (default: none)");
  auto* facets = verb->add_option("--facets", simplify.facets, "Stop at this number of facets")->check(positive);
  verb->add_option("--ratio", simplify.ratio, "Stop at this fraction of the number of triangles")
    ->check(CLI::Range(0., 1.))
    ->excludes(facets);
  add_length(*verb, "--thickness", simplify.thickness,
             "Thickness of the shell (default: chosen for the tolerance; otherwise, 1%)");
  verb->add_flag("--keep-normals", simplify.carries_normals, "Interpolate normals instead of recomputing them");
  add_time_limit(*verb, simplify.seconds);
  add_common(*verb, simplify.writes_json);
  verb->callback([&] { code = Tool::simplify(simplify); });

  Tool::Shell_options shell;
  verb = program.add_subcommand("shell", "Build a certified shell, its surfaces, and its certificate." + lengths);
  verb->add_option("IN", shell.input, "The mesh")->required();
  verb->add_option("-o,--output", shell.prefix, "Prefix of the names of the results")->required();
  add_length(*verb, "--thickness", shell.thickness, "Thickness of the shell (default: 1%)");
  add_time_limit(*verb, shell.seconds);
  add_common(*verb, shell.writes_json);
  verb->callback([&] { code = Tool::shell(shell); });

  Tool::Check_options check;
  verb = program.add_subcommand("check", "Describe a file, its defects, and the shell it can have." + lengths);
  verb->add_option("IN", check.input, "The mesh")->required();
  add_length(*verb, "--thickness", check.thickness, "Thickness of the shell (default: 1%)");
  add_common(*verb, check.writes_json);
  verb->callback([&] { code = Tool::check(check); });

  Tool::Certify_options certify;
  verb = program.add_subcommand("certify", "Prove that a mesh lies in a shell and is mapped one-to-one.");
  verb->add_option("SHELL", certify.shell, "The shell")->required();
  verb->add_option("MESH", certify.mesh, "The mesh")->required();
  add_common(*verb, certify.writes_json);
  verb->callback([&] { code = Tool::certify(certify); });

  try {
    program.parse(argc, argv);
  } catch(const CLI::Success& success) {
    return program.exit(success);
  } catch(const CLI::ParseError& error) {
    return refuse(program, error);
  } catch(const std::exception& error) {
    std::cerr << "bspline_shell: " << error.what() << std::endl;
    return Tool::WRONG_INPUT;
  }
  return code;
}
