#include "temporary_files.h"

#include <Bake/Color_source.h>
#include <Files/read_model.h>

#include <catch2/catch.hpp>

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace test_Color_source {

using namespace Tool;

const Color red = { 200, 0, 0 }, green = { 0, 100, 0 }, blue = { 0, 0, 50 };

// Two texels beside each other.
std::string picture(const Color& left, const Color& right)
{
  Image image(2, 1);
  image.set(0, left);
  image.set(1, right);
  return *png_of(image);
}

std::string base64(const std::string& text)
{
  const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  for(std::size_t n = 0; n < text.size(); n += 3) {
    unsigned bits = 0;
    for(std::size_t i = 0; i < 3; ++i)
      bits = bits << 8 | (n + i < text.size() ? static_cast<unsigned char>(text[n + i]) : 0u);
    for(std::size_t i = 0; i < 4; ++i) result += n + i <= text.size() ? digits[bits >> (18 - 6 * i) & 63] : '=';
  }
  return result;
}

Model model_of(const std::string& name, const std::string& text)
{
  const Temporary_file file(name, text);
  Model model;
  REQUIRE(read_model(name, model));
  return model;
}

Color corner_color(const Color_source& colors, std::size_t polygon, std::size_t corner)
{
  return colors(polygon, { { 3 * polygon + corner, 1. } });
}

// A triangle whose corners have the texture coordinates (0.25, 0.5), (0.75, 0.5), and (1.75, 0.5), and two colors.
const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25 0.5\nvt 0.75 0.5\nvt 1.75 0.5\nf 1/1 2/2 3/3\n";

std::string gltf(const std::string& image, const std::string& material, const std::string& more = "")
{
  const auto bytes = [](const std::vector<float>& x) {
    return std::string(reinterpret_cast<const char*>(x.data()), x.size() * sizeof(float));
  };
  const std::string data = bytes({ 0, 0, 0, 1, 0, 0, 0, 1, 0 }) + bytes({ 0.25f, 0.5f, 0.75f, 0.5f, 1.75f, 0.5f });
  return "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],\"meshes\":[{"
         "\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1},\"material\":0}]}],\"accessors\":[{"
         "\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},{\"bufferView\":1,"
         "\"componentType\":5126,\"count\":3,\"type\":\"VEC2\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{"
         "\"buffer\":0,\"byteOffset\":36,\"byteLength\":24}],\"buffers\":[{\"byteLength\":60,"
         "\"uri\":\"data:application/octet-stream;base64,"
         + base64(data) + "\"}],\"images\":[{\"uri\":\"" + image + "\"}],\"textures\":[{\"source\":0" + more
         + "}],\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}" + material + "}}]}";
}

TEST_CASE("Color_source: images of glTF files, which are in the file or beside it")
{
  const Temporary_file image("two colors.png", picture(red, blue));
  for(const std::string& uri :
      { std::string("two%20colors.png"), "data:image/png;base64," + base64(picture(red, blue)) }) {
    const Model model = model_of("test.gltf", gltf(uri, ""));
    std::vector<std::string> warnings;
    const Color_source colors(model, warnings);
    CHECK(warnings.empty());
    REQUIRE(colors);
    CHECK(corner_color(colors, 0, 0) == red);
    CHECK(corner_color(colors, 0, 1) == blue);
    CHECK(corner_color(colors, 0, 2) == blue);
  }
}

TEST_CASE("Color_source: factors of glTF materials are intensities of light")
{
  const Temporary_file image("two.png", picture({ 255, 255, 255 }, { 188, 188, 188 }));
  std::vector<std::string> warnings;
  const Model model = model_of("test.gltf", gltf("two.png", ",\"baseColorFactor\":[0.5,1,0,1]"));
  const Color_source tinted(model, warnings);
  // A color of 188 is half as bright as white.
  CHECK(corner_color(tinted, 0, 0)[0] == Approx(188).margin(0.5));
  CHECK(corner_color(tinted, 0, 0)[1] == 255);
  CHECK(corner_color(tinted, 0, 1)[0] == Approx(137).margin(0.5)); // a quarter
  CHECK(corner_color(tinted, 0, 1)[2] == 0);

  const Model missing = model_of("test.gltf", gltf("missing.png", ",\"baseColorFactor\":[0.5,1,0,1]"));
  const Color_source plain(missing, warnings);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("missing.png") != std::string::npos);
  CHECK(corner_color(plain, 0, 0)[0] == Approx(188).margin(0.5));
  CHECK(corner_color(plain, 0, 0)[1] == Approx(255));
}

