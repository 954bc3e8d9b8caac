#include "temporary_files.h"

#include <Files/read_model.h>
#include <Files/write_model.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>

namespace test_files {

using namespace Tool;

Model model_of(const std::string& name, const std::string& text)
{
  const Temporary_file file(name, text);
  Model model;
  REQUIRE(read_model(name, model));
  return model;
}

std::string text_of(const Model& model, const std::string& name)
{
  return write_model(model, name).files[0].second;
}

const char* const square = "ply\nformat ascii 1.0\ncomment made by a test\nobj_info scan 7\n"
                           "element vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
                           "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float heat\n"
                           "property short label\n"
                           "element face 2\nproperty list uchar int vertex_indices\nproperty uint material\n"
                           "property list uchar double texcoord\nend_header\n"
                           "0 0 0 1 2 3 0.5 -1\n1 0 0 4 5 6 0.25 0\n1 1 0 7 8 9 0.1 1\n0 1 0 10 11 12 1e-20 2\n"
                           "3 0 1 2 4000000000 6 0 0 1 0 1 1\n3 0 2 3 1 0\n";

TEST_CASE("PLY: all properties are read, with their types and groups")
{
  const Model model = model_of("square.ply", square);
  CHECK(model.soup.points.size() == 4);
  CHECK(model.comments == std::vector<std::string>{ "comment made by a test", "obj_info scan 7" });
  REQUIRE(model.attributes.size() == 5);
  const Attribute &color = model.attributes[0], &heat = model.attributes[1], &label = model.attributes[2],
                  &material = model.attributes[3], &texture = model.attributes[4];
  CHECK(color.kind == Kind::COLOR);
  CHECK(color.dimension() == 3);
  CHECK(color[2][1] == 8);
  CHECK(heat.kind == Kind::REAL);
  CHECK(heat.type == Number_type::FLOAT32);
  CHECK(label.kind == Kind::LABEL);
  CHECK(label[0][0] == -1);
  CHECK(material.element == Element::POLYGON);
  CHECK(material[0][0] == 4000000000.);
  CHECK(texture.element == Element::CORNER);
  CHECK(texture[2][1] == 1);
  CHECK(std::isnan(texture[3][0]));
}

TEST_CASE("PLY: text that is read and written is the same")
{
  CHECK(text_of(model_of("square.ply", square), "square.ply") == square);
}

TEST_CASE("PLY: each encoding keeps all values")
{
  Model model = model_of("square.ply", square);
  for(const char* encoding : { "binary_little_endian", "binary_big_endian" }) {
    model.encoding = encoding;
    Model again = model_of("again.ply", text_of(model, "again.ply"));
    CHECK(again.encoding == encoding);
    again.encoding = "ascii";
    CHECK(text_of(again, "again.ply") == square);
  }
}

TEST_CASE("PLY: lists and other elements are left out with a warning")
{
  std::string text = square;
  text.insert(text.find("element face"), "property list uchar int neighbors\n");
  text.insert(text.find("end_header"), "element edge 1\nproperty int vertex1\n");
  for(const char* end : { " -1\n", " 0\n", " 1\n", " 2\n" })
    text.insert(text.find(end, text.find("end_header")) + std::strlen(end) - 1, " 2 5 6");
  text += "0\n";
  const Temporary_file file("lists.ply", text);
  Model model;
  const File_report report = read_model("lists.ply", model);
  REQUIRE(report);
  REQUIRE(report.warnings.size() == 2);
  CHECK(report.warnings[0].find("\"neighbors\"") != std::string::npos);
  CHECK(report.warnings[1].find("\"edge\"") != std::string::npos);
  CHECK(text_of(model, "lists.ply") == square);
}

TEST_CASE("PLY: damaged files are malformed")
{
  std::string binary = text_of(
    [] {
      Model model = model_of("square.ply", square);
      model.encoding = "binary_little_endian";
      return model;
    }(),
    "x.ply");
  std::string long_list = binary;
  long_list.back() = '\x7f'; // the length of the last list
  for(const std::string& text :
      { binary.substr(0, binary.size() - 3), long_list, std::string("ply\nelement vertex 3\n"),
        std::string("ply\nformat ascii 1.0\nelement vertex 999999999999\n"
                    "property float x\nend_header\n1\n") }) {
    const Temporary_file file("damaged.ply", text);
    Model model;
    CHECK(read_model("damaged.ply", model).status == File_status::MALFORMED);
  }
}

const char* const cube_side =
  "# a comment\nmtllib side.mtl\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 0.5 0.5 0.5\n"
  "o thing\ng left part\nusemtl red paint\ns 3\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n"
  "f 1/1/1 2/2/1 3/3/1\ns off\nusemtl blue\nvt 0 1\nf 1/1/1 3/3/1 4/4/1\n";

TEST_CASE("OBJ: corners, colors, materials, groups, and smoothing groups survive reading and writing")
{
  const Temporary_file library("side.mtl", "newmtl red paint\nmap_Kd -s 2 2 2 wood.png\nnewmtl blue\nKd 0 0 1\n");
  const Model model = model_of("side.obj", cube_side);
  const Attribute& material = *model.find(material_name, Element::POLYGON);
  CHECK(material.names[std::size_t(material[0][0])] == "red paint");
  CHECK(material.names[std::size_t(material[1][0])] == "blue");
  CHECK(model.find(texture_name, Element::CORNER)->values == std::vector<double>{ 0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1 });
  const Written_files written = write_model(model, "folder/other.obj");
  REQUIRE(written.files.size() == 2);
  CHECK(written.warnings.empty());
  CHECK(written.files[1].first == "folder/other.mtl");
  CHECK(written.files[1].second == "newmtl red paint\nmap_Kd -s 2 2 2 ../wood.png\nnewmtl blue\nKd 0 0 1\n");
  const Model again = model_of("other.obj", written.files[0].second);
  REQUIRE(again.attributes.size() == model.attributes.size());
  for(std::size_t n = 0; n < model.attributes.size(); ++n) {
    CHECK(again.attributes[n].values == model.attributes[n].values);
    CHECK(again.attributes[n].names == model.attributes[n].names);
  }
}

TEST_CASE("OBJ: names of texture files may have spaces and follow options")
{
  const Temporary_file library("side.mtl",
                               "newmtl red paint\nmap_Kd -o 0.5 1 -mm 0 2 -clamp on old oak.png \nbump rough.png\n"
                               "map_Bump -bm 0.2 /textures/my bumps.png\nKd 1 0 0\n");
  const Model model = model_of("side.obj", cube_side);
  CHECK(write_model(model, "side_2.obj").files[1].second == model.materials);
  CHECK(write_model(model, "folder/other.obj").files[1].second
        == "newmtl red paint\nmap_Kd -o 0.5 1 -mm 0 2 -clamp on ../old oak.png \nbump ../rough.png\n"
           "map_Bump -bm 0.2 /textures/my bumps.png\nKd 1 0 0\n");
}

TEST_CASE("OBJ: a material library of another model is not replaced")
{
  const std::string materials = "newmtl red paint\nnewmtl blue\n";
  const Temporary_file library("side.mtl", materials);
  const Model model = model_of("side.obj", cube_side);
  const auto library_name = [&] { return write_model(model, "result.obj").files[1].first; };
  CHECK(library_name() == "result.mtl");
  const Temporary_file other("result.mtl", "newmtl green\n");
  const Written_files written = write_model(model, "result.obj");
  CHECK(written.files[1].first == "result_1.mtl");
  CHECK(written.files[0].second.find("mtllib result_1.mtl\n") != std::string::npos);
  REQUIRE(written.warnings.size() == 1);
  CHECK(written.warnings[0].find("result.mtl belongs to another model") != std::string::npos);
  const Temporary_file first("result_1.mtl", "newmtl yellow\n");
  CHECK(library_name() == "result_2.mtl");
  {
    const Temporary_file earlier("result.obj", "mtllib result_1.mtl\n");
    CHECK(library_name() == "result_1.mtl");
  }
  const Temporary_file same("result_1.mtl", materials);
  CHECK(library_name() == "result_1.mtl");
}

TEST_CASE("Texts of labels survive a way through other formats")
{
  const Model obj = model_of("side.obj", cube_side);
  const Model ply = model_of("side.ply", text_of(obj, "side.ply"));
  CHECK(text_of(ply, "again.ply") == text_of(obj, "side.ply"));
  const Model again = model_of("again.obj", text_of(ply, "again.obj"));
  for(const char* name : { object_name, group_name, material_name, smoothing_name }) {
    INFO(name);
    const Attribute &before = *obj.find(name, Element::POLYGON), &after = *again.find(name, Element::POLYGON);
    CHECK(after.values == before.values);
    CHECK(after.names == before.names);
  }

  const std::string facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  const Model stl = model_of("parts.stl",
                             "solid one\n" + facet + "endsolid one\nsolid two\n" + facet + "endsolid two\n");
  const Model groups = model_of("parts.obj", text_of(stl, "parts.obj"));
  const Attribute& group = *groups.find(group_name, Element::POLYGON);
  CHECK(group.names[std::size_t(group[0][0])] == "one");
  CHECK(group.names[std::size_t(group[1][0])] == "two");

  // Numbers without texts become their digits. Other comments remain.
  const Model numbers = model_of("numbers.ply",
                                 "ply\nformat ascii 1.0\ncomment label of a scan\ncomment label x 7 seven\n"
                                 "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                                 "element face 2\nproperty list uchar int vertex_indices\nproperty int material\n"
                                 "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 0\n3 2 1 0 4\n");
  CHECK(numbers.comments == std::vector<std::string>{ "comment label of a scan", "comment label x 7 seven" });
  const std::string text = text_of(numbers, "numbers.obj");
  CHECK(text.find("usemtl 0\nf 1 2 3\nusemtl 4\nf 3 2 1\n") != std::string::npos);
}

TEST_CASE("OBJ: negative indices, continued lines, comments, and missing parts of corners")
{
  const Model model = model_of("odd.obj", "v 0 0 0\nv 1 0 \\\n 0 # end\nv 1 1 0\nv 0 1 0\nvn 0 0 1\n"
                                          "f -4//1 -3//1 -2//-1\nf 1 3 4\n");
  CHECK(model.soup.polygons == Model::Polygons{ { 0, 1, 2 }, { 0, 2, 3 } });
  const Attribute& normal = *model.find(Kind::NORMAL, Element::CORNER);
  CHECK(normal[2][2] == 1);
  CHECK(std::isnan(normal[3][2]));
  CHECK(text_of(model, "odd.obj").find("f 1 3 4\n") != std::string::npos);
}

TEST_CASE("Text files keep all digits of coordinates")
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-1e3, 1e3);
  Model model;
  for(int n = 0; n < 300; ++n) model.soup.points.emplace_back(coordinate(random), coordinate(random) * 1e-9, n);
  for(std::size_t n = 0; n < 300; n += 3) model.soup.polygons.push_back({ n, n + 1, n + 2 });
  for(const char* name : { "digits.ply", "digits.obj", "digits.off", "digits.stl" }) {
    const Model again = model_of(name, text_of(model, name));
    CHECK(again.soup.points == model.soup.points);
    CHECK(again.soup.polygons == model.soup.polygons);
  }
}

