// certify.h: a shell that was read from a file is certified again, and nothing in the file is trusted.
#include <CGAL/Bspline_shell_3/Certificate/certify.h>
#include "shell_files.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_containment_3.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>

#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <array>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

namespace test_certify {
namespace {

typedef BS::Shell_certificate_3<Varying_shell::Field, Varying_shell::Threshold> Certificate;
typedef BS::Shell_map_3<Varying_shell, Mesh> Map;
using BS::Flow_status;
using BS::Verdict;

Mesh near_sphere(double radius = 1)
{
  return sphere(2, radius);
}
Mesh far_sphere(double radius = 1)
{
  return sphere(2, radius, Point_3(3, 0, 0));
}
const Mesh& two_spheres()
{
  static const Mesh mesh = joined(near_sphere(), far_sphere());
  return mesh;
}
const Varying_shell& two_shells()
{
  static const Varying_shell shell = CGAL::certified_bspline_shell_3(two_spheres(),
                                                                     BS::parameters::relative_thickness(0.05));
  REQUIRE(shell.is_certified());
  return shell;
}

Varying_shell read_shell(const std::string& bytes)
{
  Varying_shell shell;
  REQUIRE(read(bytes, shell) == Status::SUCCESS);
  CHECK_FALSE(shell.is_certified());
  return shell;
}
Varying_shell read_two_shells()
{
  return read_shell(written(two_shells(), Format::BINARY));
}

// Returns the shell of the two spheres, read from a file in which `change` has edited the lines of the paths.
Varying_shell with_paths(const std::function<void(Lines& paths)>& change)
{
  Lines lines = lines_of(written(two_shells(), Format::ASCII));
  const std::size_t begin = line_that_begins_with(lines, "paths"), end = line_that_begins_with(lines, "truncation");
  Lines paths(lines.begin() + std::ptrdiff_t(begin) + 1, lines.begin() + std::ptrdiff_t(end));
  REQUIRE(paths.size() > 2);
  change(paths);
  lines.erase(lines.begin() + std::ptrdiff_t(begin) + 1, lines.begin() + std::ptrdiff_t(end));
  lines[begin] = "paths " + std::to_string(paths.size());
  lines.insert(lines.begin() + std::ptrdiff_t(begin) + 1, paths.begin(), paths.end());
  return read_shell(text_of(lines));
}

bool has(const BS::Certificate_report& report, BS::Certificate_witness::Reason reason)
{
  return std::any_of(report.witnesses.begin(), report.witnesses.end(),
                     [&](const BS::Certificate_witness& w) { return w.reason == reason; });
}

bool are_same_paths(const std::vector<BS::Crossing_path>& a, const std::vector<BS::Crossing_path>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const BS::Crossing_path& p, const BS::Crossing_path& q) {
    return p.component == q.component && p.source == q.source && p.target == q.target;
  });
}

} // namespace

TEST_CASE("certify: a shell read from a file gets its previous certificate, cover and paths")
{
  for(Format format : { Format::BINARY, Format::ASCII }) {
    Varying_shell shell = read_shell(written(two_shells(), format));
    CHECK(shell.component_paths().empty());
    CHECK(shell.message() == BS::message(BS::Shell_status::SUCCESS));
    const auto certificate = BS::certify(shell, two_spheres());
    CHECK(certificate);
    REQUIRE(shell.is_certified());
    CHECK(shell.message() == "The shell is certified.");
    const BS::Certificate_report &before = two_shells().report().certificate, &after = shell.report().certificate;
    CHECK(after.components == before.components);
    CHECK(after.least_gradient == before.least_gradient);
    CHECK(after.largest_gradient == before.largest_gradient);
    CHECK(after.displacement_bound == before.displacement_bound);
    CHECK(after.least_angle == before.least_angle);
    CHECK(are_same_paths(shell.component_paths(), two_shells().component_paths()));
    CHECK(shell.path_candidates().empty());
    REQUIRE(shell.proved_cover());
    CHECK(shell.proved_cover()->size() == two_shells().proved_cover()->size());
    CHECK(shell.shell_cells() == two_shells().shell_cells());
    CHECK(shell.cell_bounds());
    // The file of the shell is also the same.
    CHECK(written(shell, format) == written(two_shells(), format));
  }
}

TEST_CASE("certify: another mesh in the same components certifies the shell as well")
{
  Varying_shell shell = read_two_shells();
  const Mesh moved = joined(far_sphere(0.995), near_sphere(1.01));
  REQUIRE(BS::certify(shell, moved));
  REQUIRE(shell.is_certified());
  CHECK(Certificate(shell).verify(two_spheres()));
  CHECK(Map(shell, two_spheres(), moved).status() == Flow_status::SUCCESS);
}

