// Shell_filter.h, Shell_facet_oracle_3.h, Collapse_visitor.h: placements that leave the shell, face away or wind twice
// are rejected for that reason. Accepted placements are proved.
#include "frozen_facets.h"

#include <CGAL/Bspline_shell_3/Editing/Collapse_visitor.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_facet_oracle_3.h>
#include <CGAL/Bspline_shell_3/Editing/Shell_filter.h>
#include <CGAL/bspline_shell_3.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Polyhedral_envelope.h>
#include <CGAL/Random.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Polyhedral_envelope_filter.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace test_Shell_filter {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace P = CGAL::Bspline_shells::parameters;
namespace SMS = CGAL::Surface_mesh_simplification;
using BS::Placement_verdict;
typedef CGAL::Bspline_shell_3<> Shell;
typedef BS::Shell_facet_oracle_3<> Oracle;

// Returns the thinnest possible shell around its mesh.
const Shell& tight_shell()
{
  static const Shell shell = CGAL::bspline_shell_3(sphere(1), P::resolution(12));
  return shell;
}

// Returns a shell with room around its mesh.
const Shell& shell()
{
  static const Shell shell = widened(tight_shell(), 0.08);
  return shell;
}

const Oracle& oracle()
{
  static const Oracle oracle(shell());
  return oracle;
}

Placement_verdict verdict_on(const Point_3& p, const std::vector<Point_3>& link)
{
  Oracle::Memory memory;
  const Placement_verdict verdict = oracle()(p, link, memory);
  CHECK(oracle()(p, link, memory) == verdict); // the verdict does not depend on the cache
  return verdict;
}

struct Edge_count_stop
{
  std::size_t edges;
  template <typename FT, typename Profile>
  bool operator()(const FT&, const Profile&, std::size_t, std::size_t current) const
  {
    return current < edges;
  }
};

// Collapses edges to their midpoints, shortest first, until fewer than `edges` edges are left. A filter can reject
// collapses.
template <typename Filter, typename Visitor = BS::Default_collapse_visitor>
int collapse(Mesh& mesh, std::size_t edges, const Filter& filter, Visitor visitor = Visitor())
{
  return SMS::edge_collapse(mesh, Edge_count_stop{ edges },
                            CGAL::parameters::get_cost(SMS::Edge_length_cost<Mesh>())
                              .get_placement(SMS::Midpoint_placement<Mesh>())
                              .filter(filter)
                              .visitor(visitor));
}

struct Refuse
{
  template <typename Profile, typename OptionalPoint>
  OptionalPoint operator()(const Profile&, const OptionalPoint&) const
  {
    return OptionalPoint();
  }
};

} // namespace

TEST_CASE("Facet oracle: invalid stars are rejected for the right reason")
{
  REQUIRE(shell());
  const Mesh mesh = sphere(1);
  const auto v = *mesh.vertices().begin();
  const std::vector<Point_3> link = link_of(mesh, v);
  const Point_3 p = mesh.point(v);
  const auto scaled = [&](double s) { return CGAL::ORIGIN + s * (p - CGAL::ORIGIN); };
  CHECK(verdict_on(p, link) == Placement_verdict::ACCEPTED);
  for(double s : { 0.5, 2., 100. }) CHECK(verdict_on(scaled(s), link) == Placement_verdict::LEAVES_SHELL);
  // inside out
  std::vector<Point_3> reversed(link.rbegin(), link.rend());
  CHECK(verdict_on(p, reversed) == Placement_verdict::FACES_AWAY);
  // at a vertex of the link: a facet has no area
  CHECK(verdict_on(link[0], link) == Placement_verdict::FACES_AWAY);
  // beyond the link: in the shell, but a facet is turned over
  const Vector_3 away = link[0] - CGAL::ORIGIN + 0.7 * (link[0] - p);
  CHECK(verdict_on(CGAL::ORIGIN + away / std::sqrt(away.squared_length()), link) == Placement_verdict::FACES_AWAY);
}

TEST_CASE("Facet oracle: facets that touch a threshold are accepted")
{
  const Mesh mesh = sphere(1);
  const Oracle tight(tight_shell());
  for(auto f : mesh.faces()) CHECK(is_accepted(tight, mesh, f));
}

TEST_CASE(
  "Facet oracle: accepted facets of any size and shape are proved, and most facets that are proved are accepted")
{
  const BS::Field_predicates_3<Shell::Field> predicates(shell().field());
  CGAL::Random random(5);
  std::size_t accepted = 0, missed = 0, rejected = 0;
  for(int n = 0; n < 400; ++n) {
    const double size = std::ldexp(0.5, -(n % 8));
    const auto on_sphere = [&](const Vector_3& d, double radius) {
      return CGAL::ORIGIN + radius / std::sqrt(d.squared_length()) * d;
    };
    const auto noise = [&]() {
      return Vector_3(random.get_double(-1, 1), random.get_double(-1, 1), random.get_double(-1, 1));
    };
    const Vector_3 d = noise();
    const double unit = size * std::sqrt(d.squared_length()), off = random.get_double(-0.02, 0.02);
    const Point_3 p = on_sphere(d, 0.97 + off), q = on_sphere(d + unit * noise(), 0.97 + off);
    // every third facet is a needle
    const Point_3 r = n % 3 == 0 ? on_sphere(q - CGAL::ORIGIN + 1e-6 * noise(), 0.97 + off)
                                 : on_sphere(d + unit * noise(), 0.97 + off);
    const std::array<Point_3, 3> t = { p, q, r };
    const bool proved = !CGAL::collinear(p, q, r)
                        && predicates.values_within(t, shell().inner_threshold(), shell().outer_threshold())
                             == BS::Verdict::PROVED
                        && predicates.crosses_upwards(t) == BS::Verdict::PROVED;
    const bool is_accepted = oracle()(p, q, r) == Placement_verdict::ACCEPTED;
    ++(is_accepted ? accepted : rejected);
    if(is_accepted) CHECK(proved);
    else missed += proved;
  }
  CHECK(accepted > 50);
  CHECK(rejected > 50);
  CHECK(missed <= accepted / 20);
}

