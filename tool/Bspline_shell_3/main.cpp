// The command-line program: simplifies meshes in files with everything that is in them, and proves the result.
#include "Files/Words.h"
#include "Commands/Exit_code.h"
#include "Commands/Length.h"
#include "Commands/Outcome.h"
#include "Commands/commands.h"

#include <CGAL/Bspline_shell_3/Support/keep_freed_memory.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace {

// Limits the number of threads until the end of the program.
class Thread_limit
{
public:
  void operator()(std::size_t threads)
  {
#ifdef CGAL_LINKED_WITH_TBB
    m_control = std::make_shared<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads);
#else
    CGAL_USE(threads);
#endif
  }

private:
#ifdef CGAL_LINKED_WITH_TBB
  std::shared_ptr<tbb::global_control> m_control;
#endif
};

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

std::vector<std::string> commands_of(const CLI::App& program)
{
  std::vector<std::string> names;
  for(const CLI::App* command : program.get_subcommands(nullptr)) names.push_back(command->get_name());
  return names;
}

// Returns the option or command that is most similar to an unknown one, or an empty name if none is similar.
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
    for(const std::string& name : commands_of(app)) consider(name);
  return 2 * edit_distance(word, best) <= word.size() ? best : "";
}

// Returns the fault in the arguments of the program as a sentence.
std::string wrong_usage(const CLI::App& program, const CLI::App& app, const CLI::ParseError& error)
{
  const bool has_command = &app != &program;
  const std::vector<std::string> unknown = app.remaining();
  std::string commands = " The commands are";
  for(const std::string& name : commands_of(program)) commands += " " + name + ",";
  commands.back() = '.';
  if(unknown.empty()) return has_command ? error.what() : "A command is required." + commands;
  const std::string& word = unknown.front();
  const bool is_option = word.compare(0, 1, "-") == 0;
  const std::string similar = nearest(word, app), hint = similar.empty() ? "." : ": did you mean " + similar + "?";
  if(word == "%") return "A percentage is written without a space: 1%.";
  if(is_option) return "Unknown option " + word + hint;
  if(!has_command) return "Unknown command " + word + (similar.empty() ? "." + commands : hint);
  const bool has_output = app.get_option_no_throw("--output") != nullptr && app.count("--output") == 0;
  return "Unexpected argument " + word + (has_output ? ": to name the result, use -o " + word + "." : std::string("."));
}

int refuse(const CLI::App& program, const CLI::ParseError& error)
{
  const auto commands = program.get_subcommands();
  const CLI::App& app = commands.empty() ? program : *commands.front();
  std::cerr << wrong_usage(program, app, error) << "\nSee bspline_shell "
            << (commands.empty() ? "" : app.get_name() + " ") << "--help." << std::endl;
  return Tool::WRONG_USAGE;
}

void add_length(CLI::App& command, const std::string& name, std::optional<Tool::Length>& length,
                const std::string& text)
{
  command
    .add_option_function<std::string>(
      name,
      [name, &length](const std::string& value) {
        length = Tool::read_length(value);
        if(!length) throw CLI::ValidationError(name, "must be a positive number or a percentage, not " + value + ".");
      },
      text)
    ->type_name("LENGTH");
}

// Checks that a number is positive and at most as large as another one.
CLI::Validator positive(double largest = std::numeric_limits<double>::infinity())
{
  return CLI::Validator(
    [largest](std::string& text) {
      double x = 0;
      if(Tool::read_number(text, x) && x > 0 && x <= largest) return std::string();
      return "must be positive"
             + (std::isfinite(largest) ? " and at most " + std::to_string(int(largest)) : std::string()) + ", not "
             + text + ".";
    },
    "");
}

// Checks that a number is a positive integer.
CLI::Validator natural()
{
  return CLI::Validator(
    [](std::string& text) {
      const bool is_natural = !text.empty() && text.find_first_not_of("0123456789") == text.npos
                              && text.find_first_not_of('0') != text.npos;
      return is_natural ? std::string() : "must be a positive integer, not " + text + ".";
    },
    "");
}

void add_shell(CLI::App& command, Tool::Shell_options& shell, const std::string& thickness,
               const std::string& name = "IN", const std::string& mesh = "The mesh")
{
  command.add_option(name, shell.input, mesh)->required();
  add_length(command, "--thickness", shell.thickness, "Thickness of the shell (default: " + thickness + ")");
  add_length(command, "--weld", shell.weld,
             "Merge points within this distance if this closes cracks (default: a few units in the last digit)");
  command
    .add_option(
      "--excise", shell.excised_percentage,
      "Largest part of the area, in percent, that may be excluded from the shell because of intersections and "
      "other defects; this part is not changed")
    ->check(CLI::Range(0., 100.))
    ->capture_default_str();
}

void add_output(CLI::App& command, std::string& output)
{
  command
    .add_option("-o,--output", output,
                "The result; its extension selects the format. The standard output, -, has the format of the input.")
    ->required();
}

void add_view(CLI::App& command, std::string& view, const std::string& contents)
{
  command.add_option("--view", view, "Write a page for a browser that shows " + contents)->type_name("PAGE.html");
}