TEST_CASE("certify: a mesh that misses a component is not certified, before or after the shell is")
{
  for(bool is_certified : { false, true }) {
    Varying_shell shell = read_two_shells();
    if(is_certified) REQUIRE(BS::certify(shell, two_spheres()));
    for(const Mesh& one : { near_sphere(), far_sphere() }) {
      Certificate certificate(shell);
      CHECK_FALSE(certificate.verify(one));
      CHECK(has(certificate.report(), BS::Certificate_witness::EMPTY_COMPONENT));
      CHECK(certificate.verdict(BS::Claim::ONE_SHEET) == (is_certified ? Verdict::REFUTED : Verdict::UNDECIDED));
      CHECK(has(BS::certify(shell, one).report(), BS::Certificate_witness::EMPTY_COMPONENT));
      CHECK(shell.is_certified() == is_certified);
    }
    CHECK(Certificate(shell).verify(two_spheres()));
  }
}

TEST_CASE("certify: a map between meshes in different components never has the status SUCCESS")
{
  const Mesh near = near_sphere(), other_near = near_sphere(1.01), far = far_sphere();
  Varying_shell shell = read_two_shells();
  const auto status = [&](const Mesh& source, const Mesh& target) {
    const Map map(shell, source, target);
    CHECK(map.inverse().status() == map.status());
    return map.status();
  };
  CHECK(status(near, far) == Flow_status::COMPONENTS_UNKNOWN);
  CHECK(status(near, two_spheres()) == Flow_status::COMPONENTS_UNKNOWN);
  CHECK(status(two_spheres(), far) == Flow_status::COMPONENTS_UNKNOWN);
  CHECK(status(near, other_near) == Flow_status::SUCCESS);
  CHECK(status(two_spheres(), two_spheres()) == Flow_status::SUCCESS);
  // Points are mapped nevertheless, and each has a status.
  const Map unknown(shell, near, far), partly(shell, near, two_spheres());
  CHECK(unknown.maps_points());
  CHECK(unknown(Mesh::Vertex_index(0)).status == Flow_status::LEAVES_SHELL);
  CHECK(partly(Mesh::Vertex_index(0)).status == Flow_status::SUCCESS);
  REQUIRE(BS::certify(shell, two_spheres()));
  CHECK(status(near, far) == Flow_status::COMPONENTS_DIFFER);
  CHECK(status(near, two_spheres()) == Flow_status::COMPONENTS_DIFFER);
  CHECK(status(two_spheres(), two_spheres()) == Flow_status::SUCCESS);
  CHECK_FALSE(Map(shell, near, far).maps_points());
  CHECK(Map(shell, near, far)(Mesh::Vertex_index(0)).status == Flow_status::COMPONENTS_DIFFER);
}

TEST_CASE("certify: paths of a file that do not lead through the shell are ignored")
{
  const auto check = [&](const std::function<void(Lines & paths)>& change) {
    Varying_shell shell = with_paths(change);
    CHECK(shell.component_paths().empty());
    // The mesh defines the components.
    REQUIRE(BS::certify(shell, two_spheres()));
    CHECK(are_same_paths(shell.component_paths(), two_shells().component_paths()));
    CHECK_FALSE(Certificate(shell).verify(near_sphere()));
  };
  check([](Lines& paths) { paths.clear(); });
  // The paths are reversed, shortened at either end, displaced, of length zero, or outside the domain.
  typedef std::array<double, 6> Path;
  const auto check_replaced = [&](const std::function<Path(const Path&)>& by) {
    check([&](Lines& paths) {
      for(std::string& line : paths) {
        std::size_t component;
        Path x;
        std::istringstream in(line);
        in >> component;
        for(double& c : x) in >> c;
        REQUIRE(in);
        std::ostringstream out;
        out.precision(17);
        out << component;
        for(double c : by(x)) out << " " << c;
        line = out.str();
      }
    });
  };
  check_replaced([](const Path& x) { return Path{ x[3], x[4], x[5], x[0], x[1], x[2] }; });
  check_replaced(
    [](const Path& x) { return Path{ x[0], x[1], x[2], (x[0] + x[3]) / 2, (x[1] + x[4]) / 2, (x[2] + x[5]) / 2 }; });
  check_replaced(
    [](const Path& x) { return Path{ (x[0] + x[3]) / 2, (x[1] + x[4]) / 2, (x[2] + x[5]) / 2, x[3], x[4], x[5] }; });
  check_replaced([](const Path& x) { return Path{ x[0], x[1] + 40, x[2], x[3], x[4] + 40, x[5] }; });
  check_replaced([](const Path& x) { return Path{ x[0], x[1], x[2], x[0], x[1], x[2] }; });
  check_replaced([](const Path&) { return Path{ 1e300, 0, 0, -1e300, 0, 0 }; });
}

TEST_CASE("certify: a file with duplicate or missing component numbers certifies no map between components")
{
  const auto check = [](Varying_shell shell) {
    // Either component can be certified, but then the other one is not part of the shell.
    REQUIRE(BS::certify(shell, near_sphere()));
    CHECK(shell.report().certificate.components == std::vector<std::size_t>{ 0 });
    CHECK(Certificate(shell).verify(near_sphere(1.01)));
    CHECK_FALSE(Certificate(shell).verify(far_sphere()));
    CHECK_FALSE(Certificate(shell).verify(two_spheres()));
    const Mesh near = near_sphere(), far = far_sphere();
    CHECK(Map(shell, near, far).status() == Flow_status::COMPONENTS_DIFFER);
    CHECK_FALSE(BS::Shell_containment_3<Varying_shell::Field, Varying_shell::Threshold>(shell)(Point_3(4, 0, 0)));
  };
  check(with_paths([](Lines& paths) {
    for(std::string& line : paths) line = with_word(line, 0, "0");
  }));
  check(with_paths([](Lines& paths) {
    const auto is_of_second = [](const std::string& line) { return line[0] == '1'; };
    paths.erase(std::remove_if(paths.begin(), paths.end(), is_of_second), paths.end());
  }));
}

