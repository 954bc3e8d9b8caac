// simplify_in_shell.h: the result is certified; failed edits leave the mesh unchanged; the caller's options are
// respected.
#include "frozen_facets.h"
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_containment_3.h>
#include <CGAL/Bspline_shell_3/Editing/remesh_in_shell.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/bspline_shell_3.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_triangle_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace test_simplify_in_shell {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace P = CGAL::Bspline_shells::parameters;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace SMS = CGAL::Surface_mesh_simplification;
using BS::Placement_verdict;
typedef BS::Edit_status Status;
typedef CGAL::Bspline_shell_3<> Shell;

const Shell& sphere_shell()
{
  static const Shell shell = widened(CGAL::bspline_shell_3(sphere(2), P::resolution(12)), 0.08);
  return shell;
}

const Shell& torus_shell()
{
  static const Shell shell = widened(CGAL::bspline_shell_3(torus(1, 0.4, 40, 20), P::resolution(20)), 0.03);
  return shell;
}

const Shell& box_shell()
{
  static const Shell shell = widened(CGAL::bspline_shell_3(box({ 0, 0, 0 }, { 1, 1, 1 }), P::resolution(16)), 0.01);
  return shell;
}

// Returns the unit box; each side has 8 x 8 squares of two facets. Coordinates are multiples of 1/8.
Mesh fine_box()
{
  Mesh mesh;
  std::map<Point_3, Mesh::Vertex_index> vertices;
  const auto vertex = [&](int side, int i, int j) {
    double p[3];
    p[side / 2] = side % 2;
    p[(side / 2 + 1) % 3] = i / 8.;
    p[(side / 2 + 2) % 3] = j / 8.;
    const Point_3 point(p[0], p[1], p[2]);
    const auto found = vertices.find(point);
    return found != vertices.end() ? found->second : vertices.emplace(point, mesh.add_vertex(point)).first->second;
  };
  for(int side = 0; side < 6; ++side)
    for(int i = 0; i < 8; ++i)
      for(int j = 0; j < 8; ++j) {
        const auto a = vertex(side, i, j), b = vertex(side, i + 1, j), c = vertex(side, i + 1, j + 1),
                   d = vertex(side, i, j + 1);
        if(side % 2 == 1) {
          mesh.add_face(a, b, c);
          mesh.add_face(a, c, d);
        } else {
          mesh.add_face(a, c, b);
          mesh.add_face(a, d, c);
        }
      }
  return mesh;
}

bool is_at_edge_of_box(const Point_3& p)
{
  int sides = 0;
  for(int i = 0; i < 3; ++i) sides += p[i] == 0 || p[i] == 1;
  return sides >= 2;
}

// The caller's set of edges. It is up to date if it contains exactly the constrained edges of the mesh.
typedef std::set<Mesh::Edge_index> Edge_set;

template <typename Predicate>
Edge_set edges_between(const Mesh& mesh, const Predicate& is_on_line)
{
  Edge_set result;
  for(auto e : mesh.edges())
    if(is_on_line(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1)))) result.insert(e);
  return result;
}

double length(const Mesh& mesh, Mesh::Edge_index e)
{
  return std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
}

bool is_certified(const Shell& shell, const Mesh& mesh)
{
  BS::Shell_certificate_3<> certificate(shell);
  return certificate.verify<CGAL::Sequential_tag>(mesh);
}

template <typename CGAL_NP_TEMPLATE_PARAMETERS>
BS::Simplification_result<Mesh> simplify(Mesh& mesh, const Shell& shell,
                                         const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  return BS::simplify_in_shell<CGAL::Sequential_tag>(mesh, shell, np);
}

auto stop_at(std::size_t facets)
{
  return P::stop(BS::Facet_count_stop_predicate(facets));
}

// Returns options for a set of constrained edges that may be merged.
auto merging(Edge_set& constrained)
{
  return P::edge_is_constrained_map(CGAL::Boolean_property_map<Edge_set>(constrained)).protect_constraints(false);
}

// Splits an edge and the facets beside it, with the new vertex at an end of the edge. Returns a halfedge of the part
// that is not of length zero.
Mesh::Halfedge_index split_at_end(Mesh& mesh, Mesh::Halfedge_index h)
{
  const auto part = CGAL::Euler::split_edge(h, mesh);
  mesh.point(mesh.target(part)) = mesh.point(mesh.target(h));
  CGAL::Euler::split_face(part, mesh.next(h), mesh);
  CGAL::Euler::split_face(mesh.opposite(h), mesh.next(mesh.opposite(part)), mesh);
  return part;
}

