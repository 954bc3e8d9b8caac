// write_shell.h, write_file.h: the text and the bytes follow the format; files are complete, or not written.
#include <CGAL/Bspline_shell_3/IO/write_shell.h>
#include "shell_files.h"

#include <CGAL/Random.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <locale>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace test_write_shell {
namespace {

// Returns the value of the uniform cubic B-spline.
double b(double t)
{
  t = std::abs(t);
  return t >= 2 ? 0 : t >= 1 ? std::pow(2 - t, 3) / 6 : 2. / 3 - t * t + t * t * t / 2;
}

} // namespace

TEST_CASE("Shell files: the text follows the format")
{
  const Shell shell = small_shell();
  const Field& field = shell.field();
  const std::string text = written(shell, Format::ASCII);
  const Lines lines = lines_of(text);
  CHECK(text_of(lines) == text);
  REQUIRE(lines.size() == 5 + 1 + 80 + 1 + 2 + 1 + 3 + 4);
  CHECK(Lines(lines.begin(), lines.begin() + 4)
        == Lines{ "cubic_bspline_shell 5 ascii", "unit 3.7000000000000002",
                  "levels -0.10000000000000001 0.33333333333333331", "triangles 20 components 1" });
  CHECK(lines[5] == "functions 80");
  const std::string range = "-0.050000000000000003 0.29999999999999999";
  CHECK(Lines(lines.begin() + 86, lines.end())
        == Lines{ "leaves 2", "0 -1 0 2 0", "0 0 0 2 1", "facet_ranges 3", range, range, range, "closing 0 0 0",
                  "paths 0", "truncation", "0 0 0 0 0 0" });

  std::string word, kind;
  double origin[3], spacing;
  std::istringstream(lines[4]) >> word >> kind >> origin[0] >> origin[1] >> origin[2] >> spacing;
  CHECK(kind == "hierarchical");
  CHECK(spacing == field.cells().lattice().spacing());
  // Compute f from the functions alone, as a sum of B-splines centered at lattice points.
  CGAL::Random random(5);
  for(Field::Cell_index c = 0; c < 2; ++c)
    for(int s = 0; s < 20; ++s) {
      std::array<double, 3> p;
      for(std::size_t a = 0; a < 3; ++a) p[a] = field.cell(c).corner()[a] + random.get_double() * spacing;
      double f = 0;
      for(std::size_t n = 6; n < 86; ++n) {
        int level, ijk[3];
        double term;
        std::istringstream(lines[n]) >> level >> ijk[0] >> ijk[1] >> ijk[2] >> term;
        CHECK(level == 0);
        for(int a = 0; a < 3; ++a) term *= b((p[std::size_t(a)] - (origin[a] + ijk[a] * spacing)) / spacing);
        f += term;
      }
      CHECK(f == Approx(field.value(Point_3(p[0], p[1], p[2])).value()).margin(1e-14));
    }
}

