// failing_facets.h: facets that a field does not cross upwards, each with a place where it fails to.
#include <CGAL/Bspline_shell_3/Construction/failing_facets.h>
#include "polynomial_fields.h"
#include "input_of_mesh.h"

#include <CGAL/tags.h>

#include <cmath>
#include <cstddef>
#include <set>
#include <vector>

namespace test_failing_facets {
namespace BS = CGAL::Bspline_shells;

namespace {

// A sphere of radius 1/2, in a field whose gradient is (0, 0, 1 + 3 z^2).
struct In_rising_field
{
  BS::Input_mesh_3 input = input_of(sphere(2, 0.5));
  Field field = hierarchical_field({ { 1, { 0, 0, 1 } }, { 1, { 0, 0, 3 } } });

  bool faces_up(std::size_t facet) const
  {
    const auto t = input.triangle(BS::Input_mesh_3::Face_index(BS::Input_mesh_3::Face_index::size_type(facet)));
    return CGAL::cross_product(t[1] - t[0], t[2] - t[0]).z() > 1e-9;
  }
};

} // namespace

TEST_CASE("Failing facets: exactly the facets that face away from the gradient fail")
{
  const In_rising_field problem;
  const std::size_t size = problem.input.mesh().number_of_faces();
  const auto failures = BS::failing_facets<CGAL::Sequential_tag>(problem.field, problem.input,
                                                                 std::vector<char>(size, 1));
  std::set<std::size_t> failing;
  for(const BS::Facet_failure& f : failures) {
    failing.insert(f.facet);
    // The place is on the facet.
    const auto t = problem.input.triangle(BS::Input_mesh_3::Face_index(f.facet));
    const Point_3 p(f.point[0], f.point[1], f.point[2]);
    CHECK(f.cell == problem.field.locate(p));
    CHECK(std::sqrt(CGAL::squared_distance(p, Kernel::Triangle_3(t[0], t[1], t[2]))) < 1e-12);
  }
  CHECK(failing.size() == failures.size());
  for(std::size_t facet = 0; facet < size; ++facet) CHECK(problem.faces_up(facet) == (failing.count(facet) == 0));
  CHECK(failing.size() >= size / 2);
  CHECK(failing.size() < size);
}

TEST_CASE("Failing facets: only requested facets are reported, in the same order for any number of threads")
{
  const In_rising_field problem;
  std::vector<char> chosen(problem.input.mesh().number_of_faces(), 0);
  std::vector<std::size_t> expected;
  for(std::size_t facet = 0; facet < chosen.size(); facet += 3) {
    chosen[facet] = 1;
    if(!problem.faces_up(facet)) expected.push_back(facet);
  }
  const auto facets = [](const std::vector<BS::Facet_failure>& failures) {
    std::vector<std::size_t> facets;
    for(const BS::Facet_failure& f : failures) facets.push_back(f.facet);
    return facets;
  };
  CHECK(facets(BS::failing_facets<CGAL::Sequential_tag>(problem.field, problem.input, chosen)) == expected);
  CHECK(facets(BS::failing_facets<CGAL::Parallel_if_available_tag>(problem.field, problem.input, chosen)) == expected);
}
} // namespace test_failing_facets
