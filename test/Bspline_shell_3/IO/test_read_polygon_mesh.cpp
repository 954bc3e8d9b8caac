// read_polygon_mesh.h, write_file.h: a mesh is read completely, or refused for the right reason and at the right places
// of the file. A file is written completely, or not at all.
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>
#include <CGAL/Bspline_shell_3/IO/write_file.h>

#include <CGAL/IO/STL.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>

namespace test_read_polygon_mesh {
using namespace CGAL::Bspline_shells;

namespace {

// A file that is removed at the end of the test.
struct Temporary_file
{
  explicit Temporary_file(const std::string& name, const std::string& text = std::string()) : name(name)
  {
    if(!text.empty()) std::ofstream(name, std::ios::binary) << text;
  }
  ~Temporary_file() { std::remove(name.c_str()); }
  std::string name;
};

Shell_status read(const std::string& name, const std::string& text, Offending_simplices& offenders)
{
  const Temporary_file file(name, text);
  Mesh mesh;
  return read_polygon_mesh(file.name, mesh, offenders);
}

std::string contents(const std::string& name)
{
  std::ifstream in(name, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
}

// A tetrahedron: rows of coordinates and of facets, each followed by `behind`.
std::string vertex_rows(const std::string& behind = "\n")
{
  std::string rows;
  for(const char* row : { "0 0 0", "2.5 0 0", "0 1 0", "0 0 1" }) rows += row + behind;
  return rows;
}

std::string facet_rows(const std::string& behind = "\n")
{
  std::string rows;
  for(const char* row : { "3 0 2 1", "3 0 1 3", "3 1 2 3", "3 2 0 3" }) rows += row + behind;
  return rows;
}

const std::string xyz = "property float x\nproperty float y\nproperty float z\n",
                  indices = "property list uchar int vertex_indices\n";

std::string PLY(const std::string& vertex_properties, const std::string& facet_properties, const std::string& data,
                const std::string& more = std::string(), const std::string& format = "ascii")
{
  return "ply\nformat " + format + " 1.0\ncomment a tetrahedron\nelement vertex 4\n" + vertex_properties
         + "element face 4\n" + facet_properties + more + "end_header\n" + data;
}

template <typename T>
void append(std::string& data, T value, bool is_big_endian)
{
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  if(is_big_endian) std::reverse(bytes, bytes + sizeof(T));
  data.append(bytes, sizeof(T));
}

// Returns the tetrahedron in binary. Facets have a flag before their indices, and two lists after them.
std::string binary_PLY(bool is_big_endian, int first_length = 3)
{
  std::string data;
  const auto put = [&](auto value) { append(data, value, is_big_endian); };
  for(float x : { 0.f, 0.f, 0.f, 2.5f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f }) put(x);
  int length = first_length;
  for(const auto& facet : { std::array<int, 3>{ 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } }) {
    put('\7');
    put(length);
    for(int v : facet) put(v);
    put('\2');
    for(float u : { 0.25f, 0.75f }) put(u);
    put('\1');
    put('\0');
    length = 3;
  }
  return PLY(xyz,
             "property uchar flag\nproperty list int int vertex_indices\nproperty list uchar float texcoord\n"
             "property list uchar uchar color\n",
             data, "", is_big_endian ? "binary_big_endian" : "binary_little_endian");
}

// Returns whether the file contains the tetrahedron.
bool is_tetrahedron(const std::string& name, const std::string& text)
{
  const Temporary_file file(name, text);
  Mesh mesh;
  Offending_simplices offenders;
  if(read_polygon_mesh(file.name, mesh, offenders) != Shell_status::SUCCESS) return false;
  std::vector<Point_3> points;
  for(Mesh::Vertex_index v : mesh.vertices()) points.push_back(mesh.point(v));
  return points == std::vector<Point_3>{ { 0, 0, 0 }, { 2.5, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }
         && mesh.number_of_faces() == 4 && CGAL::is_closed(mesh);
}

// The same tetrahedron as OBJ, GOCAD and STL.
std::string OBJ()
{
  return "v 0 0 0\nv 2.5 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
}

std::string GOCAD()
{
  return "GOCAD TSurf 1\nTFACE\nVRTX 7 0 0 0\nVRTX 8 2.5 0 0\nPVRTX 9 0 1 0 5 5\nVRTX 10 0 0 1\n"
         "TRGL 7 9 8\nTRGL 7 8 10\nTRGL 8 9 10\nTRGL 9 7 10\nEND\n";
}

std::string STL(const std::string& first = "solid\n", const std::string& normal = "0 0 1")
{
  const char* const points[] = { "0 0 0", "2.5 0 0", "0 1 0", "0 0 1" };
  std::string text = first;
  for(const auto& t : { std::array<int, 3>{ 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } }) {
    text += "facet normal " + normal + "\nouter loop\n";
    for(int v : t) text += std::string("vertex ") + points[v] + "\n";
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid\n";
}

// Returns whether the file contains the tetrahedron, in any order of vertices.
bool is_tetrahedron_STL(const std::string& name, const std::string& text)
{
  const Temporary_file file(name, text);
  Mesh mesh;
  return read_polygon_mesh(file.name, mesh) == Shell_status::SUCCESS && mesh.number_of_vertices() == 4
         && mesh.number_of_faces() == 4 && CGAL::is_closed(mesh)
         && CGAL::Polygon_mesh_processing::volume(mesh) == Approx(2.5 / 6);
}

} // namespace

TEST_CASE("Reading: an STL file yields a closed mesh with shared vertices, even if a binary file begins like a text")
{
  Mesh cube = box(Point_3(0, 0, 0), Point_3(1, 1, 1));
  for(bool binary : { false, true }) {
    const Temporary_file file("read_cube.stl");
    {
      std::ofstream out(file.name, std::ios::binary);
      if(binary) CGAL::IO::set_binary_mode(out);
      REQUIRE(CGAL::IO::write_STL(out, cube));
    }
    if(binary) { // binary STL is ambiguous: its header may begin like a text file
      std::string text = contents(file.name);
      text.replace(0, 5, "solid");
      std::ofstream(file.name, std::ios::binary) << text;
    }
    Mesh mesh;
    Offending_simplices offenders;
    REQUIRE(read_polygon_mesh(file.name, mesh, offenders) == Shell_status::SUCCESS);
    CHECK(mesh.number_of_faces() == 12);
    CHECK(mesh.number_of_vertices() == 8);
    CHECK(CGAL::is_closed(mesh));
  }
}

TEST_CASE("Reading: a facet with the wrong orientation is reversed")
{
  Offending_simplices offenders;
  const Temporary_file file("read_turned.off",
                            "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
  Mesh mesh;
  REQUIRE(read_polygon_mesh(file.name, mesh, offenders) == Shell_status::SUCCESS);
  CHECK(CGAL::is_closed(mesh));
  CHECK(mesh.number_of_faces() == 4);
}

TEST_CASE("Reading: an invalid file has a status, and leaves the mesh unchanged")
{
  Offending_simplices offenders;
  Mesh mesh = box(Point_3(0, 0, 0), Point_3(1, 1, 1));
  CHECK(read_polygon_mesh("no_such_file.off", mesh, offenders) == Shell_status::MISSING_FILE);
  CHECK(mesh.number_of_faces() == 12);
  CHECK(read("read_bad.off", "this is no mesh", offenders) == Shell_status::MALFORMED_FILE);
  CHECK(read("read_bad.xyzzy", "OFF\n0 0 0\n", offenders) == Shell_status::UNSUPPORTED_FILE);
  CHECK(read("read_bad.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n", offenders) == Shell_status::MALFORMED_FILE);
  CHECK(read("read_bad.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", offenders) != Shell_status::SUCCESS);
  CHECK(read("read_bad.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", offenders) == Shell_status::EMPTY_MESH);
  CHECK(read("read_bad.off", "OFF\n0 0 0\n", offenders) == Shell_status::EMPTY_MESH);
}

TEST_CASE("Reading: an STL file without facets is empty if it declares none, and malformed otherwise")
{
  Offending_simplices offenders;
  const std::string header(80, ' '), spaces(200, ' '), zero(4, '\0');
  for(const std::string& text : { std::string("this is no mesh"), std::string("solid ground\n"), std::string("\n"),
                                  spaces, std::string("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"),
                                  "this is no mesh" + spaces, "solid ground" + spaces, header, header + "\1" }) {
    CAPTURE(text);
    CHECK(read("read_none.stl", text, offenders) == Shell_status::MALFORMED_FILE);
    CHECK(read("read_none.STL", text, offenders) == Shell_status::MALFORMED_FILE);
  }
  for(const std::string& text : { std::string("solid none\nendsolid none\n"), "none" + header.substr(4) + zero }) {
    CAPTURE(text);
    CHECK(read("read_empty.stl", text, offenders) == Shell_status::EMPTY_MESH);
  }
}

TEST_CASE("Reading: missing, unreadable, empty, malformed and unsupported files are distinguished")
{
  Offending_simplices offenders;
  Mesh mesh;
  CHECK(read_polygon_mesh("", mesh) == Shell_status::MISSING_FILE);
  CHECK(read_polygon_mesh("no_such_folder/mesh.off", mesh) == Shell_status::MISSING_FILE);
  CHECK(read_polygon_mesh("no_such_file.xyzzy", mesh) == Shell_status::MISSING_FILE);
  CHECK(read_polygon_mesh(".", mesh) == Shell_status::UNREADABLE_FILE);
  for(const char* extension : { "off", "obj", "ply", "stl", "ts" }) {
    const std::string name = std::string("read_kinds.") + extension;
    CAPTURE(name);
    {
      const Temporary_file file(name);
      std::ofstream(name).flush();
      CHECK(read_polygon_mesh(name, mesh) == Shell_status::EMPTY_FILE);
    }
    CHECK(read(name, "\nthis is no mesh", offenders) == Shell_status::MALFORMED_FILE);
  }
  const std::string text = "OFF\n4 4 0\n" + vertex_rows() + facet_rows();
  CHECK(read("read_kinds.txt", text, offenders) == Shell_status::UNSUPPORTED_FILE);
  CHECK(read("read_kinds", text, offenders) == Shell_status::UNSUPPORTED_FILE);
}

TEST_CASE("Reading: the line of a syntax error is reported")
{
  Offending_simplices offenders;
  const std::string v = vertex_rows(), f = facet_rows();
  const auto line = [&](const std::string& name, std::string text, const std::string& old, const std::string& by) {
    CHECK(read(name, text.replace(text.find(old), old.size(), by), offenders) == Shell_status::MALFORMED_FILE);
    return offenders.line;
  };
  CHECK(line("read_line.off", "# counts\nOFF\n4 4 0\n" + v + f, "0 1 0", "0 one 0") == 6);
  CHECK(line("read_line.off", "OFF\n4 4 0\n\n" + v + f, "3 2 0 3\n", "3 2 0") == 11);
  CHECK(line("read_line.ply", PLY(xyz, indices, v + f), "0 1 0", "0 one 0") == 13);
  CHECK(line("read_line.obj", OBJ(), "0 1 0", "0 one 0") == 3);
  CHECK(line("read_line.obj", OBJ(), "f 1 3 2", "f 1 3 x") == 5);
  CHECK(line("read_line.obj", OBJ(), "f 1 3 2", "f 1 0 2") == 5);
  CHECK(line("read_line.stl", STL(), "endfacet", "vertex 0 0 0") == 8);
  CHECK(line("read_line.ts", GOCAD(), "0 1 0", "0 one 0") == 5);
  const std::string wrong = "OFF\n4 4 0\n" + v + facet_rows(" \n3 0 1 9\n");
  CHECK(read("read_line.off", wrong, offenders) == Shell_status::MALFORMED_FILE);
  CHECK(offenders.facets == std::vector<std::size_t>{ 1, 3 });
}

TEST_CASE("Reading: coordinates that are not finite are reported with their vertex and line, in every format")
{
  Offending_simplices offenders;
  const auto check = [&](const std::string& name, std::string text, std::size_t line, std::size_t vertex,
                         const std::string& old, const std::string& by) {
    CAPTURE(name, by);
    CHECK(read(name, text.replace(text.find(old), old.size(), by), offenders) == Shell_status::NOT_FINITE);
    CHECK(offenders.vertices == std::vector<std::size_t>{ vertex });
    CHECK(offenders.line == line);
  };
  const std::string v = vertex_rows(), f = facet_rows(), off = "OFF\n4 4 0\n" + v + f;
  for(const char* word : { "nan", "NaN", "-nan", "nan(ind)", "inf", "-Infinity", "1.#QNAN", "-1.#IND", "1e999" }) {
    check("read_nan.off", off, 5, 2, "0 1 0", std::string("0 ") + word + " 0");
    check("read_nan.ply", PLY(xyz, indices, v + f), 13, 2, "0 1 0", std::string("0 ") + word + " 0");
    check("read_nan.obj", OBJ(), 3, 2, "0 1 0", std::string("0 ") + word + " 0");
    check("read_nan.ts", GOCAD(), 5, 2, "0 1 0", std::string("0 ") + word + " 0");
    check("read_nan.stl", STL(), 5, 1, "0 1 0", std::string("0 ") + word + " 0");
  }
  check("read_nan.off", "4OFF\n4 4 0\n" + vertex_rows(" 1\n") + f, 5, 2, "0 1 0 1", "0 1 0 0");
  std::string data = binary_PLY(false);
  data.replace(data.find("end_header\n") + 11 + 12 * 2, 4, std::string("\0\0\x80\x7f", 4)); // infinity
  CHECK(read("read_nan.ply", data, offenders) == Shell_status::NOT_FINITE);
  CHECK(offenders.vertices == std::vector<std::size_t>{ 2 });
  CHECK(offenders.line == 0);
}

TEST_CASE("Reading: coordinates may have a sign, and may underflow")
{
  CHECK(is_tetrahedron("read_signs.off", "OFF\n4 4 0\n+0 -0 0\n+2.5 0. 1e-999\n.0 1.0E0 0\n0 0 +1\n" + facet_rows()));
}

TEST_CASE("Reading: a text STL file is distinguished from a binary file by its length, whatever its first line")
{
  for(const char* first : { "solid\n", "solid a name\n", "Solid\n", "SOLID name\n", "solid\tname\n", " solid name\n",
                            "\xEF\xBB\xBFsolid name\n", "# made by hand\nsolid\n", "solidname\n",
                            "solid facet normal\n", "solid name\r\n", "" })
    CHECK(is_tetrahedron_STL("read_first.stl", STL(first)));
  std::string upper = STL();
  for(char& c : upper)
    if(c >= 'a' && c <= 'z') c = char(c - 'a' + 'A');
  CHECK(is_tetrahedron_STL("read_upper.stl", upper));
  std::string indented = STL();
  for(std::size_t i = 0; (i = indented.find('\n', i)) != std::string::npos; i += 3) indented.replace(i, 1, "\r\n\t");
  CHECK(is_tetrahedron_STL("read_tabs.stl", indented));
  CHECK(is_tetrahedron_STL("read_normals.stl", STL("solid\n", "nan nan nan")));

  // The file is truncated, or has additional bytes at its end.
  Offending_simplices offenders;
  std::string binary = std::string(80, ' ') + std::string("\1\0\0\0", 4) + std::string(50, '\0');
  CHECK(read("read_short.stl", binary.substr(0, 133), offenders) == Shell_status::MALFORMED_FILE);
  CHECK(read("read_long.stl", binary + " ", offenders) == Shell_status::MALFORMED_FILE);
  CHECK(offenders.line == 0);
}

TEST_CASE("Reading: an OBJ file may have continued lines, relative and compound indices, and additional values")
{
  const std::string f = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  for(const std::string& text : std::vector<std::string>{
        OBJ(), "v 0 0 \\\n 0\nv 2.5 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 \\\n2\nf 1 2 4\nf 2 \\\n 3 \\\n 4\nf 3 1 4\n",
        "v 0 0 \\\r\n 0\r\nv 2.5 0 0\r\nv 0 1 0\r\nv 0 0 1\r\nf 1 3 2\r\nf 1 2 4\r\nf 2 3 4\r\nf 3 1 4\r\n",
        "# in C:\\\nv 0 0 0\nv 2.5 0 0\nv 0 1 0\nv 0 0 1\n" + f,
        "v 0 0 0 1 0.5 0.5 0.5\nv 2.5 0 0 1\nv 0 1 0 # a point\nv 0 0 1\n" + f,
        "\tv\t0\t0\t0\n v  2.5 0 0\nv 0 1 0\nv 0 0 1\n" + f,
        "mtllib none.mtl\no one\ng two\nv 0 0 0\nv 2.5 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvn nan 0 1\nusemtl none\ns off\n"
        "f 1/1/1 3/1/1 2/1/1\nf 1//1 2//1 4//1\nf 2/1 3/1 4/1\nl 1 2\nf -2/-1 -4/-1 -1/-1\n",
        "\xEF\xBB\xBFv 0 0 0\nv 2.5 0 0\nv 0 1 0\nf 1 -1 2\nv 0 0 1\nf 1 2 -1\nf 2 3 4\nf 3 1 4" }) {
    CAPTURE(text);
    CHECK(is_tetrahedron("read_variants.obj", text));
  }
  Offending_simplices offenders;
  CHECK(read("read_variants.obj", "v 0 0 0\nv 1 0 0\nf 1 2 -3\nv 0 1 0\n", offenders) == Shell_status::MALFORMED_FILE);
  CHECK(read("read_variants.obj", "v 0 0 0\nv 1 \\\n0 0\nv 0 \\\nx 0\n", offenders) == Shell_status::MALFORMED_FILE);
  CHECK(offenders.line == 5); // where the continued line ends
  CHECK(read("read_variants.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", offenders) == Shell_status::MALFORMED_FILE);
  CHECK(offenders.facets == std::vector<std::size_t>{ 0 });
}

TEST_CASE("Reading: in a GOCAD surface, vertices have names and may refer to others")
{
  CHECK(is_tetrahedron("read_gocad.ts", GOCAD()));
  std::string text = GOCAD();
  CHECK(is_tetrahedron("read_gocad.ts", text.replace(text.find("TRGL 7 9 8"), 10, "ATOM 11 9\nTRGL 7 11 8")));
  Offending_simplices offenders;
  text.replace(text.find("TRGL 7 11"), 9, "TRGL 7 12");
  CHECK(read("read_gocad.ts", text, offenders) == Shell_status::MALFORMED_FILE);
}

TEST_CASE("Reading: an OFF file may have white space, comments and blank lines anywhere, and no keyword")
{
  const std::string v = vertex_rows(), f = facet_rows();
  for(const std::string& text :
      { "OFF\n4 4 0\n" + v + f, "\t  OFF4 4 6 # joined\n  " + v + "\n \n" + f,
        "\n\n  OFF# comment\n# another\n\n4 4 6\n" + v + f, "OFF 4 4 0\r\n" + vertex_rows("\r\n") + facet_rows(" \r\n"),
        "4 4 0\n" + v + f, "OFF\n4 4 0 # counts\n" + vertex_rows(" # point\n") + "#\n" + facet_rows("#facet\n"),
        "OFF\n4\n4\n0\n" + v + f }) {
    CAPTURE(text);
    CHECK(is_tetrahedron("read_spaces.off", text));
  }
}

TEST_CASE("Reading: numbers of an OFF file may be distributed arbitrarily over lines")
{
  for(const std::string& text :
      { "OFF 4 4 6 " + vertex_rows(" ") + facet_rows(" "), "OFF\n4 4 6\n" + vertex_rows(" ") + "\n" + facet_rows(" "),
        "4 4 6 " + vertex_rows("\n") + facet_rows(" ") }) {
    CAPTURE(text);
    CHECK(is_tetrahedron("read_free.off", text));
  }
  Offending_simplices offenders;
  CHECK(read("read_free.off", "OFF 4 4 6 " + vertex_rows(" ") + facet_rows(" ") + " 1", offenders)
        == Shell_status::MALFORMED_FILE);
  CHECK(read("read_free.off", "OFF 4 5 6 " + vertex_rows(" ") + facet_rows(" "), offenders)
        == Shell_status::MALFORMED_FILE);
}

TEST_CASE("Reading: an OFF file may omit the number of edges")
{
  // The first vertex is not at zero, and its first coordinate must not be cut off.
  const std::string text = "OFF\n4 4\n1.5 2 3\n2 2 3\n1.5 3 3\n1.5 2 4\n" + facet_rows();
  const Temporary_file file("read_edges.off", text);
  Mesh mesh;
  Offending_simplices offenders;
  REQUIRE(read_polygon_mesh(file.name, mesh, offenders) == Shell_status::SUCCESS);
  CHECK(mesh.point(*mesh.vertices().begin()) == Point_3(1.5, 2, 3));
  CHECK(is_tetrahedron("read_edges.off", "OFF\n4 4\n" + vertex_rows() + facet_rows()));
}

TEST_CASE("Reading: data of an OFF file other than positions and facets are skipped")
{
  for(const auto& keyword_and_more :
      std::vector<std::pair<std::string, std::string> >{ { "COFF", " 255 0 0 255\n" },
                                                         { "COFF", " 0.5 0 0.5\n" },
                                                         { "COFF", " -2000000000\n" },
                                                         { "COFF", " 1 2\n" },
                                                         { "COFF", "\n" },
                                                         { "NOFF", " 0 0 1\n" },
                                                         { "NOFF", "\n" },
                                                         { "CNOFF", " 0 0 1 9 9 9\n" },
                                                         { "STOFF", " 0.1 0.2\n" },
                                                         { "STOFF", "\n" },
                                                         { "STCNOFF", " 0 0 1 9 9 9 1 0.1 0.2\n" },
                                                         { "4OFF", " 1\n" },
                                                         { "nOFF 3", "\n" } }) {
    CAPTURE(keyword_and_more);
    for(const char* color : { "\n", " 0.5 0.5 0.5\n", " 255 0 0 255\n", " 1 2\n" })
      CHECK(is_tetrahedron("read_more.off", keyword_and_more.first + "\n4 4 0\n" + vertex_rows(keyword_and_more.second)
                                              + facet_rows(color)));
  }
}

TEST_CASE("Reading: an incomplete OFF file is malformed, and a binary OFF file is not supported")
{
  Offending_simplices offenders;
  const std::string v = vertex_rows(), f = facet_rows(), whole = "OFF\n4 4 0\n" + v + f;
  for(const std::string& text :
      { std::string("OFF BINARY\n\0\0\0\4", 15), "nOFF\n4\n4 4 0\n" + vertex_rows(" 0\n") + f })
    CHECK(read("read_other.off", text, offenders) == Shell_status::UNSUPPORTED_FILE);
  const auto replaced = [&](const std::string& old, const std::string& by) {
    std::string text = whole;
    return text.replace(text.find(old), old.size(), by);
  };
  for(const std::string& text : { std::string("OFF"),
                                  std::string("OFF\n4"),
                                  std::string("4"),
                                  std::string("#"),
                                  std::string(" \n"),
                                  "4OFF\n4 4 0\n" + v + f,
                                  "OFF\n-4 4 0\n" + v + f,
                                  replaced("3 2 0 3\n", ""),
                                  replaced("3 2 0 3\n", "3 2 0"),
                                  replaced("2.5 0 0", "2.5 0"),
                                  replaced("2.5 0 0", "2.5 zero 0"),
                                  replaced("4 4 0", "2000000000 4 0"),
                                  replaced("4 4 0", "4 2000000000 0"),
                                  replaced("4 4 0", "4 1e300 0"),
                                  replaced("3 0 2 1", "900000000 0 2 1"),
                                  replaced("3 0 2 1", "-3 0 2 1"),
                                  replaced("3 0 2 1", "3 0 -2 1"),
                                  replaced("3 0 2 1", "3 0 2.5 1"),
                                  replaced("3 0 2 1", "3 0 4 1"),
                                  replaced("3 0 2 1", "3 0 nan 1") }) {
    CAPTURE(text);
    CHECK(read("read_broken.off", text, offenders) == Shell_status::MALFORMED_FILE);
  }
}

TEST_CASE("Reading: facets of a text PLY file may have properties before and after their indices, even lists")
{
  const std::string texture = "property list uchar float texcoord\n",
                    colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n", v = vertex_rows();
  std::string behind;
  for(const char* row : { "3 0 2 1", "3 0 1 3", "3 1 2 3", "3 2 0 3" })
    behind += "2 0.25 0.75 7 " + std::string(row) + " 0\n";
  CHECK(is_tetrahedron("read_lists.ply", PLY(xyz, indices, v + facet_rows())));
  CHECK(is_tetrahedron("read_lists.ply", PLY(xyz, indices + texture, v + facet_rows(" 6 0 0 0.5 0 0 1e-60\n"))));
  CHECK(is_tetrahedron("read_lists.ply", PLY(xyz, indices + texture, v + facet_rows(" 2 nan 1e60\n"))));
  CHECK(is_tetrahedron(
    "read_lists.ply",
    PLY(xyz, texture + "property uchar flag\n" + indices + "property list int short labels\n", v + behind)));
  // There are more numbers than declared: a list in place of three colors.
  CHECK(is_tetrahedron("read_lists.ply",
                       PLY(xyz, indices + texture + colors, v + facet_rows(" 2 0.5 0.5 9 1 1 1 1 1 1 1 1 1\n"))));
  // additional line breaks, and missing ones
  std::string lines = PLY(xyz, indices + texture, v + facet_rows("\n2 0.25 0.75\n"));
  CHECK(is_tetrahedron("read_lists.ply", lines));
  CHECK(is_tetrahedron("read_lists.ply", PLY(xyz, indices + texture, vertex_rows(" ") + facet_rows(" 2 0.25 0.75 "))));
}

TEST_CASE("Reading: a text PLY file may have any types, line ends, comments, and blank lines in its header")
{
  const std::string data = vertex_rows() + facet_rows();
  for(const char* type : { "uchar", "int8", "short", "uint16", "uint", "int32", "uint64", "float", "double" })
    CHECK(
      is_tetrahedron("read_types.ply", PLY(xyz, "property list uchar " + std::string(type) + " vertex_index\n", data)));
  CHECK(is_tetrahedron("read_types.ply", PLY("property int x\nproperty double y\nproperty short z\n", indices, data)));
  CHECK(
    is_tetrahedron("read_types.ply", PLY(xyz + "property int64 id\n", indices, vertex_rows(" 7\n") + facet_rows())));
  CHECK(is_tetrahedron("read_types.ply", PLY(xyz, indices, data, "\ncomment\nobj_info none\nelement edge 0\n")));
  CHECK(is_tetrahedron("read_types.ply", PLY(xyz, indices, data + "0 1\n",
                                             "element edge 1\nproperty int vertex1\nproperty int vertex2\n")));
  std::string text = PLY(xyz, indices, data);
  for(std::size_t i = 0; (i = text.find('\n', i)) != std::string::npos; i += 2) text.insert(i, "\r");
  CHECK(is_tetrahedron("read_types.ply", text));
}

TEST_CASE("Reading: a PLY file with triangle strips has its own status, even if it has other facets")
{
  Offending_simplices offenders;
  const std::string strips = "element tristrips 1\nproperty list int int vertex_indices\n",
                    data = vertex_rows() + facet_rows() + "6 0 2 1 3 0 2\n";
  CHECK(read("read_strips.ply", PLY(xyz, indices, data, strips), offenders) == Shell_status::TRIANGLE_STRIPS);
  CHECK(std::string(message(Shell_status::TRIANGLE_STRIPS)).find("list of facets") != std::string::npos);
  CHECK(is_tetrahedron("read_strips.ply",
                       PLY(xyz, indices, data, "element tristrips 0\nproperty list int int vertex_indices\n")));
}

TEST_CASE("Reading: an incomplete text PLY file is malformed")
{
  Offending_simplices offenders;
  const std::string v = vertex_rows(), f = facet_rows(), whole = PLY(xyz, indices, v + f);
  CHECK(read("read_other.ply", PLY(xyz, indices, v + f, "", "text"), offenders) == Shell_status::UNSUPPORTED_FILE);
  const auto replaced = [&](const std::string& old, const std::string& by) {
    std::string text = whole;
    return text.replace(text.find(old), old.size(), by);
  };
  for(const std::string& text : { replaced("3 2 0 3\n", ""),
                                  replaced("3 2 0 3\n", "3 2 0"),
                                  replaced("2.5 0 0", "2.5 0"),
                                  replaced("2.5 0 0", "2.5 zero 0"),
                                  replaced("end_header\n", ""),
                                  replaced("property float z\n", ""),
                                  replaced("float z", "float h"),
                                  replaced("vertex_indices", "corners"),
                                  replaced("uchar int", "uchar"),
                                  replaced("uchar int", "float int"),
                                  replaced("float z", "real z"),
                                  replaced("format ascii 1.0\n", ""),
                                  replaced("vertex 4", "vertex 4000000000000"),
                                  replaced("face 4", "face 4000000000000"),
                                  replaced("vertex 4", "vertex -4"),
                                  replaced("vertex 4", "vertex 3"),
                                  replaced("3 0 2 1", "1900000000 0 2 1"),
                                  replaced("3 0 2 1", "-3 0 2 1"),
                                  replaced("3 0 2 1", "3 0 -2 1"),
                                  replaced("3 0 2 1", "3 0 4 1"),
                                  replaced(indices, ""),
                                  replaced("ply", "PLY"),
                                  replaced("property float x", "property list uchar float x"),
                                  replaced(indices, "property int vertex_indices\n") }) {
    CAPTURE(text);
    CHECK(read("read_broken.ply", text, offenders) == Shell_status::MALFORMED_FILE);
  }
}

TEST_CASE("Reading: binary PLY files may have any properties, and are rejected if truncated or of unknown types")
{
  Offending_simplices offenders;
  for(bool is_big_endian : { false, true }) {
    const std::string whole = binary_PLY(is_big_endian);
    CHECK(is_tetrahedron("read_binary.ply", whole));
    const std::size_t data = whole.find("end_header\n") + 11;
    for(std::size_t size = data; size < whole.size(); ++size)
      if(read("read_binary.ply", whole.substr(0, size), offenders) != Shell_status::MALFORMED_FILE) FAIL(size - data);
    for(int length : { -2, 1900000000 })
      CHECK(read("read_binary.ply", binary_PLY(is_big_endian, length), offenders) == Shell_status::MALFORMED_FILE);
    const auto status = [&](const char* old, const char* by) {
      std::string text = whole;
      return read("read_binary.ply", text.replace(text.find(old), 5, by), offenders);
    };
    CHECK(status("float x", "int") == Shell_status::UNSUPPORTED_FILE);
    CHECK(status("float x", "int64") == Shell_status::UNSUPPORTED_FILE);
    CHECK(status("uchar flag", "int64") == Shell_status::UNSUPPORTED_FILE);
    std::string shorts = whole;
    const std::string list = "list int int vertex";
    shorts.replace(shorts.find(list), list.size(), "list int ushort vertex");
    CHECK(read("read_binary.ply", shorts, offenders) == Shell_status::UNSUPPORTED_FILE);
    CHECK(status("float x", "list uchar float") == Shell_status::MALFORMED_FILE);
  }
}

TEST_CASE("Reading: nothing is printed")
{
  std::ostringstream printed;
  std::streambuf* const before = std::cerr.rdbuf(printed.rdbuf());
  Offending_simplices offenders;
  for(const char* name :
      { "read_silent.ply", "read_silent.off", "read_silent.obj", "read_silent.stl", "read_silent.ts" })
    read(name, "f 1 2 x\nthis is no mesh", offenders);
  std::string text = binary_PLY(false);
  // CGAL's reader rejects this file.
  read("read_silent.ply", text.replace(text.find("int int"), 7, "int float"), offenders);
  std::cerr.rdbuf(before);
  CHECK(printed.str() == "");
}

TEST_CASE("Reading: three facets at an edge are non-manifold, and reported")
{
  Offending_simplices offenders;
  const Shell_status status = read(
    "read_fan.off", "OFF\n6 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 -1 0\n5 5 5\n3 0 1 2\n3 0 1 3\n3 0 1 4\n3 2 3 5\n",
    offenders);
  CHECK(status == Shell_status::NON_MANIFOLD);
  CHECK(offenders.facets == std::vector<std::size_t>{ 0, 1, 2 });
}

TEST_CASE("Reading: a vertex that joins two surfaces is non-manifold, and reported")
{
  // Two tetrahedra share the vertex 3.
  Offending_simplices offenders;
  const Shell_status status = read("read_pinched.off",
                                   "OFF\n7 8 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 2\n1 0 2\n0 1 2\n"
                                   "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 4 5 6\n3 4 3 5\n3 5 3 6\n3 6 3 4\n",
                                   offenders);
  CHECK(status == Shell_status::NON_MANIFOLD);
  CHECK(offenders.vertices == std::vector<std::size_t>{ 3 });
}

TEST_CASE("Reading: of several vertices at one position, only the first in the file is reported")
{
  // Three tetrahedra with vertices of their own meet at the origin: vertices 2, 6 and 11.
  Offending_simplices offenders;
  const Shell_status status = read(
    "read_repeated.off",
    "OFF\n12 12 0\n1 0 0\n0 1 0\n0 0 0\n0 0 1\n-1 0 0\n0 -1 0\n0 0 0\n0 0 -1\n5 5 0\n5 6 0\n5 5 1\n0 0 0\n"
    "3 0 1 2\n3 1 0 3\n3 2 1 3\n3 0 2 3\n3 4 5 6\n3 5 4 7\n3 6 5 7\n3 4 6 7\n"
    "3 8 9 11\n3 9 8 10\n3 11 9 10\n3 8 11 10\n",
    offenders);
  CHECK(status == Shell_status::NON_MANIFOLD);
  CHECK(offenders.vertices == std::vector<std::size_t>{ 2 });
  CHECK(offenders.facets.empty());

  // The same holds after a duplicate vertex, which shifts positions when vertices are merged.
  CHECK(read("read_repeated.off",
             "OFF\n10 8 0\n1 0 0\n1 0 0\n0 1 0\n0 0 0\n0 0 1\n-1 0 0\n0 -1 0\n0 0 0\n0 0 -1\n0 0 1\n"
             "3 0 2 3\n3 2 1 4\n3 3 2 9\n3 1 3 4\n3 5 6 7\n3 6 5 8\n3 7 6 8\n3 5 7 8\n",
             offenders)
        == Shell_status::NON_MANIFOLD);
  CHECK(offenders.vertices == std::vector<std::size_t>{ 3 });
}

TEST_CASE("Reading: a Moebius strip is not orientable")
{
  // Five quadrangles form a ring; the last one is twisted.
  Offending_simplices offenders;
  std::string text = "OFF\n10 5 0\n";
  for(int i = 0; i < 5; ++i)
    text += std::to_string(std::cos(i * 1.2566)) + " " + std::to_string(std::sin(i * 1.2566)) + " 0\n"
            + std::to_string(std::cos(i * 1.2566)) + " " + std::to_string(std::sin(i * 1.2566)) + " 1\n";
  text += "4 0 2 3 1\n4 2 4 5 3\n4 4 6 7 5\n4 6 8 9 7\n4 8 1 0 9\n";
  CHECK(read("read_moebius.off", text, offenders) == Shell_status::NOT_ORIENTABLE);
  CHECK(!offenders.facets.empty());
  for(std::size_t i = 1; i < offenders.facets.size(); ++i) CHECK(offenders.facets[i - 1] < offenders.facets[i]);
}

TEST_CASE("Reading: each facet at the seams of a one-sided surface is reported once, in ascending order")
{
  // The projective plane: six vertices, each two of them connected by an edge.
  Offending_simplices offenders;
  CHECK(read("read_projective.off",
             "OFF\n6 10 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 0\n1 1 1\n"
             "3 0 1 2\n3 0 2 3\n3 0 3 4\n3 0 4 5\n3 0 5 1\n3 1 2 4\n3 2 3 5\n3 3 4 1\n3 4 5 2\n3 5 1 3\n",
             offenders)
        == Shell_status::NOT_ORIENTABLE);
  REQUIRE(offenders.facets.size() > 1);
  for(std::size_t i = 1; i < offenders.facets.size(); ++i) CHECK(offenders.facets[i - 1] < offenders.facets[i]);
}

TEST_CASE("Reading: a facet with two corners at one position is degenerate, and reported")
{
  Offending_simplices offenders;
  // Vertices 1 and 3 have the same position.
  CHECK(read("read_degenerate.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 0 0\n3 0 1 2\n3 1 3 2\n", offenders)
        == Shell_status::DEGENERATE_FACET);
  CHECK(offenders.facets == std::vector<std::size_t>{ 1 });
}

TEST_CASE("Reading triangles: polygons are triangulated without new points, unless diagonals would coincide")
{
  // A cube lacks one corner, so three of its sides are concave.
  const Temporary_file cube(
    "read_triangles.off",
    "OFF 14 9 0 0 0 0 2 0 0 2 2 0 0 2 0 0 0 2 2 0 2 0 2 2 2 2 1 1 2 2 2 1 2 2 1 1 1 1 2 1 2 1 1 1 1\n"
    "4 0 3 2 1 4 0 1 5 4 4 0 4 6 3 6 1 2 7 10 9 5 6 2 3 6 8 12 7 6 4 5 9 11 8 6 4 7 12 13 10 4 9 10 13 11 4 8 11 13 "
    "12\n");
  Mesh mesh;
  REQUIRE(read_triangle_mesh(cube.name, mesh) == Shell_status::SUCCESS);
  CHECK(mesh.number_of_vertices() == 14);
  CHECK(mesh.number_of_faces() == 24);
  CHECK(CGAL::is_triangle_mesh(mesh));
  CHECK(CGAL::Polygon_mesh_processing::volume(mesh) == Approx(7));
  CHECK_FALSE(CGAL::Polygon_mesh_processing::does_self_intersect(mesh));

  // For two rhombuses back to back, the best diagonal is the same.
  const Temporary_file pillow("read_triangles.off", "OFF 4 2 0 0 0 0 2 -1 0 4 0 0 2 1 0\n4 0 1 2 3 4 3 2 1 0\n");
  Mesh none;
  CHECK(read_polygon_mesh(pillow.name, none) == Shell_status::SUCCESS);
  CHECK(read_triangle_mesh(pillow.name, none) == Shell_status::DEGENERATE_FACET);
}

TEST_CASE("Writing: a file appears complete or not at all")
{
  const Temporary_file file("write_test.txt", "old");
  CHECK_FALSE(write_file(file.name, [](std::ostream& out) {
    out << "half";
    return false;
  }));
  CHECK(contents(file.name) == "old");
  CHECK(contents(file.name + ".part").empty());
  CHECK(write_file(file.name, [](std::ostream& out) {
    out << "new";
    return true;
  }));
  CHECK(contents(file.name) == "new");
  CHECK_FALSE(write_file("no_such_folder/file", [](std::ostream& out) {
    out << "new";
    return true;
  }));
}
} // namespace test_read_polygon_mesh
