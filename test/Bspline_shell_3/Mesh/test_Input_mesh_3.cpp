// Input_mesh_3.h, vertex_cone.h: which meshes are refused, for which reason and where; how the input refers to the
// user's mesh.
#include "truncations.h"

#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/generators.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <unordered_map>

namespace test_Input_mesh_3 {
namespace {

using CGAL::Bspline_shells::Input_mesh_3;
using CGAL::Bspline_shells::vertex_cone;
typedef CGAL::Bspline_shells::Shell_status Status;
typedef std::vector<std::size_t> Positions;
namespace PMP = CGAL::Polygon_mesh_processing;

template <typename M>
Status check(Input_mesh_3& input, const M& mesh, const Input_mesh_3::Tolerated_defects& tolerated = {})
{
  return input.build<CGAL::Sequential_tag>(mesh, get(CGAL::vertex_point, mesh), tolerated);
}

template <typename Range, typename Descriptor>
std::size_t position(const Range& range, Descriptor d)
{
  const auto it = std::find(range.begin(), range.end(), d);
  REQUIRE(it != range.end());
  return std::size_t(std::distance(range.begin(), it));
}

// Returns the positions of a mesh's facets that satisfy a condition, in ascending order.
template <typename Condition>
Positions facets_where(const Mesh& mesh, const Condition& condition)
{
  Positions found;
  std::size_t n = 0;
  for(auto f : mesh.faces()) {
    if(condition(f)) found.push_back(n);
    ++n;
  }
  return found;
}

bool has_corner(const Mesh& mesh, Mesh::Face_index f, Mesh::Vertex_index v)
{
  for(auto w : mesh.vertices_around_face(mesh.halfedge(f)))
    if(w == v) return true;
  return false;
}

Mesh::Vertex_index vertex_at(const Mesh& mesh, const Point_3& p)
{
  for(auto v : mesh.vertices())
    if(mesh.point(v) == p) return v;
  FAIL("no vertex at this point");
  return Mesh::null_vertex();
}

Mesh reversed(Mesh mesh)
{
  PMP::reverse_face_orientations(mesh);
  return mesh;
}

Mesh both(Mesh a, const Mesh& b)
{
  CGAL::copy_face_graph(b, a);
  return a;
}

Mesh tetrahedron(const Point_3& p, const Point_3& q, const Point_3& r, const Point_3& s)
{
  Mesh mesh;
  CGAL::make_tetrahedron(p, q, r, s, mesh);
  if(CGAL::orientation(p, q, r, s) == CGAL::POSITIVE) PMP::reverse_face_orientations(mesh);
  return mesh;
}

// Returns a copy of a mesh with gaps in its ranges: a tetrahedron is added first, and removed again. So descriptors
// differ from positions.
Mesh with_garbage(const Mesh& mesh)
{
  Mesh garbage = tetrahedron(Point_3(50, 0, 0), Point_3(51, 0, 0), Point_3(50, 1, 0), Point_3(50, 0, 1));
  const std::vector<Mesh::Vertex_index> doomed(garbage.vertices().begin(), garbage.vertices().end());
  CGAL::copy_face_graph(mesh, garbage);
  CGAL::Euler::remove_face(garbage.halfedge(*garbage.faces().begin()), garbage);
  while(!garbage.is_removed(doomed[0]) && garbage.degree(doomed[0]) > 0)
    CGAL::Euler::remove_face(garbage.is_border(garbage.halfedge(doomed[0]))
                               ? garbage.opposite(garbage.halfedge(doomed[0]))
                               : garbage.halfedge(doomed[0]),
                             garbage);
  for(auto f : std::vector<Mesh::Face_index>(garbage.faces().begin(), garbage.faces().begin() + 4))
    if(!garbage.is_removed(f) && garbage.point(garbage.target(garbage.halfedge(f))).x() >= 50)
      CGAL::Euler::remove_face(garbage.halfedge(f), garbage);
  REQUIRE(garbage.has_garbage());
  REQUIRE(garbage.number_of_faces() == mesh.number_of_faces());
  REQUIRE(garbage.number_of_vertices() == mesh.number_of_vertices());
  return garbage;
}

// Returns a pyramid over a simple polygon in the plane z = 0, given counterclockwise. The facets at the apex face a
// common direction if and only if the polygon's kernel (the points that see the whole polygon) has an interior.
Mesh pyramid(const std::vector<std::pair<double, double> >& base, const Point_3& apex)
{
  Mesh mesh;
  std::vector<Mesh::Vertex_index> v;
  for(const auto& p : base) v.push_back(mesh.add_vertex(Point_3(p.first, p.second, 0)));
  const Mesh::Vertex_index top = mesh.add_vertex(apex);
  for(std::size_t i = 0; i < v.size(); ++i) mesh.add_face(v[i], v[(i + 1) % v.size()], top);
  mesh.add_face(std::vector<Mesh::Vertex_index>(v.rbegin(), v.rend()));
  return mesh;
}

// Returns a pyramid over an L with arms of the given width. The kernel of the L is the square at its corner. A side of
// one arm is divided into many facets, which shift the mean of the normals away from the other arm.
Mesh pyramid_over_L(double width)
{
  return pyramid({ { 0, 0 },
                   { 1, 0 },
                   { 2, 0 },
                   { 3, 0 },
                   { 4, 0 },
                   { 5, 0 },
                   { 6, 0 },
                   { 7, 0 },
                   { 8, 0 },
                   { 8, width },
                   { width, width },
                   { width, 8 },
                   { 0, 8 } },
                 Point_3(0.25, 0.25, 2));
}

// Returns a pyramid over a U, where no point sees both arms.
Mesh pyramid_over_U()
{
  return pyramid({ { 0, 0 }, { 5, 0 }, { 5, 4 }, { 4, 4 }, { 4, 1 }, { 1, 1 }, { 1, 4 }, { 0, 4 } },
                 Point_3(2, 0.5, 3));
}

// Returns the least n . g over the facets at a vertex, with exact n and g.
CGAL::Exact_rational least_exact_product(const Mesh& mesh, Mesh::Vertex_index v, const Vector_3& g)
{
  typedef CGAL::Exact_rational ET;
  typedef CGAL::Simple_cartesian<ET> Exact;
  const auto exact = [](const Point_3& p) { return Exact::Point_3(ET(p.x()), ET(p.y()), ET(p.z())); };
  const Exact::Vector_3 e(ET(g.x()), ET(g.y()), ET(g.z()));
  bool first = true;
  ET least = 0;
  for(auto h : mesh.halfedges_around_target(mesh.halfedge(v))) {
    const Exact::Point_3 p = exact(mesh.point(v)), q = exact(mesh.point(mesh.target(mesh.next(h)))),
                         r = exact(mesh.point(mesh.source(h)));
    const ET product = CGAL::cross_product(q - p, r - p) * e;
    if(first || product < least) least = product;
    first = false;
  }
  return least;
}

// Returns the mean of the unit normals at a vertex, up to a factor.
Vector_3 mean_normal(const Mesh& mesh, Mesh::Vertex_index v)
{
  Vector_3 mean = CGAL::NULL_VECTOR;
  for(auto h : mesh.halfedges_around_target(mesh.halfedge(v))) {
    const Vector_3 n = CGAL::cross_product(mesh.point(mesh.target(mesh.next(h))) - mesh.point(v),
                                           mesh.point(mesh.source(h)) - mesh.point(v));
    mean = mean + n / std::sqrt(n.squared_length());
  }
  return mean;
}

} // namespace

TEST_CASE("Input mesh: a closed mesh is accepted, with its box, unit, components and orientation")
{
  Input_mesh_3 input;
  const Mesh mesh = box(Point_3(1, 2, 3), Point_3(3, 7, 4));
  REQUIRE(check(input, mesh) == Status::SUCCESS);
  CHECK(input.mesh().number_of_faces() == 12);
  CHECK(input.bbox() == CGAL::Bbox_3(1, 2, 3, 3, 7, 4));
  CHECK(input.unit() == 5);
  CHECK(input.number_of_components() == 1);
  CHECK(input.faces_outwards());
  CHECK(input.offending_simplices().facets.empty());
  CHECK(input.offending_simplices().vertices.empty());
}

TEST_CASE("EMPTY_MESH is returned for a mesh without facets, even if it has points or removed facets")
{
  Input_mesh_3 input;
  CHECK(check(input, Mesh()) == Status::EMPTY_MESH);
  Mesh points;
  points.add_vertex(Point_3(0, 0, 0));
  CHECK(check(input, points) == Status::EMPTY_MESH);
  Mesh removed;
  const auto p = removed.add_vertex(Point_3(0, 0, 0)), q = removed.add_vertex(Point_3(1, 0, 0)),
             r = removed.add_vertex(Point_3(0, 1, 0));
  const auto f = removed.add_face(p, q, r);
  CGAL::Euler::remove_face(removed.halfedge(f), removed);
  CHECK(check(input, removed) == Status::EMPTY_MESH);
  CHECK(input.mesh().number_of_faces() == 0);
}

TEST_CASE("NOT_FINITE: the vertices with NaN or infinite coordinates are reported")
{
  typedef CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3> Plain_mesh;
  Plain_mesh mesh;
  CGAL::copy_face_graph(sphere(1), mesh);
  const std::vector<Plain_mesh::Vertex_index> v(mesh.vertices().begin(), mesh.vertices().end());
  Input_mesh_3 input;
  REQUIRE(check(input, mesh) == Status::SUCCESS);
  typedef CGAL::Simple_cartesian<double>::Point_3 Plain_point;
  mesh.point(v[7]) = Plain_point(0, std::numeric_limits<double>::quiet_NaN(), 0);
  mesh.point(v[30]) = Plain_point(0, 0, std::numeric_limits<double>::infinity());
  mesh.point(v[11]) = Plain_point(-std::numeric_limits<double>::infinity(), 0, 0);
  REQUIRE(check(input, mesh) == Status::NOT_FINITE);
  CHECK(input.offending_simplices().vertices == Positions{ 7, 11, 30 });
  CHECK(input.offending_simplices().facets.empty());
}

TEST_CASE("OPEN_MESH: the facets at the border are reported, even of polygons and after removals")
{
  Input_mesh_3 input;
  for(bool triangulated : { false, true }) {
    Mesh mesh = box(Point_3(0, 0, 0), Point_3(1, 1, 1), triangulated);
    const Mesh::Face_index gone = *std::next(mesh.faces().begin(), 2);
    Positions neighbors;
    std::vector<Mesh::Face_index> faces;
    for(auto h : mesh.halfedges_around_face(mesh.halfedge(gone))) faces.push_back(mesh.face(mesh.opposite(h)));
    CGAL::Euler::remove_face(mesh.halfedge(gone), mesh);
    for(auto f : faces) neighbors.push_back(position(mesh.faces(), f));
    std::sort(neighbors.begin(), neighbors.end());
    REQUIRE(check(input, mesh) == Status::OPEN_MESH);
    CHECK(neighbors.size() == (triangulated ? 3 : 4));
    CHECK(input.offending_simplices().facets == neighbors);
    CHECK(input.offending_simplices().vertices.empty());
  }
}

TEST_CASE("NON_MANIFOLD: the vertex at which two closed surfaces touch is reported")
{
  // Two tetrahedra are joined at a common apex. The unused vertex is removed, so positions shift.
  const Mesh lower = tetrahedron(Point_3(0, 0, 0), Point_3(1, 0, -1), Point_3(0, 1, -1), Point_3(-1, -1, -1));
  const Mesh upper = tetrahedron(Point_3(0, 0, 0), Point_3(1, 0, 1), Point_3(0, 1, 1), Point_3(-1, -1, 1));
  Mesh mesh = both(upper, lower);
  Mesh::Vertex_index keep = Mesh::null_vertex(), drop = Mesh::null_vertex();
  for(auto v : mesh.vertices())
    if(mesh.point(v) == CGAL::ORIGIN) {
      (drop == Mesh::null_vertex() ? drop : keep) = v;
    }
  const auto around = mesh.halfedges_around_target(mesh.halfedge(drop));
  const std::vector<Mesh::Halfedge_index> halfedges(around.begin(), around.end());
  for(auto h : halfedges) mesh.set_target(h, keep);
  mesh.remove_vertex(drop);
  Input_mesh_3 input;
  REQUIRE(check(input, mesh) == Status::NON_MANIFOLD);
  CHECK(input.offending_simplices().vertices == Positions{ position(mesh.vertices(), keep) });
  CHECK(input.offending_simplices().facets.empty());
}

TEST_CASE("DEGENERATE_FACET: exactly the triangles and polygons of zero area are reported")
{
  // The edge pq of a tetrahedron gets `cuts` points. Then the facet on its left side is cut along pq.
  for(int cuts : { 1, 2 }) {
    Mesh mesh = tetrahedron(Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(0, 0, 1));
    const auto p = vertex_at(mesh, Point_3(0, 0, 0)), q = vertex_at(mesh, Point_3(1, 0, 0));
    Mesh::Halfedge_index h = mesh.halfedge(p, q);     // to q
    const Mesh::Halfedge_index before = mesh.prev(h); // to p
    for(int c = 1; c <= cuts; ++c) {
      const auto first_half = CGAL::Euler::split_edge(h, mesh);
      mesh.point(mesh.target(first_half)) = Point_3(c / 4., 0, 0);
    }
    // Corners of 180 degrees are not defects: two polygons with such corners are accepted.
    Input_mesh_3 input;
    REQUIRE(check(input, mesh) == Status::SUCCESS);
    CHECK(input.mesh().number_of_faces() == std::size_t(4 + 2 * cuts));

    CGAL::Euler::split_face(before, h, mesh);
    const Positions flat = facets_where(mesh, [&](Mesh::Face_index f) {
      for(auto v : mesh.vertices_around_face(mesh.halfedge(f)))
        if(mesh.point(v).y() != 0 || mesh.point(v).z() != 0) return false;
      return true;
    });
    REQUIRE(flat.size() == 1);
    REQUIRE(check(input, mesh) == Status::DEGENERATE_FACET);
    CHECK(input.offending_simplices().facets == flat);
    CHECK(input.mesh().number_of_faces() == 0);
  }
}

TEST_CASE("COORDINATES_OUT_OF_RANGE is returned if coordinates are too large or too small for products of doubles")
{
  const auto scaled = [](double s) {
    return tetrahedron(Point_3(0, 0, 0), Point_3(s, 0, 0), Point_3(0, s, 0), Point_3(0, 0, s));
  };
  Input_mesh_3 input;
  for(double s : { 1.1e60, 1e90, 1e300, 0.9e-60, 1e-100, 1e-300 }) {
    CAPTURE(s);
    CHECK(check(input, scaled(s)) == Status::COORDINATES_OUT_OF_RANGE);
  }
  for(double s : { 0.9e60, 1.1e-60 }) {
    CAPTURE(s);
    CHECK(check(input, scaled(s)) == Status::SUCCESS);
  }
}

TEST_CASE("INCONSISTENT_ORIENTATION is returned for a flat mesh, which bounds no volume, even if it may self-intersect")
{
  // Two triangles back to back, and a folded flat octahedron that is not orthogonal to any axis.
  Mesh flat = tetrahedron(Point_3(0, 0, 0), Point_3(4, 0, 0), Point_3(0, 4, 0), Point_3(1, 1, 0));
  Input_mesh_3 input;
  CHECK(check(input, flat) == Status::SELF_INTERSECTION);
  Input_mesh_3::Tolerated_defects tolerated;
  tolerated.self_intersections = true;
  CHECK(check(input, flat, tolerated) == Status::INCONSISTENT_ORIENTATION);
  CHECK(input.offending_simplices().facets == Positions{ 0 });
  for(auto v : flat.vertices()) {
    const Point_3 p = flat.point(v);
    flat.point(v) = Point_3(p.x(), p.y(), p.x() / 3 + p.y() / 7);
  }
  CHECK(check(input, flat, tolerated) == Status::INCONSISTENT_ORIENTATION);
}

TEST_CASE("DEGENERATE_FACET is not returned for a positive area, even of one part in 10^300")
{
  const double tiny = std::ldexp(1., -1000);
  Input_mesh_3 input;
  Mesh mesh = tetrahedron(Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(0, 0, 1));
  mesh.point(vertex_at(mesh, Point_3(0, 0, 1))) = Point_3(0, tiny, tiny); // thin, but no facet is degenerate
  CHECK(check(input, mesh) == Status::SUCCESS);
  mesh.point(vertex_at(mesh, Point_3(0, tiny, tiny))) = Point_3(0.5, 0, 0);
  REQUIRE(check(input, mesh) == Status::DEGENERATE_FACET);
  const auto moved = vertex_at(mesh, Point_3(0.5, 0, 0)), off = vertex_at(mesh, Point_3(0, 1, 0));
  CHECK(input.offending_simplices().facets == facets_where(mesh, [&](Mesh::Face_index f) {
          return has_corner(mesh, f, moved) && !has_corner(mesh, f, off);
        }));
}

TEST_CASE("SELF_INTERSECTION: the facets that cross are reported, as polygons of the user's mesh")
{
  // A spike from the inside of a box of quadrangles pierces its top.
  const Point_3 tip(0.5, 0.3, 3);
  Mesh mesh = both(box(Point_3(-1, -1, -1), Point_3(1, 1, 1), false),
                   tetrahedron(tip, Point_3(0.4, 0.2, 0), Point_3(0.6, 0.2, 0), Point_3(0.5, 0.4, 0)));
  for(bool garbage : { false, true }) {
    if(garbage) mesh = with_garbage(mesh);
    const auto at_tip = vertex_at(mesh, tip);
    const Positions crossing = facets_where(mesh, [&](Mesh::Face_index f) {
      if(has_corner(mesh, f, at_tip)) return true;
      for(auto v : mesh.vertices_around_face(mesh.halfedge(f)))
        if(mesh.point(v).z() != 1) return false;
      return true;
    });
    REQUIRE(crossing.size() == 4);
    Input_mesh_3 input;
    REQUIRE(check(input, mesh) == Status::SELF_INTERSECTION);
    CHECK(input.offending_simplices().facets == crossing);
    CHECK(input.offending_simplices().vertices.empty());

    Input_mesh_3::Tolerated_defects tolerated;
    tolerated.self_intersections = true;
    CHECK(check(input, mesh, tolerated) == Status::SUCCESS);
    CHECK(input.number_of_components() == 2);
    CHECK(input.offending_simplices().facets.empty());
  }
}

TEST_CASE("INCONSISTENT_ORIENTATION: one facet of each component to be reversed is reported")
{
  Input_mesh_3 input;
  const Mesh left = box(Point_3(0, 0, 0), Point_3(1, 1, 1)), right = box(Point_3(2, 0, 0), Point_3(3, 1, 1), false),
             far = box(Point_3(4, 0, 0), Point_3(5, 1, 1));
  REQUIRE(check(input, both(both(left, right), far)) == Status::SUCCESS);
  CHECK(input.number_of_components() == 3);

  // Reversing the named components must fix the mesh, whichever side is taken as the correct one.
  const auto mend = [&input](Mesh mesh, std::size_t components) {
    REQUIRE(check(input, mesh) == Status::INCONSISTENT_ORIENTATION);
    const Positions named = input.offending_simplices().facets;
    CHECK(named.size() == components);
    CHECK(input.offending_simplices().vertices.empty());
    for(std::size_t n : named) {
      std::vector<Mesh::Face_index> component;
      PMP::connected_component(*std::next(mesh.faces().begin(), n), mesh, std::back_inserter(component));
      PMP::reverse_face_orientations(component, mesh);
    }
    CHECK(check(input, mesh) == Status::SUCCESS);
  };
  mend(both(left, reversed(right)), 1);
  mend(both(both(left, reversed(right)), reversed(far)), 2);
  mend(with_garbage(both(left, reversed(right))), 1);
  // A cavity must have the orientation opposite to its surroundings, and a body in the cavity again the opposite one.
  const Mesh outer = sphere(1, 4), cavity = sphere(1, 2), core = sphere(1, 1);
  mend(both(outer, cavity), 1);
  mend(both(both(outer, reversed(cavity)), reversed(core)), 1);
}

TEST_CASE("Input mesh: the whole mesh may be inside out")
{
  Input_mesh_3 input;
  const Mesh hollow = both(sphere(1, 4), reversed(sphere(1, 2)));
  REQUIRE(check(input, hollow) == Status::SUCCESS);
  CHECK(input.faces_outwards());
  CHECK(input.number_of_components() == 2);
  REQUIRE(check(input, reversed(hollow)) == Status::SUCCESS);
  CHECK_FALSE(input.faces_outwards());
  CHECK(input.number_of_components() == 2);
  REQUIRE(check(input, reversed(sphere(1))) == Status::SUCCESS);
  CHECK_FALSE(input.faces_outwards());
  // The order of the components does not matter.
  REQUIRE(check(input, both(reversed(sphere(1, 2)), sphere(1, 4))) == Status::SUCCESS);
  CHECK(input.faces_outwards());
}

TEST_CASE("SINGULAR_VERTEX: the apex over a polygon with an empty kernel is reported")
{
  Mesh mesh = pyramid_over_U();
  for(bool garbage : { false, true }) {
    if(garbage) mesh = with_garbage(mesh);
    const auto apex = vertex_at(mesh, Point_3(2, 0.5, 3));
    Input_mesh_3 input;
    REQUIRE(check(input, mesh) == Status::SINGULAR_VERTEX);
    CHECK(input.offending_simplices().vertices == Positions{ position(mesh.vertices(), apex) });
    CHECK(input.offending_simplices().facets.empty());

    Input_mesh_3::Tolerated_defects tolerated;
    tolerated.singular_vertices = true;
    CHECK(check(input, mesh, tolerated) == Status::SUCCESS);
  }
}

TEST_CASE("Input mesh: a vertex with a tiny positive cone margin is not singular")
{
  for(int exponent : { 3, 20, 40 }) {
    CAPTURE(exponent);
    const Mesh mesh = pyramid_over_L(std::ldexp(1., -exponent));
    const auto apex = vertex_at(mesh, Point_3(0.25, 0.25, 2));
    // The mean of the normals is not a solution here, so the linear program must find one.
    REQUIRE(least_exact_product(mesh, apex, mean_normal(mesh, apex)) <= 0);
    const std::optional<Vector_3> g = vertex_cone(mesh, apex);
    REQUIRE(g);
    CHECK(g->squared_length() == Approx(1).epsilon(1e-15));
    CHECK(least_exact_product(mesh, apex, *g) > 0);
    Input_mesh_3 input;
    CHECK(check(input, mesh) == Status::SUCCESS);
  }
  // The kernel of the first polygon is a rectangle. The kernel of the second one is a segment, which has no interior.
  const Mesh flat_kernel = pyramid({ { 0, 0 }, { 4, 0 }, { 4, 2 }, { 8, 2 }, { 8, 4 }, { 4, 4 }, { 4, 6 }, { 0, 6 } },
                                   Point_3(2, 3, 2));
  const Mesh no_kernel = pyramid({ { 0, 0 }, { 4, 0 }, { 4, 4 }, { 8, 4 }, { 8, 8 }, { 2, 8 }, { 2, 4 }, { 0, 4 } },
                                 Point_3(3, 4, 2));
  CHECK(vertex_cone(flat_kernel, vertex_at(flat_kernel, Point_3(2, 3, 2))));
  CHECK_FALSE(vertex_cone(no_kernel, vertex_at(no_kernel, Point_3(3, 4, 2))));
}

TEST_CASE("Input mesh: vertex_cone() finds a direction at every vertex of an ordinary mesh, at any scale")
{
  for(double scale : { 1., std::ldexp(1., -400), std::ldexp(1., 300) }) {
    CAPTURE(scale);
    Mesh mesh = torus(3, 1, 7, 5);
    for(auto v : mesh.vertices())
      mesh.point(v) = Point_3(scale * mesh.point(v).x(), scale * mesh.point(v).y(), scale * mesh.point(v).z());
    bool all = true;
    for(auto v : mesh.vertices()) {
      const std::optional<Vector_3> g = vertex_cone(mesh, v);
      all = all && g && std::abs(g->squared_length() - 1) < 1e-15 * 4 && least_exact_product(mesh, v, *g) > 0;
    }
    CHECK(all);
  }
}

TEST_CASE("Input mesh: triangles of a polygon keep their facet of origin")
{
  Mesh mesh = both(box(Point_3(0, 0, 0), Point_3(1, 2, 3), false), sphere(0, 1, Point_3(5, 5, 5)));
  for(bool garbage : { false, true }) {
    if(garbage) mesh = with_garbage(mesh);
    Input_mesh_3 input;
    REQUIRE(check(input, mesh) == Status::SUCCESS);
    REQUIRE(input.mesh().number_of_faces() == 6 * 2 + 20);
    const std::vector<Mesh::Face_index> faces(mesh.faces().begin(), mesh.faces().end());
    std::vector<int> triangles(faces.size(), 0);
    for(auto f : input.mesh().faces()) {
      const std::size_t origin = input.facet_of_origin(f);
      REQUIRE(origin < faces.size());
      ++triangles[origin];
      for(const Point_3& p : input.triangle(f)) CHECK(has_corner(mesh, faces[origin], vertex_at(mesh, p)));
    }
    for(std::size_t n = 0; n < faces.size(); ++n) CHECK(triangles[n] == int(mesh.degree(faces[n])) - 2);
  }
}

TEST_CASE(
  "Input mesh: facets and vertices have their origin's points, despite removals, isolated vertices and reordering")
{
  const Mesh plain = both(box(Point_3(0, 0, 0), Point_3(1, 2, 3)), sphere(1, 1, Point_3(5, 5, 5)));
  Mesh isolated = box(Point_3(0, 0, 0), Point_3(1, 2, 3));
  isolated.add_vertex(Point_3(50, 0, 0));
  isolated = both(isolated, sphere(1, 1, Point_3(5, 5, 5)));
  Mesh reordered;
  reordered.add_vertex(Point_3(50, 0, 0));
  CGAL::copy_face_graph(plain, reordered);
  reordered.remove_vertex(Mesh::Vertex_index(0));
  reordered.collect_garbage();
  for(const Mesh& mesh : { plain, with_garbage(plain), isolated, reordered }) {
    Input_mesh_3 input;
    REQUIRE(check(input, mesh) == Status::SUCCESS);
    REQUIRE(input.mesh().number_of_faces() == mesh.number_of_faces());
    const std::vector<Mesh::Face_index> faces(mesh.faces().begin(), mesh.faces().end());
    const std::vector<Mesh::Vertex_index> vertices(mesh.vertices().begin(), mesh.vertices().end());
    for(auto f : input.mesh().faces()) {
      auto h = mesh.halfedge(faces[input.facet_of_origin(f)]);
      const auto t = input.triangle(f);
      // The facet may begin at another corner.
      for(int turns = 0; turns < 2 && mesh.point(mesh.source(h)) != t[0]; ++turns) h = mesh.next(h);
      CHECK(t
            == std::array<Point_3, 3>{ mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                                       mesh.point(mesh.target(mesh.next(h))) });
    }
    for(auto v : input.mesh().vertices())
      if(!input.mesh().is_isolated(v)) CHECK(input.mesh().point(v) == mesh.point(vertices[input.vertex_of_origin(v)]));
    CHECK(input.bbox() == CGAL::Bbox_3(0, 0, 0, 6, 6, 6));
  }
}

TEST_CASE("Input mesh: property maps of the user's mesh are unchanged, whatever their names")
{
  Mesh mesh = both(sphere(1), sphere(1, 1, Point_3(5, 5, 5)));
  auto component = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:component", 7).first;
  Input_mesh_3 input;
  REQUIRE(check(input, mesh) == Status::SUCCESS);
  CHECK(input.number_of_components() == 2);
  CHECK(std::all_of(mesh.faces().begin(), mesh.faces().end(), [&](auto f) { return component[f] == 7; }));
  CHECK_FALSE(input.mesh().property_map<Mesh::Face_index, std::size_t>("f:component").second);
}

namespace {

typedef CGAL::Bspline_shells::Shell_closing_3 Closing;
typedef CGAL::Bspline_shells::Surface_part Part;

Status check_closed(Input_mesh_3& input, const Mesh& mesh, const Closing& closing)
{
  const auto closer = Input_mesh_3::closer(std::make_shared<const Closing>(closing));
  return input.build<CGAL::Sequential_tag>(mesh, mesh.points(), {}, closer);
}

Status check_truncated(Input_mesh_3& input, const Mesh& mesh, const Truncation_parts& parts,
                       const Input_mesh_3::Tolerated_defects& tolerated = {})
{
  const auto truncator = Input_mesh_3::truncator(parts.shared());
  return input.build<CGAL::Sequential_tag>(mesh, mesh.points(), tolerated, Input_mesh_3::Closer(), truncator);
}

// Returns a pyramid over a square, without its base.
Mesh open_pyramid()
{
  Mesh mesh;
  const auto top = mesh.add_vertex(Point_3(0, 0, 1));
  std::vector<Mesh::Vertex_index> v;
  for(const Point_3& p : { Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(-1, 0, 0), Point_3(0, -1, 0) })
    v.push_back(mesh.add_vertex(p));
  for(int i = 0; i < 4; ++i) mesh.add_face(top, v[i], v[(i + 1) % 4]);
  return mesh;
}

// Returns the missing base, with a point below.
Closing base_of_pyramid(const Closing::Point& below)
{
  return Closing({ { 1, 0, 0 }, { 0, 1, 0 }, { -1, 0, 0 }, { 0, -1, 0 }, below }, 4,
                 { { 1, 0, 4 }, { 2, 1, 4 }, { 3, 2, 4 }, { 0, 3, 4 } },
                 std::vector<Closing::Kind>(4, Closing::Kind::CAP));
}

} // namespace

TEST_CASE("Input mesh: each facet of a closed mesh belongs to the user's mesh or to the closing")
{
  Input_mesh_3 input;
  REQUIRE(check_closed(input, open_pyramid(), base_of_pyramid({ 0, 0, -1 })) == Status::SUCCESS);
  CHECK(input.number_of_facets_of_origin() == 8);
  for(std::size_t n = 0; n < 8; ++n) CHECK(input.part_of_facet(n) == (n < 4 ? Part::MESH : Part::CLOSING));
  for(auto v : input.mesh().vertices()) CHECK(input.is_of_user(v) == (input.mesh().point(v).z() >= 0));
}

TEST_CASE("Input mesh: a closing that belongs to another mesh, or does not yield a surface, is rejected")
{
  const Mesh mesh = open_pyramid();
  const Positions all = { 0, 1, 2, 3 }; // each facet has an edge on the border
  Input_mesh_3 input;
  const auto refused = [&](const Mesh& m, const Closing& closing) {
    const Status status = check_closed(input, m, closing);
    CHECK(input.offending_simplices().facets == all);
    CHECK(input.mesh().number_of_faces() == 0);
    CHECK_FALSE(input.closing());
    return status;
  };
  Mesh moved = mesh;
  moved.point(Mesh::Vertex_index(1)) = Point_3(1.1, 0, 0);
  CHECK(refused(moved, base_of_pyramid({ 0, 0, -1 })) == Status::OPEN_MESH);
  // degenerate triangles, and coordinates out of range
  CHECK(refused(mesh, base_of_pyramid({ 0.5, 0.5, 0 })) == Status::NOT_CLOSABLE);
  CHECK(refused(mesh, base_of_pyramid({ 0, 0, -1e70 })) == Status::NOT_CLOSABLE);
  // The closing has an edge that the mesh also has.
  Mesh square = sheet({ 0, 1 }, { 0, 1 }, [](double, double) { return 0.; });
  const Closing across({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0.7, 0.3, -1 }, { 0.3, 0.7, -1 } }, 4,
                       { { 1, 0, 4 }, { 2, 1, 4 }, { 0, 2, 4 }, { 3, 2, 5 }, { 0, 3, 5 }, { 2, 0, 5 } },
                       std::vector<Closing::Kind>(6, Closing::Kind::BACK));
  CHECK(check_closed(input, square, across) == Status::NOT_CLOSABLE);
  CHECK(input.offending_simplices().facets == Positions{ 0, 1 });
  // If triangles intersect the mesh, facets of the mesh are reported.
  CHECK(check_closed(input, mesh, base_of_pyramid({ 0.9, 0.9, 0.3 })) == Status::NOT_CLOSABLE);
  CHECK_FALSE(input.offending_simplices().facets.empty());
  for(std::size_t f : input.offending_simplices().facets) CHECK(f < mesh.number_of_faces());
  REQUIRE(check_closed(input, mesh, base_of_pyramid({ 0, 0, -1 })) == Status::SUCCESS);
}

