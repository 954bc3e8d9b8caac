// read_shell.h, Shell_file_status.h: a shell is read bit by bit as it was written, or not at all.
#include <CGAL/Bspline_shell_3/IO/read_shell.h>
#include "random_hierarchies.h"
#include "shell_files.h"

#include <CGAL/Bspline_shell_3/IO/checksum.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>

#include <CGAL/Random.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace test_read_shell {
namespace {

template <typename Any_shell>
void check_damaged(const std::string& what, const std::string& bytes, const Any_shell& shell)
{
  INFO(what);
  Any_shell unchanged = shell;
  CHECK(read(bytes, unchanged) == Status::DAMAGED);
  CHECK(same(unchanged, shell));
}

// The text of a shell, whose changes are rejected, even if the checksum is correct.
template <typename Any_shell>
struct Changed_text
{
  const Any_shell shell;
  const Lines lines;
  const std::size_t functions, leaves, facets;

  explicit Changed_text(const Any_shell& s)
    : shell(s), lines(lines_of(written(s, Format::ASCII))), functions(line_that_begins_with(lines, "functions")),
      leaves(line_that_begins_with(lines, "leaves")), facets(line_that_begins_with(lines, "facet_ranges"))
  {
    Any_shell back;
    REQUIRE(read(text_of(lines), back) == Status::SUCCESS);
  }
  void check(const std::string& what, const std::function<void(Lines&)>& change) const
  {
    Lines changed = lines;
    change(changed);
    check_damaged(what, text_of(changed), shell);
  }
  void check_word(const std::string& what, std::size_t line, std::size_t word, const std::string& by) const
  {
    check(what, [&](Lines& l) { l.at(line) = with_word(l[line], word, by); });
  }
};

void erase(Lines& lines, std::size_t first, std::size_t number = 1)
{
  lines.erase(lines.begin() + std::ptrdiff_t(first), lines.begin() + std::ptrdiff_t(first + number));
}
void insert(Lines& lines, std::size_t before, const std::string& line)
{
  lines.insert(lines.begin() + std::ptrdiff_t(before), line);
}

} // namespace

TEST_CASE("Shell files: a shell is read exactly as it was written")
{
  const auto check = [](const auto& shell) {
    REQUIRE(shell);
    for(Format format : { Format::BINARY, Format::ASCII }) {
      const std::string bytes = written(shell, format);
      std::decay_t<decltype(shell)> back;
      REQUIRE(read(bytes, back) == Status::SUCCESS);
      CHECK(same(shell, back));
      CHECK(written(back, format) == bytes);
    }
    const std::string text = written(shell, Format::ASCII);
    CHECK(text.substr(text.size() - 26) == "checksum " + BS::Checksum::text(BS::shell_checksum(shell)) + "\n");
  };
  namespace P = CGAL::Bspline_shells::parameters;
  SECTION("a shell of a mesh") check(CGAL::bspline_shell_3(sphere(2), P::resolution(12)));
  SECTION("polygons far from the origin")
  {
    check(
      CGAL::bspline_shell_3(box(Point_3(1000.1, -70.3, 0.1), Point_3(1003.1, -68, 1.4), false), P::resolution(9.7)));
  }
  SECTION("very small and very large meshes")
  {
    check(CGAL::bspline_shell_3(sphere(1, 1e-30), P::resolution(6)));
    check(CGAL::bspline_shell_3(sphere(1, 1e30), P::resolution(6)));
  }
  SECTION("two distant components")
  {
    check(CGAL::bspline_shell_3(joined(sphere(1), sphere(1, 1, Point_3(40, 50, 60))), P::resolution(120)));
  }
  SECTION("a small shell") check(small_shell());
  SECTION("cells of different sizes, and varying thresholds") check(small_varying_shell());
  SECTION("many levels of cells")
  {
    CGAL::Random random(3);
    const BS::Lattice_3 lattice(CGAL::Bbox_3(-3, -2, -1, 1, 2, 4), 0.7);
    for(int levels = 1; levels < 6; ++levels) {
      const Hierarchy cells = random_hierarchy(random, some_cells(random, lattice, { -3, -2, -1 }, { 1, 1, 2 }, 0.7),
                                               levels);
      REQUIRE(cells.number_of_levels() == levels);
      typedef CGAL::Bspline_shell_3<BS::Hierarchical_bspline_field_3<> > Levels_shell; // between two levels
      Levels_shell::Field field(cells);
      Eigen::VectorXd x(Eigen::Index(field.number_of_coefficients()));
      for(Eigen::Index n = 0; n < x.size(); ++n) x[n] = random.get_double(-1, 1);
      field.set_coefficients(x);
      check(Levels_shell(field, BS::Level_range{ -0.5, 0.25 }, std::vector<char>(field.number_of_cells(), 1), {},
                         report_of(field)));
    }
  }
  SECTION("extreme numbers")
  {
    typedef std::numeric_limits<double> Limits;
    const double numbers[] = { -0.,    0.,  1. / 3, Limits::denorm_min(), -(Limits::min)(),     1e300,
                               -1e300, 0.1, 5e-324, 123456789.123456789,  1 + Limits::epsilon() };
    check(shell_on(BS::Lattice_3(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1), 0.7), { { 3, -4, 5 }, { 4, -4, 5 }, { 3, -3, 6 } },
                   [&](std::size_t n) { return numbers[n % 11]; }));
  }
  SECTION("cells at the ends of the lattice")
  {
    const int last = BS::Lattice_key::max_coordinate;
    const BS::Lattice_3 lattice(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1), 0.5);
    for(int end : { -last, last }) check(shell_on(lattice, { { end, end, end } }, [](std::size_t) { return 1.; }));
  }
  SECTION("no facet ranges, and equal levels")
  {
    const Shell some = small_shell();
    check(Shell(some.field(), BS::Level_range{ 0, 0 }, some.shell_cells(), {}, some.report()));
  }
}