// Splits a vertex into two at the same place, with two facets of area zero between them.
void split_vertex(Mesh& mesh, Mesh::Halfedge_index h)
{
  const Point_3 p = mesh.point(mesh.target(h));
  const auto split = CGAL::Euler::split_vertex(
    h, mesh.opposite(mesh.next(mesh.opposite(mesh.next(mesh.opposite(mesh.next(h)))))), mesh);
  mesh.point(mesh.target(split)) = mesh.point(mesh.source(split)) = p;
  PMP::triangulate_faces(mesh);
}

// Counts calls, and checks their order.
struct Counting_visitor : SMS::internal::Dummy_visitor
{
  // s: started, o: selected, f: filter, c: collapsing, C: collapsed, n: not collapsable, e: finished
  std::string calls;

  void OnStarted(Mesh&) { calls += 's'; }
  void OnFinished(Mesh&) { calls += 'e'; }
  template <typename Profile, typename Cost>
  void OnSelected(const Profile&, const Cost&, std::size_t initial, std::size_t current)
  {
    calls += 'o';
    CHECK(current <= initial);
    initial_edges.insert(initial);
  }
  template <typename Profile, typename Point>
  void OnCollapsing(const Profile&, const Point&)
  {
    calls += 'c';
  }
  template <typename Profile, typename Vertex>
  void OnCollapsed(const Profile&, const Vertex&)
  {
    calls += 'C';
  }
  template <typename Profile>
  void OnNonCollapsable(const Profile&)
  {
    calls += 'n';
  }

  std::set<std::size_t> initial_edges;
};

// A filter that records its calls together with those of a visitor. It cannot be copied.
struct Recording_filter
{
  Counting_visitor* visitor;
  bool accepts;

  Recording_filter(Counting_visitor& visitor, bool accepts) : visitor(&visitor), accepts(accepts) {}
  Recording_filter(const Recording_filter&) = delete;
  template <typename Profile, typename OptionalPoint>
  OptionalPoint operator()(const Profile&, const OptionalPoint& p) const
  {
    visitor->calls += 'f';
    return accepts ? p : OptionalPoint();
  }
};

} // namespace

TEST_CASE("Simplification: the result is certified, has the requested size, and reports the image of each vertex")
{
  REQUIRE(sphere_shell());
  const Mesh start = sphere(3);
  Mesh mesh = start;
  const auto result = simplify(mesh, sphere_shell(), stop_at(300));
  REQUIRE(result);
  CHECK(result.status == Status::SUCCESS);
  CHECK(result.facets_before == start.number_of_faces());
  CHECK(result.facets == 300);
  CHECK(mesh.number_of_faces() == 300);
  CHECK(result.end == BS::Edit_termination::STOP_PREDICATE);
  CHECK(result.collapsed == start.number_of_vertices() - mesh.number_of_vertices());
  for(BS::Verdict v : result.certificate.verdicts) CHECK(v == BS::Verdict::PROVED);
  CHECK(is_certified(sphere_shell(), mesh));
  CHECK_FALSE(PMP::does_self_intersect(mesh));
  REQUIRE(result.images.size() == start.number_of_vertices());
  std::set<Mesh::Vertex_index> images;
  for(auto v : result.images) {
    CHECK_FALSE(mesh.is_removed(v));
    images.insert(v);
  }
  CHECK(images.size() == mesh.number_of_vertices());
}

TEST_CASE(
  "Simplification: on request, the result has a location of each vertex that agrees with the map between both meshes")
{
  const Mesh start = sphere(3);
  Mesh mesh = start;
  const auto result = simplify(mesh, sphere_shell(), stop_at(300).locate_vertices(true));
  REQUIRE(result);
  const BS::Shell_map_3<Shell, Mesh> map(sphere_shell(), start, mesh);
  REQUIRE(result.locations.size() == start.number_of_vertices());
  for(auto v : start.vertices()) {
    const auto image = map(v);
    REQUIRE(image);
    CHECK(result.locations[v.idx()] == image.location);
  }
}

TEST_CASE(
  "Simplification: by default, simplification ends when every collapse is rejected, and a second run does nothing")
{
  Mesh mesh = torus(1, 0.4, 40, 20);
  const auto result = simplify(mesh, torus_shell());
  REQUIRE(result);
  CHECK(result.facets < 400);
  CHECK(result.placements.number(Placement_verdict::LEAVES_SHELL) > 0);
  CHECK(result.end == BS::Edit_termination::SHELL);
  CHECK(is_certified(torus_shell(), mesh));
  CHECK_FALSE(PMP::does_self_intersect(mesh));
  // The incremental proofs agree with the certificate on each facet.
  const BS::Shell_facet_oracle_3<> oracle(torus_shell());
  for(auto f : mesh.faces()) CHECK(is_accepted(oracle, mesh, f));
}

