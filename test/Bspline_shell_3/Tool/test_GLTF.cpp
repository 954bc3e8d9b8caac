#include "temporary_files.h"

#include <Files/read_model.h>
#include <Files/write_model.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace test_GLTF {

using namespace Tool;

template <typename T>
std::string bytes(const std::vector<T>& values)
{
  return std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

void pad(std::string& text, char c)
{
  while(text.size() % 4 != 0) text += c;
}

// Puts a file together by hand, so that it does not depend on the library of the program.
struct File
{
  std::string accessors, views, data;
  int number = 0;

  int view(const std::string& content, const std::string& more = "")
  {
    pad(data, '\0');
    views += (views.empty() ? "" : ",") + ("{\"buffer\":0,\"byteOffset\":" + std::to_string(data.size()))
             + ",\"byteLength\":" + std::to_string(content.size()) + more + "}";
    data += content;
    return int(std::count(views.begin(), views.end(), '{')) - 1;
  }
  int accessor(const std::string& members)
  {
    accessors += (accessors.empty() ? "{" : ",{") + members + "}";
    return number++;
  }
  // Appends an accessor of tightly packed values of a type, as the specification numbers types.
  template <typename T>
  int add(const std::vector<T>& values, int component_type, const std::string& type, std::size_t dimension,
          const std::string& more = "")
  {
    return accessor("\"bufferView\":" + std::to_string(view(bytes(values)))
                    + ",\"componentType\":" + std::to_string(component_type)
                    + ",\"count\":" + std::to_string(values.size() / dimension) + ",\"type\":\"" + type + "\"" + more);
  }
  int vectors(const std::vector<float>& values) { return add(values, 5126, "VEC3", 3); }
  int pairs(const std::vector<float>& values) { return add(values, 5126, "VEC2", 2); }
  int indices(const std::vector<std::uint16_t>& values) { return add(values, 5123, "SCALAR", 1); }

  std::string json(const std::string& rest, const std::string& uri = "") const
  {
    return "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":" + std::to_string(data.size())
           + (uri.empty() ? "" : ",\"uri\":\"" + uri + "\"") + "}],\"bufferViews\":[" + views + "],\"accessors\":["
           + accessors + "]," + rest + "}";
  }
  std::string binary(const std::string& rest) const
  {
    std::string head = json(rest), tail = data;
    pad(head, ' ');
    pad(tail, '\0');
    const auto length = std::uint32_t(28 + head.size() + tail.size());
    return "glTF" + bytes<std::uint32_t>({ 2, length, std::uint32_t(head.size()) }) + "JSON" + head
           + bytes<std::uint32_t>({ std::uint32_t(tail.size()) }) + std::string("BIN\0", 4) + tail;
  }
};

const std::string scene = "\"scenes\":[{\"nodes\":[0]}]", node = scene + ",\"nodes\":[{\"mesh\":0}]";

std::string mesh(const std::string& primitives)
{
  return ",\"meshes\":[{\"primitives\":[" + primitives + "]}]";
}

File_report report_of(const std::string& text, Model& model, const std::string& name = "test.glb")
{
  const Temporary_file file(name, text);
  return read_model(name, model);
}

Model model_of(const std::string& text, const std::string& name = "test.glb")
{
  Model model;
  const File_report report = report_of(text, model, name);
  INFO((report.warnings.empty() ? std::string() : report.warnings[0]));
  REQUIRE(report);
  return model;
}

std::string text_of(const Model& model, const std::string& name)
{
  return write_model(model, name).files[0].second;
}

const std::string picture("\x89PNG\r\n\x1a\n\0 a picture with any bytes \xff", 37);

// Two triangles of a square. The edge between them is a seam of the texture, and has two normals.
std::string square()
{
  File file;
  const std::string attributes =
    "\"attributes\":{\"POSITION\":"
    + std::to_string(file.vectors({ 0, 0, 0, 1, 0, 0, 1, 1, 0.1f, 0, 0, 0, 1, 1, 0.1f, 0, 1, 0 })) + ",\"NORMAL\":"
    + std::to_string(file.vectors({ 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0.6f, 0.8f, 0, 0.6f, 0.8f, 0, 0.6f, 0.8f }))
    + ",\"TEXCOORD_0\":" + std::to_string(file.pairs({ 0, 1, 0.3f, 1, 0.3f, 0.7f, 0.5f, 0, 0.7f, 0.2f, 0.5f, 0.2f }))
    + ",\"COLOR_0\":"
    + std::to_string(file.add<std::uint8_t>({ 1, 2, 3, 255, 4, 5, 6, 255, 7,  8,  9,  250, //
                                              1, 2, 3, 255, 7, 8, 9, 250, 10, 11, 12, 255 },
                                            5121, "VEC4", 4, ",\"normalized\":true"))
    + ",\"_TEMPERATURE\":" + std::to_string(file.add<float>({ 1.5f, 2, 3, 1.5f, 3, 1e-20f }, 5126, "SCALAR", 1))
    + ",\"_LABEL\":" + std::to_string(file.add<std::uint16_t>({ 1, 2, 30000, 1, 30000, 4 }, 5123, "SCALAR", 1)) + "}";
  const std::string first = std::to_string(file.indices({ 0, 1, 2 })),
                    second = std::to_string(file.indices({ 3, 4, 5 }));
  const std::string image = std::to_string(file.view(picture));
  return file.binary(
    "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,\"name\":\"wall\"}]"
    + mesh("{" + attributes + ",\"indices\":" + first + ",\"material\":1},{" + attributes + ",\"indices\":" + second
           + "}")
    + ",\"extensionsUsed\":[\"KHR_materials_unlit\"],\"materials\":[{\"name\":\"paint\"},{\"name\":\"paint\","
      "\"extensions\":{\"KHR_materials_unlit\":{}},\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0.25,1,0.5],"
      "\"baseColorTexture\":{\"index\":0}},\"alphaMode\":\"BLEND\"}],\"textures\":[{\"source\":0,\"sampler\":0}],"
      "\"samplers\":[{\"magFilter\":9728}],\"images\":[{\"bufferView\":"
    + image + ",\"mimeType\":\"image/png\"},{\"uri\":\"old%20oak.png\"}]");
}

TEST_CASE("GLTF: split vertices are one point, and different values belong to corners")
{
  const Model model = model_of(square());
  CHECK(model.soup.points.size() == 4);
  CHECK(model.soup.polygons == Model::Polygons{ { 0, 1, 2 }, { 0, 2, 3 } });
  CHECK(model.soup.points[2].z() == 0.1f);
  CHECK(model.coordinates == Number_type::FLOAT32);
  const Attribute &color = *model.find(color_name, Element::POINT),
                  &texture = *model.find(texture_name, Element::CORNER),
                  &normal = *model.find(normal_name, Element::CORNER),
                  &temperature = *model.find("TEMPERATURE", Element::POINT),
                  &label = *model.find("LABEL", Element::POINT),
                  &material = *model.find(material_name, Element::POLYGON),
                  &object = *model.find(object_name, Element::POLYGON);
  CHECK(color.type == Number_type::UINT8);
  CHECK(color.kind == Kind::COLOR);
  CHECK(color[2][3] == 250);
  CHECK(texture[1][0] == 0.3f);
  CHECK(texture[1][1] == 0); // at the bottom of the image
  CHECK(texture[3][1] == 1);
  CHECK(normal.kind == Kind::NORMAL);
  CHECK(normal[4][1] == 0.6f);
  CHECK(temperature[3][0] == 1e-20f);
  CHECK(temperature.kind == Kind::REAL);
  CHECK(label.kind == Kind::LABEL);
  CHECK(label.type == Number_type::UINT16);
  CHECK(label[2][0] == 30000);
  CHECK(material.values == std::vector<double>{ 2, 0 });
  CHECK(std::set<std::string>(material.names.begin(), material.names.end()).size() == 3);
  CHECK(object.names[std::size_t(object[1][0])] == "wall");
}

TEST_CASE("GLTF: a file that is read and written has the same values, materials, and images")
{
  const Model model = model_of(square());
  for(const char* name : { "again.glb", "again.gltf" }) {
    INFO(name);
    const Written_files written = write_model(model, name);
    CHECK(written.files.size() == 1);
    CHECK(written.warnings.empty());
    CHECK(written.attributes.size() == model.attributes.size());
    const std::string& text = written.files[0].second;
    CHECK((text.substr(0, 4) == "glTF") == (std::string(name) == "again.glb"));
    CHECK(text.find("KHR_materials_unlit") != std::string::npos);
    CHECK(text.find("old%20oak.png") != std::string::npos);
    CHECK(text.find("9728") != std::string::npos);
    if(std::string(name) == "again.glb") CHECK(text.find(picture) != std::string::npos);
    const Model again = model_of(text, name);
    CHECK(text_of(again, name) == text);
    REQUIRE(again.attributes.size() == model.attributes.size());
    // The primitive without material comes first.
    CHECK(again.soup.polygons.size() == 2);
    const Attribute &before = *model.find(texture_name, Element::CORNER),
                    &after = *again.find(texture_name, Element::CORNER);
    const Attribute &material = *model.find(material_name, Element::POLYGON),
                    &material_again = *again.find(material_name, Element::POLYGON);
    CHECK(material_again.names == material.names);
    for(std::size_t n = 0; n < 2; ++n) {
      const std::size_t m = material_again[0][0] == material[n][0] ? 0 : 1;
      CHECK(material_again[m][0] == material[n][0]);
      for(std::size_t i = 0; i < 3; ++i) {
        CHECK(again.soup.points[again.soup.polygons[m][i]] == model.soup.points[model.soup.polygons[n][i]]);
        for(std::size_t k = 0; k < 2; ++k) CHECK(after[3 * m + i][k] == before[3 * n + i][k]);
        for(const char* attribute : { "TEMPERATURE", "LABEL" })
          CHECK((*again.find(attribute, Element::POINT))[again.soup.polygons[m][i]][0]
                == (*model.find(attribute, Element::POINT))[model.soup.polygons[n][i]][0]);
      }
    }
  }
}

TEST_CASE("GLTF: buffers and images may be files, whose names are encoded")
{
  File file;
  const std::string positions = std::to_string(file.vectors({ 0, 0, 0, 1, 0, 0, 0, 1, 0 }));
  const std::string rest = node + mesh("{\"attributes\":{\"POSITION\":" + positions + "},\"material\":0}")
                           + ",\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],"
                             "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"old%20oak.png\"}]";
  const std::string text = file.json(rest, "my%20buffer.bin");
  Model model;
  const File_report missing = report_of(text, model, "test.gltf");
  CHECK(missing.status == File_status::MALFORMED);
  REQUIRE(!missing.warnings.empty());
  CHECK(missing.warnings[0].find("my buffer.bin") != std::string::npos);

  const Temporary_file buffer("my buffer.bin", file.data);
  const File_report found = report_of(text, model, "test.gltf");
  REQUIRE(found);
  CHECK(model.files == std::vector<std::string>{ "test.gltf", "my buffer.bin", "old oak.png" });
  REQUIRE(found.warnings.size() == 1); // The image is missing.
  CHECK(found.warnings[0].find("old oak.png") != std::string::npos);
  CHECK(text_of(model, "folder/out.gltf").find("\"../old%20oak.png\"") != std::string::npos);
}

TEST_CASE("GLTF: nodes move points and normals, and reflections keep the side of triangles")
{
  File file;
  const float half = float(std::sqrt(0.5)); // sine and cosine of 45 degrees
  const std::string primitive = "{\"attributes\":{\"POSITION\":"
                                + std::to_string(file.vectors({ 0, 0, 0, 1, 0, 0, 0, 1, 1 })) + ",\"NORMAL\":"
                                + std::to_string(file.vectors({ 0, -half, half, 0, -half, half, 0, -half, half }))
                                + "}}";
  const auto with_nodes = [&](const std::string& nodes) {
    return model_of(file.binary(scene + ",\"nodes\":[" + nodes + "]" + mesh(primitive)));
  };
  // A child is scaled, turned by 90 degrees about z, and moved; its parent moves it again.
  const Model moved = with_nodes("{\"children\":[1],\"translation\":[0,0,100]},{\"mesh\":0,\"translation\":[10,0,0],"
                                 "\"rotation\":[0,0,"
                                 + std::to_string(half) + "," + std::to_string(half) + "],\"scale\":[2,1,1]}");
  const auto distance = [](const auto& p, double x, double y, double z) {
    return std::abs(p.x() - x) + std::abs(p.y() - y) + std::abs(p.z() - z);
  };
  CHECK(distance(moved.soup.points[1], 10, 2, 100) < 1e-5);
  CHECK(distance(moved.soup.points[2], 9, 0, 101) < 1e-5);

  // The matrix maps (x, y, z) to (-x, y, 3 z + 5); its columns follow each other.
  const Model reflected = with_nodes("{\"mesh\":0,\"matrix\":[-1,0,0,0,0,1,0,0,0,0,3,0,0,0,5,1]}");
  CHECK(distance(reflected.soup.points[reflected.soup.polygons[0][0]], 0, 0, 5) == 0);
  const auto& t = reflected.soup.polygons[0];
  const auto& p = reflected.soup.points;
  const auto normal_of_triangle = CGAL::cross_product(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
  const Attribute& normal = *reflected.find(Kind::NORMAL, Element::POINT);
  const double length = std::sqrt(normal_of_triangle.squared_length());
  for(int i = 0; i < 3; ++i) CHECK(std::abs(normal[0][i] - normal_of_triangle[i] / length) < 1e-6);

  for(const std::string& damaged :
      { std::string("{\"mesh\":0,\"children\":[0]}"), std::string("{\"mesh\":7}"), std::string("{\"children\":[3]}"),
        std::string("{\"mesh\":0,\"matrix\":[1,2]}"), std::string("{\"mesh\":0,\"rotation\":[1,2]}") }) {
    INFO(damaged);
    Model model;
    CHECK(report_of(file.binary(scene + ",\"nodes\":[" + damaged + "]" + mesh(primitive)), model).status
          == File_status::MALFORMED);
  }
}

TEST_CASE("GLTF: strips and fans become triangles with the same orientation")
{
  File file;
  const std::string points = std::to_string(file.vectors({ 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0 }));
  const auto polygons = [&](const std::string& rest) {
    return model_of(file.binary(node + mesh("{\"attributes\":{\"POSITION\":" + points + "}" + rest + "}"))).soup;
  };
  const auto area = [](const BS::Polygon_soup& soup) {
    double sum = 0;
    for(const auto& t : soup.polygons)
      sum += CGAL::cross_product(soup.points[t[1]] - soup.points[t[0]], soup.points[t[2]] - soup.points[t[0]]).z() / 2;
    return sum;
  };
  const auto strip = polygons(",\"mode\":5");
  CHECK(strip.polygons.size() == 3);
  CHECK(area(strip) == 1.5);
  const std::string fan = ",\"mode\":6,\"indices\":" + std::to_string(file.indices({ 0, 1, 3, 4, 2 }));
  CHECK(polygons(fan).polygons.size() == 3);
  CHECK(area(polygons(fan)) == 1.5);
  const std::string joined = ",\"mode\":5,\"indices\":" + std::to_string(file.indices({ 0, 1, 2, 2, 3, 3, 2, 4 }));
  CHECK(polygons(joined).polygons.size() == 2);
  CHECK(area(polygons(joined)) == 1);
}

TEST_CASE("GLTF: sparse, interleaved, and normalized values")
{
  File file;
  const std::string indices = std::to_string(file.view(bytes<std::uint16_t>({ 1, 2 }))),
                    values = std::to_string(file.view(bytes<float>({ 1, 0, 0, 0, 1, 0 })));
  const std::string sparse = std::to_string(
    file.accessor("\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"sparse\":{\"count\":2,"
                  "\"indices\":{\"bufferView\":"
                  + indices + ",\"componentType\":5123},\"values\":{\"bufferView\":" + values + "}}"));
  const std::string both = std::to_string(
    file.view(bytes<std::int8_t>({ 127, 0, 0, 0, -127, 64, 0, 0, -128, 127, 0, 0 }), ",\"byteStride\":4"));
  const std::string weights = std::to_string(file.accessor(
    "\"bufferView\":" + both + ",\"componentType\":5120,\"normalized\":true,\"count\":3,\"type\":\"VEC2\""));
  const std::string numbers = std::to_string(file.accessor(
    "\"bufferView\":" + both + ",\"byteOffset\":1,\"componentType\":5120,\"count\":3,\"type\":\"SCALAR\""));
  const Model model = model_of(file.binary(
    node
    + mesh("{\"attributes\":{\"POSITION\":" + sparse + ",\"_PAIR\":" + weights + ",\"_NUMBER\":" + numbers + "}}")));
  CHECK(model.soup.points == Model::Points{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } });
  const Attribute &pair = *model.find("PAIR", Element::POINT), &number = *model.find("NUMBER", Element::POINT);
  CHECK(pair.values == std::vector<double>{ 1, 0, -1, 64 / 127., -1, 1 });
  CHECK(pair.type == Number_type::FLOAT32);
  CHECK(number.values == std::vector<double>{ 0, 64, 127 });
  CHECK(number.kind == Kind::LABEL);
}

TEST_CASE("GLTF: primitives may have different attributes")
{
  File file;
  const std::string points = std::to_string(file.vectors({ 0, 0, 0, 1, 0, 0, 0, 1, 0 })),
                    others = std::to_string(file.vectors({ 0, 0, 5, 1, 0, 5, 0, 1, 5 })),
                    opaque = std::to_string(file.vectors({ 1, 0, 0, 0, 1, 0, 0, 0, 1 })),
                    clear = std::to_string(file.add<std::uint8_t>({ 255, 0, 51, 0, 255, 0, 51, 0, 255, 0, 51, 0 }, 5121,
                                                                  "VEC4", 4, ",\"normalized\":true"));
  const Model model = model_of(file.binary(
    node
    + mesh("{\"attributes\":{\"POSITION\":" + points + ",\"COLOR_0\":" + opaque + "}},{\"attributes\":{\"POSITION\":"
           + others + ",\"COLOR_0\":" + clear + "}},{\"attributes\":{\"POSITION\":" + others + "},\"mode\":5}")));
  const Attribute& color = *model.find(color_name, Element::CORNER);
  CHECK(color.dimension() == 4);
  CHECK(color.type == Number_type::FLOAT32);
  CHECK(color[0][3] == 1);
  CHECK(color[3][2] == 0.2);
  CHECK(color[3][3] == 0);
  CHECK(std::isnan(color[6][0]));
  const Model again = model_of(text_of(model, "again.glb"));
  const Attribute& color_again = *again.find(color_name, Element::CORNER);
  const auto known = [](const Attribute& a) {
    return std::count_if(a.values.begin(), a.values.end(), [](double x) { return !std::isnan(x); });
  };
  CHECK(known(color_again) == known(color));
}

TEST_CASE("GLTF: warnings name the omitted data")
{
  File file;
  const std::string points = std::to_string(file.vectors({ 0, 0, 0, 1, 0, 0, 0, 1, 0 })),
                    tangents = std::to_string(file.add<float>({ 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1 }, 5126, "VEC4", 4));
  Model model;
  const File_report report = report_of(
    file.binary(node
                + mesh("{\"attributes\":{\"POSITION\":" + points + ",\"TANGENT\":" + tangents
                       + "},\"targets\":[{\"POSITION\":" + points + "}]},{\"attributes\":{\"POSITION\":" + points
                       + "},\"mode\":0}")
                + ",\"skins\":[{\"joints\":[0]}],\"animations\":[{\"channels\":[],\"samplers\":[]}],"
                  "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":1}}]"),
    model);
  REQUIRE(report);
  const auto said = [&](const std::string& words) {
    return std::any_of(report.warnings.begin(), report.warnings.end(),
                       [&](const std::string& warning) { return warning.find(words) != std::string::npos; });
  };
  for(const char* words : { "TANGENT", "Morph targets", "points or lines", "Skins", "Animations", "Cameras" }) {
    INFO(words);
    CHECK(said(words));
  }
  CHECK(model.soup.polygons.size() == 1);
}