TEST_CASE("Input mesh: cores have the facets that they are part of, and discs have none")
{
  const Mesh mesh = sphere(1);
  const Truncation_parts parts = truncation_at(mesh, { Mesh::Vertex_index(0), Mesh::Vertex_index(5) }, true);
  Input_mesh_3 input;
  REQUIRE(check_truncated(input, mesh, parts) == Status::SUCCESS);
  REQUIRE(input.truncation());
  CHECK(CGAL::is_closed(input.mesh()));
  const std::vector<Mesh::Face_index> faces(mesh.faces().begin(), mesh.faces().end());
  std::size_t in_discs = 0;
  for(auto f : input.mesh().faces()) {
    const std::size_t n = input.facet_of_origin(f);
    CHECK(input.part_of_facet(n) == (n < faces.size() ? Part::MESH : Part::DISC));
    in_discs += n >= faces.size() ? 1 : 0;
    if(n >= faces.size()) continue;
    // All vertices are in the plane of the facet, up to rounding.
    const auto h = mesh.halfedge(faces[n]);
    const Point_3 &p = mesh.point(mesh.source(h)), &q = mesh.point(mesh.target(h));
    const Point_3& r = mesh.point(mesh.target(mesh.next(h)));
    for(const Point_3& x : input.triangle(f)) CHECK(std::abs(CGAL::volume(p, q, r, x)) < 1e-15);
    const auto t = input.triangle(f);
    CHECK(CGAL::squared_distance(CGAL::centroid(t[0], t[1], t[2]), Kernel::Triangle_3(p, q, r)) < 1e-30);
  }
  CHECK(in_discs == input.truncation()->discs()[0].triangles.size() + input.truncation()->discs()[1].triangles.size());
  CHECK(input.number_of_facets_of_origin() == faces.size() + in_discs);
}

