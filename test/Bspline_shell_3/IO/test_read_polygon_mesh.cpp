// read_polygon_mesh.h, write_file.h: a mesh is read completely, or rejected for the right reason and at the right
// places of the file. A file is written completely, or not at all.
#include "temporary_files.h"
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
#include <functional>
#include <iostream>
#include <sstream>

namespace test_read_polygon_mesh {
using namespace CGAL::Bspline_shells;

namespace {

struct Result
{
  Shell_status status;
  Offending_simplices offenders;
};

Result read(const std::string& name, const std::string& text)
{
  const Temporary_file file(name, text);
  Mesh mesh;
  Result result;
  result.status = read_polygon_mesh(file.name, mesh, result.offenders);
  return result;
}

void check_status(const std::string& name, const std::vector<std::string>& texts, Shell_status status)
{
  for(const std::string& text : texts) {
    CAPTURE(name, text);
    CHECK(read(name, text).status == status);
  }
}

// Returns the text in which the left part of a change, "old -> new", is replaced by the right part.
std::string changed(std::string text, const std::string& change)
{
  const std::size_t arrow = change.find(" -> ");
  return text.replace(text.find(change.substr(0, arrow)), arrow, change.substr(arrow + 4));
}

void check_status_after_changes(const std::string& name, const std::string& text,
                                const std::vector<std::string>& changes, Shell_status status)
{
  for(const std::string& change : changes) check_status(name, { changed(text, change) }, status);
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

// Checks that each file contains the tetrahedron.
void check_tetrahedra(const std::string& name, const std::vector<std::string>& texts)
{
  for(const std::string& text : texts) {
    CAPTURE(name, text);
    const Temporary_file file(name, text);
    Mesh mesh;
    Offending_simplices offenders;
    CHECK(read_polygon_mesh(file.name, mesh, offenders) == Shell_status::SUCCESS);
    std::vector<Point_3> points;
    for(Mesh::Vertex_index v : mesh.vertices()) points.push_back(mesh.point(v));
    CHECK(points == std::vector<Point_3>{ { 0, 0, 0 }, { 2.5, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } });
    CHECK(mesh.number_of_faces() == 4);
    CHECK(CGAL::is_closed(mesh));
  }
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

// Checks that each file contains the tetrahedron, in any order of vertices.
void check_tetrahedra_STL(const std::vector<std::string>& texts)
{
  for(const std::string& text : texts) {
    CAPTURE(text);
    const Temporary_file file("read_tetrahedron.stl", text);
    Mesh mesh;
    CHECK(read_polygon_mesh(file.name, mesh) == Shell_status::SUCCESS);
    CHECK(mesh.number_of_vertices() == 4);
    CHECK(mesh.number_of_faces() == 4);
    CHECK(CGAL::is_closed(mesh));
    CHECK(CGAL::Polygon_mesh_processing::volume(mesh) == Approx(2.5 / 6));
  }
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
    REQUIRE(read_polygon_mesh(file.name, mesh) == Shell_status::SUCCESS);
    CHECK(mesh.number_of_faces() == 12);
    CHECK(mesh.number_of_vertices() == 8);
    CHECK(CGAL::is_closed(mesh));
  }
}

TEST_CASE("Reading: a facet with the wrong orientation is reversed")
{
  const Temporary_file file("read_turned.off",
                            "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
  Mesh mesh;
  REQUIRE(read_polygon_mesh(file.name, mesh) == Shell_status::SUCCESS);
  CHECK(CGAL::is_closed(mesh));
  CHECK(mesh.number_of_faces() == 4);
}

TEST_CASE("Reading: an invalid file has a status, and leaves the mesh unchanged")
{
  Mesh mesh = box(Point_3(0, 0, 0), Point_3(1, 1, 1));
  CHECK(read_polygon_mesh("no_such_file.off", mesh) == Shell_status::MISSING_FILE);
  CHECK(mesh.number_of_faces() == 12);
  check_status("read_bad.off", { "this is no mesh", "OFF\n4 4 0\n0 0 0\n1 0 0\n" }, Shell_status::MALFORMED_FILE);
  check_status("read_bad.xyzzy", { "OFF\n0 0 0\n" }, Shell_status::UNSUPPORTED_FILE);
  CHECK(read("read_bad.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n").status != Shell_status::SUCCESS);
  check_status("read_bad.off", { "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "OFF\n0 0 0\n" }, Shell_status::EMPTY_MESH);
}

TEST_CASE("Reading: an STL file without facets is empty if it declares none, and malformed otherwise")
{
  const std::string header(80, ' '), spaces(200, ' '), zero(4, '\0');
  for(const char* name : { "read_none.stl", "read_none.STL" })
    check_status(name,
                 { "this is no mesh", "solid ground\n", "\n", spaces,
                   "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "this is no mesh" + spaces,
                   "solid ground" + spaces, header, header + "\1" },
                 Shell_status::MALFORMED_FILE);
  check_status("read_empty.stl", { "solid none\nendsolid none\n", "none" + header.substr(4) + zero },
               Shell_status::EMPTY_MESH);
}

TEST_CASE("Reading: missing, unreadable, empty, malformed and unsupported files are distinguished")
{
  Mesh mesh;
  for(const char* name : { "", "no_such_folder/mesh.off", "no_such_file.xyzzy" })
    CHECK(read_polygon_mesh(name, mesh) == Shell_status::MISSING_FILE);
  CHECK(read_polygon_mesh(".", mesh) == Shell_status::UNREADABLE_FILE);
  for(const char* extension : { "off", "obj", "ply", "stl", "ts" }) {
    const std::string name = std::string("read_kinds.") + extension;
    {
      const Temporary_file file(name);
      std::ofstream(name).flush();
      CHECK(read_polygon_mesh(name, mesh) == Shell_status::EMPTY_FILE);
    }
    check_status(name, { "\nthis is no mesh" }, Shell_status::MALFORMED_FILE);
  }
  for(const char* name : { "read_kinds.txt", "read_kinds" })
    check_status(name, { "OFF\n4 4 0\n" + vertex_rows() + facet_rows() }, Shell_status::UNSUPPORTED_FILE);
}

TEST_CASE("Reading: the line of a syntax error is reported")
{
  const std::string v = vertex_rows(), f = facet_rows();
  const auto line = [](const std::string& name, const std::string& text, const std::string& change) {
    const Result result = read(name, changed(text, change));
    CHECK(result.status == Shell_status::MALFORMED_FILE);
    return result.offenders.line;
  };
  CHECK(line("read_line.off", "# counts\nOFF\n4 4 0\n" + v + f, "0 1 0 -> 0 one 0") == 6);
  CHECK(line("read_line.off", "OFF\n4 4 0\n\n" + v + f, "3 2 0 3\n -> 3 2 0") == 11);
  CHECK(line("read_line.ply", PLY(xyz, indices, v + f), "0 1 0 -> 0 one 0") == 13);
  CHECK(line("read_line.obj", OBJ(), "0 1 0 -> 0 one 0") == 3);
  CHECK(line("read_line.obj", OBJ(), "f 1 3 2 -> f 1 3 x") == 5);
  CHECK(line("read_line.obj", OBJ(), "f 1 3 2 -> f 1 0 2") == 5);
  CHECK(line("read_line.stl", STL(), "endfacet -> vertex 0 0 0") == 8);
  CHECK(line("read_line.ts", GOCAD(), "0 1 0 -> 0 one 0") == 5);
  const Result wrong = read("read_line.off", "OFF\n4 4 0\n" + v + facet_rows(" \n3 0 1 9\n"));
  CHECK(wrong.status == Shell_status::MALFORMED_FILE);
  CHECK(wrong.offenders.facets == std::vector<std::size_t>{ 1, 3 });
}

TEST_CASE("Reading: coordinates that are not finite are reported with their vertex and line, in every format")
{
  const auto check = [](const std::string& name, const std::string& text, std::size_t line, std::size_t vertex) {
    CAPTURE(name, text);
    const Result result = read(name, text);
    CHECK(result.status == Shell_status::NOT_FINITE);
    CHECK(result.offenders.vertices == std::vector<std::size_t>{ vertex });
    CHECK(result.offenders.line == line);
  };
  const std::string v = vertex_rows(), f = facet_rows();
  for(const char* word : { "nan", "NaN", "-nan", "nan(ind)", "inf", "-Infinity", "1.#QNAN", "-1.#IND", "1e999" }) {
    const std::string change = "0 1 0 -> 0 " + std::string(word) + " 0";
    check("read_nan.off", changed("OFF\n4 4 0\n" + v + f, change), 5, 2);
    check("read_nan.ply", changed(PLY(xyz, indices, v + f), change), 13, 2);
    check("read_nan.obj", changed(OBJ(), change), 3, 2);
    check("read_nan.ts", changed(GOCAD(), change), 5, 2);
    check("read_nan.stl", changed(STL(), change), 5, 1);
  }
  check("read_nan.off", changed("4OFF\n4 4 0\n" + vertex_rows(" 1\n") + f, "0 1 0 1 -> 0 1 0 0"), 5, 2);
  std::string data = binary_PLY(false);
  data.replace(data.find("end_header\n") + 11 + 12 * 2, 4, std::string("\0\0\x80\x7f", 4)); // infinity
  check("read_nan.ply", data, 0, 2);
}

TEST_CASE("Reading: coordinates may have a sign, and may underflow")
{
  check_tetrahedra("read_signs.off", { "OFF\n4 4 0\n+0 -0 0\n+2.5 0. 1e-999\n.0 1.0E0 0\n0 0 +1\n" + facet_rows() });
}

TEST_CASE("Reading: a text STL file is distinguished from a binary file by its length, whatever its first line")
{
  std::string upper = STL(), indented = STL();
  for(char& c : upper)
    if(c >= 'a' && c <= 'z') c = char(c - 'a' + 'A');
  for(std::size_t i = 0; (i = indented.find('\n', i)) != std::string::npos; i += 3) indented.replace(i, 1, "\r\n\t");
  check_tetrahedra_STL({ upper, indented, STL("solid\n", "nan nan nan") });
  for(const char* first : { "solid\n", "solid a name\n", "Solid\n", "SOLID name\n", "solid\tname\n", " solid name\n",
                            "\xEF\xBB\xBFsolid name\n", "# made by hand\nsolid\n", "solidname\n",
                            "solid facet normal\n", "solid name\r\n", "" })
    check_tetrahedra_STL({ STL(first) });

  // The file is truncated, or has additional bytes at its end.
  const std::string binary = std::string(80, ' ') + std::string("\1\0\0\0", 4) + std::string(50, '\0');
  check_status("read_length.stl", { binary.substr(0, 133), binary + " " }, Shell_status::MALFORMED_FILE);
  CHECK(read("read_length.stl", binary + " ").offenders.line == 0);
}

TEST_CASE("Reading: an OBJ file may have continued lines, relative and compound indices, and additional values")
{
  const std::string f = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  check_tetrahedra(
    "read_variants.obj",
    { OBJ(), "v 0 0 \\\n 0\nv 2.5 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 \\\n2\nf 1 2 4\nf 2 \\\n 3 \\\n 4\nf 3 1 4\n",
      "v 0 0 \\\r\n 0\r\nv 2.5 0 0\r\nv 0 1 0\r\nv 0 0 1\r\nf 1 3 2\r\nf 1 2 4\r\nf 2 3 4\r\nf 3 1 4\r\n",
      "# in C:\\\nv 0 0 0\nv 2.5 0 0\nv 0 1 0\nv 0 0 1\n" + f,
      "v 0 0 0 1 0.5 0.5 0.5\nv 2.5 0 0 1\nv 0 1 0 # a point\nv 0 0 1\n" + f,
      "\tv\t0\t0\t0\n v  2.5 0 0\nv 0 1 0\nv 0 0 1\n" + f,
      "mtllib none.mtl\no one\ng two\nv 0 0 0\nv 2.5 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvn nan 0 1\nusemtl none\ns off\n"
      "f 1/1/1 3/1/1 2/1/1\nf 1//1 2//1 4//1\nf 2/1 3/1 4/1\nl 1 2\nf -2/-1 -4/-1 -1/-1\n",
      "\xEF\xBB\xBFv 0 0 0\nv 2.5 0 0\nv 0 1 0\nf 1 -1 2\nv 0 0 1\nf 1 2 -1\nf 2 3 4\nf 3 1 4" });
  const std::string continued = "v 0 0 0\nv 1 \\\n0 0\nv 0 \\\nx 0\n", missing = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n";
  check_status("read_variants.obj", { "v 0 0 0\nv 1 0 0\nf 1 2 -3\nv 0 1 0\n", continued, missing },
               Shell_status::MALFORMED_FILE);
  CHECK(read("read_variants.obj", continued).offenders.line == 5); // where the continued line ends
  CHECK(read("read_variants.obj", missing).offenders.facets == std::vector<std::size_t>{ 0 });
}

TEST_CASE("Reading: in a GOCAD surface, vertices have names and may refer to others")
{
  const std::string other_name = changed(GOCAD(), "TRGL 7 9 8 -> ATOM 11 9\nTRGL 7 11 8");
  check_tetrahedra("read_gocad.ts", { GOCAD(), other_name });
  check_status("read_gocad.ts", { changed(other_name, "TRGL 7 11 -> TRGL 7 12") }, Shell_status::MALFORMED_FILE);
}

TEST_CASE("Reading: an OFF file may have white space, comments and blank lines anywhere, and no keyword")
{
  const std::string v = vertex_rows(), f = facet_rows();
  check_tetrahedra("read_spaces.off",
                   { "OFF\n4 4 0\n" + v + f, "\t  OFF4 4 6 # joined\n  " + v + "\n \n" + f,
                     "\n\n  OFF# comment\n# another\n\n4 4 6\n" + v + f,
                     "OFF 4 4 0\r\n" + vertex_rows("\r\n") + facet_rows(" \r\n"), "4 4 0\n" + v + f,
                     "OFF\n4 4 0 # counts\n" + vertex_rows(" # point\n") + "#\n" + facet_rows("#facet\n"),
                     "OFF\n4\n4\n0\n" + v + f });
}

TEST_CASE("Reading: numbers of an OFF file may be distributed arbitrarily over lines")
{
  const std::string v = vertex_rows(" "), f = facet_rows(" ");
  check_tetrahedra("read_free.off",
                   { "OFF 4 4 6 " + v + f, "OFF\n4 4 6\n" + v + "\n" + f, "4 4 6 " + vertex_rows("\n") + f });
  check_status("read_free.off", { "OFF 4 4 6 " + v + f + " 1", "OFF 4 5 6 " + v + f }, Shell_status::MALFORMED_FILE);
}

TEST_CASE("Reading: an OFF file may omit the number of edges")
{
  // The first vertex is not at zero, and its first coordinate must not be cut off.
  const Temporary_file file("read_edges.off", "OFF\n4 4\n1.5 2 3\n2 2 3\n1.5 3 3\n1.5 2 4\n" + facet_rows());
  Mesh mesh;
  REQUIRE(read_polygon_mesh(file.name, mesh) == Shell_status::SUCCESS);
  CHECK(mesh.point(*mesh.vertices().begin()) == Point_3(1.5, 2, 3));
  check_tetrahedra("read_edges.off", { "OFF\n4 4\n" + vertex_rows() + facet_rows() });
}

TEST_CASE("Reading: data of an OFF file other than positions and facets are skipped")
{
  // the keyword, and what is behind each vertex
  for(const std::string& line :
      std::vector<std::string>{ "COFF: 255 0 0 255\n", "COFF: 0.5 0 0.5\n", "COFF: -2000000000\n", "COFF: 1 2\n",
                                "COFF:\n", "NOFF: 0 0 1\n", "NOFF:\n", "CNOFF: 0 0 1 9 9 9\n", "STOFF: 0.1 0.2\n",
                                "STOFF:\n", "STCNOFF: 0 0 1 9 9 9 1 0.1 0.2\n", "4OFF: 1\n", "nOFF 3:\n" }) {
    const std::size_t end = line.find(":");
    for(const char* color : { "\n", " 0.5 0.5 0.5\n", " 255 0 0 255\n", " 1 2\n" })
      check_tetrahedra("read_more.off",
                       { line.substr(0, end) + "\n4 4 0\n" + vertex_rows(line.substr(end + 1)) + facet_rows(color) });
  }
}

TEST_CASE("Reading: an incomplete OFF file is malformed, and a binary OFF file is not supported")
{
  const std::string v = vertex_rows(), f = facet_rows(), whole = "OFF\n4 4 0\n" + v + f;
  check_status("read_other.off",
               { std::string("OFF BINARY\n\0\0\0\4", 15), "nOFF\n4\n4 4 0\n" + vertex_rows(" 0\n") + f },
               Shell_status::UNSUPPORTED_FILE);
  check_status("read_broken.off",
               { "OFF", "OFF\n4", "4", "#", " \n", "4OFF\n4 4 0\n" + v + f, "OFF\n-4 4 0\n" + v + f },
               Shell_status::MALFORMED_FILE);
  check_status_after_changes("read_broken.off", whole,
                             { "3 2 0 3\n -> ", "3 2 0 3\n -> 3 2 0", "2.5 0 0 -> 2.5 0", "2.5 0 0 -> 2.5 zero 0",
                               "4 4 0 -> 2000000000 4 0", "4 4 0 -> 4 2000000000 0", "4 4 0 -> 4 1e300 0",
                               "3 0 2 1 -> 900000000 0 2 1", "3 0 2 1 -> -3 0 2 1", "3 0 2 1 -> 3 0 -2 1",
                               "3 0 2 1 -> 3 0 2.5 1", "3 0 2 1 -> 3 0 4 1", "3 0 2 1 -> 3 0 nan 1" },
                             Shell_status::MALFORMED_FILE);
}

TEST_CASE("Reading: facets of a text PLY file may have properties before and after their indices, even lists")
{
  const std::string texture = "property list uchar float texcoord\n",
                    colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n", v = vertex_rows();
  std::string behind;
  for(const char* row : { "3 0 2 1", "3 0 1 3", "3 1 2 3", "3 2 0 3" })
    behind += "2 0.25 0.75 7 " + std::string(row) + " 0\n";
  check_tetrahedra(
    "read_lists.ply",
    { PLY(xyz, indices, v + facet_rows()), PLY(xyz, indices + texture, v + facet_rows(" 6 0 0 0.5 0 0 1e-60\n")),
      PLY(xyz, indices + texture, v + facet_rows(" 2 nan 1e60\n")),
      PLY(xyz, texture + "property uchar flag\n" + indices + "property list int short labels\n", v + behind),
      // There are more numbers than declared: a list in place of three colors.
      PLY(xyz, indices + texture + colors, v + facet_rows(" 2 0.5 0.5 9 1 1 1 1 1 1 1 1 1\n")),
      // additional line breaks, and missing ones
      PLY(xyz, indices + texture, v + facet_rows("\n2 0.25 0.75\n")),
      PLY(xyz, indices + texture, vertex_rows(" ") + facet_rows(" 2 0.25 0.75 ")) });
}

TEST_CASE("Reading: a text PLY file may have any types, line ends, comments, and blank lines in its header")
{
  const std::string data = vertex_rows() + facet_rows();
  for(const char* type : { "uchar", "int8", "short", "uint16", "uint", "int32", "uint64", "float", "double" })
    check_tetrahedra("read_types.ply",
                     { PLY(xyz, "property list uchar " + std::string(type) + " vertex_index\n", data) });
  std::string text = PLY(xyz, indices, data);
  for(std::size_t i = 0; (i = text.find('\n', i)) != std::string::npos; i += 2) text.insert(i, "\r");
  check_tetrahedra("read_types.ply",
                   { PLY("property int x\nproperty double y\nproperty short z\n", indices, data),
                     PLY(xyz + "property int64 id\n", indices, vertex_rows(" 7\n") + facet_rows()),
                     PLY(xyz, indices, data, "\ncomment\nobj_info none\nelement edge 0\n"),
                     PLY(xyz, indices, data + "0 1\n", "element edge 1\nproperty int vertex1\nproperty int vertex2\n"),
                     text });
}

TEST_CASE("Reading: a PLY file with triangle strips has its own status, even if it has other facets")
{
  const std::string list = "property list int int vertex_indices\n",
                    data = vertex_rows() + facet_rows() + "6 0 2 1 3 0 2\n";
  check_status("read_strips.ply", { PLY(xyz, indices, data, "element tristrips 1\n" + list) },
               Shell_status::TRIANGLE_STRIPS);
  CHECK(std::string(message(Shell_status::TRIANGLE_STRIPS)).find("list of facets") != std::string::npos);
  check_tetrahedra("read_strips.ply", { PLY(xyz, indices, data, "element tristrips 0\n" + list) });
}

TEST_CASE("Reading: an incomplete text PLY file is malformed")
{
  const std::string data = vertex_rows() + facet_rows();
  check_status("read_other.ply", { PLY(xyz, indices, data, "", "text") }, Shell_status::UNSUPPORTED_FILE);
  check_status_after_changes("read_broken.ply", PLY(xyz, indices, data),
                             { "3 2 0 3\n -> ",
                               "3 2 0 3\n -> 3 2 0",
                               "2.5 0 0 -> 2.5 0",
                               "2.5 0 0 -> 2.5 zero 0",
                               "end_header\n -> ",
                               "property float z\n -> ",
                               "float z -> float h",
                               "vertex_indices -> corners",
                               "uchar int -> uchar",
                               "uchar int -> float int",
                               "float z -> real z",
                               "format ascii 1.0\n -> ",
                               "vertex 4 -> vertex 4000000000000",
                               "face 4 -> face 4000000000000",
                               "vertex 4 -> vertex -4",
                               "vertex 4 -> vertex 3",
                               "3 0 2 1 -> 1900000000 0 2 1",
                               "3 0 2 1 -> -3 0 2 1",
                               "3 0 2 1 -> 3 0 -2 1",
                               "3 0 2 1 -> 3 0 4 1",
                               indices + " -> ",
                               "ply -> PLY",
                               "property float x -> property list uchar float x",
                               indices + " -> property int vertex_indices\n" },
                             Shell_status::MALFORMED_FILE);
}

TEST_CASE("Reading: binary PLY files may have any properties, and are rejected if truncated or of unknown types")
{
  for(bool is_big_endian : { false, true }) {
    const std::string whole = binary_PLY(is_big_endian);
    check_tetrahedra("read_binary.ply", { whole });
    const std::size_t data = whole.find("end_header\n") + 11;
    for(std::size_t size = data; size < whole.size(); ++size)
      if(read("read_binary.ply", whole.substr(0, size)).status != Shell_status::MALFORMED_FILE) FAIL(size - data);
    check_status("read_binary.ply",
                 { binary_PLY(is_big_endian, -2), binary_PLY(is_big_endian, 1900000000),
                   changed(whole, "float -> list uchar float") },
                 Shell_status::MALFORMED_FILE);
    check_status("read_binary.ply",
                 { changed(whole, "float -> int"), changed(whole, "float -> int64"), changed(whole, "uchar -> int64"),
                   changed(whole, "list int int vertex -> list int ushort vertex") },
                 Shell_status::UNSUPPORTED_FILE);
  }
}

TEST_CASE("Reading: nothing is printed")
{
  std::ostringstream printed;
  std::streambuf* const before = std::cerr.rdbuf(printed.rdbuf());
  for(const char* extension : { "ply", "off", "obj", "stl", "ts" })
    read(std::string("read_silent.") + extension, "f 1 2 x\nthis is no mesh");
  read("read_silent.ply", changed(binary_PLY(false), "int int -> int float")); // CGAL's reader rejects this file
  std::cerr.rdbuf(before);
  CHECK(printed.str() == "");
}

TEST_CASE("Reading: non-manifold edges and vertices, and degenerate facets, are reported")
{
  struct Case
  {
    const char *what, *text;
    Shell_status status;
    std::vector<std::size_t> vertices, facets;
  };
  const std::vector<Case> cases = {
    { "three facets at an edge",
      "OFF\n6 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 -1 0\n5 5 5\n3 0 1 2\n3 0 1 3\n3 0 1 4\n3 2 3 5\n",
      Shell_status::NON_MANIFOLD,
      {},
      { 0, 1, 2 } },
    { "a vertex of two tetrahedra",
      "OFF\n7 8 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 2\n1 0 2\n0 1 2\n"
      "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 4 5 6\n3 4 3 5\n3 5 3 6\n3 6 3 4\n",
      Shell_status::NON_MANIFOLD,
      { 3 },
      {} },
    // Of several vertices at one position, only the first in the file is reported.
    { "three tetrahedra with vertices of their own at the origin: 2, 6 and 11",
      "OFF\n12 12 0\n1 0 0\n0 1 0\n0 0 0\n0 0 1\n-1 0 0\n0 -1 0\n0 0 0\n0 0 -1\n5 5 0\n5 6 0\n5 5 1\n0 0 0\n"
      "3 0 1 2\n3 1 0 3\n3 2 1 3\n3 0 2 3\n3 4 5 6\n3 5 4 7\n3 6 5 7\n3 4 6 7\n"
      "3 8 9 11\n3 9 8 10\n3 11 9 10\n3 8 11 10\n",
      Shell_status::NON_MANIFOLD,
      { 2 },
      {} },
    { "such a vertex after a duplicate vertex, which shifts positions when vertices are merged",
      "OFF\n10 8 0\n1 0 0\n1 0 0\n0 1 0\n0 0 0\n0 0 1\n-1 0 0\n0 -1 0\n0 0 0\n0 0 -1\n0 0 1\n"
      "3 0 2 3\n3 2 1 4\n3 3 2 9\n3 1 3 4\n3 5 6 7\n3 6 5 8\n3 7 6 8\n3 5 7 8\n",
      Shell_status::NON_MANIFOLD,
      { 3 },
      {} },
    { "a facet with two corners at one position, vertices 1 and 3",
      "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 0 0\n3 0 1 2\n3 1 3 2\n",
      Shell_status::DEGENERATE_FACET,
      {},
      { 1 } }
  };
  for(const Case& c : cases) {
    INFO(c.what);
    const Result result = read("read_offenders.off", c.text);
    CHECK(result.status == c.status);
    CHECK(result.offenders.vertices == c.vertices);
    CHECK(result.offenders.facets == c.facets);
  }
}

TEST_CASE("Reading: a non-orientable surface is rejected, and each facet at its seams is reported once, in order")
{
  // Five quadrangles form a ring; the last one is twisted.
  std::string moebius = "OFF\n10 5 0\n";
  for(int i = 0; i < 5; ++i)
    for(const char* z : { " 0\n", " 1\n" })
      moebius += std::to_string(std::cos(i * 1.2566)) + " " + std::to_string(std::sin(i * 1.2566)) + z;
  moebius += "4 0 2 3 1\n4 2 4 5 3\n4 4 6 7 5\n4 6 8 9 7\n4 8 1 0 9\n";
  // The projective plane: six vertices, each two of them connected by an edge.
  const std::string plane =
    "OFF\n6 10 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 0\n1 1 1\n"
    "3 0 1 2\n3 0 2 3\n3 0 3 4\n3 0 4 5\n3 0 5 1\n3 1 2 4\n3 2 3 5\n3 3 4 1\n3 4 5 2\n3 5 1 3\n";
  for(const std::string& text : { moebius, plane }) {
    CAPTURE(text);
    const Result result = read("read_one_sided.off", text);
    CHECK(result.status == Shell_status::NOT_ORIENTABLE);
    const std::vector<std::size_t>& facets = result.offenders.facets;
    CHECK(facets.size() > std::size_t(text == plane ? 1 : 0));
    CHECK(std::adjacent_find(facets.begin(), facets.end(), std::greater_equal<>()) == facets.end());
  }
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