TEST_CASE("GLTF: extensions that are required and not supported are named")
{
  File file;
  const std::string points = std::to_string(file.vectors({ 0, 0, 0, 1, 0, 0, 0, 1, 0 }));
  const std::string rest = node + mesh("{\"attributes\":{\"POSITION\":" + points + "}}") + ",\"extensionsRequired\":";
  Model model;
  const File_report report = report_of(file.binary(rest + "[\"KHR_draco_mesh_compression\"]"), model);
  CHECK(report.status == File_status::UNSUPPORTED_EXTENSION);
  REQUIRE(report.warnings.size() == 1);
  CHECK(report.warnings[0].find("KHR_draco_mesh_compression") != std::string::npos);
  CHECK(report_of(file.binary(rest + "[\"KHR_mesh_quantization\",\"KHR_texture_transform\"]"), model));
}

TEST_CASE("GLTF: damaged files are malformed")
{
  const auto status = [](const File& file, const std::string& rest) {
    Model model;
    return report_of(file.binary(rest), model).status;
  };
  const auto with_accessor = [&](const std::string& members) {
    File file;
    file.vectors({ 0, 0, 0, 1, 0, 0, 0, 1, 0 });
    const std::string accessor = std::to_string(file.accessor(members));
    return status(file, node + mesh("{\"attributes\":{\"POSITION\":" + accessor + "}}"));
  };
  const std::string vectors = "\"componentType\":5126,\"type\":\"VEC3\",";
  REQUIRE(with_accessor(vectors + "\"bufferView\":0,\"count\":3") == File_status::SUCCESS);
  for(const std::string members :
      { "\"bufferView\":0,\"count\":4", "\"bufferView\":0,\"count\":3,\"byteOffset\":4", "\"bufferView\":9,\"count\":3",
        "\"bufferView\":0,\"count\":4611686018427387904", "\"count\":1000000000000",
        "\"bufferView\":0,\"count\":3,\"byteOffset\":18446744073709551615",
        "\"count\":3,\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":0,\"componentType\":5125},"
        "\"values\":{\"bufferView\":7}}",
        "\"count\":3,\"sparse\":{\"count\":-1,\"indices\":{\"bufferView\":0,\"componentType\":5125},"
        "\"values\":{\"bufferView\":0}}" }) {
    INFO(members);
    CHECK(with_accessor(vectors + members) == File_status::MALFORMED);
  }
  CHECK(with_accessor("\"componentType\":5126,\"type\":\"VEC2\",\"bufferView\":0,\"count\":3")
        == File_status::MALFORMED);

  File file;
  const std::string points = std::to_string(file.vectors({ 0, 0, 0, 1, 0, 0, 0, 1, 0 }));
  const std::string primitive = "{\"attributes\":{\"POSITION\":" + points + "}";
  const std::string beyond = std::to_string(file.indices({ 0, 1, 3 }));
  CHECK(status(file, node + mesh(primitive + ",\"indices\":" + beyond + "}")) == File_status::MALFORMED);
  CHECK(status(file, node + mesh(primitive + ",\"material\":0}")) == File_status::MALFORMED);
  CHECK(status(file, node + ",\"scene\":1" + mesh(primitive + "}")) == File_status::MALFORMED);
  const std::string image = ",\"images\":[{\"bufferView\":" + std::to_string(file.view(picture)) + "}]";
  const std::string whole = node + mesh(primitive + "}") + image;
  CHECK(status(file, whole) == File_status::SUCCESS);
  file.views.replace(file.views.rfind("\"byteLength\":") + 13, 2, "99");
  CHECK(status(file, whole) == File_status::MALFORMED);

  const std::string text = square();
  for(std::size_t size : { std::size_t(3), std::size_t(19), std::size_t(200), text.size() - 4 }) {
    INFO(size);
    Model model;
    CHECK(report_of(text.substr(0, size), model).status == File_status::MALFORMED);
  }
  Model model;
  CHECK(report_of("{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":0}]}", model, "test.gltf").status
        == File_status::MALFORMED);
}

