// The curves in which a horizontal plane meets a mesh.
#ifndef HORIZONTAL_SECTION_H
#define HORIZONTAL_SECTION_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/locate.h>
#include <CGAL/Surface_mesh.h>

#include <vector>

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
typedef std::vector<CGAL::Polygon_mesh_processing::Face_location<Mesh, double> > Polyline;

// Returns the closed polylines in which a horizontal plane that contains no vertex meets a closed mesh.
inline std::vector<Polyline> horizontal_section(const Mesh& mesh, double z)
{
  const auto is_above = [&](Mesh::Vertex_index v) { return mesh.point(v).z() > z; };
  std::vector<Polyline> result;
  std::vector<char> is_done(mesh.num_halfedges(), 0);
  for(Mesh::Halfedge_index h : mesh.halfedges())
    if(!is_done[h] && !is_above(mesh.source(h)) && is_above(mesh.target(h))) {
      result.emplace_back();
      while(!is_done[h]) {
        is_done[h] = 1;
        const double a = mesh.point(mesh.source(h)).z() - z, b = mesh.point(mesh.target(h)).z() - z;
        result.back().push_back(CGAL::Polygon_mesh_processing::locate_on_halfedge<double>(h, a / (a - b), mesh));
        h = mesh.next(h); // the facet's other edge with ends on both sides
        if(is_above(mesh.source(h)) == is_above(mesh.target(h))) h = mesh.next(h);
        h = mesh.opposite(h);
      }
      result.back().push_back(result.back().front());
    }
  return result;
}

#endif // HORIZONTAL_SECTION_H