TEST_CASE("Simplification: within planes, short edges are collapsed first, so that no vertex has many edges")
{
  Mesh mesh = fine_box();
  for(std::size_t facets : { 400, 200, 100 }) {
    REQUIRE(simplify(mesh, box_shell(), stop_at(facets)));
    std::size_t largest = 0;
    for(auto v : mesh.vertices()) largest = (std::max)(largest, std::size_t(mesh.degree(v)));
    CAPTURE(facets);
    CHECK(largest <= 12);
  }
}

TEST_CASE("Simplification: an edit that is not certified is repeated with all proofs if this is unobservable")
{
  const Mesh start = sphere(2);
  const auto edited = [](auto& mesh, bool may_repeat, int failures, auto& result,
                         std::vector<BS::Facet_proofs>& proofs) {
    // The first `failures` edits move a vertex out of the shell.
    const auto edit = [&](const auto& oracle, auto&, const auto& vertices_before) {
      auto vpm = get(CGAL::vertex_point, mesh);
      proofs.push_back(oracle.proofs());
      result.images.assign(vertices_before.begin(), vertices_before.end());
      if(int(proofs.size()) <= failures) put(vpm, *vertices(mesh).begin(), Point_3(9, 9, 9));
      return Status::SUCCESS;
    };
    const BS::internal::Edit_options<std::decay_t<decltype(mesh)> > options;
    return BS::internal::edit_under_proof<CGAL::Parallel_if_available_tag>(
      mesh, get(CGAL::vertex_point, mesh), sphere_shell(), may_repeat, options, result, edit);
  };
  typedef std::vector<BS::Facet_proofs> Proofs;
  const BS::Facet_proofs all = BS::Facet_proofs::ALL, doubtful = BS::Facet_proofs::WHERE_DOUBTFUL;
  for(int failures : { 0, 1, 2 })
    for(bool may_repeat : { true, false }) {
      Mesh mesh = start;
      BS::Simplification_result<Mesh> result;
      Proofs proofs;
      const Status status = edited(mesh, may_repeat, failures, result, proofs);
      const bool is_repeated = may_repeat && failures > 0;
      CHECK(status == (failures > (may_repeat ? 1 : 0) ? Status::NOT_CERTIFIED : Status::SUCCESS));
      CHECK(result.is_repeated == is_repeated);
      CHECK(proofs == (!may_repeat ? Proofs{ all } : is_repeated ? Proofs{ doubtful, all } : Proofs{ doubtful }));
      CHECK(is_equal(mesh, start));
      CHECK(result.images.size() == (status == Status::SUCCESS ? start.number_of_vertices() : 0));
    }
  // Edits are not repeated if that would replace elements of the mesh: for other mesh types, and if indices have gaps.
  CGAL::Polyhedron_3<Kernel> polyhedron;
  CGAL::copy_face_graph(start, polyhedron);
  BS::Simplification_result<CGAL::Polyhedron_3<Kernel> > of_polyhedron;
  Proofs proofs;
  CHECK(edited(polyhedron, true, 1, of_polyhedron, proofs) == Status::NOT_CERTIFIED);
  CHECK(proofs == Proofs{ all });
  Mesh with_removed_vertex = start;
  with_removed_vertex.remove_vertex(with_removed_vertex.add_vertex(Point_3(0, 0, 0)));
  BS::Simplification_result<Mesh> of_removed_vertex;
  proofs.clear();
  CHECK(edited(with_removed_vertex, true, 1, of_removed_vertex, proofs) == Status::NOT_CERTIFIED);
  CHECK(proofs == Proofs{ all });
}

TEST_CASE("Simplification: a repeated edit starts from the original constrained edges, and its own results are kept")
{
  Mesh mesh = sphere(2);
  const Mesh start = mesh;
  const auto first_edges = [&](std::size_t number) {
    return Edge_set(mesh.edges().begin(), std::next(mesh.edges().begin(), std::ptrdiff_t(number)));
  };
  Edge_set constrained = first_edges(40);
  const Edge_set before = constrained;
  CGAL::Boolean_property_map<Edge_set> map(constrained);
  int runs = 0;
  const auto edit = [&](const auto&, auto&, const auto&) {
    CHECK(constrained == before);
    for(auto e : first_edges(60)) put(map, e, !get(map, e));
    if(++runs == 1) mesh.point(*mesh.vertices().begin()) = Point_3(9, 9, 9);
    else put(map, *before.begin(), true);
    return Status::SUCCESS;
  };
  BS::Simplification_result<Mesh> result;
  BS::internal::Edit_options<Mesh> options;
  options.constraints = BS::internal::Edge_constraints<Mesh>(map);
  CHECK(BS::internal::edit_under_proof<CGAL::Sequential_tag>(mesh, get(CGAL::vertex_point, mesh), sphere_shell(), true,
                                                             options, result, edit)
        == Status::SUCCESS);
  CHECK(runs == 2);
  CHECK(result.is_repeated);
  CHECK(is_equal(mesh, start));
  Edge_set expected = first_edges(60);
  for(auto e : before) expected.erase(e);
  expected.insert(*before.begin());
  CHECK(constrained == expected);
}