TEST_CASE("Shell files: a shell that was read gives the same answers as the original")
{
  const Mesh mesh = sphere(2);
  const Shell shell = CGAL::bspline_shell_3(mesh, CGAL::Bspline_shells::parameters::resolution(10));
  Shell back;
  REQUIRE(read(written(shell, Format::BINARY), back) == Status::SUCCESS);
  CGAL::Random random(3);
  for(int n = 0; n < 1000; ++n) {
    const Point_3 p(random.get_double(-1.2, 1.2), random.get_double(-1.2, 1.2), random.get_double(-1.2, 1.2));
    REQUIRE(back.field().value(p) == shell.field().value(p));
    REQUIRE(back.bounded_side(p) == shell.bounded_side(p));
  }
  CHECK(back.relative_thickness() == shell.relative_thickness());
  CHECK(back.facet_ranges().size() == mesh.number_of_faces());
}

TEST_CASE("Shell files: a certified shell that was read can be certified again, and is not certified before that")
{
  const Mesh mesh = box(Point_3(0.1, 0, 0), Point_3(1.1, 0.7, 0.3));
  const Varying_shell shell = CGAL::certified_bspline_shell_3(mesh,
                                                              BS::parameters::resolution(8).relative_thickness(0.02));
  REQUIRE(shell);
  REQUIRE(shell.is_certified());
  REQUIRE(shell.field().number_of_levels() > 1);
  BS::Shell_certificate_3<Varying_shell::Field, Varying_shell::Threshold> before(shell);
  CHECK(before.verify(mesh));
  for(Format format : { Format::BINARY, Format::ASCII }) {
    Varying_shell back;
    REQUIRE(read(written(shell, format), back) == Status::SUCCESS);
    CHECK(same(back, shell));
    CHECK_FALSE(back.is_certified());
    BS::Shell_certificate_3<Varying_shell::Field, Varying_shell::Threshold> after(back);
    CHECK(after.verify(mesh));
    CHECK(after.least_gradient() == before.least_gradient());
    CHECK(after.least_angle() == before.least_angle());
    REQUIRE(after.cover()->boxes().size() == before.cover()->boxes().size());
    for(std::size_t n = 0; n < after.cover()->boxes().size(); ++n) {
      const BS::Cover_box &a = after.cover()->boxes()[n], &b = before.cover()->boxes()[n];
      REQUIRE((a.cell == b.cell && a.kind == b.kind && a.depth == b.depth && a.component == b.component
               && a.proof == b.proof));
    }
  }
}

