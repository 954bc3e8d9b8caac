// Bends a solid whose surface mesh has badly shaped triangles. The surface is remeshed in its shell, the remeshed solid
// is filled with tetrahedra, and nonlinear elasticity is solved on them. The one-to-one map transfers labels of held
// and moved facets to the remeshed mesh, and displacements back to all vertices of the surface. This example requires
// TetGen (AGPL) or Gmsh (GPL).
#include "Neo_hookean_solid.h"
#include "bend_ends.h"
#include "example_files.h"
#include "tetrahedralize.h"

#include <CGAL/Bspline_shell_3/Editing/remesh_in_shell.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_face_labels.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

typedef Surface Mesh;
typedef CGAL::Certified_bspline_shell_3 Shell;
typedef Neo_hookean_solid<> Solid;

int failed(const std::string& reason)
{
  std::cerr << reason << std::endl;
  return EXIT_FAILURE;
}

// Moves the vertices by the first displacements, and writes the mesh.
bool write_displaced(const char* file, Mesh& mesh, const Solid::Vectors& u)
{
  for(Mesh::Vertex_index v : mesh.vertices()) {
    const auto d = u.col(Eigen::Index(v));
    mesh.point(v) = mesh.point(v) + CGAL::Exact_predicates_inexact_constructions_kernel::Vector_3(d[0], d[1], d[2]);
  }
  return save(file, mesh);
}

int main(int argc, char** argv)
{
  std::string file;
  double edges = 20, degrees = 45;
  int element_order = 1;
  const auto code = Arguments("Usage: elastic_proxy MESH [EDGES [ANGLE [ORDER]]]\n"
                              "  EDGES: edges of the proxy along the longest side of the bounding box (default 20)\n"
                              "  ANGLE: bending angle in degrees (default 45)\n"
                              "  ORDER: order of the elements, 1 or 2 (default 1)\n"
                              "  Writes bent.ply, bent_proxy.ply and solid.vtk.\n")
                      .required(file)
                      .optional(edges)
                      .optional(degrees)
                      .optional(element_order)
                      .read(argc, argv);
  if(code) return *code;
  const double angle = degrees * std::acos(-1.) / 180;
  const Element_order order = element_order == 2 ? Element_order::QUADRATIC : Element_order::LINEAR;
  Mesh mesh;
  if(!read_mesh(file, mesh)) return EXIT_FAILURE;

  if(!CGAL::is_closed(mesh)) return failed("The mesh is open and bounds no solid: close its holes.");

  const Shell shell = CGAL::certified_bspline_shell_3(mesh);
  if(!shell || !shell.is_certified()) return failed(shell.message());
  Mesh proxy = mesh;
  auto sharp = proxy.add_property_map<Mesh::Edge_index, bool>("e:sharp", false).first;
  CGAL::Polygon_mesh_processing::detect_sharp_edges(proxy, 60, sharp);
  const auto report = BS::remesh_in_shell(proxy, shell.report().unit / edges, shell,
                                          BS::parameters::edge_is_constrained_map(sharp));
  if(!report) return failed(report.message());
  proxy.collect_garbage();
  const BS::Shell_map_3<Shell, Mesh> map(shell, mesh, proxy);

  const Bend motion(mesh, angle);
  auto ends = mesh.add_property_map<Mesh::Face_index, End>("f:end", End::NONE).first;
  auto ends_of_proxy = proxy.add_property_map<Mesh::Face_index, End>("f:end", End::NONE).first;
  motion.label_ends(mesh, ends);
  const BS::Transfer_report labels = BS::transfer_face_labels(map, ends, ends_of_proxy);
  if(!labels)
    return failed(std::to_string(labels.failures.size())
                  + " facets have no label: " + message(labels.failures[0].second));

  Tetrahedra tetrahedra;
#ifdef HAVE_TETGEN
  tetrahedra = tetrahedralize_with_TetGen(proxy);
#else
  tetrahedra = tetrahedralize_with_Gmsh(proxy);
#endif
  if(!tetrahedra) return failed(tetrahedra.error);
  std::cout << "mesh: " << mesh.number_of_faces() << " facets; proxy: " << proxy.number_of_faces()
            << " facets, the border of " << tetrahedra.cells.size() << " tetrahedra\n";

  std::vector<Eigen::Vector3d> points;
  for(const auto& p : tetrahedra.points) points.push_back(to_Eigen(p));
  const Solid solid(points, tetrahedra.cells, order, lame_parameters(1, 0.3));
  const Solid::Result result = bend(solid, proxy, ends_of_proxy, motion, 2);
  std::cout << message(result.status) << " " << result.iterations << " iterations in " << result.load_steps
            << " load steps; smallest Jacobian determinant: " << result.least_jacobian << "\n";
  if(!result) return EXIT_FAILURE;

  // Each vertex of the surface gets the displacement of its image on the remeshed mesh.
  Solid::Vectors u(3, mesh.number_of_vertices());
  for(Mesh::Vertex_index v : mesh.vertices()) {
    const auto image = map(v);
    if(!image) return failed(std::string("A vertex has no image: ") + message(image.status));
    u.col(Eigen::Index(v)) = solid.displacement(result.displacements, corners(proxy, image.location.first),
                                                image.location.second);
  }
  std::cout << "maximum displacement: " << u.colwise().norm().maxCoeff() / motion.length()
            << " of the longest side of the bounding box\n";
  if(!write_VTK("solid.vtk", tetrahedra, result.displacements, "displacement") || !write_displaced("bent.ply", mesh, u)
     || !write_displaced("bent_proxy.ply", proxy, result.displacements))
    return failed(
      "Not all of bent.ply, bent_proxy.ply and solid.vtk were written: check the folder and the free space.");
  return EXIT_SUCCESS;
}
