#include "Transfer_map.h"
#include "Input.h"
#include "Search_tuning.h"

#include <CGAL/Bspline_shell_3/Projection/Projection_target_3.h>

#include <CGAL/Polygon_mesh_processing/measure.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace Tool {

namespace {

// A facet of a mesh, and the nearest point of another mesh to its centroid.
struct Nearest
{
  double distance, area;
  double cosine; // of the angle between the normals; NaN if one of them is zero
};

std::vector<Nearest> nearest_points(const Mesh& mesh, const Mesh& other)
{
  const BS::Projection_target_3<Mesh> target(other, other.points());
  std::vector<Nearest> result;
  for(auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const auto &p = mesh.point(mesh.source(h)), &q = mesh.point(mesh.target(h)),
               &r = mesh.point(mesh.target(mesh.next(h)));
    const auto center = CGAL::centroid(p, q, r);
    const auto normal = CGAL::cross_product(q - p, r - p);
    const auto closest = target.closest({ center.x(), center.y(), center.z() });
    const auto at = target.point(closest.first, closest.second);
    const auto& n = target.normal(closest.first);
    const Mesh::Point image(at[0], at[1], at[2]);
    const decltype(normal) other_normal(n[0], n[1], n[2]);
    result.push_back({ std::sqrt(CGAL::squared_distance(center, image)), std::sqrt(normal.squared_length()) / 2,
                       normal * other_normal / std::sqrt(normal.squared_length() * other_normal.squared_length()) });
  }
  return result;
}

// Returns whether most of a mesh faces against the other mesh.
bool is_opposed(const std::vector<Nearest>& nearest)
{
  double sum = 0;
  for(const Nearest& n : nearest)
    if(!std::isnan(n.cosine)) sum += n.area * n.cosine;
  return sum < 0;
}

// Returns the distance that is not exceeded on a fraction of the area.
double quantile(std::vector<Nearest> nearest, double fraction)
{
  std::sort(nearest.begin(), nearest.end(), [](const auto& n, const auto& m) { return n.distance < m.distance; });
  double area = 0, sum = 0;
  for(const Nearest& n : nearest) area += n.area;
  for(const Nearest& n : nearest)
    if((sum += n.area) >= fraction * area) return n.distance;
  return nearest.back().distance;
}

std::vector<double> thicknesses(double unit, double distance, const std::vector<Nearest>& nearest)
{
  constexpr const Search_tuning& t = search_tuning;
  std::vector<double> result;
  for(double d : { distance, quantile(nearest, t.most_of_the_area), quantile(nearest, t.much_of_the_area) }) {
    const double thickness = (std::min)((std::max)(t.thickness_per_distance * d, t.thinnest_transfer * unit),
                                        t.thickest_transfer * unit);
    if(result.empty() || thickness < t.different * result.back()) result.push_back(thickness);
  }
  return result;
}

} // namespace

std::unique_ptr<const Transfer_map> transfer_map(const Model& from, const Model& to, const Shell_options& options,
                                                 double distance, const Time_limit& time, Progress& progress)
{
  constexpr double least_seconds = 1e-3; // time limits must be positive
  const double unit = longest_side(from);
  const Triangulated_model source(from), target(to);
  const std::vector<Nearest> nearest = nearest_points(target.mesh(), source.mesh());
  const std::vector<double> attempts = options.thickness ? std::vector<double>{ options.thickness->in_box(unit) }
                                                         : thicknesses(unit, distance, nearest);
  std::unique_ptr<const Transfer_map> best;
  for(double attempt : attempts) {
    if(best && !(time.left() > 0)) break;
    auto result = std::make_unique<Transfer_map>(to);
    result->thickness = attempt;
    result->outcome = find_shell(from, options, attempt, (std::max)(time.left(), least_seconds), progress,
                                 result->found);
    progress.show("map", 0);
    if(is_opposed(result->outcome ? nearest_points(target.mesh(), result->found.mesh()) : nearest))
      result->mesh.reverse();
    result->map = std::make_unique<const Model_map>(from, result->found, result->mesh.mesh());
    result->parts = mapped_parts(*result->map);
    progress.clear();
    if(best && result->parts.share(Mapped::ONE_TO_ONE) <= best->parts.share(Mapped::ONE_TO_ONE)) continue;
    best = std::move(result);
    if(best->parts.is_one_to_one()) break;
  }
  return best;
}

} // namespace Tool
