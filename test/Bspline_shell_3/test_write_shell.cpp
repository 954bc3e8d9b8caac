// write_shell.h, write_file.h: the text and the bytes are what the format says, and all of them, or nothing.
#include <CGAL/Bspline_shell_3/IO/write_shell.h>
#include "shell_files.h"

#include <CGAL/Random.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <locale>
#include <sstream>
#include <string>

TEST_CASE("files: the text is what the format says")
{
  const Shell shell = small_shell();
  const Field& field = shell.field();
  const std::string text = written(shell, Format::ASCII);
  const Lines lines = lines_of(text);
  CHECK(text_of(lines) == text);
  REQUIRE(lines.size() == 5 + 1 + 80 + 1 + 2 + 1 + 3);
  CHECK(lines[0] == "cubic_bspline_shell 1 ascii");
  CHECK(lines[1] == "unit 3.7000000000000002");
  CHECK(lines[2] == "levels -0.10000000000000001 0.33333333333333331");
  CHECK(lines[3] == "triangles 20 components 1");
  CHECK(lines[5] == "functions 80");
  CHECK(lines[86] == "leaves 2");
  CHECK(lines[89] == "facet_ranges 3");
  CHECK(lines[90] == "-0.050000000000000003 0.29999999999999999");

  std::string word;
  double origin[3], spacing;
  std::istringstream(lines[4]) >> word >> word >> origin[0] >> origin[1] >> origin[2] >> spacing;
  CHECK(spacing == field.cells().width());
  // f from the functions alone, as a sum of B-splines centred at lattice points
  const auto b = [](double t) {
    t = std::abs(t);
    return t >= 2 ? 0 : t >= 1 ? std::pow(2 - t, 3) / 6 : 2. / 3 - t * t + t * t * t / 2;
  };
  const auto sum = [&](const std::array<double, 3>& p) {
    double f = 0;
    for(int n = 6; n < 86; ++n) {
      int ijk[3];
      double coefficient;
      std::istringstream(lines[std::size_t(n)]) >> ijk[0] >> ijk[1] >> ijk[2] >> coefficient;
      for(int a = 0; a < 3; ++a) coefficient *= b((p[std::size_t(a)] - (origin[a] + ijk[a] * spacing)) / spacing);
      f += coefficient;
    }
    return f;
  };
  CGAL::Random random(5);
  for(Field::Cell_index c = 0; c < 2; ++c) {
    std::istringstream in(lines[87 + c]);
    int i, j, k, mark;
    double numbers[69];
    in >> i >> j >> k >> mark;
    for(double& x : numbers) in >> x;
    CHECK(in);
    CHECK(in.eof());
    CHECK(field.cells().lattice_point(c) == BS::Lattice_3::Point{ i, j, k });
    CHECK(mark == int(c));
    CHECK(numbers[0] == origin[0] + i * spacing);
    CHECK(numbers[3] == spacing);
    // f from the Bernstein coefficients of the leaf
    for(int s = 0; s < 20; ++s) {
      const double t[3] = { random.get_double(), random.get_double(), random.get_double() };
      double f = 0;
      for(int n = 0; n < 64; ++n) {
        const int steps[3] = { n % 4, n / 4 % 4, n / 16 };
        const double binomial[4] = { 1, 3, 3, 1 };
        double weight = 1;
        for(int a = 0; a < 3; ++a)
          weight *= binomial[steps[a]] * std::pow(t[a], steps[a]) * std::pow(1 - t[a], 3 - steps[a]);
        f += weight * numbers[5 + n];
      }
      std::array<double, 3> p;
      for(std::size_t a = 0; a < 3; ++a) p[a] = numbers[a] + t[a] * spacing;
      CHECK(f == Approx(sum(p)).margin(1e-14));
      CHECK(f == Approx(field.value(Point_3(p[0], p[1], p[2])).value()).margin(1e-14));
    }
  }
}

TEST_CASE("files: the bytes are where the format says")
{
  const Shell shell = small_shell();
  const std::string bytes = written(shell, Format::BINARY);
  REQUIRE(bytes.size() == 112 + 2 * 13 + 80 * 8 + 3 * 16 + 8);
  CHECK(bytes.substr(0, 8) == "BSHELL01");
  CHECK(at<double>(bytes, 8) == 3.7);
  CHECK(at<double>(bytes, 16) == shell.inner_level());
  CHECK(at<double>(bytes, 24) == shell.outer_level());
  CHECK(at<std::uint64_t>(bytes, 32) == 20);
  CHECK(at<std::uint64_t>(bytes, 40) == 1);
  for(std::size_t a = 0; a < 3; ++a) CHECK(at<double>(bytes, 48 + 8 * a) == shell.field().cells().lattice().origin()[a]);
  CHECK(at<double>(bytes, 72) == shell.field().cells().lattice().spacing());
  CHECK(at<std::uint64_t>(bytes, 80) == 80);
  CHECK(at<std::uint64_t>(bytes, 88) == 2);
  CHECK(at<std::uint64_t>(bytes, 96) == 3);
  CHECK(at<std::uint64_t>(bytes, 104) == 0);
  CHECK(at<std::int32_t>(bytes, 112) == -1);
  CHECK(at<std::int32_t>(bytes, 120) == 2);
  CHECK(at<char>(bytes, 124) == 0);
  CHECK(at<std::int32_t>(bytes, 125) == 0);
  CHECK(at<char>(bytes, 137) == 1);
  CHECK(at<double>(bytes, 138) == shell.field().coefficients()[0]);
  CHECK(at<double>(bytes, 138 + 8 * 80) == -0.05);
  CHECK(at<std::uint64_t>(bytes, bytes.size() - 8) == slow_checksum(bytes.substr(0, bytes.size() - 8)));
}

TEST_CASE("files: locales and flags of streams do not matter")
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

TEST_CASE("files: what is no shell is not written")
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
  const Mesh open_mesh = []() { Mesh m = sphere(0); m.remove_face(*m.faces().begin()); m.collect_garbage(); return m; }();
  check(CGAL::bspline_shell_3(open_mesh, CGAL::Bspline_shells::parameters::resolution(6)));
  BS::Shell_report report = some.report();
  BS::Level_range levels;
  levels.min = -1;
  levels.max = 1;
  check(Shell(Field(), levels, {}, {}, report));                                             // no cells
  check(Shell(some.field(), levels, { 1 }, {}, report));                                     // not one mark for each
  check(Shell(some.field(), BS::Level_range(), some.shell_cells(), {}, report));             // empty levels
  check(Shell(some.field(), levels, some.shell_cells(), { BS::Level_range() }, report));     // an empty range
  for(double x : { nan, infinity, 1e308 }) {
    Field field = some.field();
    Eigen::VectorXd coefficients = field.coefficients();
    coefficients[3] = x;
    field.set_coefficients(coefficients);
    check(Shell(field, levels, some.shell_cells(), {}, report));
  }
  report.unit = nan;
  check(Shell(some.field(), levels, some.shell_cells(), {}, report));

  CHECK(BS::write_shell("none.shell", Shell()) == Status::NOT_A_SHELL);
  CHECK_FALSE(std::ifstream("none.shell"));
}

TEST_CASE("files: they are there and complete, or as before")
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
  // what is no shell does not replace one
  CHECK(BS::write_shell(binary.name, Shell()) == Status::NOT_A_SHELL);
  CHECK(contents(binary.name) == written(shell, Format::BINARY));
  // the extension does not decide if the format is given, nor when reading
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