void add_edit(CLI::App& command, Tool::Edit_options& edit)
{
  add_output(command, edit.output);
  add_length(command, "--tolerance", edit.tolerance,
             "Largest distance of any point of either surface from the other one (default: no limit)");
  command
    .add_option("--shell", edit.shell,
                "Write the shell, its mesh, and its surfaces as well; see the command shell for the names")
    ->type_name("PREFIX");
  add_view(command, edit.view, "the mesh, the result, the shell, and the map between them");
  command.add_flag("--keep-normals", edit.carries_normals, "Interpolate normals instead of recomputing them");
}

void add_limits(CLI::App& command, Tool::Shell_options& shell, Thread_limit& threads)
{
  command.add_option("--time-limit", shell.seconds, "Time limit in seconds")->check(positive());
  command.add_option("--memory-limit", shell.megabytes, "Memory for the shell, in megabytes")
    ->check(positive())
    ->capture_default_str();
  command
    .add_option_function<std::size_t>("--threads", std::ref(threads), "Number of threads (default: all processors)")
    ->check(natural());
}

void add_common(CLI::App& command, bool& writes_json, const std::string& examples)
{
  command.group("Commands");
  command.add_flag("--json", writes_json, "Print the result, or the error, as JSON");
  command.footer("Examples\n" + examples + "\n" + Tool::exit_codes);
}

// Lists commands with the first lines of their descriptions.
class Help_formatter : public CLI::Formatter
{
public:
  Help_formatter()
  {
    column_width(32);
    label("SUBCOMMAND", "COMMAND");
  }
  std::string make_subcommand(const CLI::App* command) const override
  {
    const std::string description = command->get_description();
    std::ostringstream out;
    CLI::detail::format_help(out, command->get_name(), description.substr(0, description.find('\n')), column_width_);
    return out.str();
  }
};

} // namespace