TEST_CASE("Input mesh: a tip that another facet pierces is rejected, even if self-intersections are tolerated")
{
  // The tip is beyond the disc, so the truncated mesh does not intersect itself.
  Mesh mesh = ::pyramid(4, 1);
  const Truncation_parts parts = truncation_at(mesh, { Mesh::Vertex_index(0) }, false);
  mesh = both(mesh, box(Point_3(-0.5, -0.5, 0.9), Point_3(0.5, 0.5, 1.5)));
  Input_mesh_3::Tolerated_defects tolerated;
  tolerated.self_intersections = tolerated.singular_vertices = tolerated.orientation = true;
  Input_mesh_3 input;
  CHECK(check(input, mesh, tolerated) == Status::SUCCESS);
  CHECK(check_truncated(input, mesh, parts, tolerated) == Status::SELF_INTERSECTION);
  CHECK(check_truncated(input, ::pyramid(4, 1), parts, tolerated) == Status::SUCCESS);
}

TEST_CASE("Input mesh: a truncation that does not yield a surface is rejected, and its cut-off vertices are reported")
{
  const Mesh mesh = sphere(1);
  const Mesh::Vertex_index v(5);
  Truncation_parts parts = truncation_at(mesh, { v }, true);
  Input_mesh_3 input;
  const auto refused = [&](const Mesh& m, const Truncation_parts& p) {
    REQUIRE(p.is_valid());
    const Status status = check_truncated(input, m, p);
    CHECK(input.offending_simplices().vertices == Positions{ 5 });
    CHECK(input.offending_simplices().facets.empty());
    CHECK(input.mesh().number_of_faces() == 0);
    CHECK_FALSE(input.truncation());
    return status;
  };
  parts.points.back() = parts.points[parts.discs[0].rim[1]]; // the inner point of the disc is on its rim
  CHECK(refused(mesh, parts) == Status::NOT_TRUNCATABLE);
  parts.points.back() = { 0, 0, 1e70 };
  CHECK(refused(mesh, parts) == Status::NOT_TRUNCATABLE);

  // Facets of the closing are not part of the user's mesh, and cannot be cut.
  Mesh open = mesh;
  CGAL::Euler::remove_face(open.halfedge(v), open);
  open.collect_garbage();
  std::vector<Closing::Point> hole;
  for(auto h : open.halfedges())
    if(open.is_border(h)) {
      auto g = h;
      do {
        const Point_3& p = open.point(open.source(g));
        hole.push_back({ p.x(), p.y(), p.z() });
        g = open.next(g);
      } while(g != h);
      break;
    }
  REQUIRE(hole.size() == 3);
  const auto cap = std::make_shared<const Closing>(hole, 3, std::vector<Closing::Triangle>{ { 0, 1, 2 } },
                                                   std::vector<Closing::Kind>{ Closing::Kind::CAP });
  parts = truncation_at(mesh, { v }, true);
  const auto status = [&](const Truncation_parts& p) {
    const auto truncator = Input_mesh_3::truncator(p.shared());
    return input.build<CGAL::Sequential_tag>(open, open.points(), {}, Input_mesh_3::closer(cap), truncator);
  };
  CHECK(status(parts) == Status::NOT_TRUNCATABLE);
  CHECK(input.offending_simplices().vertices.size() == 1);
}