TEST_CASE("Simplification: a repeated edit has the result of an edit with all proofs, even with stateful policies")
{
  // Two spheres are in one shell: each facet is accepted, but the mesh covers the shell twice.
  const Mesh start = joined(sphere(2), sphere(2, 0.98));
  Mesh mesh = start;
  const SMS::GarlandHeckbert_triangle_policies<Mesh, Kernel> policies(mesh);
  const auto np = stop_at(300).get_cost(policies.get_cost()).get_placement(policies.get_placement());
  const auto repeated = simplify(mesh, sphere_shell(), np);
  CHECK(repeated.status == Status::NOT_CERTIFIED);
  CHECK(repeated.is_repeated);
  CHECK(is_equal(mesh, start));
  Counting_visitor visitor;
  const auto once = simplify(mesh, sphere_shell(), np.visitor(std::ref(visitor)));
  CHECK(once.status == Status::NOT_CERTIFIED);
  CHECK_FALSE(once.is_repeated);
  CHECK(once.collapsed > 100);
  CHECK(repeated.collapsed == once.collapsed);
  CHECK(repeated.selected == once.selected);
  CHECK(repeated.placements.by_verdict == once.placements.by_verdict);
}

TEST_CASE("Simplification: an edit that fails because of the shell is not repeated")
{
  // The shell is the whole ball, with its critical point.
  Mesh mesh = sphere(2);
  const Mesh start = mesh;
  const auto result = simplify(mesh, widened(sphere_shell(), 1.5), stop_at(300));
  CHECK(result.status == Status::NOT_CERTIFIED);
  CHECK(result.certificate.verdict(BS::Claim::CONTAINMENT) == BS::Verdict::PROVED);
  CHECK(result.certificate.verdict(BS::Claim::GRADIENT) != BS::Verdict::PROVED);
  CHECK_FALSE(result.is_repeated);
  CHECK(is_equal(mesh, start));
}

TEST_CASE("Simplification: estimates and full proofs yield the same mesh")
{
  // A visitor observes the edits, so everything is proved.
  Mesh estimated = torus(1, 0.4, 40, 20), proved = estimated;
  Counting_visitor visitor;
  const auto result = simplify(estimated, torus_shell(), stop_at(500));
  REQUIRE(result);
  REQUIRE(simplify(proved, torus_shell(), stop_at(500).visitor(std::ref(visitor))));
  CHECK_FALSE(result.is_repeated);
  CHECK(is_equal(estimated, proved));
}

TEST_CASE("Simplification: a stop predicate is repeated only if this cannot be observed")
{
  CHECK(BS::Is_repeatable_stop_predicate<BS::Facet_count_stop_predicate>::value);
  CHECK(BS::Is_repeatable_stop_predicate<BS::Never_stop_predicate>::value);
  struct Recording_stop_predicate : BS::Never_stop_predicate
  {};
  CHECK_FALSE(BS::Is_repeatable_stop_predicate<Recording_stop_predicate>::value);
}

TEST_CASE("Simplification: nothing changes if every collapse is rejected")
{
  const Mesh start = sphere(2);
  Mesh mesh = start;
  Counting_visitor visitor;
  const Recording_filter filter(visitor, false);
  const auto result = simplify(mesh, sphere_shell(), P::filter(std::cref(filter)));
  CHECK(result);
  CHECK(result.collapsed == 0);
  CHECK(result.placements.number(Placement_verdict::BASE_FILTER) == result.placements.rejected());
  CHECK(result.end == BS::Edit_termination::FILTER);
  CHECK(is_equal(mesh, start));
  for(std::size_t n = 0; n < result.images.size(); ++n) CHECK(std::size_t(result.images[n]) == n);
}

TEST_CASE("Simplification: the report states whether the predicate, the shell, a filter or the mesh ended the edit")
{
  using BS::Edit_termination;
  const auto end = [](const auto& np, const Shell& shell) {
    Mesh mesh = sphere(2);
    const auto result = simplify(mesh, shell, np);
    CHECK(std::string(message(result.end)).size() > 20);
    CHECK((result.end == Edit_termination::NOT_EDITED) == !result);
    return result.end;
  };
  // The shell does not permit the first target, but the second one.
  CHECK(end(stop_at(4), sphere_shell()) == Edit_termination::SHELL);
  CHECK(end(stop_at(200), sphere_shell()) == Edit_termination::STOP_PREDICATE);
  // If both the filter and the shell reject placements, the shell is reported.
  const auto is_on_one_side = [](const auto& profile, auto placement) {
    return profile.p0().x() < 0 ? decltype(placement)() : placement;
  };
  CHECK(end(P::filter(is_on_one_side), sphere_shell()) == Edit_termination::SHELL);
  // all edges are constrained
  Mesh mesh = sphere(2);
  const auto all = mesh.add_property_map<Mesh::Edge_index, bool>("e:all", true).first;
  CHECK(simplify(mesh, sphere_shell(), P::edge_is_constrained_map(all)).end == Edit_termination::MESH);
  CHECK(end(CGAL::parameters::default_values(), Shell()) == Edit_termination::NOT_EDITED);
}