TEST_CASE("GLTF: a file with any byte damaged is refused, or can be written again")
{
  const std::string text = square();
  for(std::size_t n = 0; n < text.size(); ++n) {
    std::string damaged = text;
    damaged[n] = char(damaged[n] ^ (1 << n % 8));
    Model model;
    if(!report_of(damaged, model)) continue;
    for(const char* name : { "damaged.obj", "damaged.glb" }) CHECK(!write_model(model, name).files.empty());
  }
}

TEST_CASE("GLTF: materials of OBJ files and back")
{
  const Temporary_file library("part.mtl", "newmtl red paint\nKd 1 0.5 0.25\nmap_Kd -s 2 2 pictures/old oak.png\n"
                                           "newmtl glass\nd 0.5\nNs 10\n");
  const std::string obj = "mtllib part.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 0.25\n"
                          "o wall\nusemtl red paint\nf 1/1 2/2 3/3\nusemtl glass\nf 1 3 4\n";
  const Model model = model_of(obj, "part.obj");
  const Written_files written = write_model(model, "folder/part.gltf");
  REQUIRE(written.warnings.size() == 1);
  CHECK(written.warnings[0].find("A glTF file") == 0);
  CHECK(written.files[0].second.find("\"../pictures/old%20oak.png\"") != std::string::npos);
  const Model gltf = model_of(text_of(model, "part.glb"), "part.glb");
  const Attribute& material = *gltf.find(material_name, Element::POLYGON);
  const std::size_t red = material.names[std::size_t(material[0][0])] == "red paint" ? 0 : 1;
  CHECK(material.names[std::size_t(material[1 - red][0])] == "glass");
  const Attribute& texture = *gltf.find(texture_name, Element::CORNER);
  CHECK(texture[3 * red + 2][1] == 0.25);
  CHECK(std::isnan(texture[3 * (1 - red)][0]));

  const Written_files back = write_model(gltf, "back.obj");
  REQUIRE(back.files.size() == 2);
  CHECK(back.files[1].first == "back.mtl");
  CHECK(back.files[1].second
        == "newmtl red paint\nKd 1 0.5 0.25\nmap_Kd pictures/old oak.png\nnewmtl glass\nKd 1 1 1\nd 0.5\n");
  CHECK(back.files[0].second.find("vt 2 0.5\n") != std::string::npos); // scaled by the option -s
  CHECK(back.files[0].second.find("usemtl red paint\n") != std::string::npos);
  CHECK(back.files[0].second.find("o wall\n") != std::string::npos);

  // Materials without a library keep their names.
  const Model ply = model_of(text_of(gltf, "part.ply"), "part.ply");
  const Model named = model_of(text_of(ply, "part.glb"), "part.glb");
  const Attribute& names = *named.find(material_name, Element::POLYGON);
  for(const char* name : { "red paint", "glass" }) CHECK(std::count(names.names.begin(), names.names.end(), name) == 1);
}