TEST_CASE("Filter: after CGAL's edge collapse, every facet is accepted, and every fan winds once")
{
  const Mesh start = sphere(3);
  for(auto f : start.faces()) REQUIRE(is_accepted(oracle(), start, f));
  const BS::Shell_filter<Oracle> filter(oracle());
  BS::Collapse_visitor<Mesh> visitor;
  Mesh mesh = start;
  const int removed = collapse(mesh, 6, filter, visitor);
  CHECK(removed > 0);
  CHECK(CGAL::is_closed(mesh));
  CHECK(mesh.number_of_faces() < start.number_of_faces() / 2);
  for(auto f : mesh.faces()) CHECK(is_accepted(oracle(), mesh, f));
  for(auto v : mesh.vertices()) CHECK(oracle().winding_number(mesh.point(v), link_of(mesh, v)) == 1);

  // The copies that CGAL makes share the statistics; the history is complete.
  const auto& statistics = filter.statistics();
  CHECK(statistics.number(Placement_verdict::ACCEPTED) >= visitor.history().collapsed);
  CHECK(statistics.rejected() > 0);
  CHECK(visitor.history().collapsed == start.number_of_vertices() - mesh.number_of_vertices());
  CHECK(visitor.history().selected >= visitor.history().collapsed);
  std::size_t kept = 0;
  for(auto v : start.vertices()) {
    const auto image = visitor.history().image(v);
    CHECK_FALSE(mesh.is_removed(image));
    kept += image == v;
  }
  CHECK(kept == mesh.number_of_vertices());
}

TEST_CASE("Filter: a shell filter can be combined with another filter, and rejects what that filter rejects")
{
  typedef SMS::Bounded_normal_change_filter<> Normal;
  const Mesh start = sphere(1);
  Mesh mesh = start;
  const BS::Shell_filter<Oracle, Normal> filter(oracle(), Normal());
  collapse(mesh, 60, filter);
  CHECK(mesh.number_of_faces() < start.number_of_faces());

  mesh = start;
  const BS::Shell_filter<Oracle, Refuse> refusing(oracle());
  CHECK(collapse(mesh, 6, refusing) == 0);
  CHECK(refusing.statistics().number(Placement_verdict::BASE_FILTER) == start.number_of_edges());
  CHECK(refusing.statistics().number(Placement_verdict::ACCEPTED) == 0);
}

TEST_CASE("Filter: a filter made from a shell has the same result as a filter that proves all facets")
{
  const Oracle all(shell(), BS::Facet_proofs::ALL);
  const Mesh start = sphere(2);
  Mesh mesh = start, other = start;
  const BS::Shell_filter of_shell(shell()), of_oracle(all);
  collapse(mesh, 6, of_shell);
  collapse(other, 6, of_oracle);
  CHECK(mesh.number_of_faces() < start.number_of_faces() / 2);
  CHECK(mesh.number_of_faces() == other.number_of_faces());
  CHECK(of_shell.statistics().by_verdict == of_oracle.statistics().by_verdict);
}

TEST_CASE("Filter: another filter that is passed by reference keeps the mesh in an envelope, too")
{
  const Mesh start = sphere(2);
  const double thickness = 0.05;
  const SMS::Polyhedral_envelope_filter<Kernel> envelope_filter(thickness);
  const BS::Shell_filter filter(shell(), std::cref(envelope_filter));
  Mesh mesh = start;
  collapse(mesh, 6, filter);
  CHECK(mesh.number_of_faces() < start.number_of_faces());
  CHECK(CGAL::Polyhedral_envelope<Kernel>(start, thickness)(mesh));
  CHECK(filter.statistics().number(Placement_verdict::BASE_FILTER) > 0);
  for(auto f : mesh.faces()) CHECK(is_accepted(oracle(), mesh, f));
}

TEST_CASE("Filter: an open mesh keeps its border under edge collapse, and is certified")
{
  Mesh start = sphere(3);
  const Mesh whole = start;
  // The facets at one vertex, and those at another.
  for(auto v : { *whole.vertices().begin(), Mesh::Vertex_index(100) }) {
    std::vector<Mesh::Face_index> fan;
    for(auto f : CGAL::faces_around_target(whole.halfedge(v), whole)) fan.push_back(f);
    for(auto f : fan) CGAL::Euler::remove_face(start.halfedge(f), start);
  }
  start.collect_garbage();
  const auto shell = CGAL::certified_bspline_shell_3(start, P::relative_thickness(0.02));
  REQUIRE(shell.is_certified());
  Mesh mesh = start;
  collapse(mesh, 6, BS::Shell_filter(shell));
  mesh.collect_garbage();
  const auto border_edges = [](const Mesh& m) {
    return std::count_if(m.edges().begin(), m.edges().end(), [&](auto e) { return m.is_border(e); });
  };
  CHECK(mesh.number_of_faces() < start.number_of_faces() / 2);
  CHECK(border_edges(mesh) == border_edges(start));
  CHECK(BS::Shell_certificate_3(shell).verify(mesh));
}
} // namespace test_Shell_filter
