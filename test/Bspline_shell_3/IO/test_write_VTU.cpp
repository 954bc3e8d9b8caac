// write_VTU.h: the file represents the field.
#include <CGAL/Bspline_shell_3/IO/write_VTU.h>
#include "shell_files.h"

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <locale>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace test_write_VTU {
namespace {

typedef boost::property_tree::ptree Tree;

template <typename T>
std::vector<T> numbers_of(const std::string& text)
{
  std::istringstream in(text);
  std::vector<T> numbers;
  for(T x; in >> x;) numbers.push_back(x);
  CHECK(in.eof());
  return numbers;
}

// The arrays of a VTU file in text, by name.
struct Grid
{
  explicit Grid(const std::string& xml)
  {
    std::istringstream in(xml);
    Tree tree;
    REQUIRE_NOTHROW(boost::property_tree::read_xml(in, tree));
    const Tree& file = tree.get_child("VTKFile");
    CHECK(file.get<std::string>("<xmlattr>.type") == "UnstructuredGrid");
    CHECK(file.get<std::string>("<xmlattr>.version") == "2.2"); // the order of control points depends on this version
    const Tree& piece = file.get_child("UnstructuredGrid.Piece");
    points = piece.get<std::size_t>("<xmlattr>.NumberOfPoints");
    cells = piece.get<std::size_t>("<xmlattr>.NumberOfCells");
    CHECK(piece.get<std::string>("PointData.<xmlattr>.Scalars") == "f");
    CHECK(piece.get<std::string>("CellData.<xmlattr>.HigherOrderDegrees") == "HigherOrderDegrees");
    std::map<std::string, std::string> arrays;
    for(const char* part : { "PointData", "CellData", "Points", "Cells" })
      for(const auto& child : piece.get_child(part))
        if(child.first == "DataArray") arrays[child.second.get<std::string>("<xmlattr>.Name")] = child.second.data();
    f = numbers_of<double>(arrays["f"]);
    inner = numbers_of<double>(arrays["inner"]);
    outer = numbers_of<double>(arrays["outer"]);
    positions = numbers_of<double>(arrays["Points"]);
    degrees = numbers_of<double>(arrays["HigherOrderDegrees"]);
    connectivity = numbers_of<std::int64_t>(arrays["connectivity"]);
    offsets = numbers_of<std::int64_t>(arrays["offsets"]);
    types = numbers_of<int>(arrays["types"]);
    const auto data = file.get_child_optional("UnstructuredGrid.FieldData.DataArray");
    if(data) levels = numbers_of<double>(data->data());
  }

  std::size_t points, cells;
  std::vector<double> f, inner, outer, positions, degrees, levels;
  std::vector<std::int64_t> connectivity, offsets;
  std::vector<int> types;
};

template <typename T>
void append(std::string& bytes, const std::vector<T>& numbers)
{
  bytes += as_bytes(std::uint64_t(numbers.size() * sizeof(T)));
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
}

// Returns which coefficient of a cell belongs to the control point at a position, or -1.
template <typename Cell>
int control_point(const Cell& cell, const double* position)
{
  int index = 0;
  for(std::size_t a = 0; a < 3; ++a) {
    const double step = 3 * (position[a] - cell.corner()[a]) / cell.width();
    if(!(std::abs(step - std::round(step)) < 1e-9 && step > -0.5 && step < 3.5)) return -1;
    index += int(std::round(step)) << 2 * a;
  }
  return index;
}

} // namespace

TEST_CASE("VTU: a file has the cells of the shell as Bezier hexahedra, with values of f at their control points")
{
  const Shell shell = CGAL::bspline_shell_3(sphere(2), CGAL::Bspline_shells::parameters::resolution(10));
  REQUIRE(shell);
  const Field& field = shell.field();
  for(bool whole_field : { false, true }) {
    std::ostringstream out;
    REQUIRE((whole_field ? BS::write_VTU(out, field, Format::ASCII) : BS::write_VTU(out, shell, Format::ASCII))
            == Status::SUCCESS);
    const Grid grid(out.str());
    std::vector<Field::Cell_index> cells;
    for(Field::Cell_index c = 0; c < field.number_of_cells(); ++c)
      if(whole_field || shell.shell_cells()[c]) cells.push_back(c);
    REQUIRE(grid.cells == cells.size());
    REQUIRE(cells.size() > 50);
    CHECK(grid.types == std::vector<int>(cells.size(), 79));
    CHECK(grid.degrees == std::vector<double>(3 * cells.size(), 3.));
    REQUIRE(grid.f.size() == grid.points);
    REQUIRE(grid.positions.size() == 3 * grid.points);
    REQUIRE(grid.connectivity.size() == 64 * cells.size());
    REQUIRE(grid.offsets.size() == cells.size());
    if(whole_field) CHECK(grid.levels.empty());
    else CHECK(grid.levels == std::vector<double>{ shell.inner_level(), shell.outer_level() });

    bool offsets = true, points = true, values = true, corners = true, interpolates = true;
    const double rounding = 1e-15;
    // VTK's order of corners, followed by samples: points of an edge along z, of faces, and of the interior
    const int order[][4] = { { 0, 0, 0, 0 },  { 1, 3, 0, 0 },  { 2, 3, 3, 0 }, { 3, 0, 3, 0 },  { 4, 0, 0, 3 },
                             { 5, 3, 0, 3 },  { 6, 3, 3, 3 },  { 7, 0, 3, 3 }, { 28, 3, 3, 1 }, { 31, 0, 3, 2 },
                             { 32, 0, 1, 1 }, { 41, 2, 0, 1 }, { 57, 2, 1, 1 } };
    for(std::size_t n = 0; n < cells.size(); ++n) {
      const auto cell = field.cell(cells[n]);
      offsets = offsets && grid.offsets[n] == std::int64_t(64 * (n + 1));
      std::set<std::int64_t> different;
      for(std::size_t v = 0; v < 64; ++v) {
        const std::int64_t point = grid.connectivity[64 * n + v];
        REQUIRE(point >= 0);
        REQUIRE(std::size_t(point) < grid.points);
        different.insert(point);
        const int index = control_point(cell, &grid.positions[3 * std::size_t(point)]);
        REQUIRE(index >= 0);
        values = values && grid.f[std::size_t(point)] == cell.coefficients()[index];
      }
      points = points && different.size() == 64;
      for(const auto& o : order) {
        const std::size_t point = std::size_t(grid.connectivity[64 * n + std::size_t(o[0])]);
        for(std::size_t a = 0; a < 3; ++a) {
          const double expected = cell.corner()[a] + o[1 + a] * cell.width() / 3;
          corners = corners && std::abs(grid.positions[3 * point + a] - expected) < rounding;
        }
        if(o[0] < 8) {
          const double* p = &grid.positions[3 * point];
          interpolates = interpolates
                         && std::abs(grid.f[point] - field.value(Point_3(p[0], p[1], p[2])).value()) < rounding;
        }
      }
    }
    CHECK(offsets);
    CHECK(points);
    CHECK(values);
    CHECK(corners);
    CHECK(interpolates);
    // Neighbors share their points: positions are unique, and every point is used.
    std::set<std::array<double, 3> > positions;
    for(std::size_t p = 0; p < grid.points; ++p)
      positions.insert({ grid.positions[3 * p], grid.positions[3 * p + 1], grid.positions[3 * p + 2] });
    CHECK(positions.size() == grid.points);
    CHECK(std::set<std::int64_t>(grid.connectivity.begin(), grid.connectivity.end()).size() == grid.points);

    // The binary file has the same numbers, one array after the other, at the offsets in the XML.
    std::ostringstream binary;
    REQUIRE((whole_field ? BS::write_VTU(binary, field) : BS::write_VTU(binary, shell)) == Status::SUCCESS);
    const std::string bytes = binary.str();
    std::string expected;
    std::vector<std::size_t> begins;
    const auto add = [&](const auto& numbers) {
      begins.push_back(expected.size());
      append(expected, numbers);
    };
    add(grid.f);
    add(grid.degrees);
    add(grid.positions);
    add(grid.connectivity);
    add(grid.offsets);
    add(std::vector<std::uint8_t>(grid.types.begin(), grid.types.end()));
    const std::string mark = "<AppendedData encoding=\"raw\">\n_", end = "\n</AppendedData>\n</VTKFile>\n";
    const std::size_t begin = bytes.find(mark);
    REQUIRE(begin != std::string::npos);
    CHECK(bytes.substr(begin + mark.size()) == expected + end);
    const std::string xml = bytes.substr(0, begin) + "</VTKFile>\n";
    CHECK(xml.find("byte_order=\"LittleEndian\" header_type=\"UInt64\"") != std::string::npos);
    std::size_t position = 0;
    for(std::size_t offset : begins) {
      position = xml.find("offset=\"" + std::to_string(offset) + "\"", position);
      CHECK(position != std::string::npos);
    }
    Tree tree;
    std::istringstream in(xml);
    CHECK_NOTHROW(boost::property_tree::read_xml(in, tree));
  }
}

TEST_CASE("VTU: cells may have different sizes, and control points have the values of varying thresholds")
{
  const Varying_shell shell = small_varying_shell();
  const Varying_shell::Field& field = shell.field();
  std::ostringstream out;
  REQUIRE(BS::write_VTU(out, shell, Format::ASCII) == Status::SUCCESS);
  const Grid grid(out.str());
  REQUIRE(grid.cells == field.number_of_cells() - 1); // the first cell is not marked
  CHECK(grid.levels.empty());
  REQUIRE(grid.f.size() == grid.points);
  REQUIRE(grid.inner.size() == grid.points);
  REQUIRE(grid.outer.size() == grid.points);
  // A large cell, and a block of 6 x 2 x 2 small cells that share control points.
  CHECK(grid.points == 64 + (3 * 6 + 1) * (3 * 2 + 1) * (3 * 2 + 1));
  std::size_t wrong = 0;
  for(std::size_t n = 0; n < grid.cells; ++n) {
    const Field::Cell_index c = Field::Cell_index(n + 1);
    const auto cell = field.cell(c);
    for(std::size_t v = 0; v < 64; ++v) {
      const std::size_t point = std::size_t(grid.connectivity[64 * n + v]);
      const int index = control_point(cell, &grid.positions[3 * point]);
      REQUIRE(index >= 0);
      wrong += grid.f[point] != cell.coefficients()[index];
      wrong += grid.inner[point] != shell.inner_threshold().field().cell(c).coefficients()[index];
      wrong += grid.outer[point] != shell.outer_threshold().field().cell(c).coefficients()[index];
    }
  }
  CHECK(wrong == 0);
  std::ostringstream binary;
  CHECK(BS::write_VTU(binary, shell) == Status::SUCCESS);
  CHECK(binary.str().find("Name=\"outer\"") != std::string::npos);
  std::ostringstream whole;
  CHECK(BS::write_VTU(whole, field, Format::ASCII) == Status::SUCCESS);
  CHECK(Grid(whole.str()).cells == field.number_of_cells());
}

TEST_CASE("VTU: locales and stream flags do not affect the output")
{
  const Shell shell = small_shell();
  std::ostringstream plain;
  REQUIRE(BS::write_VTU(plain, shell, Format::ASCII) == Status::SUCCESS);
  const std::locale foreign(std::locale::classic(), new Foreign_numbers), before = std::locale::global(foreign);
  std::ostringstream out;
  out.setf(std::ios::hex | std::ios::showpos | std::ios::fixed);
  out.precision(3);
  out.width(50);
  CHECK(BS::write_VTU(out, shell, Format::ASCII) == Status::SUCCESS);
  std::locale::global(before);
  CHECK(out.str() == plain.str());
}

TEST_CASE("VTU: a file is written completely, or the previous file is kept")
{
  const Shell shell = small_shell();
  const Temporary_file vtu("small.vtu");
  CHECK(BS::write_VTU(vtu.name, shell) == Status::SUCCESS);
  CHECK(contents(vtu.name).substr(0, 5) == "<?xml");
  CHECK_FALSE(std::ifstream(vtu.name + ".part"));
  // An empty shell is not written, and does not replace a file.
  CHECK(BS::write_VTU(vtu.name, Shell()) == Status::NOT_A_SHELL);
  CHECK(contents(vtu.name).substr(0, 5) == "<?xml");
  CHECK_FALSE(std::ifstream(vtu.name + ".part"));
  std::ostringstream out;
  CHECK(BS::write_VTU(out, Shell()) == Status::NOT_A_SHELL);
  CHECK(out.str().empty());
  CHECK(BS::write_VTU("none.vtu", Shell()) == Status::NOT_A_SHELL);
  CHECK_FALSE(std::ifstream("none.vtu"));

  CHECK(BS::write_VTU("no_such_folder/small.vtu", shell) == Status::CANNOT_WRITE);
  for(std::size_t capacity : { 0, 100, 800 })
    for(Format format : { Format::BINARY, Format::ASCII }) {
      Full_disk disk(capacity);
      std::ostream full(&disk);
      CHECK(BS::write_VTU(full, shell, format) == Status::CANNOT_WRITE);
    }
}
} // namespace test_write_VTU