TEST_CASE("GLTF: images in the file are written beside an OBJ file")
{
  const Model model = model_of(square());
  const Written_files written = write_model(model, "wall.obj");
  REQUIRE(written.files.size() == 3);
  CHECK(written.files[1].first == "wall_image0.png");
  CHECK(written.files[1].second == picture);
  CHECK(written.files[2].second.find("Kd 0.735357 0.537099 1\nd 0.5\nmap_Kd wall_image0.png\n") != std::string::npos);
  const Temporary_file other("wall_image0.png", "a picture of another model");
  CHECK(write_model(model, "wall.obj").files[1].first == "wall_1_image0.png");
}

TEST_CASE("GLTF: coordinates with more digits are rounded relative to the center")
{
  Model model;
  for(int n = 0; n < 4; ++n) model.soup.points.emplace_back(4e6 + 0.1 * (n & 1), 5e6 + 0.1 * (n & 2), 0.1);
  model.soup.polygons = { { 0, 1, 3, 2 } };
  const Written_files written = write_model(model, "far.glb");
  CHECK(written.warnings.size() == 1);
  const Model again = model_of(written.files[0].second);
  CHECK(again.soup.polygons.size() == 2);
  for(const auto& p : again.soup.points) {
    double nearest = 1;
    for(const auto& q : model.soup.points) nearest = (std::min)(nearest, CGAL::squared_distance(p, q));
    CHECK(std::sqrt(nearest) < 1e-7);
  }
  CHECK(has_single_precision("far.glb"));
  CHECK(!has_single_precision("far.ply"));
}

