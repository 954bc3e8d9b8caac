#include "pages.h"

#include <Carry/Triangulated_model.h>
#include <View/page_of.h>

#include <CGAL/Bspline_shell_3/Projection/Projection_target_3.h>
#include <CGAL/certified_shell_of_soup_3.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace test_page_of {

using namespace Tool;

// An octahedron whose facets are split into four, and pushed out by a factor.
Model octahedron(double radius, double push)
{
  Model model;
  auto& points = model.soup.points;
  const auto add = [&](double x, double y, double z) {
    points.emplace_back(radius * x, radius * y, radius * z);
    return points.size() - 1;
  };
  for(int signs = 0; signs < 8; ++signs) {
    const double x = signs & 1 ? -1 : 1, y = signs & 2 ? -1 : 1, z = signs & 4 ? -1 : 1;
    const std::size_t a = add(x, 0, 0), b = add(0, y, 0), c = add(0, 0, z);
    const std::size_t u = add(0, push * y, push * z), v = add(push * x, 0, push * z), w = add(push * x, push * y, 0);
    for(std::vector<std::size_t> t : { std::vector<std::size_t>{ a, w, v }, { w, b, u }, { v, u, c }, { u, v, w } }) {
      if(x * y * z < 0) std::swap(t[1], t[2]);
      model.soup.polygons.push_back(t);
    }
  }
  return model;
}

struct Example
{
  Example() : first(octahedron(1, 0.6)), second(octahedron(1.01, 0.6))
  {
    found = CGAL::certified_shell_of_soup_3(first.soup, BS::parameters::relative_thickness(0.04));
    view.title = "example";
    view.sides = { { "first", &first }, { "second", &second } };
    view.shell = &found.shell();
  }

  Model first, second;
  BS::Shell_of_soup_3 found;
  View view;
};

TEST_CASE("page_of: a page has the meshes, the field, the surfaces, distances, and the thickness")
{
  if(!has_page_scripts()) return; // the program was built without three.js
  const Example example;
  REQUIRE(example.found.is_certified());
  const std::string page = page_of(example.view);
  for(const char* name : { "mesh0", "mesh0.points", "mesh1.triangles", "field.frame", "field.coefficients",
                           "inner.points", "outer.triangles" })
    CHECK(has_array(page, name));
  CHECK_FALSE(has_array(page, "mesh0.images"));
  CHECK_FALSE(has_array(page, "places"));
  // The octahedra are similar: their distance is largest at the corners, and least inside of facets.
  const auto distances = array_of<float>(page, "mesh1.channel0");
  CHECK(*std::max_element(distances.begin(), distances.end()) == Approx(0.01).epsilon(0.02));
  for(float t : array_of<float>(page, "mesh0.channel1"))
    CHECK(t == Approx(example.found.shell().thickness()).epsilon(0.05));
}

TEST_CASE("page_of: coefficients of the page are those of the field, relative to the center of the box")
{
  if(!has_page_scripts()) return;
  const Example example;
  const std::string page = page_of(example.view);
  const auto& field = example.found.shell().field();
  const auto frame = array_of<double>(page, "field.frame");
  const auto points = array_of<int>(page, "field.points");
  const auto coefficients = array_of<float>(page, "field.coefficients");
  REQUIRE(3 * points.size() == 4 * coefficients.size());
  CHECK(frame[3] == field.cells().level_width(0));
  const Eigen::VectorXd all = field.extend(field.coefficients());
  for(std::size_t n = 0; n < points.size() / 4; ++n) {
    const int* const p = &points[4 * n];
    const auto index = field.points(p[0]).index(p[1], p[2], p[3]);
    CHECK(coefficients[3 * n] == float(all[field.first_point(p[0]) + index]));
    CHECK(coefficients[3 * n + 1] < coefficients[3 * n + 2]); // thresholds
  }
  // Each flagged cell has its 64 points.
  const auto cells = array_of<int>(page, "field.cells");
  const auto& flags = example.found.shell().shell_cells();
  CHECK(std::size_t(std::count_if(flags.begin(), flags.end(), [](char c) { return c != 0; })) == cells.size() / 4);
}

TEST_CASE("page_of: if the page would be too large, images of vertices replace the field, and the report says so")
{
  if(!has_page_scripts()) return;
  const Example example;
  const std::string page = page_of(example.view, 1000);
  CHECK_FALSE(has_array(page, "field.frame"));
  CHECK_FALSE(has_array(page, "inner.points"));
  CHECK(page.find("<dt>Curves</dt><dd>are omitted") != std::string::npos);
  CHECK(page.find("<dt>Surfaces</dt><dd>of the shell are omitted") != std::string::npos);
  const auto points = array_of<float>(page, "mesh0.points"), images = array_of<float>(page, "mesh0.images");
  REQUIRE(points.size() == images.size());
  const Triangulated_model second(example.second);
  const BS::Projection_target_3<Mesh> target(second.mesh(), second.mesh().points());
  for(std::size_t n = 0; n < images.size(); n += 3) {
    const std::array<double, 3> image = { images[n], images[n + 1], images[n + 2] };
    const auto [facet, weights] = target.closest(image);
    const auto nearest = target.point(facet, weights);
    double from_mesh = 0, moved = 0;
    for(std::size_t i = 0; i < 3; ++i) {
      from_mesh = (std::max)(from_mesh, std::abs(image[i] - nearest[i]));
      moved = (std::max)(moved, std::abs(image[i] - double(points[n + i])));
    }
    CHECK(from_mesh < 1e-6);
    CHECK(moved > 1e-3);
    CHECK(moved < 0.02);
  }
}

TEST_CASE("page_of: places have their points and sentences")
{
  if(!has_page_scripts()) return;
  const Example example;
  View view;
  view.sides = { { "first", &example.first } };
  view.places = { { { 1, 2, 3 }, "first sentence" }, { { 4, 5, 6 }, "second sentence" } };
  const std::string page = page_of(view);
  CHECK(array_of<float>(page, "places") == std::vector<float>{ 1, 2, 3, 4, 5, 6 });
  const auto text = array_of<char>(page, "places.messages");
  CHECK(std::string(text.begin(), text.end()) == "first sentence\nsecond sentence\n");
  CHECK_FALSE(has_array(page, "mesh1"));
}

} // namespace test_page_of
