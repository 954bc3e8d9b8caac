// sample_components.h: samples lie on the mesh, are as close as cells are wide, and know their component.
#include <CGAL/Bspline_shell_3/Certificate/sample_components.h>
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include "test_meshes.h"

#include <CGAL/Random.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace {

namespace BS = CGAL::Bspline_shells;

// cells of width one, smaller ones at a corner
BS::Hierarchical_bspline_field_3<> some_field()
{
  std::vector<std::uint64_t> keys;
  for(int k = -4; k < 4; ++k)
    for(int j = -4; j < 4; ++j)
      for(int i = -4; i < 4; ++i) keys.push_back(BS::Lattice_key::encode(i, j, k));
  BS::Cell_hierarchy_3 cells(BS::Cell_complex_3(BS::Lattice_3(CGAL::Bbox_3(0, 0, 0, 8, 8, 8), 1), keys));
  for(int n = 0; n < 2; ++n) cells = cells.refined({ cells.locate(Point_3(0.6, 0.6, 0.6)) });
  return BS::Hierarchical_bspline_field_3<>(cells);
}

} // namespace

TEST_CASE("Samples of components: every point of a mesh has one of its component about as near as its cell is wide")
{
  Mesh mesh = box(Point_3(0.5, 0.5, 0.5), Point_3(7, 3, 4));
  CGAL::copy_face_graph(box(Point_3(1, 5, 1), Point_3(7, 7, 7)), mesh);
  BS::Input_mesh_3 input;
  REQUIRE(input.build<CGAL::Sequential_tag>(mesh, mesh.points(), {}) == BS::Shell_status::SUCCESS);
  const auto field = some_field();
  const auto samples = BS::internal::sample_components(field, input);
  CGAL::Random random(1);
  std::size_t far = 0, off = 0;
  double smallest = std::numeric_limits<double>::infinity();
  for(auto f : input.mesh().faces()) {
    const auto t = input.triangle(f);
    for(int n = 0; n < 40; ++n) {
      double u = random.get_double(), v = random.get_double();
      if(u + v > 1) { u = 1 - u; v = 1 - v; }
      const Point_3 p = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
      const double width = field.cell(field.locate(p)).width();
      double nearest = std::numeric_limits<double>::infinity();
      for(const auto& s : samples)
        if(s.second == input.component(f)) nearest = (std::min)(nearest, CGAL::squared_distance(p, Point_3(s.first[0], s.first[1], s.first[2])));
      // cells beside those of the point may be wider
      far += nearest > 4 * width * width;
      smallest = (std::min)(smallest, width);
    }
  }
  CHECK(smallest < 1);
  CHECK(far == 0);
  for(const auto& s : samples) {
    double nearest = std::numeric_limits<double>::infinity();
    for(auto f : input.mesh().faces())
      if(s.second == input.component(f)) {
        const auto t = input.triangle(f);
        nearest = (std::min)(nearest, CGAL::squared_distance(Point_3(s.first[0], s.first[1], s.first[2]), CGAL::Epick::Triangle_3(t[0], t[1], t[2])));
      }
    off += nearest > 1e-20;
  }
  CHECK(off == 0);
  // no more of them than the area needs: some 216 in all, and about two for each square of half the width
  CHECK(samples.size() < 5000);
}