TEST_CASE("Shell files: a shell is only read into a shell with the same type of thresholds")
{
  Shell constant = other_shell();
  Varying_shell varying = small_varying_shell();
  for(Format format : { Format::BINARY, Format::ASCII }) {
    CHECK(read(written(small_varying_shell(), format), constant) == Status::OTHER_KIND);
    CHECK(read(written(small_shell(), format), varying) == Status::OTHER_KIND);
  }
  CHECK(same(constant, other_shell()));
  CHECK(same(varying, small_varying_shell()));
}

TEST_CASE("Shell files: files of older versions, with another word for a field on cells of one size, are read")
{
  const Shell shell = small_shell();
  Lines lines = lines_of(written(shell, Format::ASCII));
  lines[4] = with_word(lines[4], 1, "uniform");
  Shell from_text, from_bytes;
  CHECK(read(text_of(lines), from_text) == Status::SUCCESS);
  CHECK(same(from_text, shell));
  std::string bytes = written(shell, Format::BINARY);
  bytes.resize(bytes.size() - 8);
  bytes.replace(104, 8, as_bytes(std::uint64_t(0)));
  CHECK(read(bytes + as_bytes(slow_checksum(bytes)), from_bytes) == Status::SUCCESS);
  CHECK(same(from_bytes, shell));
}

TEST_CASE("Shell files: a truncated file is rejected, wherever it ends, and the shell is unchanged")
{
  const auto check = [](const auto& shell, const auto& before, std::size_t step) {
    for(Format format : { Format::BINARY, Format::ASCII }) {
      const std::string bytes = written(shell, format);
      auto target = before;
      std::decay_t<decltype(before)> none;
      std::size_t accepted = 0;
      for(std::size_t size = 0; size < bytes.size(); size += step)
        if(read(bytes.substr(0, size), target) == Status::SUCCESS) ++accepted;
      CHECK(accepted == 0);
      CHECK(same(target, before));
      for(std::size_t size : { std::size_t(0), bytes.size() / 2, bytes.size() - 1 }) read(bytes.substr(0, size), none);
      CHECK(none.status() == BS::Shell_status::NOT_BUILT);
      // Nothing may follow the shell.
      for(const std::string& more : { std::string("\n"), std::string(1, '\0'), std::string(" "), bytes })
        CHECK(read(bytes + more, target) == Status::DAMAGED);
      CHECK(read(bytes, target) == Status::SUCCESS);
      CHECK(same(target, shell));
    }
  };
  const Shell before = other_shell();
  check(small_shell(), before, 1);
  check(small_varying_shell(), Varying_shell(), 7);
  // This shell is read in several parts.
  const Shell larger = CGAL::bspline_shell_3(sphere(1), CGAL::Bspline_shells::parameters::resolution(8));
  CGAL::Random random(11);
  for(Format format : { Format::BINARY, Format::ASCII }) {
    const std::string bytes = written(larger, format);
    REQUIRE(bytes.size() > (1 << 15));
    Shell target = before;
    for(int n = 0; n < 60; ++n)
      REQUIRE(read(bytes.substr(0, std::size_t(random.get_int(0, int(bytes.size())))), target) != Status::SUCCESS);
    CHECK(same(target, before));
  }
}

TEST_CASE("Shell files: any altered byte is detected, and the shell is unchanged")
{
  CGAL::Random random(13);
  const auto check = [&](const auto& shell, const auto& before, std::size_t step) {
    for(Format format : { Format::BINARY, Format::ASCII }) {
      const std::string bytes = written(shell, format);
      auto target = before;
      std::size_t accepted = 0;
      for(std::size_t n = 0; n < bytes.size(); n += step)
        for(int flip : { 1, 0x20, 0x80, random.get_int(1, 256) }) { // 0x20 turns uppercase letters into lowercase ones
          std::string altered = bytes;
          altered[n] = char(altered[n] ^ flip);
          if(read(altered, target) == Status::SUCCESS) ++accepted;
        }
      // bytes are removed, duplicated, swapped
      for(std::size_t n = 0; n + 1 < bytes.size(); n += 7 * step) {
        std::string altered = bytes;
        altered.erase(n, 1);
        if(read(altered, target) == Status::SUCCESS) ++accepted;
        altered = bytes;
        altered.insert(n, 1, altered[n]);
        if(read(altered, target) == Status::SUCCESS) ++accepted;
        altered = bytes;
        std::swap(altered[n], altered[n + 1]);
        if(altered != bytes && read(altered, target) == Status::SUCCESS) ++accepted;
      }
      CHECK(accepted == 0);
      CHECK(same(target, before));
    }
  };
  check(small_shell(), other_shell(), 1);
  check(small_varying_shell(), Varying_shell(), 7);
}

