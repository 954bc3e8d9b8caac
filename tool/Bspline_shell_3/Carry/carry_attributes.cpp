#include "carry_attributes.h"
#include "Result_builder.h"
#include "corner_mixes.h"
#include "polygon_values.h"

#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>

#include <algorithm>

namespace Tool {

namespace {

typedef BS::Shell_map_3<Shell, Mesh> Mesh_map;

template <typename Map>
Model carry(const Map& map, const Model& model, const BS::Excised_soup_3* excised, const BS::Rejoined_soup_3& rejoined,
            Normals normals, Carry_report& report, const std::function<void(double)>& progress)
{
  const Mesh& target = map.target();
  const Mesh_origins origins(model, map.source());
  const Corner_mixes mixes = corner_mixes(map, model, origins, progress);
  report.points_without_image = mixes.points_without_image;
  report.facets_across_seams = mixes.facets_across_seams;
  progress(0.7);
  std::vector<Result_triangle> triangles(target.num_faces());
  for(auto f : target.faces()) {
    std::size_t i = 0;
    for(auto h : target.halfedges_around_face(target.halfedge(f))) {
      Result_triangle::Corner& corner = triangles[f].corners[i++];
      corner.point = target.target(h);
      corner.smooth = mixes.smooth[target.target(h)];
      if(!mixes.split.empty()) corner.split = mixes.split[h];
    }
  }

  Model::Points points;
  for(auto v : target.vertices()) points.push_back(target.point(v));
  const std::vector<std::size_t> first = model.first_corners();
  if(excised != nullptr) {
    points = rejoined.soup.points;
    for(std::size_t n = rejoined.facets; n < rejoined.soup.polygons.size(); ++n) {
      const std::size_t t = excised->excised_triangles()[n - rejoined.facets], polygon = excised->soup().polygon_of[t];
      triangles.emplace_back();
      for(std::size_t i = 0; i < 3; ++i) {
        const std::size_t v = rejoined.soup.polygons[n][i];
        const auto& corners = model.soup.polygons[polygon];
        const auto is_here = [&](std::size_t u) { return model.soup.points[u] == points[v]; };
        const std::size_t k = std::size_t(std::find_if(corners.begin(), corners.end(), is_here) - corners.begin());
        const Mix own = { { first[polygon] + (k < corners.size() ? k : 0), 1. } };
        triangles.back().corners[i] = { v, own, own };
      }
    }
  }
  Model result = build_result(model, points, triangles, mixes.with_seams, normals == Normals::RECOMPUTED);
  for(Attribute& a : result.attributes) {
    if(a.element != Element::POLYGON) continue;
    const Attribute& before = model.attributes[std::size_t(&a - result.attributes.data())];
    a.values = polygon_values(map, origins, before);
    for(std::size_t n = target.num_faces(); n < triangles.size(); ++n) {
      const double* const v = before[excised->soup().polygon_of[excised->excised_triangles()[n - target.num_faces()]]];
      a.values.insert(a.values.end(), v, v + a.dimension());
    }
  }
  progress(1);
  return result;
}

} // namespace

Model carry_attributes(const Model& model, const BS::Shell_of_soup_3& found, const Mesh& mesh,
                       const std::shared_ptr<const BS::Shell_closing_3>& closing, const BS::Rejoined_soup_3& rejoined,
                       Normals normals, Carry_report& report, const std::function<void(double)>& progress)
{
  if(found.proxy) {
    const auto map = found.proxy->map(mesh);
    return carry(map, model, nullptr, rejoined, normals, report, progress);
  }
  const Mesh_map map(found.shell(), found.mesh(), mesh, BS::parameters::closing(found.shell().closing()),
                     BS::parameters::closing(closing));
  return carry(map, model, found.excised.get(), rejoined, normals, report, progress);
}

} // namespace Tool
