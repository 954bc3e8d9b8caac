// The shell of a mesh does not depend on the type of the mesh, or on the order of named parameters.
#include "test_meshes.h"

#include <CGAL/bspline_shell_3.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <vector>

namespace test_mesh_types {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace P = CGAL::Bspline_shells::parameters;
typedef CGAL::Bspline_shell_3<> Shell;
typedef CGAL::Sequential_tag Tag;
typedef CGAL::Exact_predicates_exact_constructions_kernel Epeck;
typedef CGAL::Simple_cartesian<double> Plain;
typedef CGAL::Polyhedron_3<Kernel> Polyhedron;

// Returns a mesh of quadrangles and triangles. A copied facet may begin at another corner, which changes rounding, so
// all meshes are copies.
template <typename FaceGraph>
FaceGraph mixed_mesh()
{
  FaceGraph mesh;
  CGAL::copy_face_graph(box(Point_3(0, 0, 0), Point_3(1, 0.5, 0.5), false), mesh);
  CGAL::copy_face_graph(sphere(1, 0.4, Point_3(0.5, 1.125, 0.25)), mesh);
  return mesh;
}

void check_identical(const Shell& a, const Shell& b)
{
  REQUIRE(a);
  REQUIRE(b);
  CHECK(a.inner_level() == b.inner_level());
  CHECK(a.outer_level() == b.outer_level());
  REQUIRE(a.field().number_of_coefficients() == b.field().number_of_coefficients());
  CHECK((a.field().coefficients() == b.field().coefficients())); // failures do not print the vectors
  REQUIRE(a.facet_ranges().size() == b.facet_ranges().size());
  bool same = true;
  for(std::size_t n = 0; n < a.facet_ranges().size(); ++n)
    same = same && a.facet_ranges()[n].min == b.facet_ranges()[n].min
           && a.facet_ranges()[n].max == b.facet_ranges()[n].max;
  CHECK(same);
}

const Shell& reference()
{
  static const Shell shell = CGAL::bspline_shell_3<Tag>(mixed_mesh<Mesh>(), P::resolution(10));
  return shell;
}

} // namespace

TEST_CASE("Mesh types: a Surface_mesh with another kernel has the same shell")
{
  const auto plain = mixed_mesh<CGAL::Surface_mesh<Plain::Point_3> >();
  check_identical(reference(), CGAL::bspline_shell_3<Tag>(plain, P::resolution(10)));
  const auto exact = mixed_mesh<CGAL::Surface_mesh<Epeck::Point_3> >();
  check_identical(reference(), CGAL::bspline_shell_3<Tag>(exact, P::resolution(10)));
}

TEST_CASE("Mesh types: a Polyhedron_3 has the same shell, with facet ranges in its own order")
{
  const Polyhedron polyhedron = mixed_mesh<Polyhedron>();
  const Shell shell = CGAL::bspline_shell_3<Tag>(polyhedron, P::resolution(10));
  REQUIRE(shell);
  REQUIRE(shell.facet_ranges().size() == polyhedron.size_of_facets());
  // Facets may begin at another corner, which changes quadrature: see test_invariance.cpp.
  const double tolerance = 1e-3 * shell.field().cells().lattice().spacing();
  CHECK(shell.report().cells == reference().report().cells);
  CHECK(std::abs(shell.inner_level() - reference().inner_level()) < tolerance);
  CHECK(std::abs(shell.outer_level() - reference().outer_level()) < tolerance);
  std::size_t n = 0;
  bool enclosed = true;
  for(auto f : faces(polyhedron)) {
    for(auto h : CGAL::halfedges_around_face(halfedge(f, polyhedron), polyhedron)) {
      const double value = shell.field().value(target(h, polyhedron)->point()).value();
      enclosed = enclosed && value >= shell.facet_ranges()[n].min - 1e-14
                 && value <= shell.facet_ranges()[n].max + 1e-14;
    }
    ++n;
  }
  CHECK(enclosed);
}

