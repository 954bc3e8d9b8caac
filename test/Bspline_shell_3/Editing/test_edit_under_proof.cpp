// edit_under_proof.h: edits that break a guarantee are undone; reports refer to facets and vertices of the user's mesh.
#include <CGAL/Bspline_shell_3/Editing/internal/edit_under_proof.h>
#include "frozen_facets.h"
#include "truncations.h"

#include <CGAL/Bspline_shell_3/Editing/Edit_result.h>
#include <CGAL/bspline_shell_3.h>

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

namespace test_edit_under_proof {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace P = CGAL::Bspline_shells::parameters;
typedef CGAL::Bspline_shell_3<> Shell;
typedef BS::Edit_status Status;
typedef BS::Edit_result<BS::Edit_report, Mesh> Result;
typedef std::vector<std::size_t> Positions;

// Returns a shell of the unit sphere, with room around the sphere.
const Shell& shell()
{
  static const Shell shell = widened(CGAL::bspline_shell_3(sphere(2), P::resolution(12)), 0.1);
  return shell;
}

template <typename Edit>
Status run(Mesh& mesh, const Shell& shell, Result& result, const Edit& edit, bool freezes)
{
  result.facets_before = mesh.number_of_faces();
  BS::internal::Edit_options<Mesh> options;
  options.freezes_rejected_facets = freezes;
  return BS::internal::edit_and_certify<CGAL::Sequential_tag>(mesh, get(CGAL::vertex_point, mesh), shell,
                                                              BS::Facet_proofs::ALL, options, result,
                                                              [&](const auto&, const auto&, const auto&) {
                                                                edit(mesh);
                                                                return Status::SUCCESS;
                                                              });
}

const auto nothing = [](Mesh&) {};

const Mesh::Vertex_index out(7);

// Returns a sphere with one vertex moved to its center, out of the shell.
Mesh sphere_with_vertex_outside()
{
  Mesh mesh = sphere(2);
  mesh.point(out) = CGAL::ORIGIN;
  return mesh;
}

Positions facets_at(const Mesh& mesh, Mesh::Vertex_index v)
{
  Positions positions;
  for(auto f : mesh.faces_around_target(mesh.halfedge(v))) positions.push_back(std::size_t(f));
  std::sort(positions.begin(), positions.end());
  return positions;
}

// Returns the vertex farthest from the one outside the shell.
Mesh::Vertex_index far(const Mesh& mesh)
{
  const Vector_3 n = sphere(2).point(out) - CGAL::ORIGIN;
  return *std::min_element(mesh.vertices().begin(), mesh.vertices().end(), [&](auto v, auto w) {
    return (mesh.point(v) - CGAL::ORIGIN) * n < (mesh.point(w) - CGAL::ORIGIN) * n;
  });
}

} // namespace

TEST_CASE("Edit under proof: an edit must keep frozen facets, leave all others in the shell, and close the mesh")
{
  REQUIRE(shell());
  const Mesh start = sphere_with_vertex_outside();
  const auto status = [&](const auto& edit) {
    Mesh mesh = start;
    Result result;
    const Status status = run(mesh, shell(), result, edit, true);
    CHECK(result.frozen_facets_before == facets_at(start, out));
    CHECK(result.offending_simplices.facets == facets_at(start, out));
    if(status == Status::NOT_CERTIFIED) {
      CHECK(is_equal(mesh, start));
      CHECK(result.facets == start.number_of_faces());
      CHECK(result.frozen_facets.empty());
    }
    return status;
  };
  CHECK(status(nothing) == Status::PARTIALLY_EDITED);
  // The vertex stays in the shell, or leaves it.
  const auto scaled = [](double s) {
    return [s](Mesh& m) { m.point(far(m)) = CGAL::ORIGIN + s * (m.point(far(m)) - CGAL::ORIGIN); };
  };
  CHECK(status(scaled(1.02)) == Status::PARTIALLY_EDITED);
  CHECK(status(scaled(3)) == Status::NOT_CERTIFIED);
  // The frozen vertex is moved, and stays outside the shell.
  CHECK(status([](Mesh& m) { m.point(out) = Point_3(0, 0, 0.1); }) == Status::NOT_CERTIFIED);
  CHECK(status([](Mesh& m) { CGAL::Euler::remove_face(m.halfedge(far(m)), m); }) == Status::NOT_CERTIFIED);
  CHECK(status([](Mesh& m) { CGAL::Euler::remove_face(m.halfedge(out), m); }) == Status::NOT_CERTIFIED);
}

TEST_CASE("Edit under proof: fans that wind twice are found before the edit, and frozen")
{
  const Mesh folded = sliced_sphere(25, 12, 2);
  Mesh mesh = folded;
  Result result;
  CHECK(run(mesh, shell(), result, nothing, false) == Status::NOT_IN_SHELL);
  CHECK(result.offending_simplices.vertices == Positions{ 0, 1 });
  CHECK(result.offending_simplices.facets.empty());
  Result frozen;
  CHECK(run(mesh, shell(), frozen, nothing, true) == Status::PARTIALLY_EDITED);
  CHECK(frozen.frozen_facets.size() == 50);
}

TEST_CASE("Edit under proof: with a truncating shell, reports refer to facets and vertices of the original mesh")
{
  const Mesh start = sphere_with_vertex_outside();
  const Mesh::Vertex_index tip = far(start);
  Truncation_parts parts = truncation_at(start, { tip }, true);
  for(bool is_disc_rejected : { false, true }) {
    if(is_disc_rejected) parts.points.back() = { 0, 0, 0 };
    Shell truncating = shell();
    BS::internal::Shell_access::set_truncation(truncating, parts.shared());
    REQUIRE(truncating.truncation()->is_valid());
    for(bool freezes : { false, true }) {
      CAPTURE(is_disc_rejected, freezes);
      Mesh mesh = start;
      Result result;
      const Status status = run(mesh, truncating, result, nothing, freezes);
      CHECK(status == (freezes ? Status::PARTIALLY_EDITED : Status::NOT_IN_SHELL));
      CHECK(result.offending_simplices.facets == facets_at(start, out));
      CHECK(result.offending_simplices.vertices == (is_disc_rejected ? Positions{ std::size_t(tip) } : Positions()));
      if(!freezes) {
        CHECK(is_equal(mesh, start));
        continue;
      }
      Positions named = result.frozen_facets_before;
      CHECK(result.frozen_facets.size() == named.size());
      std::sort(named.begin(), named.end());
      const auto end = std::lower_bound(named.begin(), named.end(), std::size_t(BS::Edit_report::no_facet));
      CHECK(std::size_t(named.end() - end) == (is_disc_rejected ? parts.discs[0].triangles.size() : 0));
      named.erase(end, named.end());
      CHECK(named == facets_at(start, out));
    }
  }
}
} // namespace test_edit_under_proof
