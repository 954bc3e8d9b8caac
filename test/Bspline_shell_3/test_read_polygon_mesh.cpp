// read_polygon_mesh.h, write_file.h: a mesh is read whole or refused for the right reason, at the right places of its file;
// a file is written whole or not at all.
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>
#include <CGAL/Bspline_shell_3/IO/write_file.h>
#include <CGAL/IO/STL.h>

#include <fstream>
#include <iterator>

using namespace CGAL::Bspline_shells;

namespace {

// a file that is gone when the test ends
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

} // namespace

TEST_CASE("reading: a mesh is read whole, with shared vertices also from STL")
{
  Mesh cube = box(Point_3(0, 0, 0), Point_3(1, 1, 1));
  for(bool binary : { false, true }) {
    const Temporary_file file("read_cube.stl");
    {
      std::ofstream out(file.name, std::ios::binary);
      if(binary) CGAL::IO::set_binary_mode(out);
      REQUIRE(CGAL::IO::write_STL(out, cube));
    }
    if(binary) {      // the trap of the format: a binary file whose header begins like a text file
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

TEST_CASE("reading: a facet that faces the wrong way is turned round")
{
  Offending_simplices offenders;
  const Temporary_file file("read_turned.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
  Mesh mesh;
  REQUIRE(read_polygon_mesh(file.name, mesh, offenders) == Shell_status::SUCCESS);
  CHECK(CGAL::is_closed(mesh));
  CHECK(mesh.number_of_faces() == 4);
}

TEST_CASE("reading: what is no mesh has a status, and the mesh stays as it was")
{
  Offending_simplices offenders;
  Mesh mesh = box(Point_3(0, 0, 0), Point_3(1, 1, 1));
  CHECK(read_polygon_mesh("no_such_file.off", mesh, offenders) == Shell_status::UNREADABLE_FILE);
  CHECK(mesh.number_of_faces() == 12);
  CHECK(read("read_bad.off", "this is no mesh", offenders) == Shell_status::UNREADABLE_FILE);
  CHECK(read("read_bad.xyzzy", "OFF\n0 0 0\n", offenders) == Shell_status::UNREADABLE_FILE);
  CHECK(read("read_bad.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n", offenders) == Shell_status::UNREADABLE_FILE);
  CHECK(read("read_bad.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", offenders) != Shell_status::SUCCESS);
  CHECK(read("read_bad.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", offenders) == Shell_status::EMPTY_MESH);
  CHECK(read("read_bad.off", "OFF\n0 0 0\n", offenders) == Shell_status::EMPTY_MESH);
}

TEST_CASE("reading: an STL file without facets is empty if it says so, and unreadable otherwise")
{
  Offending_simplices offenders;
  const std::string header(80, ' '), spaces(200, ' '), zero(4, '\0');
  for(const std::string& text : { std::string("this is no mesh"), std::string("solid ground\n"), std::string("\n"), spaces,
                                  std::string("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"),
                                  "this is no mesh" + spaces, "solid ground" + spaces, header, header + "\1" }) {
    CAPTURE(text);
    CHECK(read("read_none.stl", text, offenders) == Shell_status::UNREADABLE_FILE);
    CHECK(read("read_none.STL", text, offenders) == Shell_status::UNREADABLE_FILE);
  }
  for(const std::string& text : { std::string("solid none\nendsolid none\n"), "none" + header.substr(4) + zero }) {
    CAPTURE(text);
    CHECK(read("read_empty.stl", text, offenders) == Shell_status::EMPTY_MESH);
  }
}

TEST_CASE("reading: three facets at an edge are not manifold, and named")
{
  Offending_simplices offenders;
  const Shell_status status = read("read_fan.off",
    "OFF\n6 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 -1 0\n5 5 5\n3 0 1 2\n3 0 1 3\n3 0 1 4\n3 2 3 5\n", offenders);
  CHECK(status == Shell_status::NON_MANIFOLD);
  CHECK(offenders.facets == std::vector<std::size_t>{ 0, 1, 2 });
}

TEST_CASE("reading: a vertex that joins two surfaces is not manifold, and named")
{
  // two tetrahedra with the common vertex 3
  Offending_simplices offenders;
  const Shell_status status = read("read_pinched.off",
    "OFF\n7 8 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 2\n1 0 2\n0 1 2\n"
    "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 4 5 6\n3 4 3 5\n3 5 3 6\n3 6 3 4\n", offenders);
  CHECK(status == Shell_status::NON_MANIFOLD);
  CHECK(offenders.vertices == std::vector<std::size_t>{ 3 });
}

TEST_CASE("reading: of vertices at one position, the first in the file is named, once")
{
  // three tetrahedra, each with vertices of its own, that meet at the origin: vertices 2, 6 and 11
  Offending_simplices offenders;
  const Shell_status status = read("read_repeated.off",
    "OFF\n12 12 0\n1 0 0\n0 1 0\n0 0 0\n0 0 1\n-1 0 0\n0 -1 0\n0 0 0\n0 0 -1\n5 5 0\n5 6 0\n5 5 1\n0 0 0\n"
    "3 0 1 2\n3 1 0 3\n3 2 1 3\n3 0 2 3\n3 4 5 6\n3 5 4 7\n3 6 5 7\n3 4 6 7\n"
    "3 8 9 11\n3 9 8 10\n3 11 9 10\n3 8 11 10\n", offenders);
  CHECK(status == Shell_status::NON_MANIFOLD);
  CHECK(offenders.vertices == std::vector<std::size_t>{ 2 });
  CHECK(offenders.facets.empty());

  // the same after a vertex that is there twice, so that positions in the file and after merging differ
  CHECK(read("read_repeated.off",
    "OFF\n10 8 0\n1 0 0\n1 0 0\n0 1 0\n0 0 0\n0 0 1\n-1 0 0\n0 -1 0\n0 0 0\n0 0 -1\n0 0 1\n"
    "3 0 2 3\n3 2 1 4\n3 3 2 9\n3 1 3 4\n3 5 6 7\n3 6 5 8\n3 7 6 8\n3 5 7 8\n", offenders) == Shell_status::NON_MANIFOLD);
  CHECK(offenders.vertices == std::vector<std::size_t>{ 3 });
}

TEST_CASE("reading: a Moebius band is not orientable")
{
  // five quadrangles in a ring, the last one joined with a twist
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

TEST_CASE("reading: each facet at the seams of a one-sided surface is named once, in ascending order")
{
  // the projective plane: six vertices, and each two of them have an edge
  Offending_simplices offenders;
  CHECK(read("read_projective.off",
    "OFF\n6 10 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 0\n1 1 1\n"
    "3 0 1 2\n3 0 2 3\n3 0 3 4\n3 0 4 5\n3 0 5 1\n3 1 2 4\n3 2 3 5\n3 3 4 1\n3 4 5 2\n3 5 1 3\n", offenders)
        == Shell_status::NOT_ORIENTABLE);
  REQUIRE(offenders.facets.size() > 1);
  for(std::size_t i = 1; i < offenders.facets.size(); ++i) CHECK(offenders.facets[i - 1] < offenders.facets[i]);
}

TEST_CASE("reading: a facet with a repeated vertex is degenerate, and named")
{
  Offending_simplices offenders;
  // vertices 1 and 3 are at the same position
  CHECK(read("read_degenerate.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 0 0\n3 0 1 2\n3 1 3 2\n", offenders)
        == Shell_status::DEGENERATE_FACET);
  CHECK(offenders.facets == std::vector<std::size_t>{ 1 });
}

TEST_CASE("writing: a file appears complete or not at all")
{
  const Temporary_file file("write_test.txt", "old");
  CHECK_FALSE(write_file(file.name, [](std::ostream& out) { out << "half"; return false; }));
  CHECK(contents(file.name) == "old");
  CHECK(contents(file.name + ".part").empty());
  CHECK(write_file(file.name, [](std::ostream& out) { out << "new"; return true; }));
  CHECK(contents(file.name) == "new");
  CHECK_FALSE(write_file("no_such_folder/file", [](std::ostream& out) { out << "new"; return true; }));
}
