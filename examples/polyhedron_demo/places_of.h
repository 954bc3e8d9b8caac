// The places at which a shell could not be built or certified, or a mesh was not edited.
#ifndef POLYHEDRON_DEMO_PLACES_OF_H
#define POLYHEDRON_DEMO_PLACES_OF_H

#include <CGAL/Bspline_shell_3/Editing/Edit_report.h>
#include <CGAL/Bspline_shell_3/Shell/Shell_report.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/centroid.h>

#include <cstddef>
#include <vector>

// Appends the centroids of the facets and the vertices, which have positions in `faces(mesh)` and `vertices(mesh)`.
template <typename Mesh>
void append_places(const CGAL::Bspline_shells::Offending_simplices& simplices, const Mesh& mesh,
                   std::vector<typename Mesh::Point>& places)
{
  const std::vector<typename Mesh::Face_index> facets(faces(mesh).begin(), faces(mesh).end());
  const std::vector<typename Mesh::Vertex_index> all_vertices(vertices(mesh).begin(), vertices(mesh).end());
  for(std::size_t n : simplices.facets) {
    std::vector<typename Mesh::Point> corners;
    for(auto v : vertices_around_face(mesh.halfedge(facets[n]), mesh)) corners.push_back(mesh.point(v));
    places.push_back(CGAL::centroid(corners.begin(), corners.end(), CGAL::Dimension_tag<0>()));
  }
  for(std::size_t n : simplices.vertices) places.push_back(mesh.point(all_vertices[n]));
}

// Appends the points of obstacles or witnesses.
template <typename Range, typename Point>
void append_places(const Range& range, std::vector<Point>& places)
{
  for(const auto& place : range) places.emplace_back(place.point[0], place.point[1], place.point[2]);
}

template <typename Mesh>
std::vector<typename Mesh::Point> places_of(const CGAL::Bspline_shells::Shell_report& report, const Mesh& mesh)
{
  std::vector<typename Mesh::Point> places;
  append_places(report.offending_simplices, mesh, places);
  append_places(report.obstacles, places);
  if(places.empty()) append_places(report.certificate.witnesses, places);
  return places;
}

template <typename Mesh>
std::vector<typename Mesh::Point> places_of(const CGAL::Bspline_shells::Edit_report& report, const Mesh& mesh)
{
  std::vector<typename Mesh::Point> places;
  append_places(report.offending_simplices, mesh, places);
  append_places(report.certificate.witnesses, places);
  return places;
}

#endif // POLYHEDRON_DEMO_PLACES_OF_H
