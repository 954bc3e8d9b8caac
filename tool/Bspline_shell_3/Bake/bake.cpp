#include "bake.h"

#include "../Carry/Corner_places.h"

#include <algorithm>
#include <utility>

namespace Tool {

namespace {

// Fills texels beside covered ones with the mean of their covered neighbors, in several rounds.
class Margin
{
public:
  Margin(const Texel_map& texels) : m_size(texels.size()), m_state(m_size * m_size, EMPTY)
  {
    for(std::size_t n = 0; n < m_state.size(); ++n)
      if(texels.facet(n) != Mesh::null_face()) m_state[n] = COVERED;
    for(std::size_t n = 0; n < m_state.size(); ++n)
      if(m_state[n] == COVERED) list_neighbors(n);
  }

  void add_to(std::vector<Image>& images, std::size_t rounds)
  {
    for(std::size_t round = 0; round < rounds && !m_listed.empty(); ++round) {
      const std::vector<std::size_t> listed = std::move(m_listed);
      m_listed.clear();
      for(std::size_t n : listed)
        for(Image& image : images) image.set(n, mean(image, n));
      for(std::size_t n : listed) m_state[n] = COVERED;
      for(std::size_t n : listed) list_neighbors(n);
    }
  }

private:
  enum State : char
  {
    EMPTY,
    LISTED, // filled in the next round
    COVERED
  };

  template <typename Visit>
  void visit_neighbors(std::size_t texel, const Visit& visit) const
  {
    const std::size_t x = texel % m_size, y = texel / m_size;
    for(std::size_t v = y > 0 ? y - 1 : 0; v < (std::min)(y + 2, m_size); ++v)
      for(std::size_t u = x > 0 ? x - 1 : 0; u < (std::min)(x + 2, m_size); ++u) visit(v * m_size + u);
  }

  void list_neighbors(std::size_t texel)
  {
    visit_neighbors(texel, [&](std::size_t n) {
      if(m_state[n] != EMPTY) return;
      m_state[n] = LISTED;
      m_listed.push_back(n);
    });
  }

  Color mean(const Image& image, std::size_t texel) const
  {
    Color sum = {};
    int number = 0;
    visit_neighbors(texel, [&](std::size_t n) {
      if(m_state[n] != COVERED) return;
      const Color color = image.at(n);
      for(std::size_t i = 0; i < 3; ++i) sum[i] += color[i];
      ++number;
    });
    for(double& c : sum) c /= number;
    return sum;
  }

  std::size_t m_size;
  std::vector<State> m_state; // by texel
  std::vector<std::size_t> m_listed;
};

} // namespace

std::vector<Image> bake(const Model_map& map, const Texel_map& texels, std::size_t margin,
                        const std::vector<Color_of_point>& colors, const std::function<void(double)>& progress)
{
  constexpr std::size_t block = 1 << 16; // texels that are mapped at once, to bound the memory
  const std::size_t size = texels.size(), number = size * size;
  std::vector<Image> images(colors.size(), Image(size, size));
  map.visit([&](const auto& m) {
    const auto inverse = m.inverse();
    const Corner_places places(m);
    for(std::size_t next = 0; next < number;) {
      progress(double(next) / double(number));
      std::vector<std::size_t> covered;
      std::vector<std::pair<Mesh::Face_index, std::array<double, 3> > > locations;
      for(; next < number && covered.size() < block; ++next) {
        if(texels.facet(next) == Mesh::null_face()) continue;
        covered.push_back(next);
        locations.emplace_back(texels.facet(next), texels.weights(next));
      }
      const auto found = inverse.project(locations);
      for(std::size_t n = 0; n < covered.size(); ++n) {
        Source_point point;
        if(found[n]) {
          const auto& [facet, weights] = found[n].location;
          point = { facet, corners_of(m.source(), facet), weights };
        } else {
          const auto p = inverse.point(locations[n]);
          const Place place = places.nearest({ p[0], p[1], p[2] });
          point = { m.source().face(place.corner[0]), place.corner, place.weight };
        }
        for(std::size_t i = 0; i < colors.size(); ++i) images[i].set(covered[n], colors[i](point));
      }
    }
  });
  if(margin > 0) Margin(texels).add_to(images, margin);
  return images;
}

} // namespace Tool