TEST_CASE("OFF: colors of points and polygons, and normals")
{
  const std::string text =
    "CNOFF\n# colors\n3 2 0\n0 0 0 0 0 1 255 0 0 255\n1 0 0 0 0 1 0 255 0 255\n0 1 0 0 0 1 0 0 255 255\n"
    "3 0 1 2 10 20 30\n3 2 1 0\n";
  const Model model = model_of("colors.off", text);
  CHECK(model.find(Kind::NORMAL, Element::POINT)->dimension() == 3);
  CHECK((*model.find(Kind::COLOR, Element::POINT))[1][1] == 255);
  CHECK((*model.find(Kind::COLOR, Element::POLYGON))[0][2] == 30);
  CHECK(text_of(model, "colors.off") == text);
  const Model reals = model_of("reals.off", "COFF\n3 1 0\n0 0 0 1.0 0 0 1\n1 0 0 0 0.5 0 1\n0 1 0 0 0 1 1\n3 0 1 2\n");
  CHECK(is_real(reals.attributes[0].type));
  CHECK(model_of("again.off", text_of(reals, "again.off")).attributes[0].values == reals.attributes[0].values);
}

TEST_CASE("STL: solids are labels, and binary files keep their header and the values of facets")
{
  const std::string facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  const std::string text = "solid first part\n" + facet + "endsolid first part\nsolid second\n" + facet
                           + "endsolid second\n";
  const Model model = model_of("parts.stl", text);
  CHECK(model.soup.points.size() == 3);
  CHECK(model.attributes[0].names == std::vector<std::string>{ "first part", "second" });
  CHECK(text_of(model, "parts.stl") == text);
  std::string capitals = text;
  capitals[0] = 'S';
  CHECK(text_of(model_of("capitals.stl", capitals), "parts.stl") == text);

  std::string binary(80, '\0');
  binary.replace(0, 9, "a program");
  const std::uint32_t size = 1;
  const float numbers[12] = { 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.1f, 0 };
  const std::uint16_t value = 4711;
  binary.append(reinterpret_cast<const char*>(&size), sizeof size);
  binary.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
  binary.append(reinterpret_cast<const char*>(&value), sizeof value);
  const Model stl = model_of("binary.stl", binary);
  CHECK(text_of(stl, "binary.stl") == binary);
  const Model ply = model_of("binary.ply", text_of(stl, "binary.ply"));
  CHECK(ply.soup.points == stl.soup.points);
  CHECK(ply.encoding == "binary_little_endian");
}