TEST_CASE("GLTF: warnings name the attributes that the format cannot hold")
{
  Model model = model_of(square());
  model.attributes.push_back(
    { "quality", Element::POLYGON, Kind::REAL, Number_type::FLOAT64, { "quality" }, { 1, 2 }, {} });
  model.attributes.push_back(
    { "number", Element::POINT, Kind::LABEL, Number_type::INT32, { "number" }, { 1, 2, 3, 16777217 }, {} });
  model.attributes.push_back(
    { "level", Element::POINT, Kind::LABEL, Number_type::INT32, { "level" }, { -1, 2, 3, 4 }, {} });
  const Written_files written = write_model(model, "again.glb");
  REQUIRE(written.warnings.size() == 2);
  CHECK(written.warnings[0].find("\"number\"") != std::string::npos);
  CHECK(written.warnings[1].find("\"quality\"") != std::string::npos);
  const Model again = model_of(written.files[0].second);
  CHECK(again.find("level", Element::POINT)->type == Number_type::INT8);
}

TEST_CASE("GLTF: sets of texture coordinates and colors keep their numbers, in any order of the attributes")
{
  Model model;
  model.soup.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  model.soup.polygons = { { 0, 1, 2 } };
  const auto add = [&](const char* name, Kind kind, std::vector<std::string> components, double value) {
    const std::vector<double> values(3 * components.size(), value);
    model.attributes.push_back({ name, Element::POINT, kind, Number_type::FLOAT32, std::move(components), values, {} });
  };
  add("texture_1", Kind::REAL, { "u", "v" }, 0.25);
  add("color_1", Kind::COLOR, { "red", "green", "blue" }, 0.25);
  add("texture", Kind::REAL, { "u", "v" }, 0.75);
  add("color", Kind::COLOR, { "red", "green", "blue" }, 0.75);
  const Model again = model_of(text_of(model, "again.glb"));
  for(const char* name : { "texture", "color" }) {
    CHECK((*again.find(name, Element::POINT))[0][0] == 0.75);
    CHECK((*again.find(name + std::string("_1"), Element::POINT))[0][0] == 0.25);
  }
}

