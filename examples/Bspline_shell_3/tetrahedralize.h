// Fills a closed mesh with tetrahedra whose boundary triangles are those of the mesh: by TetGen if HAVE_TETGEN is
// defined, or by Gmsh if HAVE_GMSH is defined.
//
// The licenses of these third-party libraries apply to every program that is linked with them. TetGen is under the
// AGPL, version 3 (Debian: libtet1.5-dev), Gmsh under the GPL, version 2 or later (Debian: libgmsh-dev).
#ifndef TETRAHEDRALIZE_H
#define TETRAHEDRALIZE_H

#include <CGAL/Bspline_shell_3/IO/write_file.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#ifdef HAVE_TETGEN
#define TETLIBRARY
#include <tetgen.h>
#endif
#ifdef HAVE_GMSH
#include <gmsh.h>
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <exception>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

struct Tetrahedra
{
  typedef CGAL::Exact_predicates_inexact_constructions_kernel::Point_3 Point;

  std::vector<Point> points;                      // the first ones are those of the mesh, in its order
  std::vector<std::array<std::size_t, 4> > cells; // positively oriented; empty after an error
  std::string error;                              // the error, or why the boundary is not the mesh

  explicit operator bool() const { return error.empty(); }
};

typedef CGAL::Surface_mesh<Tetrahedra::Point> Surface;

// Returns whether the boundary facets of the tetrahedra are those of the mesh, with the same orientation, and its
// points are the first points, bit for bit. For meshes with cavities, this is false: both generators fill cavities.
inline bool conforms(const Tetrahedra& tetrahedra, const Surface& mesh)
{
  typedef std::array<std::size_t, 3> Facet;
  const auto from_least = [](Facet f) {
    std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
    return f;
  };
  // An inner facet belongs to two tetrahedra, with opposite orientations. No facet may occur twice with the same
  // orientation.
  std::set<Facet> border;
  for(const auto& [a, b, c, d] : tetrahedra.cells)
    for(const Facet& f : { Facet{ a, c, b }, Facet{ a, b, d }, Facet{ b, c, d }, Facet{ a, d, c } })
      if(border.erase(from_least({ f[0], f[2], f[1] })) == 0 && !border.insert(from_least(f)).second) return false;
  for(Surface::Face_index f : mesh.faces()) {
    const Surface::Halfedge_index h = mesh.halfedge(f);
    if(border.erase(from_least({ mesh.source(h), mesh.target(h), mesh.target(mesh.next(h)) })) == 0) return false;
  }
  return border.empty() && tetrahedra.points.size() >= mesh.number_of_vertices()
         && std::equal(mesh.points().begin(), mesh.points().end(), tetrahedra.points.begin());
}

// Writes an unstructured grid of VTK, as text, with a vector at each point.
template <typename Vectors>
bool write_VTK(const std::string& file, const Tetrahedra& tetrahedra, const Vectors& vectors, const std::string& name)
{
  return CGAL::Bspline_shells::write_file(file, [&](std::ostream& out) {
    out.precision(17);
    out << "# vtk DataFile Version 3.0\ntetrahedra\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS "
        << tetrahedra.points.size() << " double\n";
    for(const Tetrahedra::Point& p : tetrahedra.points) out << p << "\n";
    out << "CELLS " << tetrahedra.cells.size() << " " << 5 * tetrahedra.cells.size() << "\n";
    for(const auto& [a, b, c, d] : tetrahedra.cells) out << "4 " << a << " " << b << " " << c << " " << d << "\n";
    out << "CELL_TYPES " << tetrahedra.cells.size() << "\n";
    for(std::size_t n = 0; n < tetrahedra.cells.size(); ++n) out << "10\n";
    out << "POINT_DATA " << tetrahedra.points.size() << "\nVECTORS " << name << " double\n";
    for(std::size_t n = 0; n < tetrahedra.points.size(); ++n) out << vectors.col(n).transpose() << "\n";
    return bool(out);
  });
}

// Orients the tetrahedra, and checks that they conform to the mesh.
inline Tetrahedra checked(Tetrahedra tetrahedra, const Surface& mesh)
{
  for(auto& [a, b, c, d] : tetrahedra.cells) {
    const auto& p = tetrahedra.points;
    if(CGAL::orientation(p[a], p[b], p[c], p[d]) == CGAL::NEGATIVE) std::swap(c, d);
  }
  if(tetrahedra.error.empty() && !conforms(tetrahedra, mesh))
    tetrahedra.error = "The border of the tetrahedra differs from the mesh.";
  return tetrahedra;
}