TEST_CASE("Simplification: an exception in the caller's code leaves the mesh unchanged")
{
  const Mesh start = sphere(2);
  Mesh mesh = start;
  const auto throw_at_last = [](const auto&, const auto&, std::size_t, std::size_t edges) {
    if(edges < 400) throw std::runtime_error("no more");
    return false;
  };
  CHECK_THROWS_AS(simplify(mesh, sphere_shell(), P::stop(throw_at_last)), std::runtime_error);
  CHECK(is_equal(mesh, start));
}

TEST_CASE("Simplification: the caller's visitor and filter are called in the documented order")
{
  Mesh mesh = sphere(2);
  Counting_visitor visitor;
  const Recording_filter filter(visitor, true);
  const auto result = simplify(mesh, sphere_shell(), stop_at(100).visitor(std::ref(visitor)).filter(std::cref(filter)));
  CHECK(result);
  const std::string& calls = visitor.calls;
  REQUIRE(calls.size() > 2);
  CHECK(calls.front() == 's');
  CHECK(calls.back() == 'e');
  CHECK(std::count(calls.begin(), calls.end(), 's') == 1);
  CHECK(std::count(calls.begin(), calls.end(), 'e') == 1);
  CHECK(visitor.initial_edges == std::set<std::size_t>{ 480 });
  CHECK(std::size_t(std::count(calls.begin(), calls.end(), 'C')) == result.collapsed);
  CHECK(std::size_t(std::count(calls.begin(), calls.end(), 'o')) == result.selected);
  for(std::size_t n = 1; n < calls.size(); ++n) {
    const char before = calls[n - 1];
    if(calls[n] == 'C') CHECK(before == 'c');
    if(calls[n] == 'c') CHECK(before == 'f');
    if(calls[n] == 'f') CHECK((before == 'o' || before == 'f'));
  }
}

namespace {
// A filter that owns memory: a dangling reference to it would be seen by a sanitizer.
struct Far_from_points
{
  std::vector<Point_3> points;

  template <typename Profile, typename OptionalPoint>
  OptionalPoint operator()(const Profile&, const OptionalPoint& placement) const
  {
    const auto is_near = [&](const Point_3& p) { return CGAL::squared_distance(p, *placement) < 0.25; };
    return placement && std::none_of(points.begin(), points.end(), is_near) ? placement : OptionalPoint();
  }
};
} // namespace

TEST_CASE("Simplification: a filter may be passed by value or by reference")
{
  const Mesh start = sphere(2);
  Mesh by_value = start, by_reference = start;
  const Far_from_points filter{ { Point_3(0, 0, 1), Point_3(1, 0, 0) } };
  REQUIRE(BS::simplify_in_shell(by_value, sphere_shell(), P::filter(Far_from_points(filter))));
  REQUIRE(BS::simplify_in_shell(by_reference, sphere_shell(), P::filter(std::cref(filter))));
  CHECK(by_value.number_of_faces() < start.number_of_faces());
  CHECK(by_value.number_of_faces() == by_reference.number_of_faces());
}

TEST_CASE("Simplification: constrained edges and their vertices are kept")
{
  Mesh mesh = torus(1, 0.4, 40, 20);
  auto constrained = mesh.add_property_map<Mesh::Edge_index, bool>("e:constrained", false).first;
  std::map<Mesh::Edge_index, std::set<Point_3> > ends;
  for(auto e : mesh.edges()) {
    const Point_3 &p = mesh.point(mesh.vertex(e, 0)), &q = mesh.point(mesh.vertex(e, 1));
    // is the edge on the outer equator?
    if(p.z() == 0 && q.z() == 0 && p.x() * p.x() + p.y() * p.y() > 1 && q.x() * q.x() + q.y() * q.y() > 1) {
      constrained[e] = true;
      ends[e] = { p, q };
    }
  }
  REQUIRE(ends.size() == 40);
  const auto result = simplify(mesh, torus_shell(), P::edge_is_constrained_map(constrained));
  REQUIRE(result);
  CHECK(result.facets < 800);
  for(const auto& e : ends) {
    REQUIRE_FALSE(mesh.is_removed(e.first));
    CHECK(std::set<Point_3>{ mesh.point(mesh.vertex(e.first, 0)), mesh.point(mesh.vertex(e.first, 1)) } == e.second);
  }
}