int main(int argc, char** argv)
{
  CGAL::Bspline_shells::keep_freed_memory();
  CLI::App program("Simplifies triangle meshes and keeps their attributes: colors, texture\n"
                   "coordinates, materials, groups, labels, and other properties. The distance and the one-to-one map\n"
                   "between the original and the result are proved: both lie in a shell, a thin layer around the\n"
                   "surface, and each curve through it meets each of them once. Files: PLY, OBJ with MTL, OFF, STL,\n"
                   "glTF, GLB; - is the standard input or output.",
                   "bspline_shell");
  program.formatter(std::make_shared<Help_formatter>());
  program.set_version_flag("--version", std::string("bspline_shell ") + BSPLINE_SHELL_3_VERSION);
  program.set_help_all_flag("--help-all", "Print the help of all commands");
  program.require_subcommand(1);
  program.footer(Tool::exit_codes);
  bool writes_json = false;
  Thread_limit threads;
  Tool::Outcome outcome;
  const std::string lengths =
    "\nA LENGTH is in the unit of the file, or in percent of the longest side of its box: 0.5%";

  Tool::Simplify_options simplify;
  CLI::App* command = program.add_subcommand("simplify", "Simplify a mesh, and keep its attributes." + lengths);
  add_edit(*command, simplify);
  auto* facets = command->add_option("--facets", simplify.facets, "Stop at this number of triangles")->check(natural());
  command->add_option("--ratio", simplify.ratio, "Stop at this fraction of the number of triangles")
    ->check(positive(1))
    ->excludes(facets);
  add_length(*command, "--border", simplify.border,
             "Simplify open borders within this distance (default: borders are kept)");
  command->add_flag("--cut-seams", simplify.cuts_lines,
                    "Cut facets along seams and borders of labels, so that none straddles one");
  add_shell(*command, simplify,
            "begins at the tolerance, or else at 1%, and is adapted to the tolerance or the number of facets");
  add_limits(*command, simplify, threads);
  add_common(*command, writes_json,
             "  bspline_shell simplify scan.obj -o small.obj --tolerance 0.5%\n"
             "  bspline_shell simplify part.stl -o part.ply --facets 10000\n"
             "  bspline_shell simplify terrain.ply -o coarse.ply --tolerance 2 --border 2\n"
             "  bspline_shell simplify - -o - --ratio 0.1 < scan.ply > small.ply\n");
  command->callback([&] { outcome = Tool::simplify(simplify, writes_json); });

  Tool::Remesh_options remesh;
  command = program.add_subcommand("remesh",
                                   "Remesh a mesh to edges of about one length, and keep its attributes." + lengths);
  add_edit(*command, remesh);
  add_length(*command, "--edge", remesh.edge, "Length of edges");
  command->get_option("--edge")->required();
  command
    ->add_option("--features", remesh.feature,
                 "Keep edges with a larger angle between the normals of their facets, in degrees")
    ->type_name("ANGLE")
    ->check(CLI::Range(0., 180.))
    ->capture_default_str();
  add_shell(*command, remesh, "as required by the tolerance; without one, 1%");
  add_limits(*command, remesh, threads);
  add_common(*command, writes_json, "  bspline_shell remesh part.ply -o even.ply --edge 1% --features 40\n");
  command->callback([&] { outcome = Tool::remesh(remesh, writes_json); });

  Tool::Transfer_options transfer;
  command = program.add_subcommand("transfer", "Transfer the attributes of one mesh to another." + lengths);
  add_shell(*command, transfer, "as required by the distance of TO", "FROM", "The mesh with attributes");
  command->add_option("TO", transfer.to, "The mesh that gets them; its points and polygons are kept")->required();
  add_output(*command, transfer.output);
  add_view(*command, transfer.view, "both meshes, the shell, and the map between them");
  command->add_flag("--normals", transfer.includes_normals, "Transfer normals as well");
  command
    ->add_option("--bake", transfer.image, "Bake colors of FROM into this PNG file, over texture coordinates of TO")
    ->type_name("IMAGE");
  command->add_option("--bake-normals", transfer.normal_image, "Bake normals of FROM, in its coordinates")
    ->type_name("IMAGE");
  command->add_option("--size", transfer.size, "Number of texels along each side of the image")
    ->type_name("PIXELS")
    ->check(CLI::Range(1, 16384))
    ->capture_default_str();
  command->add_option("--margin", transfer.margin, "Number of texels that are filled around charts")
    ->type_name("PIXELS")
    ->check(CLI::Range(0, 1024))
    ->capture_default_str();
  add_limits(*command, transfer, threads);
  add_common(*command, writes_json,
             "  bspline_shell transfer scan.obj retopology.obj -o result.obj\n"
             "  bspline_shell transfer scan.ply unwrapped.obj -o result.obj --bake colors.png --size 2048\n");
  command->callback([&] { outcome = Tool::transfer(transfer, writes_json); });

  Tool::Shell_options shell;
  std::string prefix, page;
  command = program.add_subcommand(
    "shell",
    "Build a certified shell, and write it with its surfaces and its proof.\n"
    "  PREFIX.shell                 the shell, for the command certify and the library's function read_shell()\n"
    "  PREFIX.json                  report on the file, its repairs, and the shell\n"
    "  PREFIX_mesh.ply              the mesh of the shell: the mesh of the file, the part of it without\n"
    "                               excised triangles, the union of its parts, or a proxy\n"
    "  PREFIX_{inner,outer}.ply     the surfaces that bound the shell\n"
    "  PREFIX_excised.ply           excised triangles, if any\n"
    "  PREFIX_soup.ply              if there is a proxy, the triangles of the file: green where they are\n"
    "                               mapped along curves, yellow where they are mapped to the nearest point,\n"
    "                               gray where the proxy hides them\n"
    "  PREFIX.shell.txt, PREFIX.mesh.off, PREFIX.certificate.txt\n"
    "                               the proof, for an independent checker\n"
    "If the shell is not certified:\n"
    "  PREFIX_failed.json           the report\n"
    "  PREFIX_failed_mesh.ply       the mesh\n"
    "  PREFIX_failed_places.ply     points where the proof fails\n"
    "If it is certified, all files of an earlier run with this prefix are replaced or removed; otherwise, only\n"
    "those whose names begin with PREFIX_failed."
      + lengths);
  add_shell(*command, shell, "1%");
  command->add_option("-o,--output", prefix, "Prefix of the names of the files")->required()->type_name("PREFIX");
  add_view(*command, page, "the mesh and the shell, or the places where the proof fails");
  add_limits(*command, shell, threads);
  add_common(*command, writes_json, "  bspline_shell shell part.stl -o part\n");
  command->callback([&] { outcome = Tool::shell(shell, prefix, page, writes_json); });

  Tool::Check_options check;
  command = program.add_subcommand(
    "check", "Describe a file: its attributes, its defects, and the shell that it can have." + lengths);
  add_shell(*command, check, "1%");
  command
    ->add_option("--distance", check.other,
                 "Prove bounds on the one-sided Hausdorff distances to the surface of another file and back")
    ->type_name("MESH");
  add_common(*command, writes_json,
             "  bspline_shell check part.stl --thickness 0.2\n"
             "  bspline_shell check part.stl --distance part_of_supplier.stl\n");
  command->callback([&] { outcome = Tool::check(check, writes_json); });

  std::string shell_file, mesh_file;
  command = program.add_subcommand(
    "certify", "Prove that a mesh lies in a shell and is mapped one-to-one.\n"
               "The claims:\n"
               "  containment      the mesh lies in the shell\n"
               "  transversality   each facet faces along the curves that lead through the shell\n"
               "  gradient         no curve ends within the shell\n"
               "  one_sheet        each part of the shell contains one part of the mesh\n"
               "  degree_one       a path from the inner to the outer surface crosses the mesh once");
  command->add_option("SHELL", shell_file, "The file PREFIX.shell that the command shell has written")->required();
  command->add_option("MESH", mesh_file, "The mesh")->required();
  add_common(*command, writes_json,

             "  bspline_shell shell part.ply -o part\n"
             "  bspline_shell certify part.shell part_remeshed.ply\n");
  command->callback([&] { outcome = Tool::certify(shell_file, mesh_file, writes_json); });

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
  return Tool::report(outcome, writes_json);
}