TEST_CASE("Shell files: the text of a hierarchy with varying thresholds follows the format")
{
  const Varying_shell shell = small_varying_shell();
  const Varying_shell::Field& field = shell.field();
  const std::string text = written(shell, Format::ASCII);
  const Lines lines = lines_of(text);
  CHECK(text_of(lines) == text);
  REQUIRE(field.number_of_cells() == 2 + 24);
  const std::size_t functions = field.number_of_coefficients();
  REQUIRE(lines.size() == 5 + 1 + functions + 1 + 26 + 1 + 3 + 4);
  CHECK(lines[0] == "cubic_bspline_shell 5 ascii");
  CHECK(lines[2] == "thickness 0.29999999999999999");
  CHECK(lines[5] == "functions " + std::to_string(functions));
  const auto leaves = lines.begin() + std::ptrdiff_t(6 + functions);
  CHECK(Lines(leaves, leaves + 4) == Lines{ "leaves 26", "0 1 1 0 0", "0 2 1 0 1", "1 -4 2 0 1" });

  std::string word, kind;
  double origin[3], spacing;
  std::istringstream(lines[4]) >> word >> kind >> origin[0] >> origin[1] >> origin[2] >> spacing;
  CHECK(kind == "hierarchical");
  // Coefficients that are not listed follow from the level above.
  typedef std::array<int, 4> Key;
  std::map<Key, std::array<double, 3> > listed;
  for(std::size_t n = 6; n < 6 + functions; ++n) {
    Key key;
    std::array<double, 3> x;
    std::istringstream in(lines[n]);
    for(int& i : key) in >> i;
    for(double& c : x) in >> c;
    CHECK(in);
    CHECK(listed.emplace(key, x).second);
  }
  const auto coefficient = [&](const Key& key) {
    const auto found = listed.find(key);
    if(found != listed.end()) return found->second;
    REQUIRE(key[0] == 1);
    std::array<double, 3> sum = {};
    for(int k = -8; k < 8; ++k)
      for(int j = -8; j < 8; ++j)
        for(int i = -8; i < 8; ++i) {
          double weight = 1;
          const int parent[] = { i, j, k };
          for(int a = 0; a < 3; ++a) {
            const int offset = std::abs(key[std::size_t(a) + 1] - 2 * parent[a]);
            weight *= offset == 0 ? 0.75 : offset == 1 ? 0.5 : offset == 2 ? 0.125 : 0;
          }
          if(weight == 0) continue;
          REQUIRE(listed.count({ 0, i, j, k }) == 1);
          for(std::size_t s = 0; s < 3; ++s) sum[s] += weight * listed[{ 0, i, j, k }][s];
        }
    return sum;
  };
  CGAL::Random random(5);
  for(std::size_t n = 7 + functions; n < 7 + functions + 26; ++n) {
    int level, ijk[3];
    std::istringstream(lines[n]) >> level >> ijk[0] >> ijk[1] >> ijk[2];
    const double width = spacing / (1 << level);
    double p[3], sum[3] = {};
    for(int a = 0; a < 3; ++a) p[a] = origin[a] + (ijk[a] + random.get_double()) * width;
    for(int m = 0; m < 64; ++m) {
      const Key key = { level, ijk[0] + m % 4 - 1, ijk[1] + m / 4 % 4 - 1, ijk[2] + m / 16 - 1 };
      double weight = 1;
      for(int a = 0; a < 3; ++a) weight *= b((p[a] - (origin[a] + key[std::size_t(a) + 1] * width)) / width);
      const std::array<double, 3> x = coefficient(key);
      for(int s = 0; s < 3; ++s) sum[s] += weight * x[std::size_t(s)];
    }
    const Varying_shell::Point_3 at(p[0], p[1], p[2]);
    CHECK(sum[0] == Approx(field.value(at).value()).margin(1e-14));
    CHECK(sum[1] == Approx(shell.inner_threshold().value(at)).margin(1e-14));
    CHECK(sum[2] == Approx(shell.outer_threshold().value(at)).margin(1e-14));
  }
}

TEST_CASE("Shell files: the binary data follow the format")
{
  const Shell shell = small_shell();
  const std::string bytes = written(shell, Format::BINARY);
  REQUIRE(bytes.size() == 112 + 2 * 14 + 80 * 8 + 3 * 16 + 3 * 8 + 8 + 6 * 4 + 8);
  CHECK(bytes.substr(0, 8) == "BSHELL05");
  CHECK(at<double>(bytes, 8) == 3.7);
  CHECK(at<double>(bytes, 16) == shell.inner_level());
  CHECK(at<double>(bytes, 24) == shell.outer_level());
  CHECK(at<std::uint64_t>(bytes, 32) == 20);
  CHECK(at<std::uint64_t>(bytes, 40) == 1);
  for(std::size_t a = 0; a < 3; ++a)
    CHECK(at<double>(bytes, 48 + 8 * a) == shell.field().cells().lattice().origin()[a]);
  CHECK(at<double>(bytes, 72) == shell.field().cells().lattice().spacing());
  CHECK(at<std::uint64_t>(bytes, 80) == 80);
  CHECK(at<std::uint64_t>(bytes, 88) == 2);
  CHECK(at<std::uint64_t>(bytes, 96) == 3);
  CHECK(at<std::uint64_t>(bytes, 104) == 1);
  CHECK(at<char>(bytes, 112) == 0);
  CHECK(at<std::int32_t>(bytes, 113) == -1);
  CHECK(at<std::int32_t>(bytes, 121) == 2);
  CHECK(at<char>(bytes, 125) == 0);
  CHECK(at<std::int32_t>(bytes, 127) == 0);
  CHECK(at<char>(bytes, 139) == 1);
  CHECK(at<double>(bytes, 140) == shell.field().coefficients()[0]);
  CHECK(at<double>(bytes, 140 + 8 * 80) == -0.05);
  CHECK(at<std::uint64_t>(bytes, bytes.size() - 8) == slow_checksum(bytes.substr(0, bytes.size() - 8)));

  const Varying_shell varying = small_varying_shell();
  const std::string more = written(varying, Format::BINARY);
  const std::size_t functions = varying.field().number_of_coefficients(), coefficients = 112 + 26 * 14;
  REQUIRE(more.size() == coefficients + 3 * functions * 8 + 3 * 16 + 3 * 8 + 8 + 6 * 4 + 8);
  CHECK(more.substr(0, 8) == "BSHELL05");
  CHECK(at<double>(more, 16) == 0);
  CHECK(at<double>(more, 24) == varying.thickness());
  CHECK(at<std::uint64_t>(more, 104) == 3);
  CHECK(at<char>(more, 112 + 25 * 14) == 1);
  CHECK(at<double>(more, coefficients) == varying.field().coefficients()[0]);
  CHECK(at<double>(more, coefficients + 8 * functions) == varying.inner_threshold().field().coefficients()[0]);
  CHECK(at<double>(more, coefficients + 16 * functions) == varying.outer_threshold().field().coefficients()[0]);
}

