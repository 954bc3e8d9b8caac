// read_shell.h, write_shell.h, write_VTU.h, checksum.h, Shell_file_status.h: what is read is what was written, bit by bit,
// or nothing.
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/IO/checksum.h>
#include <CGAL/Bspline_shell_3/IO/read_shell.h>
#include <CGAL/Bspline_shell_3/IO/write_VTU.h>
#include <CGAL/Bspline_shell_3/IO/write_shell.h>
#include <CGAL/bspline_shell_3.h>

#include <CGAL/Random.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <locale>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Bspline_shell_3<> Shell;
typedef Shell::Field Field;
typedef BS::Shell_file_status Status;
typedef BS::Shell_format Format;

// --- shells

struct Cell_point { int i, j, k; };

Shell shell_on(const BS::Lattice_3& lattice, const std::vector<Cell_point>& points,
               const std::function<double(std::size_t)>& coefficient)
{
  std::vector<std::uint64_t> keys;
  for(const Cell_point& p : points) keys.push_back(BS::internal::Lattice_key::encode(p.i, p.j, p.k));
  BS::internal::sort_unique(keys);
  Field field{ BS::Cell_complex_3(lattice, keys) };
  Eigen::VectorXd x(Eigen::Index(field.number_of_coefficients()));
  for(Eigen::Index n = 0; n < x.size(); ++n) x[n] = coefficient(std::size_t(n));
  field.set_coefficients(x);
  BS::Level_range levels, facet;
  levels.min = -0.1;
  levels.max = 1. / 3;
  facet.min = -0.05;
  facet.max = 0.3;
  std::vector<char> cells(keys.size(), 1);
  cells.front() = 0;
  BS::Shell_report report;
  report.status = BS::Shell_status::SUCCESS;
  report.unit = 3.7;
  report.gamma = report.unit / lattice.spacing();
  report.triangles = 20;
  report.components = 1;
  report.cells = keys.size();
  report.unknowns = std::size_t(x.size());
  return Shell(field, levels, cells, std::vector<BS::Level_range>(3, facet), report);
}

// two cells and 80 functions: short enough to try all that can happen to its file
Shell small_shell()
{
  CGAL::Random random(7);
  return shell_on(BS::Lattice_3(CGAL::Bbox_3(-1, -2, 0, 2, 1, 5), 0.3), { { -1, 0, 2 }, { 0, 0, 2 } },
                  [&](std::size_t) { return random.get_double(-1, 1); });
}

// another one, which must not change when a file is refused
Shell other_shell()
{
  const BS::Lattice_3 lattice(CGAL::Bbox_3(0, 0, 0, 1, 1, 1), 0.25);
  return shell_on(lattice, { { 0, 0, 0 } }, [](std::size_t n) { return double(n); });
}

template <typename T>
bool same_bits(const T& a, const T& b) { return std::memcmp(&a, &b, sizeof(T)) == 0; }

bool same_bits(const BS::Level_range& a, const BS::Level_range& b)
{
  return same_bits(a.min, b.min) && same_bits(a.max, b.max);
}

bool same(const Shell& a, const Shell& b)
{
  if(a.status() != b.status()) return false;
  const Field &f = a.field(), &g = b.field();
  bool equal = f.number_of_cells() == g.number_of_cells() && f.number_of_coefficients() == g.number_of_coefficients()
            && same_bits(a.inner_level(), b.inner_level()) && same_bits(a.outer_level(), b.outer_level())
            && a.shell_cells() == b.shell_cells() && a.facet_ranges().size() == b.facet_ranges().size()
            && same_bits(f.cells().lattice().origin(), g.cells().lattice().origin())
            && same_bits(f.cells().lattice().spacing(), g.cells().lattice().spacing())
            && f.cells().lattice().is_exact() == g.cells().lattice().is_exact();
  for(std::size_t n = 0; equal && n < a.facet_ranges().size(); ++n)
    equal = same_bits(a.facet_ranges()[n], b.facet_ranges()[n]);
  for(Field::Cell_index n = 0; equal && n < f.number_of_coefficients(); ++n)
    equal = same_bits(f.coefficients()[n], g.coefficients()[n]) && f.functions().point(n) == g.functions().point(n);
  for(Field::Cell_index c = 0; equal && c < f.number_of_cells(); ++c) {
    equal = f.cells().lattice_point(c) == g.cells().lattice_point(c) && same_bits(f.cell(c).corner(), g.cell(c).corner())
         && same_bits(f.cell(c).error_radius(), g.cell(c).error_radius());
    for(int n = 0; n < 64; ++n) equal = equal && same_bits(f.cell(c).coefficients()[n], g.cell(c).coefficients()[n]);
  }
  const BS::Shell_report &r = a.report(), &s = b.report();
  return equal && same_bits(r.unit, s.unit) && same_bits(r.gamma, s.gamma) && r.triangles == s.triangles
      && r.components == s.components && r.cells == s.cells && r.unknowns == s.unknowns;
}