TEST_CASE("Input mesh: lazy coordinates are rounded by their exact values, however wide their enclosures")
{
  typedef CGAL::Exact_predicates_exact_constructions_kernel Lazy_kernel;
  typedef Lazy_kernel::FT Lazy;
  // An enclosure of x that is too wide for correct rounding, but narrow enough for to_double().
  const auto wide = [](double x) {
    const Lazy large = Lazy(1e9) / Lazy(3);
    return Lazy((Lazy(x) + large) - large);
  };
  const Mesh ball = sphere(1);
  CGAL::Surface_mesh<Lazy_kernel::Point_3> mesh;
  for(auto v : ball.vertices()) {
    const Point_3& p = ball.point(v);
    mesh.add_vertex(Lazy_kernel::Point_3(wide(p.x()), wide(p.y()), wide(p.z())));
  }
  for(auto f : ball.faces()) {
    std::vector<Mesh::Vertex_index> corners;
    for(auto v : ball.vertices_around_face(ball.halfedge(f))) corners.push_back(v);
    mesh.add_face(corners);
  }
  REQUIRE(CGAL::to_double(wide(0.1)) != 0.1);
  Input_mesh_3 input;
  REQUIRE(input.build<CGAL::Sequential_tag>(mesh, mesh.points(), {}) == Status::SUCCESS);
  for(auto v : input.mesh().vertices())
    CHECK(input.mesh().point(v) == ball.point(Mesh::Vertex_index(unsigned(input.vertex_of_origin(v)))));
}