TEST_CASE("Mesh types: offending simplices of a Polyhedron_3 are positions in its ranges")
{
  Polyhedron polyhedron;
  CGAL::copy_face_graph(sphere(1), polyhedron);
  std::size_t n = 0;
  for(auto v : vertices(polyhedron))
    if(n++ == 17) v->point() = CGAL::ORIGIN + std::numeric_limits<double>::infinity() * Vector_3(1, 1, 1);
  const Shell infinite = CGAL::bspline_shell_3<Tag>(polyhedron, P::resolution(10));
  CHECK(infinite.status() == BS::Shell_status::NOT_FINITE);
  CHECK(infinite.report().offending_simplices.vertices == std::vector<std::size_t>{ 17 });

  Polyhedron open;
  CGAL::copy_face_graph(box(Point_3(0, 0, 0), Point_3(1, 1, 1), false), open);
  std::vector<Polyhedron::Facet_handle> neighbors;
  const Polyhedron::Halfedge_handle border = std::next(open.facets_begin(), 2)->halfedge();
  for(auto h : CGAL::halfedges_around_face(border, open)) neighbors.push_back(h->opposite()->facet());
  open.make_hole(border);
  std::vector<std::size_t> expected;
  n = 0;
  for(auto f : faces(open)) {
    if(std::find(neighbors.begin(), neighbors.end(), f) != neighbors.end()) expected.push_back(n);
    ++n;
  }
  const Shell rejected = CGAL::bspline_shell_3<Tag>(open, P::resolution(10));
  CHECK(rejected.status() == BS::Shell_status::OPEN_MESH);
  CHECK(expected.size() == 4);
  CHECK(rejected.report().offending_simplices.facets == expected);
}

TEST_CASE("Mesh types: lazy coordinates are rounded by their exact values, however they were computed")
{
  typedef CGAL::Surface_mesh<Epeck::Point_3> Exact_mesh;
  // Zero, as the square of (1/3 * large - 1/3 * large). The interval around it is wide and asymmetric.
  const auto third = []() { return Epeck::FT(1) / Epeck::FT(3); };
  const Epeck::FT large(std::ldexp(1., 42));
  Exact_mesh lazy = mixed_mesh<Exact_mesh>();
  for(auto v : lazy.vertices()) {
    const Epeck::FT zero = CGAL::square(third() * large - third() * large);
    REQUIRE(CGAL::to_interval(zero).second > 1e-8);
    const Epeck::Point_3 p = lazy.point(v);
    lazy.point(v) = Epeck::Point_3(p.x() + zero, p.y() - zero, p.z() + zero);
  }
  check_identical(reference(), CGAL::bspline_shell_3<Tag>(lazy, P::resolution(10)));
}

TEST_CASE("Mesh types: the vertex point map is used at any position among the named parameters")
{
  Mesh mesh = mixed_mesh<Mesh>();
  std::unordered_map<Mesh::Vertex_index, Point_3> points;
  for(auto v : mesh.vertices()) {
    points[v] = mesh.point(v);
    mesh.point(v) = Point_3(0, 0, 0); // useless without the map
  }
  REQUIRE(CGAL::bspline_shell_3<Tag>(mesh, P::resolution(10)).status() == BS::Shell_status::DEGENERATE_FACET);
  const auto vpm = boost::make_assoc_property_map(points);
  check_identical(reference(), CGAL::bspline_shell_3<Tag>(mesh, P::resolution(10).vertex_point_map(vpm)));
  check_identical(reference(), CGAL::bspline_shell_3<Tag>(mesh, P::vertex_point_map(vpm).resolution(10)));
  check_identical(reference(), CGAL::bspline_shell_3<Tag>(
                                 mesh, P::number_of_rings(2).vertex_point_map(vpm).memory_limit(1e9).resolution(10)));
  const double spacing = reference().field().cells().lattice().spacing();
  const Shell by_spacing = CGAL::bspline_shell_3<Tag>(mixed_mesh<Mesh>(), P::grid_spacing(spacing));
  check_identical(by_spacing,
                  CGAL::bspline_shell_3<Tag>(mesh, CGAL::parameters::vertex_point_map(vpm).grid_spacing(spacing)));
}

TEST_CASE("Mesh types: a vertex point map may belong to the mesh, and hold points of another kernel")
{
  Mesh mesh = mixed_mesh<Mesh>();
  auto map = mesh.add_property_map<Mesh::Vertex_index, Plain::Point_3>("v:elsewhere").first;
  for(auto v : mesh.vertices()) {
    const Point_3 p = mesh.point(v);
    map[v] = Plain::Point_3(p.x(), p.y(), p.z());
    mesh.point(v) = Point_3(0, 0, 0);
  }
  check_identical(reference(), CGAL::bspline_shell_3<Tag>(mesh, P::vertex_point_map(map).resolution(10)));
}
} // namespace test_mesh_types