TEST_CASE("GLTF: coordinates that are not finite are named")
{
  const float infinity = std::numeric_limits<float>::infinity();
  for(float x : { std::numeric_limits<float>::quiet_NaN(), infinity, -infinity }) {
    File file;
    const std::string points = std::to_string(
      file.vectors({ 0, 0, 0, 1, 0, 0, 0, 1, 0, x, 0, 0, x, 1, 0, 0, x, 0, 0, 0, 1, 1, 1, x, 2, 2, 2 }));
    Model model;
    const File_report report = report_of(file.binary(node + mesh("{\"attributes\":{\"POSITION\":" + points + "}}")),
                                         model);
    CHECK(report.status == File_status::NOT_FINITE);
    REQUIRE(report.warnings.size() == 1);
    CHECK(report.warnings[0] == "The primitive 0 of mesh 0 is not finite.");
  }
}

TEST_CASE("GLTF: names that are not UTF-8 are written as if they were Latin-1")
{
  Model model;
  model.soup.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  model.soup.polygons = { { 0, 1, 2 } };
  const std::string latin = "gr\xFC"
                            "n",
                    utf8 = "gr\xC3\xBC"
                           "n";
  for(const char* name : { material_name, object_name })
    model.attributes.push_back(
      { name, Element::POLYGON, Kind::LABEL, Number_type::INT32, { name }, { 1 }, { "", latin } });
  model.attributes.push_back({ latin, Element::POINT, Kind::REAL, Number_type::FLOAT32, { latin }, { 1, 2, 3 }, {} });
  const Model again = model_of(text_of(model, "again.glb"));
  CHECK(again.find(material_name, Element::POLYGON)->text(0) == utf8);
  CHECK(again.find(object_name, Element::POLYGON)->text(0) == utf8);
  CHECK(again.find(utf8, Element::POINT) != nullptr);
  model.materials = "newmtl " + latin + "\nKd 1 0 0\n";
  CHECK(model_of(text_of(model, "again.glb")).find(material_name, Element::POLYGON)->text(0) == utf8);
}

