// Transfers texture coordinates with seams to another mesh in the same shell. Writes both meshes with their texture
// coordinates as OBJ files.
#include "second_mesh.h"

#include <CGAL/Bspline_shell_3/Transfer/transfer_corner_attribute.h>

#include <algorithm>
#include <cstdlib>

typedef Mesh::Property_map<Mesh::Halfedge_index, Kernel::Point_2> Texture_coordinates;

// Wraps a texture around the z-axis, from 0 to 1. A facet that crosses the seam gets the coordinates of one side.
void wrap_around_axis(const Mesh& mesh, Texture_coordinates uv)
{
  for(Mesh::Face_index f : mesh.faces()) {
    double first = 0;
    bool has_first = false;
    for(Mesh::Halfedge_index h : mesh.halfedges_around_face(mesh.halfedge(f))) {
      const Kernel::Point_3& p = mesh.point(mesh.target(h));
      double u = std::atan2(p.y(), p.x()) / (2 * CGAL_PI) + 0.5;
      if(has_first) u += std::nearbyint(first - u);
      else first = u;
      has_first = true;
      uv[h] = Kernel::Point_2(u, p.z());
    }
  }
}

bool write(const char* name, const Mesh& mesh, Texture_coordinates uv)
{
  return write_result(name, [&](std::ostream& out) {
    out.precision(17);
    for(Mesh::Vertex_index v : mesh.vertices()) out << "v " << mesh.point(v) << "\n";
    std::size_t n = 0;
    for(Mesh::Face_index f : mesh.faces()) {
      const auto corners = mesh.halfedges_around_face(mesh.halfedge(f));
      for(Mesh::Halfedge_index h : corners) out << "vt " << uv[h] << "\n";
      out << "f";
      for(Mesh::Halfedge_index h : corners) out << " " << std::size_t(mesh.target(h)) + 1 << "/" << ++n;
      out << "\n";
    }
    return bool(out);
  });
}

// Returns the longest edge in the texture.
double longest_edge(const Mesh& mesh, Texture_coordinates uv)
{
  double longest = 0;
  for(Mesh::Face_index f : mesh.faces())
    for(Mesh::Halfedge_index h : mesh.halfedges_around_face(mesh.halfedge(f)))
      longest = (std::max)(longest, CGAL::squared_distance(uv[h], uv[mesh.next(h)]));
  return std::sqrt(longest);
}

int main(int argc, char** argv)
{
  Mesh mesh, moved;
  Shell shell;
  if(const auto code = begin_example(argc, argv, mesh, shell, moved)) return *code;

  Texture_coordinates uv = mesh.add_property_map<Mesh::Halfedge_index, Kernel::Point_2>("h:uv").first,
                      uv_on_moved = moved.add_property_map<Mesh::Halfedge_index, Kernel::Point_2>("h:uv").first;
  wrap_around_axis(mesh, uv);
  const BS::Transfer_report report = BS::transfer_corner_attribute(BS::Shell_map_3<Shell, Mesh>(shell, mesh, moved), uv,
                                                                   uv_on_moved);
  if(!is_complete(report)) return EXIT_FAILURE;
  std::cout << report.transferred << " facets have texture coordinates; " << report.facets_across_seams.size()
            << " of them lie across seams.\nlongest edge in the texture: " << longest_edge(mesh, uv) << " before, "
            << longest_edge(moved, uv_on_moved) << " after" << std::endl;
  return write("texture_before.obj", mesh, uv) && write("texture_after.obj", moved, uv_on_moved) ? EXIT_SUCCESS
                                                                                                 : EXIT_FAILURE;
}
