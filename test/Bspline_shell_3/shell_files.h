// Shells with short files, files as lines and bytes, and failing devices.
#ifndef SHELL_FILES_H
#define SHELL_FILES_H

#include "temporary_files.h"
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/IO/read_shell.h>
#include <CGAL/Bspline_shell_3/IO/write_shell.h>
#include <CGAL/bspline_shell_3.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Random.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <locale>
#include <sstream>
#include <streambuf>
#include <string>
#include <vector>

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Bspline_shell_3<> Shell;
typedef Shell::Field Field;
typedef CGAL::Certified_bspline_shell_3 Varying_shell;
typedef BS::Shell_file_status Status;
typedef BS::Shell_format Format;

// --- shells

struct Cell_point
{
  int i, j, k;
};

template <typename Any_field>
BS::Shell_report report_of(const Any_field& field)
{
  BS::Shell_report report;
  report.status = BS::Shell_status::SUCCESS;
  report.unit = 3.7;
  report.gamma = report.unit / field.cells().lattice().spacing();
  report.triangles = 20;
  report.components = 1;
  report.cells = field.number_of_cells();
  report.unknowns = field.number_of_coefficients();
  return report;
}

inline Shell shell_on(const BS::Lattice_3& lattice, const std::vector<Cell_point>& points,
                      const std::function<double(std::size_t)>& coefficient)
{
  std::vector<std::uint64_t> keys;
  for(const Cell_point& p : points) keys.push_back(BS::Lattice_key::encode(p.i, p.j, p.k));
  BS::sort_unique(keys);
  Field field{ BS::Cell_complex_3(lattice, keys) };
  Eigen::VectorXd x(Eigen::Index(field.number_of_coefficients()));
  for(Eigen::Index n = 0; n < x.size(); ++n) x[n] = coefficient(std::size_t(n));
  field.set_coefficients(x);
  std::vector<char> cells(keys.size(), 1);
  cells.front() = 0;
  const BS::Shell_report report = report_of(field);
  return Shell(field, BS::Level_range{ -0.1, 1. / 3 }, cells,
               std::vector<BS::Level_range>(3, BS::Level_range{ -0.05, 0.3 }), report);
}

// Returns a shell of two cells and 80 functions. Its file is short enough for exhaustive tests.
inline Shell small_shell()
{
  CGAL::Random random(7);
  return shell_on(BS::Lattice_3(CGAL::Bbox_3(-1, -2, 0, 2, 1, 5), 0.3), { { -1, 0, 2 }, { 0, 0, 2 } },
                  [&](std::size_t) { return random.get_double(-1, 1); });
}

// Returns another shell, which must not change when a file is refused.
inline Shell other_shell()
{
  const BS::Lattice_3 lattice(CGAL::Bbox_3(0, 0, 0, 1, 1, 1), 0.25);
  return shell_on(lattice, { { 0, 0, 0 } }, [](std::size_t n) { return double(n); });
}

// Returns a row of root cells, the first three of which are split, with varying thresholds.
inline Varying_shell small_varying_shell()
{
  typedef Varying_shell::Field Varying_field;
  std::vector<std::uint64_t> keys;
  for(int i = -2; i < 3; ++i) keys.push_back(BS::Lattice_key::encode(i, 1, 0));
  const BS::Lattice_3 lattice(CGAL::Bbox_3(-1, -2, 0, 2, 1, 5), 0.3);
  Varying_field field(BS::Cell_hierarchy_3(BS::Cell_complex_3(lattice, keys)).refined({ 0 }));
  CGAL::Random random(7);
  const auto spline = [&](double least, double most) {
    Varying_field result = field;
    Eigen::VectorXd x(Eigen::Index(field.number_of_coefficients()));
    for(Eigen::Index n = 0; n < x.size(); ++n) x[n] = random.get_double(least, most);
    result.set_coefficients(x);
    return result;
  };
  BS::Shell_report report = report_of(field);
  report.thickness = 0.3;
  std::vector<char> cells(field.number_of_cells(), 1);
  cells.front() = 0;
  return Varying_shell(spline(-1, 1), Varying_shell::Threshold(spline(-0.3, -0.1)),
                       Varying_shell::Threshold(spline(0.1, 0.3)), cells,
                       std::vector<BS::Level_range>(3, BS::Level_range{ -0.05, 0.3 }), report);
}