TEST_CASE("certify: a uniform shell is certified by its own mesh, but not by an open or inverted mesh")
{
  const Mesh mesh = near_sphere();
  Shell shell = CGAL::bspline_shell_3(mesh, BS::parameters::resolution(12.));
  REQUIRE(shell);
  CHECK_FALSE(shell.is_certified());
  Mesh open = mesh;
  CGAL::Euler::remove_face(open.halfedge(*open.faces().begin()), open);
  CHECK(BS::certify(shell, open).status() == BS::Shell_status::OPEN_MESH);
  CHECK_FALSE(shell.is_certified());
  const Mesh turned = reversed(mesh);
  CHECK(BS::certify(shell, turned).verdict(BS::Claim::TRANSVERSALITY) == Verdict::REFUTED);
  CHECK_FALSE(shell.is_certified());
  REQUIRE(BS::certify(shell, mesh));
  CHECK(shell.message() == "The shell is certified.");
  CHECK(shell.is_certified());
  CHECK_FALSE(BS::certify(shell, turned));
  CHECK(shell.is_certified());
  // An empty shell is not certified.
  Shell none;
  CHECK(BS::certify(none, mesh).status() == BS::Shell_status::NOT_BUILT);
  CHECK_FALSE(none.is_certified());
}

TEST_CASE("certify: a failed certification leaves the shell unchanged, so another mesh can still certify it")
{
  Varying_shell shell = read_two_shells();
  const std::vector<char> cells = shell.shell_cells();
  CHECK(BS::certify(shell, near_sphere()).verdict(BS::Claim::GRADIENT) == Verdict::PROVED);
  CHECK_FALSE(shell.is_certified());
  CHECK(shell.shell_cells() == cells);
  CHECK(shell.report().certificate.verdict(BS::Claim::GRADIENT) == Verdict::UNDECIDED);
  CHECK(BS::certify(shell, two_spheres()));
}

TEST_CASE("certify: the returned certificate rejects meshes in other components of the shell")
{
  Varying_shell shell = with_paths([](Lines& paths) { paths.clear(); });
  auto certificate = BS::certify(shell, near_sphere());
  REQUIRE(certificate);
  CHECK(certificate.verify(near_sphere(1.01)));
  CHECK_FALSE(certificate.verify(far_sphere()));
  CHECK_FALSE(certificate.certify(shell));
  CHECK(shell.is_certified());
}

TEST_CASE("certify: paths in the report of an uncertified shell are ignored")
{
  BS::Shell_report report = two_shells().report();
  report.certificate.verdicts[std::size_t(BS::Claim::ONE_SHEET)] = Verdict::UNDECIDED;
  const Varying_shell shell(two_shells().field(), two_shells().inner_threshold(), two_shells().outer_threshold(),
                            two_shells().shell_cells(), {}, report);
  CHECK_FALSE(shell.is_certified());
  CHECK(shell.component_paths().empty());
  CHECK(written(shell, Format::ASCII).find("\npaths 0\n") != std::string::npos);
}

TEST_CASE("certify: matching certificates of different thresholds or fields is undecided")
{
  const Mesh mesh = near_sphere();
  const Shell shell = CGAL::bspline_shell_3(mesh, BS::parameters::resolution(12.)),
              copy(Shell::Field(shell.field()), BS::Level_range{ shell.inner_level(), shell.outer_level() },
                   shell.shell_cells(), {}, shell.report());
  typedef BS::Shell_certificate_3<> Certificate;
  const auto certificate = [&](const Field& field, double inner, double outer) {
    Certificate result(field, BS::Constant_threshold(inner), BS::Constant_threshold(outer));
    REQUIRE(result.verify(mesh));
    return result;
  };
  const double inner = shell.inner_level(), outer = shell.outer_level();
  const Certificate first = certificate(shell.field(), inner, outer);
  CHECK(first.matches(certificate(shell.field(), inner, outer)) == Verdict::PROVED);
  CHECK(first.matches(certificate(shell.field(), 1.01 * inner, outer)) == Verdict::UNDECIDED);
  CHECK(first.matches(certificate(shell.field(), inner, 1.01 * outer)) == Verdict::UNDECIDED);
  CHECK(first.matches(certificate(copy.field(), inner, outer)) == Verdict::UNDECIDED);
  // varying thresholds
  const Varying_shell back = read_two_shells();
  CHECK(back.inner_threshold() == two_shells().inner_threshold());
  CHECK_FALSE(back.inner_threshold() == two_shells().outer_threshold());
  CHECK_FALSE(back.inner_threshold() == Varying_shell::Threshold());
}
} // namespace test_certify
