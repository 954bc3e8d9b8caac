// Line_filter.h: edges on lines replace only parts of the lines that are near; other edges are left to the base filter.
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Editing/Line_filter.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/boost/graph/iterator.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace test_Line_filter {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace P = CGAL::Bspline_shells::parameters;
typedef Mesh::Property_map<Mesh::Edge_index, bool> Marks;

// Marks the edges whose facets are on different sides of a plane.
Marks mark_lines(Mesh& mesh, const Vector_3& normal)
{
  const Marks marks = mesh.add_property_map<Mesh::Edge_index, bool>("e:is_line", false).first;
  const auto is_above = [&](Mesh::Halfedge_index h) {
    return normal * (centroid(mesh, mesh.face(h)) - CGAL::ORIGIN) > 0;
  };
  for(auto e : mesh.edges()) marks[e] = is_above(mesh.halfedge(e)) != is_above(mesh.opposite(mesh.halfedge(e)));
  return marks;
}

std::vector<Kernel::Segment_3> lines_of(const Mesh& mesh, const Marks& marks)
{
  std::vector<Kernel::Segment_3> lines;
  for(auto e : mesh.edges())
    if(marks[e]) lines.emplace_back(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1)));
  return lines;
}

// Returns the largest distance of points on the first lines from the second ones.
double distance(const std::vector<Kernel::Segment_3>& from, const std::vector<Kernel::Segment_3>& to)
{
  double largest = 0;
  for(const auto& s : from)
    for(double t : { 0., 0.25, 0.5, 0.75, 1. }) {
      const Point_3 p = s.source() + t * s.to_vector();
      double least = 1e9;
      for(const auto& other : to) least = (std::min)(least, CGAL::squared_distance(p, other));
      largest = (std::max)(largest, std::sqrt(least));
    }
  return largest;
}

struct Counting_filter
{
  std::size_t* calls;
  bool accepts;
  template <typename Profile, typename Place>
  Place operator()(const Profile&, const Place& place) const
  {
    ++*calls;
    return accepts ? place : Place();
  }
};

} // namespace

TEST_CASE("Line filter: lines stay within the distance, and get longer edges with a larger distance")
{
  const Mesh mesh = sphere(3);
  const auto shell = CGAL::certified_bspline_shell_3(mesh, P::relative_thickness(0.04));
  REQUIRE(shell.is_certified());
  std::size_t fewest = mesh.number_of_edges();
  for(double tolerance : { 0., 0.02, 0.1 }) {
    Mesh coarse = mesh;
    const Marks marks = mark_lines(coarse, { 0.3, 0.2, 1 });
    const auto before = lines_of(coarse, marks);
    const BS::Line_filter filter(coarse, marks, tolerance);
    const auto result = BS::simplify_in_shell(
      coarse, shell, P::edge_is_constrained_map(marks).protect_constraints(false).filter(std::cref(filter)));
    REQUIRE(result);
    coarse.collect_garbage();
    const auto after = lines_of(coarse, marks);
    CHECK(after.size() == result.constrained_edges);
    CHECK(distance(before, after) <= tolerance + 1e-12);
    CHECK(distance(after, before) <= tolerance + 1e-12);
    if(tolerance == 0) CHECK(after.size() == before.size()); // no three points of the line are collinear
    else CHECK(after.size() < fewest);
    fewest = after.size();
    // The line is still closed.
    for(auto v : coarse.vertices()) {
      std::size_t degree = 0;
      for(auto h : CGAL::halfedges_around_target(v, coarse)) degree += marks[coarse.edge(h)];
      CHECK((degree == 0 || degree == 2));
    }
  }
}

TEST_CASE("Line filter: the base filter is called first")
{
  const Mesh mesh = sphere(2);
  const auto shell = CGAL::certified_bspline_shell_3(mesh, P::relative_thickness(0.04));
  REQUIRE(shell.is_certified());
  for(bool accepts : { false, true }) {
    Mesh coarse = mesh;
    const Marks marks = mark_lines(coarse, { 0.3, 0.2, 1 });
    std::size_t calls = 0;
    const BS::Line_filter filter(coarse, marks, 0.1, Counting_filter{ &calls, accepts });
    const auto result = BS::simplify_in_shell(
      coarse, shell, P::edge_is_constrained_map(marks).protect_constraints(false).filter(std::cref(filter)));
    REQUIRE(result);
    CHECK(calls > 0);
    CHECK((result.facets < mesh.number_of_faces()) == accepts);
  }
}

} // namespace test_Line_filter