TEST_CASE("GLTF: polygons that are not convex keep their area, and those with two corners are left out")
{
  Model model;
  model.soup.points = { { 0, 0, 0 }, { 4, 0, 0 }, { 4, 4, 0 }, { 3, 1, 0 } };
  model.soup.polygons = { { 0, 1, 2, 3 }, { 0, 1 }, {} };
  model.attributes.push_back({ object_name,
                               Element::POLYGON,
                               Kind::LABEL,
                               Number_type::INT32,
                               { object_name },
                               { 1, 2, 0 },
                               { "", "polygon", "edge" } });
  for(const char* name : { "polygon.glb", "polygon.stl" }) {
    const Model again = model_of(text_of(model, name), name);
    REQUIRE(again.soup.polygons.size() == 2);
    const auto& p = again.soup.points;
    double area = 0;
    for(const auto& t : again.soup.polygons) {
      const double part = CGAL::cross_product(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]).z() / 2;
      CHECK(part > 0);
      area += part;
    }
    CHECK(area == 4);
  }
}

// A triangle with two sets of texture coordinates and a material.
Model textured(const std::string& material, const std::string& more = "")
{
  File file;
  const std::string attributes = "\"POSITION\":" + std::to_string(file.vectors({ 0, 0, 0, 1, 0, 0, 0, 1, 0 }))
                                 + ",\"TEXCOORD_0\":" + std::to_string(file.pairs({ 0, 1, 0.5f, 1, 0, 0.5f }))
                                 + ",\"TEXCOORD_1\":" + std::to_string(file.pairs({ 0, 0, 0, 0.25f, 0.75f, 0 }));
  return model_of(file.binary(node + mesh("{\"attributes\":{" + attributes + "},\"material\":0}") + ",\"materials\":[{"
                              + material + "}]" + more));
}
const std::string image_of_file = ",\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"oak.png\"}]";

// Returns the texture coordinates in the file, by corner.
std::vector<std::array<double, 2> > texture_in_OBJ(const Model& model)
{
  const Model again = model_of(text_of(model, "again.obj"), "again.obj");
  const Attribute& texture = *again.find(texture_name, Element::CORNER);
  std::vector<std::array<double, 2> > values;
  for(std::size_t n = 0; n < 3; ++n) values.push_back({ texture[n][0], texture[n][1] });
  return values;
}

TEST_CASE("GLTF: an OBJ file has the texture coordinates that the material selects and transforms")
{
  const auto with_texture = [](const std::string& more) {
    return texture_in_OBJ(
      textured("\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0" + more + "}}", image_of_file));
  };
  typedef std::vector<std::array<double, 2> > List;
  CHECK(with_texture("") == List{ { 0, 0 }, { 0.5, 0 }, { 0, 0.5 } });
  CHECK(with_texture(",\"texCoord\":1") == List{ { 0, 1 }, { 0, 0.75 }, { 0.75, 1 } });
  const auto transformed = [&](const std::string& members) {
    return with_texture(",\"extensions\":{\"KHR_texture_transform\":{" + members + "}}");
  };
  CHECK(transformed("\"texCoord\":1") == List{ { 0, 1 }, { 0, 0.75 }, { 0.75, 1 } });
  // In the file, the corners are at (0, 1), (0.5, 1), and (0, 0.5), counted from the top.
  CHECK(transformed("\"offset\":[0.25,0.125]") == List{ { 0.25, -0.125 }, { 0.75, -0.125 }, { 0.25, 0.375 } });
  CHECK(transformed("\"scale\":[2,0.5]") == List{ { 0, 0.5 }, { 1, 0.5 }, { 0, 0.75 } });
  // A quarter turn moves the point (u, v), counted from the top, to (v, -u).
  const List turned = transformed("\"rotation\":1.5707963267948966");
  const List expected = { { 1, 1 }, { 1, 1.5 }, { 0.5, 1 } };
  for(std::size_t n = 0; n < 3; ++n)
    for(std::size_t i = 0; i < 2; ++i) CHECK(std::abs(turned[n][i] - expected[n][i]) < 1e-12);
}