TEST_CASE("Shell files: inconsistent text is rejected, even if its checksum is correct")
{
  const Changed_text<Shell> text(small_shell());
  const std::size_t functions = text.functions, leaves = text.leaves, facets = text.facets,
                    closing = line_that_begins_with(text.lines, "closing"),
                    paths = line_that_begins_with(text.lines, "paths");
  text.check_word("a mark", leaves + 1, 4, "2");
  text.check_word("a leaf elsewhere", leaves + 1, 1, "-2");
  text.check_word("a leaf far away", leaves + 2, 3, "1000000");
  text.check_word("a leaf beyond all lattices", leaves + 2, 3, "2000000000");
  text.check_word("a leaf that is no integer", leaves + 2, 3, "2.5");
  text.check_word("a function elsewhere", functions + 1, 1, "-3");
  for(std::size_t line : { functions + 1, leaves + 1, leaves + 2 })
    for(const char* level : { "1", "-1", "31", "2147483647" }) text.check_word("a level of a lattice", line, 0, level);
  for(const char* number : { "nan", "inf", "-inf", "1e999", "0x10", "1,5", "+1", "", "1e", "--1", "1e308" }) {
    text.check_word("a coefficient", functions + 5, 4, number);
    text.check_word("a level", 2, 1, number);
    text.check_word("the spacing", 4, 5, number);
    if(std::string(number) != "1e308") text.check_word("a facet", facets + 1, 1, number);
  }
  text.check_word("levels out of order", 2, 1, "0.34");
  text.check_word("a facet's range out of order", facets + 1, 0, "0.31");
  text.check_word("a negative unit", 1, 1, "-1");
  text.check_word("a spacing of too many bits", 4, 5, "0.10000000000000001");
  text.check_word("no spacing", 4, 5, "0");
  text.check_word("an origin of too many bits", 4, 2, "1e-20");
  text.check_word("another kind of field", 4, 1, "dense");
  text.check_word("a count of triangles", 3, 1, "-1");
  for(const char* count : { "1", "-1", "18446744073709551615" }) {
    for(std::size_t word : { 1, 2, 3 }) text.check_word("a count of the closing", closing, word, count);
    text.check_word("the number of paths", paths, 1, count);
    text.check_word("a count of the truncation", paths + 2, 0, count);
  }
  for(const char* count :
      { "0", "1", "79", "81", "4294967295", "4294967376", "18446744073709551615", "18446744073709551616" }) {
    text.check_word("the number of functions", functions, 1, count);
    text.check_word("the number of leaves", leaves, 1, count);
    text.check_word("the number of facets", facets, 1, count);
  }

  text.check("a missing line", [&](Lines& l) { erase(l, functions + 1); });
  text.check("a missing function", [&](Lines& l) {
    erase(l, functions + 1);
    l[functions] = "functions 79";
  });
  text.check("a function that acts on no cell", [&](Lines& l) {
    insert(l, functions + 1, "0 -5 -1 1 0");
    l[functions] = "functions 81";
  });
  text.check("functions out of order", [&](Lines& l) { std::swap(l[functions + 1], l[functions + 2]); });
  text.check("leaves out of order", [&](Lines& l) { std::swap(l[leaves + 1], l[leaves + 2]); });
  text.check("a leaf twice", [&](Lines& l) { l[leaves + 2] = l[leaves + 1]; });
  text.check("a missing leaf", [&](Lines& l) {
    erase(l, leaves + 1);
    l[leaves] = "leaves 1";
  });
  text.check("no leaf", [&](Lines& l) {
    erase(l, leaves + 1, 2);
    erase(l, functions + 1, leaves - functions - 1);
    l[functions] = "functions 0";
    l[functions + 1] = "leaves 0";
  });
  for(std::size_t line : { std::size_t(1), functions, functions + 1, leaves, leaves + 1, facets, facets + 1 }) {
    for(const char* more : { " ", " 1", "\r", "\t" })
      text.check("something after a line", [&](Lines& l) { l[line] += more; });
    text.check("two blanks", [&](Lines& l) { l[line].insert(l[line].find(' '), " "); });
    text.check("a blank first", [&](Lines& l) { l[line] = " " + l[line]; });
    text.check("an empty line", [&](Lines& l) { insert(l, line, ""); });
  }
  text.check("a line longer than any should be", [](Lines& l) { l[1] = "unit " + std::string(100000, '0') + "1"; });

  // Data without redundancy may differ; the file then contains another shell.
  Lines lines = text.lines;
  lines[3] = "triangles 21 components 2";
  Shell other;
  CHECK(read(text_of(lines), other) == Status::SUCCESS);
  CHECK(other.report().triangles == 21);
}