// --- files

std::string written(const Shell& shell, Format format)
{
  std::ostringstream out;
  REQUIRE(BS::write_shell(out, shell, format) == Status::SUCCESS);
  return out.str();
}

Status read(const std::string& bytes, Shell& shell)
{
  std::istringstream in(bytes);
  return BS::read_shell(in, shell);
}

std::string contents(const std::string& name)
{
  std::ifstream in(name, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
}

// a file that is gone when the test ends
struct Temporary_file
{
  explicit Temporary_file(const std::string& name) : name(name) {}
  ~Temporary_file() { std::remove(name.c_str()); }
  std::string name;
};

// CRC-64/XZ, bit by bit
std::uint64_t slow_checksum(const std::string& bytes)
{
  std::uint64_t crc = ~std::uint64_t(0);
  for(char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for(int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) ? 0xC96C5795D7870F42ull : 0);   // polynomial, reflected
  }
  return ~crc;
}

std::string checksum_line(const std::string& text)
{
  char line[40];
  std::snprintf(line, sizeof(line), "checksum %016llx\n", static_cast<unsigned long long>(slow_checksum(text)));
  return line;
}

std::string as_bytes(std::uint64_t x)
{
  std::string bytes;
  for(int n = 0; n < 8; ++n) bytes += char((x >> (8 * n)) & 0xff);
  return bytes;
}

std::string as_bytes(double x)
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
  std::memcpy(&x, &bytes[offset], sizeof(T));       // this machine is little-endian, as the files are
  return x;
}

// a text file as lines, without the last; and back, with a checksum that fits
typedef std::vector<std::string> Lines;

Lines lines_of(const std::string& text)
{
  Lines lines;
  std::istringstream in(text);
  for(std::string line; std::getline(in, line); ) lines.push_back(line);
  lines.pop_back();
  return lines;
}

std::string text_of(const Lines& lines)
{
  std::string text;
  for(const std::string& line : lines) text += line + "\n";
  return text + checksum_line(text);
}

std::vector<std::string> words_of(const std::string& line)
{
  std::istringstream in(line);
  return std::vector<std::string>(std::istream_iterator<std::string>(in), std::istream_iterator<std::string>());
}

// the line with another word at a position
std::string with_word(const std::string& line, std::size_t position, const std::string& word)
{
  std::vector<std::string> words = words_of(line);
  words.at(position) = word;
  std::string changed = words[0];
  for(std::size_t n = 1; n < words.size(); ++n) changed += " " + words[n];
  return changed;
}

std::size_t line_that_begins_with(const Lines& lines, const std::string& text)
{
  for(std::size_t n = 0; n < lines.size(); ++n)
    if(lines[n].compare(0, text.size(), text) == 0) return n;
  FAIL("no such line: " + text);
  return 0;
}

// numbers with a comma and grouped digits
struct Foreign_numbers : std::numpunct<char>
{
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

// a disk that is full
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

} // namespace

TEST_CASE("files: the checksum is CRC-64/XZ, of a text at once or of what goes to a stream")
{
  BS::Checksum checksum;
  CHECK(checksum.value() == 0);
  checksum.add("123456789");
  CHECK(checksum.value() == 0x995DC9BBDF1939FAull);      // the published check value
  CHECK(BS::Checksum::text(checksum.value()) == "995dc9bbdf1939fa");
  CHECK(BS::Checksum::text(10) == "000000000000000a");

  std::ostringstream target;
  BS::Checksum_streambuf passing(target.rdbuf()), counting;
  std::ostream summed(&passing), nowhere(&counting);
  for(std::ostream* out : { &summed, &nowhere }) *out << "12" << 3 << '4' << std::string("56789") << std::flush;
  CHECK(target.str() == "123456789");
  CHECK(passing.checksum() == 0x995DC9BBDF1939FAull);
  CHECK(counting.checksum() == 0x995DC9BBDF1939FAull);

  // numbers are their little-endian bytes
  BS::Checksum numbers;
  numbers.add(-1.75);
  numbers.add(std::uint32_t(0x01020304));
  CHECK(numbers.value() == slow_checksum(as_bytes(-1.75) + "\x04\x03\x02\x01"));
  Full_disk disk(4);
  BS::Checksum_streambuf full(&disk);
  std::ostream stopped(&full);
  stopped << "1234" << "56";
  CHECK_FALSE(stopped);
  CHECK(full.checksum() == slow_checksum("1234"));
}