#ifdef HAVE_TETGEN
// \pre The mesh is closed, without self-intersections and without removed elements.
inline Tetrahedra tetrahedralize_with_TetGen(const Surface& mesh)
{
  Tetrahedra result;
  tetgenio in, out;
  in.numberofpoints = int(mesh.number_of_vertices());
  in.pointlist = new REAL[3 * mesh.number_of_vertices()]; // freed by TetGen, like all arrays below
  REAL* coordinate = in.pointlist;
  for(const Tetrahedra::Point& p : mesh.points())
    for(int i = 0; i < 3; ++i) *coordinate++ = p[i];
  in.numberoffacets = int(mesh.number_of_faces());
  in.facetlist = new tetgenio::facet[mesh.number_of_faces()];
  tetgenio::facet* facet = in.facetlist;
  for(Surface::Face_index f : mesh.faces()) {
    tetgenio::init(facet);
    facet->numberofpolygons = 1;
    facet->polygonlist = new tetgenio::polygon[1];
    tetgenio::init(facet->polygonlist);
    facet->polygonlist->numberofvertices = 3;
    int* corner = facet->polygonlist->vertexlist = new int[3];
    for(Surface::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f))) *corner++ = int(v);
    ++facet;
  }
  try {
    // p: keep this mesh; Y: no points on its triangles; q: bound the ratio of radius to shortest edge; Q: no output
    std::string switches = "pYq1.4Q";
    tetrahedralize(switches.data(), &in, &out);
  } catch(int code) { // TetGen throws nothing else
    result.error = "TetGen failed with code " + std::to_string(code) + ".";
    return result;
  }
  for(int n = 0; n < out.numberofpoints; ++n)
    result.points.emplace_back(out.pointlist[3 * n], out.pointlist[3 * n + 1], out.pointlist[3 * n + 2]);
  for(int n = 0; n < out.numberoftetrahedra; ++n) {
    const int* t = out.tetrahedronlist + std::ptrdiff_t(n) * out.numberofcorners;
    result.cells.push_back({ std::size_t(t[0]), std::size_t(t[1]), std::size_t(t[2]), std::size_t(t[3]) });
  }
  return checked(std::move(result), mesh);
}
#endif

#ifdef HAVE_GMSH
// \pre The mesh is closed, without self-intersections and without removed elements.
inline Tetrahedra tetrahedralize_with_Gmsh(const Surface& mesh)
{
  Tetrahedra result;
  gmsh::initialize();
  try {
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("Mesh.Algorithm3D", 1); // Delaunay: keeps the surface
    gmsh::model::add("solid");
    std::vector<std::size_t> nodes, corners; // numbered from 1
    std::vector<double> coordinates;
    for(const Tetrahedra::Point& p : mesh.points()) {
      nodes.push_back(nodes.size() + 1);
      for(int i = 0; i < 3; ++i) coordinates.push_back(p[i]);
    }
    for(Surface::Face_index f : mesh.faces())
      for(Surface::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f))) corners.push_back(std::size_t(v) + 1);
    const int surface = gmsh::model::addDiscreteEntity(2), triangle = 2, tetrahedron = 4; // codes of Gmsh
    gmsh::model::mesh::addNodes(2, surface, nodes, coordinates);
    gmsh::model::mesh::addElementsByType(surface, triangle, {}, corners);
    gmsh::model::geo::addVolume({ gmsh::model::geo::addSurfaceLoop({ surface }) });
    gmsh::model::geo::synchronize();
    gmsh::model::mesh::generate(3);

    std::vector<double> parameters;
    gmsh::model::mesh::getNodes(nodes, coordinates, parameters);
    result.points.resize(*std::max_element(nodes.begin(), nodes.end()));
    for(std::size_t n = 0; n < nodes.size(); ++n)
      result.points[nodes[n] - 1] = Tetrahedra::Point(coordinates[3 * n], coordinates[3 * n + 1],
                                                      coordinates[3 * n + 2]);
    std::vector<std::size_t> numbers, cells;
    gmsh::model::mesh::getElementsByType(tetrahedron, numbers, cells);
    for(std::size_t n = 0; n < cells.size(); n += 4)
      result.cells.push_back({ cells[n] - 1, cells[n + 1] - 1, cells[n + 2] - 1, cells[n + 3] - 1 });
  } catch(const std::exception& e) {
    result.error = e.what();
  } catch(const std::string& e) {
    result.error = e;
  } catch(...) { // some versions throw numbers
    result.error = "Gmsh failed.";
  }
  gmsh::finalize();
  return result.error.empty() ? checked(std::move(result), mesh) : result;
}
#endif

#endif // TETRAHEDRALIZE_H