TEST_CASE("Shell files: leaves that are not a graded hierarchy are rejected, even if the checksum is correct")
{
  const Changed_text<Varying_shell> text(small_varying_shell());
  const std::size_t functions = text.functions, leaves = text.leaves;
  const auto at = [](Lines& l, std::size_t line) { return l.begin() + std::ptrdiff_t(line); };
  text.check("an eighth of a cell is missing", [&](Lines& l) {
    erase(l, leaves + 5);
    l[leaves] = "leaves 25";
  });
  text.check("a leaf that is split", [&](Lines& l) {
    insert(l, leaves + 1, "0 0 1 0 1");
    l[leaves] = "leaves 27";
  });
  text.check("fine leaves first",
             [&](Lines& l) { std::rotate(at(l, leaves + 1), at(l, leaves + 3), at(l, leaves + 27)); });
  text.check("functions out of order",
             [&](Lines& l) { std::rotate(at(l, functions + 1), at(l, functions + 2), at(l, leaves)); });
  text.check_word("a function of another level", functions + 1, 0, "0");
  for(std::size_t word : { 4, 5, 6 })
    for(const char* number : { "nan", "inf", "1e308", "x" })
      text.check_word("a coefficient of the field or of a threshold", functions + 3, word, number);
  text.check("no coefficient of the outer threshold",
             [&](Lines& l) { l[functions + 3].erase(l[functions + 3].rfind(' ')); });
  for(const char* line : { "thickness -1", "thickness nan", "thickness", "levels -1 1" })
    text.check(line, [&](Lines& l) { l[2] = line; });

  // The hierarchy lacks the rings around a split cell: the first root cell is split twice, but not its neighbors.
  Lines lines = { "cubic_bspline_shell 5 ascii",
                  "unit 1",
                  "levels -1 1",
                  "triangles 1 components 1",
                  text.lines[4],
                  "functions 0",
                  "leaves 17" };
  for(const char* roots : { "0 1 0 0 1", "0 2 0 0 1" }) lines.push_back(roots);
  for(int level = 1; level < 3; ++level)
    for(int o = level == 1 ? 1 : 0; o < 8; ++o)
      lines.push_back(std::to_string(level) + " " + std::to_string(o & 1) + " " + std::to_string(o >> 1 & 1) + " "
                      + std::to_string(o >> 2) + " 1");
  for(const char* line : { "facet_ranges 0", "closing 0 0 0", "paths 0", "truncation", "0 0 0 0 0 0" })
    lines.push_back(line);
  Shell none;
  CHECK(read(text_of(lines), none) == Status::DAMAGED);
  const BS::Lattice_3 lattice = text.shell.field().cells().lattice();
  std::vector<std::vector<std::uint64_t> > keys(3);
  for(std::size_t n = 7; n < lines.size() - 5; ++n) {
    int level, i, j, k;
    std::istringstream(lines[n]) >> level >> i >> j >> k;
    keys[std::size_t(level)].push_back(BS::Lattice_key::encode(i, j, k));
  }
  CHECK_FALSE(Hierarchy::from_leaves(lattice, keys)); // this is why the file is refused
}

