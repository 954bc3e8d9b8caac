// Facet labels that are preserved by CGAL's Boolean operations, and the curve between facets with different labels.
#ifndef OPERAND_LABELS_H
#define OPERAND_LABELS_H

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/transform.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <string>

namespace PMP = CGAL::Polygon_mesh_processing;
typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
typedef Mesh::Property_map<Mesh::Face_index, int> Labels;
typedef Mesh::Property_map<Mesh::Edge_index, bool> Curve;

enum class Boolean
{
  UNION,
  INTERSECTION,
  DIFFERENCE
};

inline std::optional<Boolean> operation_of(const std::string& name)
{
  if(name == "union") return Boolean::UNION;
  if(name == "intersection") return Boolean::INTERSECTION;
  if(name == "difference") return Boolean::DIFFERENCE;
  return std::nullopt;
}

// Returns the labels of facets; new facets have the label -1.
inline Labels labels_of(Mesh& mesh)
{
  return mesh.add_property_map<Mesh::Face_index, int>("f:label", -1).first;
}
inline Curve curve_of(Mesh& mesh)
{
  return mesh.add_property_map<Mesh::Edge_index, bool>("e:curve", false).first;
}

inline void set_labels(Mesh& mesh, int label)
{
  const Labels labels = labels_of(mesh);
  for(Mesh::Face_index f : mesh.faces()) labels[f] = label;
}

// Copies the label of a facet to its parts, and to their copies in the result.
struct Label_visitor : PMP::Corefinement::Default_visitor<Mesh>
{
  void before_subface_creations(Mesh::Face_index f, Mesh& mesh) { label = labels.at(&mesh)[f]; }
  void after_subface_created(Mesh::Face_index f, Mesh& mesh) { labels.at(&mesh)[f] = label; }
  void after_face_copy(Mesh::Face_index from, const Mesh& mesh, Mesh::Face_index to, Mesh& result)
  {
    labels.at(&result)[to] = labels.at(&mesh)[from];
  }

  std::map<const Mesh*, Labels> labels;
  int label = 0; // the label of the facet being split
};

// Returns whether a mesh is a valid operand of CGAL's Boolean operations.
inline bool is_operand(const Mesh& mesh)
{
  return CGAL::is_triangle_mesh(mesh) && CGAL::is_closed(mesh) && !PMP::does_self_intersect(mesh)
         && PMP::does_bound_a_volume(mesh);
}

// Returns whether the result is a manifold. Each of its facets has the label of the facet of which it is a part.
inline bool compute(Boolean operation, Mesh first, Mesh second, Mesh& result)
{
  Label_visitor visitor;
  for(Mesh* mesh : { &first, &second, &result }) visitor.labels[mesh] = labels_of(*mesh);
  const auto np = CGAL::parameters::visitor(visitor);
  if(operation == Boolean::UNION) return PMP::corefine_and_compute_union(first, second, result, np);
  if(operation == Boolean::INTERSECTION) return PMP::corefine_and_compute_intersection(first, second, result, np);
  return PMP::corefine_and_compute_difference(first, second, result, np);
}

// Marks the edges between facets with different labels, and returns their number.
inline std::size_t mark_curve(const Mesh& mesh, Labels labels, Curve curve)
{
  std::size_t number = 0;
  for(Mesh::Edge_index e : mesh.edges()) {
    curve[e] = labels[mesh.face(mesh.halfedge(e, 0))] != labels[mesh.face(mesh.halfedge(e, 1))];
    number += curve[e] ? 1 : 0;
  }
  return number;
}

// Scales, rotates, and translates a mesh such that it is as large as the first one, and their bounding boxes intersect.
// Axis-parallel facets of the two meshes are usually not coplanar.
inline void place(Mesh& mesh, const Mesh& first)
{
  const CGAL::Bbox_3 box = PMP::bbox(mesh), other = PMP::bbox(first);
  const auto side = [](const CGAL::Bbox_3& b, int axis) { return (b.max)(axis) - (b.min)(axis); };
  const auto middle = [](const CGAL::Bbox_3& b, int axis) { return ((b.max)(axis) + (b.min)(axis)) / 2; };
  const auto longest = [&](const CGAL::Bbox_3& b) { return (std::max)({ side(b, 0), side(b, 1), side(b, 2) }); };
  const double s = longest(other) / longest(box);
  // rotated by 90 degrees about the z-axis
  PMP::transform(Kernel::Aff_transformation_3(0, -s, 0, middle(other, 0) + s * middle(box, 1) + 0.31 * side(other, 0),
                                              s, 0, 0, middle(other, 1) - s * middle(box, 0) + 0.13 * side(other, 1), 0,
                                              0, s, middle(other, 2) - s * middle(box, 2) + 0.17 * side(other, 2)),
                 mesh);
}

#endif // OPERAND_LABELS_H
