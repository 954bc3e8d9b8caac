#include "Texel_map.h"

#include "../Carry/Mix.h"

#include <algorithm>
#include <cmath>

namespace Tool {

namespace {

typedef std::array<double, 2> Position; // in texels, from the upper left corner

double area(const Position& p, const Position& q, const Position& r)
{
  return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

} // namespace

Texel_map map_texels(const Model& model, const Triangulated_model& mesh, const Attribute& texture, std::size_t size)
{
  constexpr double on_edge = 1e-6; // barycentric coordinate
  constexpr std::size_t none = std::size_t(-1);
  const Mixer mixer(model);
  const double width = double(size);
  Texel_map result;
  std::vector<std::size_t> number(size * size, none); // of the texel at each position
  std::vector<char> is_inside(size * size, 0);        // whether its center is not on an edge
  for(auto f : mesh.mesh().faces()) {
    auto h = mesh.mesh().prev(mesh.mesh().halfedge(f));
    std::array<Position, 3> corner;
    for(Position& p : corner) {
      const double* const uv = texture[mixer.element(texture, mesh.corner_at(h))];
      p = { uv[0] * width, (1 - uv[1]) * width };
      h = mesh.mesh().next(h);
    }
    const double whole = area(corner[0], corner[1], corner[2]);
    std::array<double, 2> low, high;
    for(std::size_t i = 0; i < 2; ++i) {
      low[i] = (std::min)({ corner[0][i], corner[1][i], corner[2][i] });
      high[i] = (std::max)({ corner[0][i], corner[1][i], corner[2][i] });
    }
    const bool is_known = std::isfinite(whole); // not all corners of a file have texture coordinates
    if(!is_known || low[0] < -0.5 || low[1] < -0.5 || high[0] > width + 0.5 || high[1] > width + 0.5) ++result.outside;
    if(!is_known || whole == 0) continue;
    const auto first = [](double x) { return std::size_t((std::max)(std::ceil(x - 0.5), 0.)); };
    const auto end = [&](double x) { return std::size_t((std::min)((std::max)(std::floor(x - 0.5) + 1, 0.), width)); };
    for(std::size_t y = first(low[1]); y < end(high[1]); ++y)
      for(std::size_t x = first(low[0]); x < end(high[0]); ++x) {
        const Position center = { double(x) + 0.5, double(y) + 0.5 };
        Texel texel{ y * size + x, f, {} };
        for(std::size_t i = 0; i < 3; ++i)
          texel.weights[i] = area(center, corner[(i + 1) % 3], corner[(i + 2) % 3]) / whole;
        const double least = *std::min_element(texel.weights.begin(), texel.weights.end());
        if(least < -on_edge) continue;
        std::size_t& at = number[texel.position];
        if(at == none) {
          at = result.texels.size();
          is_inside[texel.position] = least > on_edge;
          result.texels.push_back(texel);
        } else if(is_inside[texel.position] && least > on_edge) {
          if(result.overlapping++ == 0)
            result.overlapping_polygons = { mesh.polygon_of(result.texels[at].facet), mesh.polygon_of(f) };
        }
      }
  }
  return result;
}

} // namespace Tool
