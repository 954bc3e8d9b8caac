#include "temporary_files.h"

#include <View/Surface_colors.h>

#include <catch2/catch.hpp>

#include <array>
#include <fstream>
#include <string>
#include <vector>

namespace test_Surface_colors {

using namespace Tool;

const std::string png = "\x89PNG of a test";

// Three triangles with materials, the last of which is in no library.
Model triangles()
{
  Model model;
  model.soup.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 } };
  model.soup.polygons = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 } };
  model.materials = "newmtl red brick\nKd 1 0.25 0\nnewmtl paint\nKd 0 0 1\nmap_Kd paint.png\n";
  model.attributes = { { material_name,
                         Element::POLYGON,
                         Kind::LABEL,
                         Number_type::INT32,
                         { material_name },
                         { 0, 1, 2 },
                         { "red brick", "paint", "unknown" } } };
  return model;
}

TEST_CASE("Surface_colors: colors of materials are used unless the model has other colors")
{
  Model model = triangles();
  Image_files images;
  const Surface_colors colors(model, images);
  CHECK(colors.has_colors());
  CHECK(colors.color(0, 0) == std::array<float, 3>{ 1, 0.25f, 0 });
  CHECK(colors.color(1, 3) == std::array<float, 3>{ 0, 0, 1 });
  CHECK(colors.color(2, 6)[0] == colors.color(2, 6)[2]); // gray
  model.attributes.push_back({ color_name,
                               Element::POINT,
                               Kind::COLOR,
                               Number_type::UINT8,
                               { "red", "green", "blue" },
                               { 255, 0, 0, 0, 255, 0, 0, 0, 255 },
                               {} });
  const Surface_colors of_points(model, images);
  CHECK(of_points.color(0, 1) == std::array<float, 3>{ 0, 1, 0 });
  CHECK(of_points.color(1, 3) == std::array<float, 3>{ 0, 1, 0 }); // the first corner of this polygon is the point 1
}

TEST_CASE("Surface_colors: images need texture coordinates and a readable file, and are stored once")
{
  const Temporary_file file("paint.png");
  Model model = triangles();
  model.materials = "newmtl paint\nmap_Kd " + file.name + "\nnewmtl red brick\nmap_Kd " + file.name + "\n";
  Image_files images;
  const auto image = [&](std::size_t polygon) { return Surface_colors(model, images).image(polygon); };
  std::ofstream(file.name, std::ios::binary) << png;
  CHECK(image(1) == Surface_colors::no_image); // no texture coordinates
  model.attributes.push_back(
    { texture_name, Element::POINT, Kind::REAL, Number_type::FLOAT64, { "u", "v" }, std::vector<double>(6), {} });
  CHECK(image(0) == 0);
  CHECK(image(1) == 0);
  CHECK(image(2) == Surface_colors::no_image);
  CHECK(images == Image_files{ png });
  std::ofstream(file.name, std::ios::binary) << "a text";
  images.clear();
  CHECK(image(1) == Surface_colors::no_image);
  CHECK(images.empty());
}

} // namespace test_Surface_colors