TEST_CASE("Input mesh: isolated vertices are ignored")
{
  Mesh mesh = box(Point_3(0, 0, 0), Point_3(1, 1, 1));
  mesh.add_vertex(Point_3(100, 100, 100));
  Input_mesh_3 input;
  REQUIRE(check(input, mesh) == Status::SUCCESS);
  CHECK(input.mesh().number_of_vertices() == 8);
  CHECK(input.bbox() == CGAL::Bbox_3(0, 0, 0, 1, 1, 1));
  CHECK(input.number_of_components() == 1);
}

TEST_CASE("Input mesh: points are taken from the vertex point map")
{
  const Mesh mesh = box(Point_3(0, 0, 0), Point_3(1, 1, 1));
  std::unordered_map<Mesh::Vertex_index, Point_3> points;
  for(auto v : mesh.vertices()) points[v] = Point_3(2 * mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z() - 5);
  Input_mesh_3 input;
  REQUIRE(input.build<CGAL::Sequential_tag>(mesh, boost::make_assoc_property_map(points), {}) == Status::SUCCESS);
  CHECK(input.bbox() == CGAL::Bbox_3(0, 0, -5, 2, 1, -4));
}

TEST_CASE("Input mesh: a rejected mesh does not affect the next one")
{
  Input_mesh_3 input;
  REQUIRE(check(input, pyramid_over_U()) == Status::SINGULAR_VERTEX);
  CHECK(input.mesh().number_of_faces() == 0);
  REQUIRE(check(input, sphere(1)) == Status::SUCCESS);
  CHECK(input.offending_simplices().vertices.empty());
  CHECK(input.mesh().number_of_faces() == 80);
}
} // namespace test_Input_mesh_3
