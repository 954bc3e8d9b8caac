#include "temporary_files.h"

#include <Bake/Image.h>

#include <catch2/catch.hpp>

#include <string>
#include <vector>

namespace test_Image {

using namespace Tool;

TEST_CASE("Image: a PNG file that is written and read has the same texels")
{
  Image image(3, 2);
  for(std::size_t n = 0; n < image.values.size(); ++n) image.values[n] = static_cast<unsigned char>(13 * n);
  const Temporary_file file("image.png", *png_of(image));
  const auto again = read_image("image.png");
  REQUIRE(again);
  CHECK(again->width == 3);
  CHECK(again->height == 2);
  CHECK(again->values == image.values);
  const std::string text = contents("image.png");
  const auto from_memory = read_image(std::vector<unsigned char>(text.begin(), text.end()));
  REQUIRE(from_memory);
  CHECK(from_memory->values == image.values);
}

TEST_CASE("Image: files of other formats are rejected")
{
  const Temporary_file file("text.png", "not an image");
  CHECK(!read_image("text.png"));
  CHECK(!read_image("missing.png"));
  CHECK(!read_image(std::vector<unsigned char>{ 1, 2, 3 }));
  CHECK(!read_image(std::vector<unsigned char>()));
}

TEST_CASE("Image: samples at centers are texels, and others are interpolated")
{
  Image image(2, 2); // v is 0 at the bottom
  image.set(0, { 0, 0, 0 });
  image.set(1, { 100, 0, 0 });
  image.set(2, { 0, 200, 0 });
  image.set(3, { 100, 200, 0 });
  CHECK(image.sample(0.25, 0.75) == Color{ 0, 0, 0 });
  CHECK(image.sample(0.75, 0.25) == Color{ 100, 200, 0 });
  CHECK(image.sample(0.5, 0.5) == Color{ 50, 100, 0 });
  CHECK(image.sample(0.375, 0.75)[0] == Approx(25));
}

TEST_CASE("Image: it is repeated")
{
  Image image(2, 1);
  image.set(1, { 200, 100, 50 });
  CHECK(image.sample(1.75, 0.5) == image.sample(0.75, 0.5));
  CHECK(image.sample(-0.25, 7.5) == image.sample(0.75, 0.5));
  CHECK(image.sample(0, 0.5)[0] == Approx(100)); // between the last and the first column
}

} // namespace test_Image
