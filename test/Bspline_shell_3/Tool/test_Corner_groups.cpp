#include <Carry/Corner_groups.h>

#include <catch2/catch.hpp>

#include <limits>

namespace test_Corner_groups {

using namespace Tool;

// Two triangles with a common edge, as a mesh and as a model with a value at each corner.
struct Two_triangles
{
  Two_triangles(std::vector<double> values, Element element, Kind kind = Kind::REAL)
  {
    model.soup.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
    model.soup.polygons = { { 0, 1, 2 }, { 0, 2, 3 } };
    model.attributes = { { "a", element, kind, Number_type::FLOAT64, { "a" }, std::move(values), {} } };
    std::vector<Mesh::Vertex_index> v;
    for(const auto& p : model.soup.points) v.push_back(mesh.add_vertex(p));
    mesh.add_face(v[0], v[1], v[2]);
    mesh.add_face(v[0], v[2], v[3]);
  }
  std::size_t number_of_lines() const
  {
    std::size_t lines = 0;
    for(char is_line : find_lines(model, mesh, Mesh_origins(model, mesh))) lines += is_line;
    return lines;
  }
  std::size_t number_with_seams() const { return attributes_with_seams(model, mesh, Mesh_origins(model, mesh)).size(); }

  Model model;
  Mesh mesh;
};

TEST_CASE("Mesh_origins: facets belong to the polygons with their corners")
{
  const Two_triangles t({ 0, 1, 2, 3 }, Element::POINT);
  const Mesh_origins origins(t.model, t.mesh);
  const Mixer mixer(t.model);
  for(auto f : t.mesh.faces()) {
    CHECK(origins.polygon_of(f) == std::size_t(f));
    for(auto h : t.mesh.halfedges_around_face(t.mesh.halfedge(f)))
      CHECK(mixer(t.model.attributes[0], origins.at(h)) == std::vector<double>{ double(t.mesh.target(h)) });
  }
}

TEST_CASE("Mesh_origins: new vertices get interpolated values of the nearest polygon")
{
  Two_triangles t({ 0, 1, 2, 1 }, Element::POINT); // x + y
  for(auto v : t.mesh.vertices()) {
    const auto& p = t.mesh.point(v);
    t.mesh.point(v) = Mesh::Point(0.25 + p.x() / 2, 0.1 + p.y() / 2, 0);
  }
  const Mesh_origins origins(t.model, t.mesh);
  const Mixer mixer(t.model);
  for(auto f : t.mesh.faces())
    for(auto h : t.mesh.halfedges_around_face(t.mesh.halfedge(f))) {
      const auto& p = t.mesh.point(t.mesh.target(h));
      if(p.x() < p.y()) continue;
      if(f == Mesh::Face_index(0)) CHECK(mixer(t.model.attributes[0], origins.at(h))[0] == Approx(p.x() + p.y()));
    }
}

TEST_CASE("find_lines: an edge is a seam if and only if a corner has another value on its other side")
{
  CHECK(Two_triangles({ 1, 2, 3, 1, 3, 4 }, Element::CORNER).number_of_lines() == 0);
  CHECK(Two_triangles({ 1, 2, 3, 1, 5, 4 }, Element::CORNER).number_of_lines() == 1);
  CHECK(Two_triangles({ 1, 2, 3, 9, 3, 4 }, Element::CORNER).number_of_lines() == 1);
  CHECK(Two_triangles({ 1, 2, 3, 1, 5, 4 }, Element::CORNER).number_with_seams() == 1);
}

TEST_CASE("find_lines: corners without a value are equal to each other, and to no others")
{
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  CHECK(Two_triangles({ none, none, none, none, none, none }, Element::CORNER).number_of_lines() == 0);
  CHECK(Two_triangles({ 1, 2, 3, none, none, none }, Element::CORNER).number_of_lines() == 1);
}

TEST_CASE("find_lines: edges between labels are lines, and edges between real numbers are not")
{
  CHECK(Two_triangles({ 1, 2 }, Element::POLYGON, Kind::LABEL).number_of_lines() == 1);
  CHECK(Two_triangles({ 2, 2 }, Element::POLYGON, Kind::LABEL).number_of_lines() == 0);
  CHECK(Two_triangles({ 1, 2 }, Element::POLYGON, Kind::REAL).number_of_lines() == 0);
}

} // namespace test_Corner_groups