TEST_CASE("Each attribute is written, or a warning names it")
{
  const Model model = model_of("square.ply", square);
  for(const char* name : { "x.ply", "x.obj", "x.off", "x.stl" }) {
    INFO(name);
    const Written_files written = write_model(model, name);
    CHECK(written.attributes.size() + written.warnings.size() == model.attributes.size());
    for(const std::string& attribute : written.attributes)
      for(const std::string& warning : written.warnings)
        CHECK(warning.find('"' + attribute + '"') == std::string::npos);
  }
  CHECK(write_model(model, "x.ply").warnings.empty());
  CHECK(write_model(model, "x.obj").warnings.size() == 2); // heat, label
  CHECK(write_model(model, "x.off").warnings.size() == 4);
  CHECK(write_model(model, "x.stl").warnings.size() == 5);
}

TEST_CASE("OBJ: the textures of material libraries are files of the model")
{
  const Temporary_file library("scan.mtl", "newmtl a\nmap_Kd -s 2 2 old oak.png\nbump pictures/bump.png\n");
  const Model model = model_of("scan.obj", "mtllib scan.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
  CHECK(model.files == std::vector<std::string>{ "scan.obj", "scan.mtl", "old oak.png", "pictures/bump.png" });
}

TEST_CASE("PLY: names of textures are relative to the folder of the file, also for models of other formats")
{
  std::string text = square;
  text.insert(text.find("obj_info"), "comment TextureFile pictures/old oak.png\n");
  Model model = model_of("square.ply", text);
  CHECK(model.files == std::vector<std::string>{ "square.ply", "pictures/old oak.png" });
  CHECK(text_of(model, "square.ply") == text);
  const std::string moved = "comment TextureFile ../pictures/old oak.png\n";
  CHECK(text_of(model, "folder/square.ply").find(moved) != std::string::npos);
  model.encoding.clear();
  CHECK(text_of(model, "folder/square.ply").find(moved) != std::string::npos);
}

} // namespace test_files
