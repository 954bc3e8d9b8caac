#include <Bake/Texel_map.h>

#include <catch2/catch.hpp>

#include <cstddef>
#include <limits>
#include <memory>
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
    mesh = std::make_unique<const Triangulated_model>(model);
  }
  Texel_map map(std::size_t size) const { return Texel_map(model, *mesh, model.attributes[0], size); }

  Model model;
  std::unique_ptr<const Triangulated_model> mesh;
};

TEST_CASE("Texel_map: texels of a square are covered once, and know their points")
{
  const Square square({ 0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1 });
  const Texel_map map = square.map(8);
  CHECK(map.overlapping() == 0);
  CHECK(map.outside() == 0);
  CHECK(map.covered() == 64);
  const Mesh& mesh = square.mesh->mesh();
  for(std::size_t texel = 0; texel < 64; ++texel) {
    REQUIRE(map.facet(texel) != Mesh::null_face());
    const auto weights = map.weights(texel);
    const auto corners = corners_of(mesh, map.facet(texel));
    double x = 0, y = 0;
    for(std::size_t i = 0; i < 3; ++i) {
      x += weights[i] * mesh.point(mesh.target(corners[i])).x();
      y += weights[i] * mesh.point(mesh.target(corners[i])).y();
    }
    CHECK(x == Approx((double(texel % 8) + 0.5) / 8));
    CHECK(y == Approx(1 - (double(texel / 8) + 0.5) / 8));
  }
}

TEST_CASE("Texel_map: triangles with the same texture coordinates overlap, even if one is mirrored")
{
  const Texel_map map = Square({ 0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 1, 0 }).map(16);
  CHECK(map.overlapping() > 100);
  CHECK(map.overlapping_polygons()[0] != map.overlapping_polygons()[1]);
}

TEST_CASE("Texel_map: triangles beyond the image are counted, and covered in part")
{
  const Texel_map map = Square({ 0, 0, 2, 0, 2, 2, 0, 0, 1, 1, 0, 1 }).map(16);
  CHECK(map.outside() == 1);
  CHECK(map.covered() == 256);
}

TEST_CASE("Texel_map: coordinates may be missing, or so large that no integer holds them")
{
  const double missing = std::numeric_limits<double>::quiet_NaN();
  for(double u : { 1e30, -1e30, 1e300, missing }) {
    const Texel_map map = Square({ 0, 0, u, 0, 1, 1, 0, 0, 1, 1, 0, 1 }).map(16);
    CHECK(map.outside() == 1);
    CHECK(map.facet(0) != Mesh::null_face());
  }
}

} // namespace test_Texel_map
