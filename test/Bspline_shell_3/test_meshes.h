// Meshes for tests: generated ones with known properties, and those of libcgal-demo.
#ifndef TEST_MESHES_H
#define TEST_MESHES_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <catch2/catch.hpp>

#include <array>
#include <functional>
#include <string>
#include <vector>

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef Kernel::Point_3 Point_3;
typedef Kernel::Vector_3 Vector_3;
typedef CGAL::Surface_mesh<Point_3> Mesh;

// Returns a mesh of libcgal-demo.
Mesh demo_mesh(const std::string& name);

// Splits each triangle into four at the midpoints of its edges.
Mesh subdivided(const Mesh& mesh);

// Returns a regular icosahedron, subdivided and projected to the sphere.
Mesh sphere(int subdivisions, double radius = 1, const Point_3& center = CGAL::ORIGIN);

// Returns a sphere of slices around its axis, in `turns` turns. Triangles are thinner closer to the poles, which are
// the first two vertices. With two turns, the sphere is covered twice: all facets face outwards, but the fans at the
// poles wind twice.
Mesh sliced_sphere(int slices, int rings, int turns = 1);

// Returns an axis-parallel box, whose six sides are quadrangles or pairs of triangles.
Mesh box(const Point_3& a, const Point_3& b, bool triangulated = true);

// Returns a torus around the z-axis.
Mesh torus(double major, double minor, int around, int across);

// Returns a pyramid over a regular polygon in the unit circle. Its apex is the first vertex.
Mesh pyramid(int sides, double height);

// Returns a double pyramid over a polygon in which every `step`-th corner of a regular one follows. The fans at its
// apices, which are the first two vertices, wind `step` times.
Mesh bipyramid(int corners, int step, double height = 1);

// Returns a block of length 1, width 0.5, and height 0.4 with a V-shaped groove across its top. The sides of the groove
// form the given angle, in degrees. If the depth is negative, there is a fin of this height instead.
Mesh grooved_block(double angle, double depth);

// Returns the boundary of a union of unit cubes, given by their least corners. No two cubes may meet only in an edge or
// a vertex.
Mesh cubes(const std::vector<std::array<int, 3> >& corners);

// Returns the boundary of cubes around (1, 1, 1), each beside the previous one. The six squares at (1, 1, 1) face no
// common direction. With five cubes, so do the ones at (1, 1, 2).
Mesh screw(int number_of_cubes = 4);

// Returns two unit balls around the x-axis, with centers at -1.5 and 1.5, joined by a neck.
Mesh dumbbell(double neck_radius, int around = 16);

// Returns whether both meshes have the same points and the same facets, in the same order.
bool is_equal(const Mesh& a, const Mesh& b);

// Returns a mesh with the components of both meshes, first those of `a`.
Mesh joined(Mesh a, const Mesh& b);

// Returns the mesh with all facets reversed.
Mesh reversed(Mesh mesh);

// Returns the mesh with each point moved to its image.
Mesh mapped(Mesh mesh, const std::function<Point_3(const Point_3&)>& map);

// Removes the triangles whose centroids satisfy the predicate.
void remove_facets(Mesh& mesh, const std::function<bool(const Point_3&)>& is_removed);

// Returns the corners of a triangle.
std::array<Point_3, 3> corners(const Mesh& mesh, Mesh::Face_index f);

Point_3 centroid(const Mesh& mesh, Mesh::Face_index f);

// Returns the vertices around a vertex, counterclockwise.
std::vector<Point_3> link_of(const Mesh& mesh, Mesh::Vertex_index v);

double distance(const Point_3& p, const Point_3& q);

// Returns first, ..., last, in equal steps.
std::vector<double> steps(double first, double last, int number);

// Returns a rectangle at height z(x, y), facing upwards, cut at the given coordinates.
template <typename Height>
Mesh sheet(const std::vector<double>& xs, const std::vector<double>& ys, const Height& z)
{
  Mesh mesh;
  std::vector<Mesh::Vertex_index> v;
  for(double x : xs)
    for(double y : ys) v.push_back(mesh.add_vertex(Point_3(x, y, z(x, y))));
  const std::size_t n = ys.size();
  for(std::size_t i = 0; i + 1 < xs.size(); ++i)
    for(std::size_t j = 0; j + 1 < n; ++j) {
      mesh.add_face(v[i * n + j], v[(i + 1) * n + j], v[(i + 1) * n + j + 1]);
      mesh.add_face(v[i * n + j], v[(i + 1) * n + j + 1], v[i * n + j + 1]);
    }
  return mesh;
}

inline Mesh sheet(const std::vector<double>& xs, const std::vector<double>& ys, double z = 0)
{
  return sheet(xs, ys, [z](double, double) { return z; });
}

#endif // TEST_MESHES_H