TEST_CASE("Simplification: constrained edges that are not protected are merged along straight lines, which are kept")
{
  const Mesh start = fine_box();
  const auto is_on_line = [](const Point_3& p, const Point_3& q) { return is_at_edge_of_box(CGAL::midpoint(p, q)); };
  for(bool protect : { true, false }) {
    Mesh mesh = start;
    Edge_set constrained = edges_between(mesh, is_on_line);
    REQUIRE(constrained.size() == 96);
    const CGAL::Boolean_property_map<Edge_set> map(constrained);
    const auto result = simplify(mesh, box_shell(), P::edge_is_constrained_map(map).protect_constraints(protect));
    REQUIRE(result);
    CHECK(result.constrained_edges == constrained.size());
    if(protect) {
      CHECK(constrained == edges_between(start, is_on_line));
    } else {
      // One constrained edge is left for each edge of the box, whose shape is unchanged.
      CHECK(result.constrained_edges == 12);
      CHECK(result.facets == 12);
    }
    double sum = 0;
    for(auto e : constrained) {
      REQUIRE_FALSE(mesh.is_removed(e));
      CHECK(is_on_line(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
      for(int end : { 0, 1 }) CHECK(is_at_edge_of_box(mesh.point(mesh.vertex(e, end))));
      sum += length(mesh, e);
    }
    CHECK(sum == 12); // exact, as all lengths are multiples of 1/8
  }
}

TEST_CASE("Simplification: ends and junctions of constrained polylines are kept")
{
  // The constrained edges form a cross in the side z = 1, of four arms with three edges each.
  Mesh mesh = fine_box();
  const auto is_on_cross = [](const Point_3& p, const Point_3& q) {
    const Point_3 middle = CGAL::midpoint(p, q);
    const auto is_on_arm = [](double along, double across) { return across == 0.5 && std::abs(along - 0.5) < 0.375; };
    return p.z() == 1 && q.z() == 1 && (is_on_arm(middle.x(), middle.y()) || is_on_arm(middle.y(), middle.x()));
  };
  Edge_set constrained = edges_between(mesh, is_on_cross);
  REQUIRE(constrained.size() == 12);
  const auto result = simplify(mesh, box_shell(), merging(constrained));
  REQUIRE(result);
  CHECK(result.constrained_edges == 4);
  CHECK(constrained.size() == 4);
  std::multiset<Point_3> ends;
  for(auto e : constrained) {
    REQUIRE_FALSE(mesh.is_removed(e));
    CHECK(length(mesh, e) == 0.375);
    for(int end : { 0, 1 }) ends.insert(mesh.point(mesh.vertex(e, end)));
  }
  CHECK(ends.count(Point_3(0.5, 0.5, 1)) == 4);
  for(const Point_3& p :
      { Point_3(0.125, 0.5, 1), Point_3(0.875, 0.5, 1), Point_3(0.5, 0.125, 1), Point_3(0.5, 0.875, 1) })
    CHECK(ends.count(p) == 1);
}

TEST_CASE("Simplification: a closed constrained polyline stays closed, with some of its vertices")
{
  Mesh mesh = torus(1, 0.4, 40, 20);
  const auto is_on_equator = [](const Point_3& p, const Point_3& q) {
    return p.z() == 0 && q.z() == 0 && p.x() * p.x() + p.y() * p.y() > 1 && q.x() * q.x() + q.y() * q.y() > 1;
  };
  Edge_set constrained = edges_between(mesh, is_on_equator);
  REQUIRE(constrained.size() == 40);
  std::set<Point_3> before;
  for(auto e : constrained) before.insert(mesh.point(mesh.vertex(e, 0)));
  // An edge of length zero at a vertex of the polyline, in a facet with one of its edges, must not interrupt it.
  // Therefore, another edge is split at its very end.
  split_at_end(mesh, mesh.prev(mesh.halfedge(*constrained.begin())));
  REQUIRE(CGAL::is_triangle_mesh(mesh));
  const std::size_t facets = mesh.number_of_faces();

  const auto result = simplify(mesh, torus_shell(), merging(constrained));
  REQUIRE(result);
  CHECK(2 * result.facets < facets);
  CHECK(result.constrained_edges == constrained.size());
  CHECK(constrained.size() < 40);
  CHECK(constrained.size() >= 3);
  std::map<Mesh::Vertex_index, int> number;
  for(auto e : constrained) {
    REQUIRE_FALSE(mesh.is_removed(e));
    for(int end : { 0, 1 }) {
      CHECK(before.count(mesh.point(mesh.vertex(e, end))) == 1);
      ++number[mesh.vertex(e, end)];
    }
  }
  CHECK(number.size() == constrained.size());
  for(const auto& v : number) CHECK(v.second == 2);
}

TEST_CASE("Simplification: after a failure, a map of constrained edges is restored")
{
  // A constrained edge of length zero is never collapsed, so there is no certificate.
  Mesh mesh = fine_box();
  Edge_set constrained = edges_between(
    mesh, [](const Point_3& p, const Point_3& q) { return is_at_edge_of_box(CGAL::midpoint(p, q)); });
  constrained.insert(mesh.edge(split_at_end(mesh, mesh.halfedge(*constrained.begin()))));
  const Edge_set edges_before = constrained;
  const Mesh before = mesh;
  const auto result = simplify(mesh, box_shell(), merging(constrained));
  CHECK(result.status == Status::NOT_CERTIFIED);
  CHECK(result.is_repeated);
  CHECK(result.collapsed > 100);
  CHECK(result.constrained_edges == 0);
  CHECK(is_equal(mesh, before));
  CHECK(constrained == edges_before);
}

TEST_CASE("Simplification: edges of length zero are collapsed, and the result is certified")
{
  Mesh mesh = sphere(2);
  const std::size_t facets = mesh.number_of_faces();
  split_vertex(mesh, *mesh.halfedges().begin());
  REQUIRE(mesh.number_of_faces() == facets + 2);
  REQUIRE_FALSE(is_certified(sphere_shell(), mesh));
  const auto result = simplify(mesh, sphere_shell(), stop_at(facets));
  CHECK(std::string(message(result.status)) == message(Status::SUCCESS));
  CHECK(result.offending_simplices.facets.empty());
  CHECK(result.facets == facets);
  CHECK(result.images.size() == facets / 2 + 3);
  CHECK(is_certified(sphere_shell(), mesh));
}

TEST_CASE("Simplification: on request, facets outside the shell are frozen, and the others are simplified")
{
  Mesh start = sphere(3);
  start.point(Mesh::Vertex_index(7)) = CGAL::ORIGIN;
  Mesh mesh = start;
  CHECK(simplify(mesh, sphere_shell(), P::freeze_rejected_facets(false)).status == Status::NOT_IN_SHELL);
  REQUIRE(is_equal(mesh, start));
  const auto result = simplify(mesh, sphere_shell(), stop_at(200).freeze_rejected_facets(true));
  check_frozen_result(result, sphere_shell(), start, mesh);
  CHECK(result.facets == 200);
  CHECK(result.frozen_facets.size() == start.degree(Mesh::Vertex_index(7)));
  CHECK(result.frozen_facets_before == result.offending_simplices.facets);
  CHECK(result.images[7] == Mesh::Vertex_index(7));
  for(auto v : CGAL::vertices_around_target(start.halfedge(Mesh::Vertex_index(7)), start))
    CHECK(result.images[v.idx()] == v);
  // The fan at each pole winds twice.
  const Mesh folded = sliced_sphere(25, 12, 2);
  mesh = folded;
  const auto of_folded = simplify(mesh, sphere_shell(), P::freeze_rejected_facets(true));
  check_frozen_result(of_folded, sphere_shell(), folded, mesh);
  CHECK(of_folded.offending_simplices.vertices == std::vector<std::size_t>{ 0, 1 });
  CHECK(of_folded.frozen_facets.size() == 50);
  CHECK(2 * of_folded.facets < of_folded.facets_before);
  // Nothing needs to be frozen.
  Mesh one = sphere(2), other = one;
  REQUIRE(simplify(one, sphere_shell()));
  const auto certified = simplify(other, sphere_shell(), P::freeze_rejected_facets(true));
  CHECK(certified);
  CHECK(certified.frozen_facets.empty());
  CHECK(is_equal(one, other));
}

TEST_CASE("Simplification: edges of length zero are removed away from frozen facets, and frozen at them")
{
  Mesh start = sphere(2);
  const Mesh::Vertex_index out(0), far(1);
  const std::size_t ring = start.degree(out);
  const Mesh::Vertex_index near = *CGAL::vertices_around_target(start.halfedge(out), start).begin();
  split_vertex(start, start.halfedge(near));
  split_vertex(start, start.halfedge(far));
  start.point(out) = CGAL::ORIGIN;
  REQUIRE(start.number_of_faces() == 324);
  Mesh mesh = start;
  const auto result = simplify(mesh, sphere_shell(), stop_at(322).freeze_rejected_facets(true));
  check_frozen_result(result, sphere_shell(), start, mesh);
  CHECK(result.facets == 322);
  CHECK(result.offending_simplices.facets.size() >= ring);
  CHECK(result.frozen_facets.size() > result.offending_simplices.facets.size());
}

TEST_CASE("Simplification: invalid input is rejected with a status, and left unchanged")
{
  const auto rejected = [](Mesh mesh, const Shell& shell) {
    const Mesh before = mesh;
    const auto result = simplify(mesh, shell);
    CHECK_FALSE(result);
    CHECK(result.images.empty());
    CHECK(result.facets == result.facets_before);
    CHECK(is_equal(mesh, before));
    CHECK(std::string(message(result.status)).size() > 20);
    CHECK(result.message() == message(result.status));
    CHECK(result.end == BS::Edit_termination::NOT_EDITED);
    return result;
  };
  CHECK(rejected(sphere(1), Shell()).status == Status::NO_SHELL);
  CHECK(rejected(Mesh(), sphere_shell()).status == Status::NOT_TRIANGULATED);
  Mesh mesh = sphere(2);
  CGAL::Euler::remove_face(*mesh.halfedges().begin(), mesh);
  CHECK(rejected(mesh, sphere_shell()).status == Status::OPEN_MESH);
  mesh = sphere(2);
  mesh.point(Mesh::Vertex_index(3)) = Point_3(0, std::numeric_limits<double>::quiet_NaN(), 0);
  CHECK(simplify(mesh, sphere_shell()).status == Status::NOT_FINITE);
  mesh = sphere(2);
  mesh.point(Mesh::Vertex_index(7)) = Point_3(0, 0, 0);
  const auto outside = rejected(mesh, sphere_shell());
  CHECK(outside.status == Status::NOT_IN_SHELL);
  CHECK(outside.offending_simplices.facets.size() >= 5);
  // Two spheres are in one shell: each facet is accepted, but the mesh covers the shell twice.
  const auto twice = rejected(joined(sphere(2), sphere(2, 0.98)), sphere_shell());
  CHECK(twice.status == Status::NOT_CERTIFIED);
  CHECK(twice.certificate.verdict(BS::Claim::CONTAINMENT) == BS::Verdict::PROVED);
  CHECK(twice.certificate.verdict(BS::Claim::ONE_SHEET) != BS::Verdict::PROVED);
}

TEST_CASE("Simplification: a Polyhedron_3 is simplified with other costs, until a stop predicate cancels")
{
  typedef CGAL::Polyhedron_3<Kernel> Polyhedron;
  Polyhedron mesh;
  CGAL::copy_face_graph(sphere(2), mesh);
  const std::size_t vertices = num_vertices(mesh);
  std::size_t calls = 0;
  const auto cancel = [&](const auto&, const auto&, std::size_t, std::size_t) { return ++calls > 40; };
  const auto result = BS::simplify_in_shell<CGAL::Sequential_tag>(
    mesh, sphere_shell(),
    P::stop(cancel).get_cost(SMS::Edge_length_cost<Polyhedron>()).get_placement(SMS::Midpoint_placement<Polyhedron>()));
  REQUIRE(result);
  CHECK(calls == 41);
  CHECK(result.end == BS::Edit_termination::STOP_PREDICATE);
  CHECK(result.collapsed > 0);
  CHECK(result.collapsed <= 40);
  CHECK(num_vertices(mesh) == vertices - result.collapsed);
  CHECK(result.images.size() == vertices);
}

TEST_CASE("Simplification and remeshing: a mesh of another kernel with double coordinates gets the same result")
{
  typedef CGAL::Simple_cartesian<double> Other_kernel;
  typedef CGAL::Surface_mesh<Other_kernel::Point_3> Other_mesh;
  const auto same = [](const Other_mesh& other, const Mesh& mesh) {
    REQUIRE(other.number_of_vertices() == mesh.number_of_vertices());
    const auto is_same = [&](Mesh::Vertex_index v) {
      const auto& p = other.point(v);
      return !mesh.is_removed(v) && Point_3(p.x(), p.y(), p.z()) == mesh.point(v);
    };
    return std::all_of(other.vertices_begin(), other.vertices_end(), is_same);
  };
  const auto target = stop_at(400);
  Mesh mesh;
  Other_mesh other;
  CGAL::copy_face_graph(torus(1, 0.4, 40, 20), mesh); // edges are in the same order
  CGAL::copy_face_graph(torus(1, 0.4, 40, 20), other);
  REQUIRE(BS::simplify_in_shell(mesh, torus_shell(), target));
  REQUIRE(BS::simplify_in_shell(other, torus_shell(), target));
  CHECK(same(other, mesh));
  REQUIRE(BS::remesh_in_shell(mesh, 0.2, torus_shell(), CGAL::parameters::number_of_iterations(1)));
  REQUIRE(BS::remesh_in_shell(other, 0.2, torus_shell(), CGAL::parameters::number_of_iterations(1)));
  CHECK(same(other, mesh));

  const BS::Shell_containment_3 contains(torus_shell());
  CHECK(contains(other));
  CHECK(contains(Other_kernel::Point_3(1.4, 0, 0)));
  CHECK_FALSE(contains(Other_kernel::Point_3(1, 0, 0), Other_kernel::Point_3(1.4, 0, 0)));
}
} // namespace test_simplify_in_shell
