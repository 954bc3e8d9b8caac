#include "pages.h"

#include <View/Drawn_mesh.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace test_Drawn_mesh {

using namespace Tool;

// A square of two triangles.
Model square()
{
  Model model;
  model.soup.points = { { 10, 0, 0 }, { 11, 0, 0 }, { 11, 1, 0 }, { 10, 1, 0 } };
  model.soup.polygons = { { 0, 1, 2 }, { 0, 2, 3 } };
  return model;
}

Drawn_mesh drawn(const Model& model)
{
  Image_files images;
  return { model, Surface_colors(model, images) };
}

TEST_CASE("Drawn_mesh: triangles share the vertices where values are equal")
{
  Model model = square();
  CHECK(drawn(model).vertices().size() == 4);
  // the values of polygons differ, and so do the vertices of their common edge
  model.attributes = { { "label", Element::POLYGON, Kind::LABEL, Number_type::INT32, { "label" }, { 3, 4 }, {} } };
  const Drawn_mesh mesh = drawn(model);
  CHECK(mesh.vertices().size() == 6);
  REQUIRE(mesh.channels.size() == 1);
  CHECK(mesh.channels[0].has_labels);
  CHECK(std::vector<float>(mesh.channels[0].values) == std::vector<float>{ 3, 3, 3, 4, 4, 4 });
}

TEST_CASE("Drawn_mesh: each component of an attribute is a channel, and missing values remain missing")
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Model model = square();
  model.attributes = {
    { "heat", Element::POINT, Kind::REAL, Number_type::FLOAT32, { "heat" }, { 0, 1, nan, 3 }, {} },
    { "flow", Element::POINT, Kind::REAL, Number_type::FLOAT32, { "u", "v" }, { 0, 1, 2, 3, 4, 5, 6, 7 }, {} },
    { normal_name, Element::POINT, Kind::NORMAL, Number_type::FLOAT32, { "x", "y", "z" }, std::vector<double>(12), {} }
  };
  const Drawn_mesh mesh = drawn(model);
  REQUIRE(mesh.channels.size() == 3);
  CHECK(mesh.channels[0].title == "heat");
  CHECK(mesh.channels[1].title == "flow u");
  CHECK(mesh.channels[2].title == "flow v");
  CHECK(mesh.vertices().size() == 4);
  for(std::size_t n = 0; n < 4; ++n) {
    const bool has_heat = !(mesh.point(n) == model.soup.points[2]);
    CHECK(std::isnan(mesh.channels[0].values[n]) == !has_heat);
    CHECK(mesh.channels[2].values[n] == mesh.channels[1].values[n] + 1);
  }
}

TEST_CASE("Drawn_mesh: points are written relative to a center, and colors in bytes")
{
  if(!has_page_scripts()) return; // the program was built without three.js
  Model model = square();
  model.attributes = { { color_name,
                         Element::POLYGON,
                         Kind::COLOR,
                         Number_type::FLOAT32,
                         { "red", "green", "blue" },
                         { 1, 0, 0.5, 0, 1, 2 },
                         {} } };
  Page page;
  const std::array<double, 3> center = { 10, 0, 0 };
  drawn(model).write(page, "mesh", center);
  const std::string text = page.HTML("", {});
  const auto points = array_of<float>(text, "mesh.points");
  const auto triangles = array_of<unsigned int>(text, "mesh.triangles");
  const auto colors = array_of<unsigned char>(text, "mesh.colors");
  REQUIRE(points.size() == 18);
  REQUIRE(triangles.size() == 6);
  CHECK(array_of<unsigned int>(text, "mesh.groups") == std::vector<unsigned int>{ 2 });
  CHECK(points[3 * triangles[1]] - points[3 * triangles[0]] == 1);
  CHECK(points[3 * triangles[0]] == 0);
  const std::size_t first = 3 * triangles[0], second = 3 * triangles[3];
  CHECK(std::vector<int>(colors.begin() + int(first), colors.begin() + int(first) + 3)
        == std::vector<int>{ 255, 0, 128 });
  CHECK(std::vector<int>(colors.begin() + int(second), colors.begin() + int(second) + 3)
        == std::vector<int>{ 0, 255, 255 });
}

} // namespace test_Drawn_mesh
