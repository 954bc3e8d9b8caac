#include "bake.h"

#include "../Carry/Corner_places.h"

#include <algorithm>
#include <utility>

namespace Tool {

namespace {

// Fills texels beside covered ones with the mean of their covered neighbors, in several rounds.
void add_margin(Image& image, std::vector<char>& is_covered, std::size_t margin)
{
  const std::ptrdiff_t width = std::ptrdiff_t(image.width), height = std::ptrdiff_t(image.height);
  for(std::size_t round = 0; round < margin; ++round) {
    std::vector<std::pair<std::size_t, Color> > filled;
    for(std::ptrdiff_t y = 0; y < height; ++y)
      for(std::ptrdiff_t x = 0; x < width; ++x) {
        if(is_covered[std::size_t(y * width + x)]) continue;
        Color sum = {};
        int number = 0;
        for(std::ptrdiff_t v = (std::max)(y - 1, std::ptrdiff_t(0)); v < (std::min)(y + 2, height); ++v)
          for(std::ptrdiff_t u = (std::max)(x - 1, std::ptrdiff_t(0)); u < (std::min)(x + 2, width); ++u) {
            const std::size_t neighbor = std::size_t(v * width + u);
            if(!is_covered[neighbor]) continue;
            const Color color = image.at(neighbor);
            for(std::size_t i = 0; i < 3; ++i) sum[i] += color[i];
            ++number;
          }
        if(number == 0) continue;
        for(double& c : sum) c /= number;
        filled.emplace_back(std::size_t(y * width + x), sum);
      }
    for(const auto& texel : filled) {
      image.set(texel.first, texel.second);
      is_covered[texel.first] = 1;
    }
  }
}

} // namespace

Image bake(const Model_map& map, const std::vector<Texel>& texels, std::size_t size, std::size_t margin,
           const std::function<Color(const Source_point&)>& color, const std::function<void(double)>& progress)
{
  constexpr std::size_t block = 1 << 16; // texels that are mapped at once, to bound the memory
  Image image(size, size);
  std::vector<char> is_covered(size * size, 0);
  map.visit([&](const auto& m) {
    const auto inverse = m.inverse();
    const Corner_places places(m);
    for(std::size_t first = 0; first < texels.size(); first += block) {
      progress(double(first) / double(texels.size()));
      const std::size_t last = (std::min)(first + block, texels.size());
      std::vector<std::pair<Mesh::Face_index, std::array<double, 3> > > locations;
      for(std::size_t n = first; n < last; ++n) locations.emplace_back(texels[n].facet, texels[n].weights);
      const auto images = inverse.project(locations);
      for(std::size_t n = first; n < last; ++n) {
        Source_point point;
        if(const auto& found = images[n - first]) {
          const auto h = m.source().halfedge(found.location.first); // leads to the second corner
          point = { found.location.first, { m.source().prev(h), h, m.source().next(h) }, found.location.second };
        } else {
          const auto p = inverse.point(locations[n - first]);
          const Place place = places.nearest({ p[0], p[1], p[2] });
          point = { m.source().face(place.corner[0]), place.corner, place.weight };
        }
        image.set(texels[n].position, color(point));
        is_covered[texels[n].position] = 1;
      }
    }
  });
  add_margin(image, is_covered, margin);
  return image;
}

} // namespace Tool