TEST_CASE("Color_source: images are repeated, mirrored, or continued as their samplers require")
{
  const Temporary_file image("two.png", picture(red, blue));
  const auto last = [](int mode) {
    const std::string sampler = ",\"sampler\":0}],\"samplers\":[{\"wrapS\":" + std::to_string(mode);
    const Model model = model_of("test.gltf", gltf("two.png", "", sampler));
    std::vector<std::string> warnings;
    return corner_color(Color_source(model, warnings), 0, 2);
  };
  CHECK(last(10497) == blue);
  CHECK(last(33071) == blue);
  CHECK(last(33648) == red);
}

TEST_CASE("Color_source: options of textures in material libraries")
{
  const Temporary_file image("two.png", picture(red, blue));
  const auto last = [](const std::string& options) {
    const Temporary_file library("two.mtl", "newmtl m\nmap_Kd " + options + "two.png\n");
    const Model model = model_of("two.obj", "mtllib two.mtl\nusemtl m\n" + triangle);
    std::vector<std::string> warnings;
    return corner_color(Color_source(model, warnings), 0, 2);
  };
  CHECK(last("") == blue);
  CHECK(last("-o 0.5 ") == red);   // 2.25
  CHECK(last("-s 3 1 1 ") == red); // 5.25
  CHECK(last("-o -1.5 0 -s 1 ") == red);
  CHECK(last("-clamp on -o 0.5 ") == blue);
}

TEST_CASE("Color_source: a texture is read once, and only if there are texture coordinates")
{
  const Temporary_file library("two.mtl",
                               "newmtl a\nKd 0.2 0.4 0.6\nmap_Kd missing.png\nnewmtl b\nmap_Kd missing.png\n");
  std::vector<std::string> warnings;
  const Model model = model_of("two.obj", "mtllib two.mtl\nusemtl a\n" + triangle + "usemtl b\nf 1 2 3\n");
  CHECK(Color_source(model, warnings));
  CHECK(warnings.size() == 1);
  warnings.clear();
  const Model plain = model_of("two.obj", "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
  const Color_source colors(plain, warnings);
  CHECK(warnings.empty());
  CHECK(corner_color(colors, 0, 0)[2] == Approx(0.6 * 255));
}

TEST_CASE("Color_source: coordinates with one component are not used")
{
  const Temporary_file library("two.mtl", "newmtl a\nKd 1 0 0\nmap_Kd missing.png\n");
  std::vector<std::string> warnings;
  const Model model = model_of("two.obj", "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5\nusemtl a\n"
                                          "f 1/1 2/1 3/1\n");
  const Color_source colors(model, warnings);
  CHECK(warnings.empty());
  CHECK(corner_color(colors, 0, 0)[0] == Approx(255));
}

TEST_CASE("Color_source: polygons of PLY files select a texture by its number")
{
  const Temporary_file first("first.png", picture(red, red)), second("second.png", picture(green, green));
  const auto ply = [](const std::string& property) {
    return "ply\nformat ascii 1.0\ncomment TextureFile first.png\ncomment TextureFile second.png\nelement vertex 3\n"
           "property float x\nproperty float y\nproperty float z\nelement face 2\n"
           "property list uchar int vertex_indices\nproperty int "
           + property
           + "\nproperty list uchar float texcoord\nend_header\n"
             "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1 6 0 0 1 0 0 1\n3 0 2 1 0 6 0 0 0 1 1 0\n";
  };
  std::vector<std::string> warnings;
  const Model model = model_of("two.ply", ply("texnumber"));
  const Color_source colors(model, warnings);
  CHECK(warnings.empty());
  CHECK(corner_color(colors, 0, 0) == green);
  CHECK(corner_color(colors, 1, 0) == red);

  const Model without = model_of("two.ply", ply("other"));
  const Color_source of_first(without, warnings);
  CHECK(corner_color(of_first, 0, 0) == red);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("texnumber") != std::string::npos);
}

TEST_CASE("Color_source: a color that the file does not give is that of the material")
{
  const Temporary_file library("two.mtl", "newmtl a\nKd 0 1 0\n");
  Model model = model_of("two.obj", "mtllib two.mtl\nv 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
  std::vector<std::string> warnings;
  const Color_source colors(model, warnings);
  CHECK(corner_color(colors, 0, 0) == Color{ 255, 0, 0 });
  CHECK(corner_color(colors, 0, 1)[1] == Approx(255));
}

} // namespace test_Color_source
