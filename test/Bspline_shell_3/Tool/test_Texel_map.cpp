#include <Bake/Texel_map.h>

#include <catch2/catch.hpp>

#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace test_Texel_map {

using namespace Tool;

// A square of two triangles, with texture coordinates at corners.
struct Square
{
  explicit Square(std::vector<double> texture)
  {
    model.soup.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
    model.soup.polygons = { { 0, 1, 2 }, { 0, 2, 3 } };
    model.attributes = {
      { texture_name, Element::CORNER, Kind::REAL, Number_type::FLOAT64, { "u", "v" }, std::move(texture), {} }
    };
  }
  Texel_map map(std::size_t size) const
  {
    return map_texels(model, Triangulated_model(model), model.attributes[0], size);
  }

  Model model;
};

TEST_CASE("map_texels: texels of a square are covered once, and know their points")
{
  const Square square({ 0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1 });
  const Texel_map map = square.map(8);
  CHECK(map.overlapping == 0);
  CHECK(map.outside == 0);
  std::set<std::size_t> positions;
  const Triangulated_model mesh(square.model);
  for(const Texel& texel : map.texels) {
    positions.insert(texel.position);
    auto h = mesh.mesh().prev(mesh.mesh().halfedge(texel.facet));
    double x = 0, y = 0;
    for(double w : texel.weights) {
      x += w * mesh.mesh().point(mesh.mesh().target(h)).x();
      y += w * mesh.mesh().point(mesh.mesh().target(h)).y();
      h = mesh.mesh().next(h);
    }
    CHECK(x == Approx((double(texel.position % 8) + 0.5) / 8));
    CHECK(y == Approx(1 - (double(texel.position / 8) + 0.5) / 8));
  }
  CHECK(positions.size() == 64);
  CHECK(map.texels.size() == 64);
}

TEST_CASE("map_texels: triangles with the same texture coordinates overlap, even if one is mirrored")
{
  const Texel_map map = Square({ 0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 1, 0 }).map(16);
  CHECK(map.overlapping > 100);
  CHECK(map.overlapping_polygons[0] != map.overlapping_polygons[1]);
}

TEST_CASE("map_texels: triangles beyond the image are counted, and covered in part")
{
  const Texel_map map = Square({ 0, 0, 2, 0, 2, 2, 0, 0, 1, 1, 0, 1 }).map(16);
  CHECK(map.outside == 1);
  CHECK(map.texels.size() == 256);
}

} // namespace test_Texel_map