TEST_CASE("Shell files: paths follow the format, as text and as binary data")
{
  Shell shell = small_shell();
  BS::internal::Shell_access::set_path_candidates(shell, { { 0, 7, { 0.5, -1, 2 }, { 1, 2, 1e-3 } } });
  const Lines lines = lines_of(written(shell, Format::ASCII));
  CHECK(Lines(lines.begin() + 94, lines.end())
        == Lines{ "paths 1", "0 0.5 -1 2 1 2 0.001", "truncation", "0 0 0 0 0 0" });
  const std::string bytes = written(shell, Format::BINARY);
  const std::size_t paths = 140 + 80 * 8 + 3 * 16 + 3 * 8;
  REQUIRE(bytes.size() == paths + 8 + 56 + 6 * 4 + 8);
  CHECK(at<std::uint64_t>(bytes, paths) == 1);
  CHECK(at<std::uint64_t>(bytes, paths + 8) == 0);
  CHECK(at<double>(bytes, paths + 16) == 0.5);
  CHECK(at<double>(bytes, paths + 56) == 1e-3);
  // Both formats are read as they are written.
  for(Format format : { Format::ASCII, Format::BINARY }) {
    Shell back;
    REQUIRE(read(written(shell, format), back) == Status::SUCCESS);
    CHECK(written(back, format) == written(shell, format));
    CHECK(back.component_paths().empty()); // the paths are not proved
  }
  BS::internal::Shell_access::set_path_candidates(
    shell, { { 0, 0, { 0, 0, 0 }, { std::numeric_limits<double>::infinity(), 0, 0 } } });
  std::ostringstream out;
  CHECK(BS::write_shell(out, shell, Format::ASCII) == Status::NOT_A_SHELL);
  // A component has no path.
  BS::internal::Shell_access::set_path_candidates(shell, { { 1, 0, { 0, 0, 0 }, { 1, 0, 0 } } });
  CHECK(BS::write_shell(out, shell, Format::ASCII) == Status::NOT_A_SHELL);
}

TEST_CASE("Shell files: locales and stream flags affect neither writing nor reading")
{
  const Shell shell = small_shell();
  const std::string text = written(shell, Format::ASCII), bytes = written(shell, Format::BINARY);

  const std::locale foreign(std::locale::classic(), new Foreign_numbers), before = std::locale::global(foreign);
  std::ostringstream probe;
  probe << 12345.5;
  CHECK(probe.str() == "12.345,5");
  std::ostringstream out;
  out.setf(std::ios::hex | std::ios::showpos | std::ios::fixed);
  out.precision(3);
  out.width(50);
  CHECK(BS::write_shell(out, shell, Format::ASCII) == Status::SUCCESS);
  Shell from_text, from_bytes, from_file;
  CHECK(read(text, from_text) == Status::SUCCESS);
  CHECK(read(bytes, from_bytes) == Status::SUCCESS);
  const Temporary_file file("locale.shell.txt");
  CHECK(BS::write_shell(file.name, shell) == Status::SUCCESS);
  CHECK(BS::read_shell(file.name, from_file) == Status::SUCCESS);
  std::locale::global(before);
  CHECK(out.str() == text);
  CHECK(contents(file.name) == text);
  CHECK(same(from_text, shell));
  CHECK(same(from_bytes, shell));
  CHECK(same(from_file, shell));
}