template <typename T>
bool same_bits(const T& a, const T& b)
{
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

inline bool same_bits(const BS::Level_range& a, const BS::Level_range& b)
{
  return same_bits(a.min, b.min) && same_bits(a.max, b.max);
}

template <typename Any_field>
bool same_fields(const Any_field& f, const Any_field& g)
{
  bool equal = f.number_of_cells() == g.number_of_cells() && f.number_of_coefficients() == g.number_of_coefficients()
               && f.number_of_levels() == g.number_of_levels()
               && same_bits(f.cells().lattice().origin(), g.cells().lattice().origin())
               && same_bits(f.cells().lattice().spacing(), g.cells().lattice().spacing())
               && f.cells().lattice().is_exact() == g.cells().lattice().is_exact();
  for(Field::Cell_index n = 0; equal && n < f.number_of_coefficients(); ++n)
    equal = same_bits(f.coefficients()[n], g.coefficients()[n])
            && f.point_of_coefficient(n) == g.point_of_coefficient(n);
  for(int l = 0; equal && l < f.number_of_levels(); ++l) {
    equal = f.points(l).size() == g.points(l).size();
    for(Field::Cell_index n = 0; equal && n < f.points(l).size(); ++n)
      equal = f.points(l).point(n) == g.points(l).point(n);
  }
  for(Field::Cell_index c = 0; equal && c < f.number_of_cells(); ++c) {
    equal = f.cells().lattice_point(c) == g.cells().lattice_point(c) && f.cells().level(c) == g.cells().level(c)
            && same_bits(f.cell(c).corner(), g.cell(c).corner()) && same_bits(f.cell(c).width(), g.cell(c).width())
            && same_bits(f.cell(c).error_radius(), g.cell(c).error_radius());
    for(int n = 0; n < 64; ++n) equal = equal && same_bits(f.cell(c).coefficients()[n], g.cell(c).coefficients()[n]);
  }
  return equal;
}

template <typename Any_shell>
bool same(const Any_shell& a, const Any_shell& b)
{
  if(a.status() != b.status() || !a) return a.status() == b.status();
  bool equal = same_fields(a.field(), b.field()) && a.shell_cells() == b.shell_cells()
               && a.facet_ranges().size() == b.facet_ranges().size() && same_bits(a.thickness(), b.thickness());
  if constexpr(Any_shell::Threshold::is_constant)
    equal = equal && same_bits(a.inner_level(), b.inner_level()) && same_bits(a.outer_level(), b.outer_level());
  else
    equal = equal && same_fields(a.inner_threshold().field(), b.inner_threshold().field())
            && same_fields(a.outer_threshold().field(), b.outer_threshold().field());
  for(std::size_t n = 0; equal && n < a.facet_ranges().size(); ++n)
    equal = same_bits(a.facet_ranges()[n], b.facet_ranges()[n]);
  const BS::Shell_report &r = a.report(), &s = b.report();
  return equal && same_bits(r.unit, s.unit) && same_bits(r.gamma, s.gamma) && r.triangles == s.triangles
         && r.components == s.components && r.cells == s.cells && r.unknowns == s.unknowns;
}

// --- files

template <typename Any_shell>
std::string written(const Any_shell& shell, Format format)
{
  std::ostringstream out;
  REQUIRE(BS::write_shell(out, shell, format) == Status::SUCCESS);
  return out.str();
}

template <typename Any_shell>
Status read(const std::string& bytes, Any_shell& shell)
{
  std::istringstream in(bytes);
  return BS::read_shell(in, shell);
}

// Returns CRC-64/XZ, computed bit by bit.
inline std::uint64_t slow_checksum(const std::string& bytes)
{
  std::uint64_t crc = ~std::uint64_t(0);
  for(char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    // the reflected polynomial
    for(int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) ? 0xC96C5795D7870F42ull : 0);
  }
  return ~crc;
}

inline std::string checksum_line(const std::string& text)
{
  char line[40];
  std::snprintf(line, sizeof(line), "checksum %016llx\n", static_cast<unsigned long long>(slow_checksum(text)));
  return line;
}

inline std::string as_bytes(std::uint64_t x)
{
  std::string bytes;
  for(int n = 0; n < 8; ++n) bytes += char((x >> (8 * n)) & 0xff);
  return bytes;
}

inline std::string as_bytes(double x)
{
  std::uint64_t bits;
  std::memcpy(&bits, &x, 8);
  return as_bytes(bits);
}

template <typename T>
T at(const std::string& bytes, std::size_t offset)
{
  REQUIRE(offset + sizeof(T) <= bytes.size());
  T x;
  std::memcpy(&x, &bytes[offset], sizeof(T)); // assumes a little-endian machine, like the files
  return x;
}

// The lines of a text file, without the last one. `text_of()` appends a matching checksum.
typedef std::vector<std::string> Lines;

inline Lines lines_of(const std::string& text)
{
  Lines lines;
  std::istringstream in(text);
  for(std::string line; std::getline(in, line);) lines.push_back(line);
  lines.pop_back();
  return lines;
}

inline std::string text_of(const Lines& lines)
{
  std::string text;
  for(const std::string& line : lines) text += line + "\n";
  return text + checksum_line(text);
}

inline std::vector<std::string> words_of(const std::string& line)
{
  std::istringstream in(line);
  return std::vector<std::string>(std::istream_iterator<std::string>(in), std::istream_iterator<std::string>());
}

// Returns the line with another word at a position.
inline std::string with_word(const std::string& line, std::size_t position, const std::string& word)
{
  std::vector<std::string> words = words_of(line);
  words.at(position) = word;
  std::string changed = words[0];
  for(std::size_t n = 1; n < words.size(); ++n) changed += " " + words[n];
  return changed;
}

inline std::size_t line_that_begins_with(const Lines& lines, const std::string& text)
{
  for(std::size_t n = 0; n < lines.size(); ++n)
    if(lines[n].compare(0, text.size(), text) == 0) return n;
  FAIL("no such line: " + text);
  return 0;
}

// Numbers with a decimal comma and grouped digits.
struct Foreign_numbers : std::numpunct<char>
{
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

// A disk that becomes full.
struct Full_disk : std::streambuf
{
  explicit Full_disk(std::size_t capacity) : left(capacity) {}
  std::streamsize xsputn(const char*, std::streamsize size) override
  {
    const std::size_t fits = (std::min)(left, std::size_t(size));
    left -= fits;
    return std::streamsize(fits);
  }
  int_type overflow(int_type c) override { return left == 0 ? traits_type::eof() : (--left, traits_type::not_eof(c)); }
  std::size_t left;
};

#endif // SHELL_FILES_H
