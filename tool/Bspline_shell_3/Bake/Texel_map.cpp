#include "Texel_map.h"

#include <algorithm>
#include <cmath>

namespace Tool {

namespace {

double area(const std::array<double, 2>& p, const std::array<double, 2>& q, const std::array<double, 2>& r)
{
  return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

} // namespace

Texel_map::Texel_map(const Model& model, const Triangulated_model& mesh, const Attribute& texture, std::size_t size)
  : m_mesh(mesh), m_texture(texture), m_mixer(model), m_size(size), m_facet(size * size, Mesh::null_face())
{
  constexpr double on_edge = 1e-6; // barycentric coordinate
  const double width = double(size);
  const auto in_image = [&](double x) { return std::size_t((std::min)((std::max)(x, 0.), width)); };
  std::vector<bool> is_inside(size * size, false); // whether the center of a texel is not on an edge
  for(auto f : mesh.mesh().faces()) {
    const Corners corner = corners(f);
    const double whole = area(corner[0], corner[1], corner[2]);
    std::array<double, 2> low, high;
    for(std::size_t i = 0; i < 2; ++i) {
      low[i] = (std::min)({ corner[0][i], corner[1][i], corner[2][i] });
      high[i] = (std::max)({ corner[0][i], corner[1][i], corner[2][i] });
    }
    const bool is_known = std::isfinite(whole); // not all corners of a file have texture coordinates
    if(!is_known || low[0] < -0.5 || low[1] < -0.5 || high[0] > width + 0.5 || high[1] > width + 0.5) ++m_outside;
    if(!is_known || whole == 0) continue;
    const auto first = [&](double x) { return in_image(std::ceil(x - 0.5)); };
    const auto end = [&](double x) { return in_image(std::floor(x - 0.5) + 1); };
    for(std::size_t y = first(low[1]); y < end(high[1]); ++y)
      for(std::size_t x = first(low[0]); x < end(high[0]); ++x) {
        const std::size_t texel = y * size + x;
        const std::array<double, 3> weight = weights(texel, corner);
        const double least = *std::min_element(weight.begin(), weight.end());
        if(least < -on_edge) continue;
        if(m_facet[texel] == Mesh::null_face()) {
          m_facet[texel] = f;
          is_inside[texel] = least > on_edge;
          ++m_covered;
        } else if(is_inside[texel] && least > on_edge) {
          if(m_overlapping++ == 0) m_overlapping_polygons = { mesh.polygon_of(m_facet[texel]), mesh.polygon_of(f) };
        }
      }
  }
}

Texel_map::Corners Texel_map::corners(Mesh::Face_index f) const
{
  Corners result;
  auto corner = result.begin();
  for(auto h : corners_of(m_mesh.mesh(), f)) {
    const double* const uv = m_texture[m_mixer.element(m_texture, m_mesh.corner_at(h))];
    *corner++ = { uv[0] * double(m_size), (1 - uv[1]) * double(m_size) };
  }
  return result;
}

std::array<double, 3> Texel_map::weights(std::size_t texel, const Corners& corner) const
{
  const Position center = { double(texel % m_size) + 0.5, double(texel / m_size) + 0.5 };
  const double whole = area(corner[0], corner[1], corner[2]);
  std::array<double, 3> weight;
  for(std::size_t i = 0; i < 3; ++i) weight[i] = area(center, corner[(i + 1) % 3], corner[(i + 2) % 3]) / whole;
  return weight;
}

} // namespace Tool