TEST_CASE("GLTF: opacities and images in OBJ files")
{
  const auto library = [](const Model& model) { return write_model(model, "again.obj").files.back().second; };
  const std::string clear = "\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,1,0.5]}";
  CHECK(library(textured(clear)).find("\nd ") == std::string::npos); // Materials are opaque unless they have a mode.
  CHECK(library(textured(clear + ",\"alphaMode\":\"BLEND\"")).find("\nd 0.5\n") != std::string::npos);

  const std::string texture = "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}",
                    in_extension =
                      ",\"textures\":[{\"extensions\":{\"EXT_texture_webp\":{\"source\":0}}}],\"images\":[{";
  const Model webp = textured(texture, in_extension + "\"bufferView\":0,\"mimeType\":\"image/webp\"}]");
  const Written_files written = write_model(webp, "again.obj");
  REQUIRE(written.files.size() == 3);
  CHECK(written.files[1].first == "again_image0.webp");
  CHECK(!written.files[1].second.empty());
  CHECK(std::count_if(written.warnings.begin(), written.warnings.end(),
                      [](const std::string& warning) { return warning.find("again_image0.webp") != std::string::npos; })
        == 1);
}

TEST_CASE("GLTF: colors of materials are intensities of light, and those of OBJ files are not")
{
  const Temporary_file library("half.mtl", "newmtl half\nKd 0.5 0.04 1\n");
  const Model model = model_of("mtllib half.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl half\nf 1 2 3\n", "half.obj");
  const Model again = model_of(text_of(model, "half.glb"), "half.glb");
  // An image of light and dark points in equal parts is half as bright as a white one; its color is 0.735.
  CHECK(text_of(model, "half.gltf").find("0.2140") != std::string::npos);
  CHECK(write_model(model, "half.gltf").warnings.empty()); // The library has no other properties.
  CHECK(write_model(again, "half.obj").files.back().second == "newmtl half\nKd 0.5 0.04 1\n");
}

TEST_CASE("GLTF: files may have no scene, and instances are named")
{
  File file;
  const std::string points = std::to_string(file.vectors({ 0, 0, 0, 1, 0, 0, 0, 1, 0 }));
  const std::string triangle = mesh("{\"attributes\":{\"POSITION\":" + points + "}}");
  const Model model = model_of(file.binary(
    "\"nodes\":[{\"mesh\":0,\"translation\":[1,0,0]},{\"children\":[0],\"translation\":[2,0,0]}]" + triangle));
  CHECK(model.soup.polygons.size() == 1);
  CHECK(model.soup.points[0] == Model::Points::value_type(3, 0, 0));

  Model instances;
  const File_report report = report_of(
    file.binary(node + triangle + ",\"extensionsUsed\":[\"EXT_mesh_gpu_instancing\"]"), instances);
  REQUIRE(report);
  REQUIRE(report.warnings.size() == 1);
  CHECK(report.warnings[0].find("Instances") == 0);
  CHECK(report_of(file.binary(node + mesh("{\"attributes\":{\"POSITION\":" + points + "},\"material\":2147483647}")),
                  instances)
          .status
        == File_status::MALFORMED);
}

TEST_CASE("GLTF: textures of PLY files are images of materials")
{
  const std::string ply = "ply\nformat ascii 1.0\ncomment TextureFile a.png\ncomment TextureFile old oak.png\n"
                          "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                          "element face 2\nproperty list uchar int vertex_indices\nproperty int texnumber\n"
                          "property list uchar float texcoord\nend_header\n"
                          "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1 6 0 0 1 0 0 1\n3 0 2 1 0 6 0 0 0 1 1 0\n";
  const Model model = model_of(ply, "two.ply");
  CHECK(model.files == std::vector<std::string>{ "two.ply", "a.png", "old oak.png" });
  const Written_files written = write_model(model, "two.glb");
  CHECK(written.warnings.empty());
  const Model again = model_of(written.files[0].second);
  const Attribute& material = *again.find(material_name, Element::POLYGON);
  CHECK(std::set<double>{ material[0][0], material[1][0] }.size() == 2);
  const std::string library = write_model(again, "two.obj").files.back().second;
  CHECK(library.find("map_Kd a.png\n") != std::string::npos);
  CHECK(library.find("map_Kd old oak.png\n") != std::string::npos);

  const Written_files direct = write_model(model, "folder/two.obj");
  CHECK(direct.warnings.empty());
  REQUIRE(direct.files.size() == 2);
  CHECK(direct.files[1].second == "newmtl 0\nKd 1 1 1\nmap_Kd ../a.png\nnewmtl 1\nKd 1 1 1\nmap_Kd ../old oak.png\n");
  const std::string& obj = direct.files[0].second;
  CHECK(obj.find("usemtl 0\nvt 0 0\nvt 0 1\nvt 1 0\nf 1/1 3/2 2/3\nusemtl 1\nf 1/1 2/3 3/2\n") != std::string::npos);

  std::string one = ply;
  one.replace(one.find("comment TextureFile old oak.png\n"), 32, "");
  one.replace(one.find("texnumber"), 9, "other");
  const Written_files of_one = write_model(model_of(one, "two.ply"), "two.obj");
  REQUIRE(of_one.files.size() == 2);
  CHECK(of_one.files[1].second == "newmtl 0\nKd 1 1 1\nmap_Kd a.png\n");
  CHECK(of_one.files[0].second.find("usemtl 0\n") != std::string::npos);
}

} // namespace test_GLTF