TEST_CASE("Shell files: an invalid shell is not written")
{
  const Shell some = small_shell();
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const auto check = [](const Shell& shell) {
    std::ostringstream out;
    CHECK(BS::write_shell(out, shell, Format::BINARY) == Status::NOT_A_SHELL);
    CHECK(BS::write_shell(out, shell, Format::ASCII) == Status::NOT_A_SHELL);
    CHECK(out.str().empty());
  };
  check(Shell());
  Mesh open_mesh = sphere(0);
  open_mesh.remove_face(*open_mesh.faces().begin());
  open_mesh.collect_garbage();
  check(CGAL::bspline_shell_3(open_mesh, CGAL::Bspline_shells::parameters::resolution(6)));
  BS::Shell_report report = some.report();
  const BS::Level_range levels{ -1, 1 };
  check(Shell(Field(), levels, {}, {}, report));                                         // no cells
  check(Shell(some.field(), levels, { 1 }, {}, report));                                 // fewer marks than cells
  check(Shell(some.field(), BS::Level_range(), some.shell_cells(), {}, report));         // empty levels
  check(Shell(some.field(), levels, some.shell_cells(), { BS::Level_range() }, report)); // an empty range
  for(double x : { nan, infinity, 1e308 }) {
    Field field = some.field();
    Eigen::VectorXd coefficients = field.coefficients();
    coefficients[3] = x;
    field.set_coefficients(coefficients);
    check(Shell(field, levels, some.shell_cells(), {}, report));
  }
  report.unit = nan;
  check(Shell(some.field(), levels, some.shell_cells(), {}, report));
  // A closing with an edge that does not end on the border, and a truncation with a core in a facet that does not
  // exist.
  typedef BS::Shell_closing_3 Closing;
  typedef BS::Shell_truncation_3 Truncation;
  const std::vector<Closing::Point> points{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  for(std::size_t border : { 2, 3 }) {
    Shell closed = some;
    BS::internal::Shell_access::set_closing(
      closed, std::make_shared<const Closing>(points, border, std::vector<Closing::Triangle>{ { 0, 1, 2 } },
                                              std::vector<Closing::Kind>{ Closing::Kind::CAP }));
    if(border == 2) check(closed);
    else CHECK_FALSE(written(closed, Format::BINARY).empty());
  }
  Shell truncated = some;
  BS::internal::Shell_access::set_truncation(
    truncated,
    std::make_shared<const Truncation>(points, std::vector<Truncation::Triangle>(), std::vector<Truncation::Cut>(),
                                       std::vector<Truncation::Core>{ { { 0, 1, 2 }, 0 } },
                                       std::vector<Truncation::Disc>(), std::vector<Truncation::Planar_point>()));
  check(truncated);

  const Varying_shell varying = small_varying_shell();
  BS::Shell_report other = varying.report();
  const auto check_varying = [&](const Varying_shell::Threshold& outer) {
    std::ostringstream out;
    CHECK(BS::write_shell(
            out, Varying_shell(varying.field(), varying.inner_threshold(), outer, varying.shell_cells(), {}, other))
          == Status::NOT_A_SHELL);
  };
  Varying_shell::Field outer = varying.outer_threshold().field();
  outer.set_coefficients(Eigen::VectorXd::Constant(Eigen::Index(outer.number_of_coefficients()), nan));
  check_varying(Varying_shell::Threshold(outer));
  // The threshold has other cells.
  check_varying(Varying_shell::Threshold(Varying_shell::Field(BS::Cell_hierarchy_3(varying.field().cells().roots()))));
  other.thickness = nan;
  check_varying(varying.outer_threshold());

  CHECK(BS::write_shell("none.shell", Shell()) == Status::NOT_A_SHELL);
  CHECK_FALSE(std::ifstream("none.shell"));
}

TEST_CASE("Shell files: a file is written completely, or the previous file is kept")
{
  const Shell shell = small_shell();
  const Temporary_file binary("small.shell"), text("small.shell.txt");
  CHECK(BS::write_shell(binary.name, shell) == Status::SUCCESS);
  CHECK(BS::write_shell(text.name, shell) == Status::SUCCESS);
  CHECK(contents(binary.name) == written(shell, Format::BINARY));
  CHECK(contents(text.name) == written(shell, Format::ASCII));
  for(const std::string& name : { binary.name, text.name }) CHECK_FALSE(std::ifstream(name + ".part"));
  Shell back;
  CHECK(BS::read_shell(binary.name, back) == Status::SUCCESS);
  CHECK(BS::read_shell(text.name, back) == Status::SUCCESS);
  // An empty shell does not replace a file.
  CHECK(BS::write_shell(binary.name, Shell()) == Status::NOT_A_SHELL);
  CHECK(contents(binary.name) == written(shell, Format::BINARY));
  // The extension is irrelevant if the format is given, and for reading.
  CHECK(BS::write_shell(binary.name, shell, Format::ASCII) == Status::SUCCESS);
  CHECK(contents(binary.name) == written(shell, Format::ASCII));
  CHECK(BS::read_shell(binary.name, back) == Status::SUCCESS);

  CHECK(BS::write_shell("no_such_folder/small.shell", shell) == Status::CANNOT_WRITE);
  for(std::size_t capacity : { 0, 100, 800 })
    for(Format format : { Format::BINARY, Format::ASCII }) {
      Full_disk disk(capacity);
      std::ostream out(&disk);
      CHECK(BS::write_shell(out, shell, format) == Status::CANNOT_WRITE);
    }
}
} // namespace test_write_shell