TEST_CASE("Shell files: inconsistent binary data are rejected, even if their checksum is correct")
{
  const Shell shell = small_shell();
  const std::string intact = written(shell, Format::BINARY);
  const auto check = [&](const std::string& what, const std::string& bytes) {
    check_damaged(what, bytes + as_bytes(slow_checksum(bytes)), shell);
  };
  const std::string body = intact.substr(0, intact.size() - 8);
  const auto altered = [&](const std::string& what, std::size_t offset, const std::string& by) {
    std::string bytes = body;
    bytes.replace(offset, by.size(), by);
    check(what, bytes);
  };
  Shell back;
  REQUIRE(read(body + as_bytes(slow_checksum(body)), back) == Status::SUCCESS);
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for(double x : { nan, infinity, -infinity })
    for(std::size_t offset : { 8, 16, 24, 48, 56, 64, 72, 140, 140 + 79 * 8, 140 + 80 * 8, 140 + 80 * 8 + 40 })
      altered("a number", offset, as_bytes(x));
  // The counts exceed the size of the file. This must be detected before memory is allocated.
  for(std::uint64_t count : { 0ull, 1ull, 1ull << 31, 1ull << 40, 1ull << 63, ~0ull })
    for(std::size_t offset : { 80, 88, 96 }) altered("a count", offset, as_bytes(count));
  altered("no kind of shell", 104, as_bytes(std::uint64_t(4)));
  altered("another level", 112, "\x01");
  altered("another cell", 113, std::string("\x02\0\0\0", 4));
  altered("the same cell twice", 127, std::string("\xff\xff\xff\xff", 4));
  altered("a mark", 125, "\x02");
  check("a number more", body + as_bytes(1.));
}

TEST_CASE("Shell files: a few cells far from each other take little memory")
{
  const int last = BS::Lattice_key::max_coordinate;
  const BS::Lattice_3 lattice(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1), 0.5);
  const Shell shell = shell_on(lattice, { { -last, -last, -last }, { last, last, last } },
                               [](std::size_t) { return 0.5; });
  Shell back;
  CHECK(read(written(shell, Format::BINARY), back) == Status::SUCCESS);
  CHECK(same(back, shell));
}

TEST_CASE("Shell files: other formats, other versions and missing files are rejected")
{
  const Shell before = small_shell();
  Shell shell = before;
  const std::string text = written(before, Format::ASCII), bytes = written(before, Format::BINARY);
  for(const char* foreign :
      { "", "\n", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "cubic_bspline_shell_certificate 1\n", "BSHELF01",
        "cubic_bspline_shell\n", "cubic_bspline_shell 5 binary\n" })
    CHECK(read(foreign, shell) == Status::NOT_A_SHELL);
  CHECK(read(std::string(100000, '\0'), shell) == Status::NOT_A_SHELL);
  for(const char* version : { "1", "4", "6", "55" }) {
    const std::string begin = "cubic_bspline_shell " + std::string(version);
    CHECK(read(begin + " ascii" + text.substr(text.find('\n')), shell) == Status::VERSION_NOT_SUPPORTED);
    CHECK(read(begin + " something\nelse", shell) == Status::VERSION_NOT_SUPPORTED);
  }
  for(const char* version : { "04", "06", "15" })
    CHECK(read("BSHELL" + (version + bytes.substr(8)), shell) == Status::VERSION_NOT_SUPPORTED);
  CHECK(BS::read_shell("no_such_file.shell", shell) == Status::CANNOT_OPEN);
  CHECK(BS::read_shell(".", shell) == Status::CANNOT_OPEN);
  std::ifstream missing("no_such_file.shell");
  CHECK(BS::read_shell(missing, shell) == Status::CANNOT_OPEN);
  CHECK(same(shell, before));
  for(Status status : { Status::SUCCESS, Status::CANNOT_OPEN, Status::CANNOT_WRITE, Status::NOT_A_SHELL,
                        Status::VERSION_NOT_SUPPORTED, Status::OTHER_KIND, Status::DAMAGED })
    CHECK_FALSE(std::string(BS::message(status)).empty());
}

TEST_CASE("Shell files: reading does not throw, even from a stream that is set to throw")
{
  const std::string bytes = written(small_shell(), Format::BINARY);
  for(std::size_t size : { std::size_t(0), std::size_t(50), bytes.size() }) {
    std::istringstream in(bytes.substr(0, size));
    in.exceptions(std::ios::badbit | std::ios::failbit | std::ios::eofbit);
    Shell shell;
    Status status = Status::CANNOT_OPEN;
    CHECK_NOTHROW(status = BS::read_shell(in, shell));
    CHECK((status == Status::SUCCESS) == (size == bytes.size()));
  }
}
} // namespace test_read_shell