TEST_CASE("files: a shell survives writing and reading, bit by bit")
{
  const auto check = [](const Shell& shell) {
    REQUIRE(shell);
    for(Format format : { Format::BINARY, Format::ASCII }) {
      const std::string bytes = written(shell, format);
      Shell back;
      REQUIRE(read(bytes, back) == Status::SUCCESS);
      CHECK(same(shell, back));
      CHECK(written(back, format) == bytes);
    }
    const std::string text = written(shell, Format::ASCII);
    CHECK(text.substr(text.size() - 26) == "checksum " + BS::Checksum::text(BS::shell_checksum(shell)) + "\n");
  };
  namespace P = CGAL::Bspline_shells::parameters;
  SECTION("of a mesh") { check(CGAL::bspline_shell_3(sphere(2), P::resolution(12))); }
  SECTION("far from the origin, of polygons")
  {
    check(CGAL::bspline_shell_3(box(Point_3(1000.1, -70.3, 0.1), Point_3(1003.1, -68, 1.4), false), P::resolution(9.7)));
  }
  SECTION("of other sizes")
  {
    check(CGAL::bspline_shell_3(sphere(1, 1e-30), P::resolution(6)));
    check(CGAL::bspline_shell_3(sphere(1, 1e30), P::resolution(6)));
  }
  SECTION("two components that are far from each other")
  {
    Mesh two = sphere(1);
    CGAL::copy_face_graph(sphere(1, 1, Point_3(40, 50, 60)), two);
    check(CGAL::bspline_shell_3(two, P::resolution(120)));
  }
  SECTION("a small one") { check(small_shell()); }
  SECTION("extreme numbers")
  {
    typedef std::numeric_limits<double> Limits;
    const double numbers[] = { -0., 0., 1. / 3, Limits::denorm_min(), -(Limits::min)(), 1e300, -1e300, 0.1, 5e-324,
                               123456789.123456789, 1 + Limits::epsilon() };
    check(shell_on(BS::Lattice_3(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1), 0.7), { { 3, -4, 5 }, { 4, -4, 5 }, { 3, -3, 6 } },
                   [&](std::size_t n) { return numbers[n % 11]; }));
  }
  SECTION("cells at the ends of the lattice")
  {
    const int last = BS::internal::Lattice_key::max_coordinate;
    const BS::Lattice_3 lattice(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1), 0.5);
    for(int end : { -last, last }) check(shell_on(lattice, { { end, end, end } }, [](std::size_t) { return 1.; }));
  }
  SECTION("without facet ranges, with levels that are equal")
  {
    const Shell some = small_shell();
    BS::Level_range levels;
    levels.min = levels.max = 0;
    check(Shell(some.field(), levels, some.shell_cells(), {}, some.report()));
  }
}

TEST_CASE("files: a shell that was read answers as the one that was written")
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
  std::ostringstream vtu;
  REQUIRE(BS::write_VTU(vtu, shell, Format::ASCII) == Status::SUCCESS);

  const std::locale foreign(std::locale::classic(), new Foreign_numbers), before = std::locale::global(foreign);
  std::ostringstream probe;
  probe << 12345.5;
  CHECK(probe.str() == "12.345,5");
  std::ostringstream out, out_vtu;
  out.setf(std::ios::hex | std::ios::showpos | std::ios::fixed);
  out.precision(3);
  out.width(50);
  CHECK(BS::write_shell(out, shell, Format::ASCII) == Status::SUCCESS);
  CHECK(BS::write_VTU(out_vtu, shell, Format::ASCII) == Status::SUCCESS);
  Shell from_text, from_bytes, from_file;
  CHECK(read(text, from_text) == Status::SUCCESS);
  CHECK(read(bytes, from_bytes) == Status::SUCCESS);
  const Temporary_file file("locale.shell.txt");
  CHECK(BS::write_shell(file.name, shell) == Status::SUCCESS);
  CHECK(BS::read_shell(file.name, from_file) == Status::SUCCESS);
  std::locale::global(before);
  CHECK(out.str() == text);
  CHECK(out_vtu.str() == vtu.str());
  CHECK(contents(file.name) == text);
  CHECK(same(from_text, shell));
  CHECK(same(from_bytes, shell));
  CHECK(same(from_file, shell));
}

