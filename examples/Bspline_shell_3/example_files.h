// Shared by examples with files: the command line, error messages, and atomic writing of files.
#ifndef EXAMPLE_FILES_H
#define EXAMPLE_FILES_H

#include <CGAL/Bspline_shell_3/IO/Shell_file_status.h>
#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>
#include <CGAL/Bspline_shell_3/IO/write_file.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/PLY.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace BS = CGAL::Bspline_shells;

// Parses a command line into strings, positive numbers (double, std::size_t), nonnegative integers (int), and flags.
class Arguments
{
public:
  static constexpr int wrong_usage = 2;

  explicit Arguments(std::string usage) : m_usage(std::move(usage)) {}

  template <typename T>
  Arguments& required(T& value)
  {
    ++m_required;
    return optional(value);
  }
  template <typename T>
  Arguments& optional(T& value)
  {
    m_positional.push_back([&value](const std::string& text) { return set(value, text); });
    return *this;
  }
  template <typename T>
  Arguments& option(const std::string& name, T& value)
  {
    m_options.push_back({ name, [&value](const std::string& text) { return set(value, text); } });
    return *this;
  }
  Arguments& flag(const std::string& name, bool& value)
  {
    m_flags.push_back({ name, [&value](const std::string&) { return value = true; } });
    return *this;
  }

  // Returns the exit code if the program has to end: after --help, or after an error message.
  std::optional<int> read(int argc, char** argv) const
  {
    std::size_t positional = 0;
    for(int i = 1; i < argc; ++i) {
      const std::string arg = argv[i];
      if(arg == "--help" || arg == "-h") {
        std::cout << m_usage << std::flush;
        return EXIT_SUCCESS;
      }
      const auto is_named = [&](const Option& option) { return option.first == arg; };
      const auto flag = std::find_if(m_flags.begin(), m_flags.end(), is_named);
      const auto option = std::find_if(m_options.begin(), m_options.end(), is_named);
      if(flag != m_flags.end()) flag->second(arg);
      else if(option != m_options.end()) {
        if(++i == argc) return wrong(arg + " needs a value.");
        if(!option->second(argv[i])) return wrong(arg + " cannot be " + argv[i] + ".");
      } else if(arg.size() > 1 && arg[0] == '-') return wrong("Unknown option: " + arg + ".");
      else if(positional == m_positional.size()) return wrong("There are too many arguments: " + arg + ".");
      else if(!m_positional[positional++](arg)) return wrong(arg + " is not a valid argument.");
    }
    return positional < m_required ? wrong("An argument is missing.") : std::nullopt;
  }
  std::optional<int> wrong(const std::string& what) const
  {
    std::cerr << what << "\n" << m_usage << std::flush;
    return wrong_usage;
  }

private:
  typedef std::function<bool(const std::string&)> Setter;
  typedef std::pair<std::string, Setter> Option;

  static bool set(std::string& value, const std::string& text)
  {
    value = text;
    return !text.empty();
  }
  static bool set(double& value, const std::string& text)
  {
    char* end;
    const double x = std::strtod(text.c_str(), &end);
    if(*end != '\0' || !std::isfinite(x) || x <= 0) return false;
    value = x;
    return true;
  }
  static bool set(std::size_t& value, const std::string& text)
  {
    if(text.size() > 18 || text.find_first_not_of("0123456789") != text.npos) return false;
    value = std::strtoul(text.c_str(), nullptr, 10);
    return value > 0;
  }

  static bool set(int& value, const std::string& text)
  {
    if(text.empty() || text.size() > 9 || text.find_first_not_of("0123456789") != text.npos) return false;
    value = std::atoi(text.c_str());
    return true;
  }

  std::string m_usage;
  std::vector<Setter> m_positional;
  std::vector<Option> m_options, m_flags;
  std::size_t m_required = 0;
};

// Lists the first ten facets or vertices.
inline void list_places(std::ostream& out, const char* kind, const std::vector<std::size_t>& places)
{
  if(places.empty()) return;
  out << kind << ":";
  for(std::size_t i = 0; i < (std::min)(places.size(), std::size_t(10)); ++i) out << " " << places[i];
  out << (places.size() > 10 ? " ... (" + std::to_string(places.size()) + " in total)" : "") << std::endl;
}

// Prints a message with its file and line, followed by the facets and vertices concerned.
inline void complain(const std::string& message, const BS::Offending_simplices& offenders,
                     const std::string& file = std::string())
{
  if(!file.empty()) std::cerr << file << (offenders.line > 0 ? ", line " + std::to_string(offenders.line) : "") << ": ";
  std::cerr << message << std::endl;
  list_places(std::cerr, "facets", offenders.facets);
  list_places(std::cerr, "vertices", offenders.vertices);
}

// Reads a triangle mesh, or prints a message.
template <typename Mesh>
bool read_mesh(const std::string& file, Mesh& mesh)
{
  BS::Offending_simplices offenders;
  const BS::Shell_status status = BS::read_triangle_mesh(file, mesh, offenders);
  if(status != BS::Shell_status::SUCCESS) complain(message(status), offenders, file);
  return status == BS::Shell_status::SUCCESS;
}

// Returns `success`, and prints a message if it is false.
inline bool is_written(bool success, const std::string& file)
{
  if(!success) std::cerr << file << ": " << message(BS::Shell_file_status::CANNOT_WRITE) << std::endl;
  return success;
}

// Writes a complete file, or no file and a message.
template <typename Writer>
bool write_result(const std::string& file, const Writer& write)
{
  return is_written(BS::write_file(file, write), file);
}

// Writes text in OFF or PLY, depending on the file name.
template <typename Mesh>
bool save(const std::string& file, const Mesh& mesh)
{
  const bool is_OFF = file.size() > 4 && file.compare(file.size() - 4, 4, ".off") == 0;
  return write_result(file, [&](std::ostream& out) {
    out.precision(17);
    return is_OFF ? bool(out << mesh) : CGAL::IO::write_PLY(out, mesh, CGAL::parameters::stream_precision(17));
  });
}

#endif // EXAMPLE_FILES_H