TEST_CASE("files: what was cut off is an error, wherever, and leaves the shell as it was")
{
  const Shell shell = small_shell();
  const Shell before = other_shell();
  for(Format format : { Format::BINARY, Format::ASCII }) {
    const std::string bytes = written(shell, format);
    Shell target = before, none;
    std::size_t accepted = 0;
    for(std::size_t size = 0; size < bytes.size(); ++size)
      if(read(bytes.substr(0, size), target) == Status::SUCCESS) ++accepted;
    CHECK(accepted == 0);
    CHECK(same(target, before));
    for(std::size_t size : { std::size_t(0), bytes.size() / 2, bytes.size() - 1 }) read(bytes.substr(0, size), none);
    CHECK(none.status() == BS::Shell_status::NOT_BUILT);
    // nor may anything follow
    for(const std::string& more : { std::string("\n"), std::string(1, '\0'), std::string(" "), bytes })
      CHECK(read(bytes + more, target) == Status::DAMAGED);
    CHECK(read(bytes, target) == Status::SUCCESS);
    CHECK(same(target, shell));
  }
  // one that is read in several parts
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

TEST_CASE("files: an altered byte is an error, whichever, and leaves the shell as it was")
{
  const Shell shell = small_shell();
  const Shell before = other_shell();
  CGAL::Random random(13);
  for(Format format : { Format::BINARY, Format::ASCII }) {
    const std::string bytes = written(shell, format);
    Shell target = before;
    std::size_t accepted = 0;
    for(std::size_t n = 0; n < bytes.size(); ++n)
      for(int flip : { 1, 0x20, 0x80, random.get_int(1, 256) }) {      // 0x20 turns capital letters into small ones
        std::string altered = bytes;
        altered[n] = char(altered[n] ^ flip);
        if(read(altered, target) == Status::SUCCESS) ++accepted;
      }
    // bytes that are missing, doubled, exchanged
    for(std::size_t n = 0; n + 1 < bytes.size(); n += 7) {
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
}

TEST_CASE("files: a text that contradicts itself is refused, though its checksum is right")
{
  const Shell shell = small_shell();
  const Lines intact = lines_of(written(shell, Format::ASCII));
  Shell target;
  REQUIRE(read(text_of(intact), target) == Status::SUCCESS);
  const std::size_t functions = line_that_begins_with(intact, "functions"), leaves = line_that_begins_with(intact, "leaves"),
                    facets = line_that_begins_with(intact, "facet_ranges");
  const auto check = [&](const std::string& what, const Lines& lines) {
    INFO(what);
    Shell left = shell;
    CHECK(read(text_of(lines), left) == Status::DAMAGED);
    CHECK(same(left, shell));
  };
  const auto altered = [&](const std::string& what, std::size_t line, std::size_t word, const std::string& by) {
    Lines lines = intact;
    lines.at(line) = with_word(lines[line], word, by);
    check(what, lines);
  };
  // every number of a leaf follows from others
  CGAL::Random random(17);
  const std::vector<std::string> leaf = words_of(intact[leaves + 1]);
  REQUIRE(leaf.size() == 73);
  for(std::size_t word = 9; word < leaf.size(); ++word) {
    char text[40];
    std::snprintf(text, sizeof(text), "%.17g", std::stod(leaf[word]) + (random.get_bool() ? 1e-14 : -1e-14));
    altered("a Bernstein coefficient", leaves + 1, word, text);
  }
  altered("a coefficient of a function", functions + 1, 3, "0.5");
  altered("the error radius", leaves + 1, 8, "0");
  altered("the error radius", leaves + 1, 8, "1e-3");
  altered("the width", leaves + 1, 7, "0.3");
  for(std::size_t word : { 4, 5, 6 }) altered("a corner", leaves + 1, word, "0.25");
  altered("a mark", leaves + 1, 3, "2");
  altered("a leaf elsewhere", leaves + 1, 0, "-2");
  altered("a leaf far away", leaves + 2, 2, "1000000");
  altered("a leaf beyond all lattices", leaves + 2, 2, "2000000000");
  altered("a leaf that is no integer", leaves + 2, 2, "2.5");
  altered("a function elsewhere", functions + 1, 0, "-3");
  for(const char* number : { "nan", "inf", "-inf", "1e999", "0x10", "1,5", "+1", "", "1e", "--1", "1e308" }) {
    altered("a coefficient", functions + 5, 3, number);
    altered("a level", 2, 1, number);
    altered("the spacing", 4, 5, number);
    if(std::string(number) != "1e308") altered("a facet", facets + 1, 1, number);
  }
  altered("levels out of order", 2, 1, "0.34");
  altered("a facet's range out of order", facets + 1, 0, "0.31");
  altered("a negative unit", 1, 1, "-1");
  altered("a spacing of too many bits", 4, 5, "0.10000000000000001");
  altered("no spacing", 4, 5, "0");
  altered("an origin of too many bits", 4, 2, "1e-20");
  altered("another kind of field", 4, 1, "dense");
  altered("a count of triangles", 3, 1, "-1");
  for(const char* count : { "0", "1", "79", "81", "4294967295", "4294967376", "18446744073709551615",
                            "18446744073709551616" }) {
    altered("the number of functions", functions, 1, count);
    altered("the number of leaves", leaves, 1, count);
    altered("the number of facets", facets, 1, count);
  }

  Lines lines = intact;
  lines.erase(lines.begin() + std::ptrdiff_t(functions) + 1);
  check("a missing line", lines);
  lines[functions] = "functions 79";
  check("a missing function", lines);
  lines = intact;
  lines.insert(lines.begin() + std::ptrdiff_t(functions) + 1, "-5 -1 1 0");
  lines[functions] = "functions 81";
  check("a function that acts on no cell", lines);
  lines = intact;
  std::swap(lines[functions + 1], lines[functions + 2]);
  check("functions out of order", lines);
  lines = intact;
  std::swap(lines[leaves + 1], lines[leaves + 2]);
  check("leaves out of order", lines);
  lines = intact;
  lines[leaves + 2] = lines[leaves + 1];
  check("a leaf twice", lines);
  lines = intact;
  lines.erase(lines.begin() + std::ptrdiff_t(leaves) + 1);
  lines[leaves] = "leaves 1";
  check("a missing leaf", lines);
  lines = intact;
  lines.erase(lines.begin() + std::ptrdiff_t(leaves) + 1, lines.begin() + std::ptrdiff_t(leaves) + 3);
  lines.erase(lines.begin() + std::ptrdiff_t(functions) + 1, lines.begin() + std::ptrdiff_t(leaves));
  lines[functions] = "functions 0";
  lines[functions + 1] = "leaves 0";
  check("no leaf", lines);
  for(std::size_t line : { std::size_t(1), functions, functions + 1, leaves, leaves + 1, facets, facets + 1 }) {
    for(const char* more : { " ", " 1", "\r", "\t" }) {
      lines = intact;
      lines[line] += more;
      check("something after a line", lines);
    }
    lines = intact;
    lines[line].insert(lines[line].find(' '), " ");
    check("two blanks", lines);
    lines = intact;
    lines[line] = " " + lines[line];
    check("a blank first", lines);
    lines = intact;
    lines.insert(lines.begin() + std::ptrdiff_t(line), "");
    check("an empty line", lines);
  }
  lines = intact;
  lines[1] = "unit " + std::string(100000, '0') + "1";
  check("a line longer than any should be", lines);

  // what has no other side may differ: it is another shell then
  lines = intact;
  lines[3] = "triangles 21 components 2";
  Shell other;
  CHECK(read(text_of(lines), other) == Status::SUCCESS);
  CHECK(other.report().triangles == 21);
}

TEST_CASE("files: rounding as on machines that fuse products and sums is no damage, and f is what the functions say")
{
  const Shell shell = small_shell();
  Lines lines = lines_of(written(shell, Format::ASCII));
  const std::size_t leaves = line_that_begins_with(lines, "leaves");
  for(std::size_t word : { 9, 30, 72 }) {
    char text[40];
    std::snprintf(text, sizeof(text), "%.17g", std::nextafter(std::stod(words_of(lines[leaves + 1])[word]), 1.));
    lines[leaves + 1] = with_word(lines[leaves + 1], word, text);
  }
  Shell back;
  REQUIRE(read(text_of(lines), back) == Status::SUCCESS);
  CHECK(same(back, shell));
}

TEST_CASE("files: bytes that contradict themselves are refused, though their checksum is right")
{
  const Shell shell = small_shell();
  const std::string intact = written(shell, Format::BINARY);
  const auto check = [&](const std::string& what, std::string bytes) {
    INFO(what);
    bytes += as_bytes(slow_checksum(bytes));
    Shell left = shell;
    CHECK(read(bytes, left) == Status::DAMAGED);
    CHECK(same(left, shell));
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
    for(std::size_t offset : { 8, 16, 24, 48, 56, 64, 72, 138, 138 + 79 * 8, 138 + 80 * 8, 138 + 80 * 8 + 40 })
      altered("a number", offset, as_bytes(x));
  // far more than the file holds: found out before the memory is taken
  for(std::uint64_t count : { 0ull, 1ull, 1ull << 31, 1ull << 40, 1ull << 63, ~0ull })
    for(std::size_t offset : { 80, 88, 96 }) altered("a count", offset, as_bytes(count));
  altered("another kind of field", 104, as_bytes(std::uint64_t(1)));
  altered("another cell", 112, std::string("\x02\0\0\0", 4));
  altered("the same cell twice", 125, std::string("\xff\xff\xff\xff", 4));
  altered("a mark", 124, "\x02");
  check("a number more", body + as_bytes(1.));
}

TEST_CASE("files: a few cells far from each other do not take all memory")
{
  // cells along a diagonal, whose table of rows would have 10^12 entries
  std::string bytes = written(small_shell(), Format::BINARY).substr(0, 80);
  for(std::uint64_t x : { 128, 2, 0, 0 }) bytes += as_bytes(x);
  for(int i : { -1000000, 1000000 }) {
    for(int a = 0; a < 3; ++a) bytes.append(as_bytes(std::uint64_t(std::uint32_t(i))), 0, 4);
    bytes += '\1';
  }
  for(int n = 0; n < 128; ++n) bytes += as_bytes(0.5);
  bytes += as_bytes(slow_checksum(bytes));
  Shell shell;
  CHECK(read(bytes, shell) == Status::DAMAGED);
  CHECK(shell.status() == BS::Shell_status::NOT_BUILT);
}

TEST_CASE("files: foreign files, later versions, no file at all")
{
  const Shell before = small_shell();
  Shell shell = before;
  const std::string text = written(before, Format::ASCII), bytes = written(before, Format::BINARY);
  for(const char* foreign : { "", "\n", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "cubic_bspline_shell_certificate 1\n",
                              "BSHELF01", "cubic_bspline_shell\n", "cubic_bspline_shell 1 binary\n" })
    CHECK(read(foreign, shell) == Status::NOT_A_SHELL);
  CHECK(read(std::string(100000, '\0'), shell) == Status::NOT_A_SHELL);
  CHECK(read("cubic_bspline_shell 2 ascii" + text.substr(text.find('\n')), shell) == Status::VERSION_NOT_SUPPORTED);
  CHECK(read("cubic_bspline_shell 2 something\nelse", shell) == Status::VERSION_NOT_SUPPORTED);
  CHECK(read("BSHELL02" + bytes.substr(8), shell) == Status::VERSION_NOT_SUPPORTED);
  CHECK(BS::read_shell("no_such_file.shell", shell) == Status::CANNOT_OPEN);
  CHECK(BS::read_shell(".", shell) == Status::CANNOT_OPEN);
  std::ifstream missing("no_such_file.shell");
  CHECK(BS::read_shell(missing, shell) == Status::CANNOT_OPEN);
  CHECK(same(shell, before));
  for(Status status : { Status::SUCCESS, Status::CANNOT_OPEN, Status::CANNOT_WRITE, Status::NOT_A_SHELL,
                        Status::VERSION_NOT_SUPPORTED, Status::DAMAGED })
    CHECK_FALSE(std::string(BS::message(status)).empty());
}

TEST_CASE("files: reading throws nothing, even from a stream that is set to")
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

  std::ostringstream out;
  CHECK(BS::write_VTU(out, Shell()) == Status::NOT_A_SHELL);
  CHECK(out.str().empty());
  CHECK(BS::write_shell("none.shell", Shell()) == Status::NOT_A_SHELL);
  CHECK(BS::write_VTU("none.vtu", Shell()) == Status::NOT_A_SHELL);
  CHECK_FALSE(std::ifstream("none.shell"));
  CHECK_FALSE(std::ifstream("none.vtu"));
}

TEST_CASE("files: they are there and complete, or as before")
{
  const Shell shell = small_shell();
  const Temporary_file binary("small.shell"), text("small.shell.txt"), vtu("small.vtu");
  CHECK(BS::write_shell(binary.name, shell) == Status::SUCCESS);
  CHECK(BS::write_shell(text.name, shell) == Status::SUCCESS);
  CHECK(BS::write_VTU(vtu.name, shell) == Status::SUCCESS);
  CHECK(contents(binary.name) == written(shell, Format::BINARY));
  CHECK(contents(text.name) == written(shell, Format::ASCII));
  CHECK(contents(vtu.name).substr(0, 5) == "<?xml");
  for(const std::string& name : { binary.name, text.name, vtu.name }) CHECK_FALSE(std::ifstream(name + ".part"));
  Shell back;
  CHECK(BS::read_shell(binary.name, back) == Status::SUCCESS);
  CHECK(BS::read_shell(text.name, back) == Status::SUCCESS);
  // what is no shell does not replace one
  CHECK(BS::write_shell(binary.name, Shell()) == Status::NOT_A_SHELL);
  CHECK(BS::write_VTU(vtu.name, Shell()) == Status::NOT_A_SHELL);
  CHECK(contents(binary.name) == written(shell, Format::BINARY));
  CHECK(contents(vtu.name).substr(0, 5) == "<?xml");
  CHECK_FALSE(std::ifstream(vtu.name + ".part"));
  // the extension does not decide if the format is given, nor when reading
  CHECK(BS::write_shell(binary.name, shell, Format::ASCII) == Status::SUCCESS);
  CHECK(contents(binary.name) == written(shell, Format::ASCII));
  CHECK(BS::read_shell(binary.name, back) == Status::SUCCESS);

  CHECK(BS::write_shell("no_such_folder/small.shell", shell) == Status::CANNOT_WRITE);
  CHECK(BS::write_VTU("no_such_folder/small.vtu", shell) == Status::CANNOT_WRITE);
  for(std::size_t capacity : { 0, 100, 800 })
    for(Format format : { Format::BINARY, Format::ASCII }) {
      Full_disk disk(capacity), vtu_disk(capacity);
      std::ostream out(&disk), vtu_out(&vtu_disk);
      CHECK(BS::write_shell(out, shell, format) == Status::CANNOT_WRITE);
      CHECK(BS::write_VTU(vtu_out, shell, format) == Status::CANNOT_WRITE);
    }
}

namespace {

typedef boost::property_tree::ptree Tree;

template <typename T>
std::vector<T> numbers_of(const std::string& text)
{
  std::istringstream in(text);
  std::vector<T> numbers;
  for(T x; in >> x; ) numbers.push_back(x);
  CHECK(in.eof());
  return numbers;
}

// the arrays of a VTU file in text, by name
struct Grid
{
  explicit Grid(const std::string& xml)
  {
    std::istringstream in(xml);
    Tree tree;
    REQUIRE_NOTHROW(boost::property_tree::read_xml(in, tree));
    const Tree& file = tree.get_child("VTKFile");
    CHECK(file.get<std::string>("<xmlattr>.type") == "UnstructuredGrid");
    CHECK(file.get<std::string>("<xmlattr>.version") == "2.2");       // the order of control points depends on it
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
    positions = numbers_of<double>(arrays["Points"]);
    degrees = numbers_of<double>(arrays["HigherOrderDegrees"]);
    connectivity = numbers_of<std::int64_t>(arrays["connectivity"]);
    offsets = numbers_of<std::int64_t>(arrays["offsets"]);
    types = numbers_of<int>(arrays["types"]);
    const auto data = file.get_child_optional("UnstructuredGrid.FieldData.DataArray");
    if(data) levels = numbers_of<double>(data->data());
  }

  std::size_t points, cells;
  std::vector<double> f, positions, degrees, levels;
  std::vector<std::int64_t> connectivity, offsets;
  std::vector<int> types;
};

template <typename T>
void append(std::string& bytes, const std::vector<T>& numbers)
{
  bytes += as_bytes(std::uint64_t(numbers.size() * sizeof(T)));
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
}

} // namespace

TEST_CASE("VTU: the cells of the shell as Bezier hexahedra, and f at their control points")
{
  const Shell shell = CGAL::bspline_shell_3(sphere(2), CGAL::Bspline_shells::parameters::resolution(10));
  REQUIRE(shell);
  const Field& field = shell.field();
  for(bool whole_field : { false, true }) {
    std::ostringstream out;
    REQUIRE((whole_field ? BS::write_VTU(out, field, Format::ASCII)
                         : BS::write_VTU(out, shell, Format::ASCII)) == Status::SUCCESS);
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
    // VTK's order of corners; then, as a sample, one point of an edge along z, of a face, and of the interior
    const int order[][4] = { { 0, 0, 0, 0 }, { 1, 3, 0, 0 }, { 2, 3, 3, 0 }, { 3, 0, 3, 0 }, { 4, 0, 0, 3 }, { 5, 3, 0, 3 },
                             { 6, 3, 3, 3 }, { 7, 0, 3, 3 }, { 28, 3, 3, 1 }, { 31, 0, 3, 2 }, { 32, 0, 1, 1 },
                             { 41, 2, 0, 1 }, { 57, 2, 1, 1 } };
    for(std::size_t n = 0; n < cells.size(); ++n) {
      const auto cell = field.cell(cells[n]);
      offsets = offsets && grid.offsets[n] == std::int64_t(64 * (n + 1));
      std::set<std::int64_t> different;
      for(std::size_t v = 0; v < 64; ++v) {
        const std::int64_t point = grid.connectivity[64 * n + v];
        REQUIRE(point >= 0);
        REQUIRE(std::size_t(point) < grid.points);
        different.insert(point);
        // the control point that is there, and its coefficient
        int index = 0;
        for(int a = 0, stride = 1; a < 3; ++a, stride *= 4) {
          const double step = 3 * (grid.positions[std::size_t(3 * point + a)] - cell.corner()[std::size_t(a)]) / cell.width();
          points = points && std::abs(step - std::round(step)) < 1e-9 && step > -0.5 && step < 3.5;
          index += stride * int(std::round(step));
        }
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
          interpolates = interpolates && std::abs(grid.f[point] - field.value(Point_3(p[0], p[1], p[2])).value()) < rounding;
        }
      }
    }
    CHECK(offsets);
    CHECK(points);
    CHECK(values);
    CHECK(corners);
    CHECK(interpolates);
    // neighbours share their points: no position occurs twice, and every point is used
    std::set<std::array<double, 3> > positions;
    for(std::size_t p = 0; p < grid.points; ++p)
      positions.insert({ grid.positions[3 * p], grid.positions[3 * p + 1], grid.positions[3 * p + 2] });
    CHECK(positions.size() == grid.points);
    CHECK(std::set<std::int64_t>(grid.connectivity.begin(), grid.connectivity.end()).size() == grid.points);

    // the binary file has the same numbers, one array after the other, where the XML says
    std::ostringstream binary;
    REQUIRE((whole_field ? BS::write_VTU(binary, field) : BS::write_VTU(binary, shell)) == Status::SUCCESS);
    const std::string bytes = binary.str();
    std::string expected;
    std::vector<std::size_t> begins;
    const auto add = [&](const auto& numbers) { begins.push_back(expected.size()); append(expected, numbers); };
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

TEST_CASE("files: a lattice is made of its origin and spacing if all corners are exact")
{
  typedef BS::Lattice_3 Lattice;
  typedef Lattice::Point Point;
  const auto is_exact = [](double origin, double spacing, int first, int last) {
    return Lattice::from_origin({ 0, origin, 0 }, spacing, Point{ 0, first, 0 }, Point{ 0, last, 0 }).is_exact();
  };
  const double bit = std::ldexp(1., -19);
  CHECK(is_exact(0, 1, 0, 0));
  CHECK(is_exact(-3.5, 0.75, -100, 100));
  CHECK(is_exact(0, 1 + bit, -1000, 1000));
  CHECK_FALSE(is_exact(0, 1 + bit / 2, 0, 0));             // 21 bits
  CHECK_FALSE(is_exact(0, 0.1, 0, 0));
  CHECK_FALSE(is_exact(0.1, 1, 0, 1000));                  // 0.1 + 1000 is rounded
  CHECK(is_exact(std::ldexp(1., 40), 1, 0, 0));            // 2^40 + 1/4096 has 53 bits
  CHECK_FALSE(is_exact(std::ldexp(1., 41), 1, 0, 0));
  CHECK_FALSE(is_exact(0, std::numeric_limits<double>::denorm_min(), 0, 0));      // cells could not be halved
  CHECK(is_exact(0, std::ldexp(1., -1074 + 12), 0, 0));
  for(double x : { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() }) {
    CHECK_FALSE(is_exact(x, 1, 0, 0));
    CHECK_FALSE(is_exact(0, x, 0, 0));
    CHECK_FALSE(is_exact(0, -x, 0, 0));
  }
  CHECK_FALSE(is_exact(0, 0, 0, 0));
  CHECK_FALSE(is_exact(0, -1, 0, 0));
  CHECK_FALSE(is_exact(0, std::ldexp(1., 1023), 0, 2));    // corners beyond all doubles

  // lattices that the other constructor makes are among them, with all the cells that a shell may have
  CGAL::Random random(19);
  for(int n = 0; n < 2000; ++n) {
    const double size = std::pow(10., random.get_double(-60, 60)), far = std::pow(10., random.get_double(0, 8));
    double a[3], b[3];
    for(int k = 0; k < 3; ++k) {
      a[k] = size * far * random.get_double(-1, 1);
      b[k] = a[k] + size * random.get_double(0.1, 1);
    }
    const CGAL::Bbox_3 box(a[0], a[1], a[2], b[0], b[1], b[2]);
    const Lattice lattice = Lattice::off_the_ends(box, size / std::pow(10., random.get_double(0, 5)));
    if(!lattice.is_exact()) continue;
    Point first, last;
    for(int k = 0; k < 3; ++k) {
      first[std::size_t(k)] = lattice.interval(k, a[k]) - 1020;
      last[std::size_t(k)] = lattice.interval(k, b[k]) + 1020;
    }
    const Lattice same = Lattice::from_origin(lattice.origin(), lattice.spacing(), first, last);
    REQUIRE(same.is_exact());
    REQUIRE(same.origin() == lattice.origin());
    REQUIRE(same.spacing() == lattice.spacing());
  }
}
