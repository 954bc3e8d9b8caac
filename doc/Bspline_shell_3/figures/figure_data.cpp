// Writes the data of figures of the manual. make_figures.sh lists the calls.
//
//   figure_data rounds  MESH PREFIX THICKNESS           the shell after each round of refinement
//   figure_data curves  MESH PREFIX THICKNESS FACETS    a simplified mesh, the surfaces of the shell, and curves
//                       between them
//   figure_data remesh  MESH PREFIX THICKNESS EDGES     a remeshed mesh, EDGES along the longest side of the box
//   figure_data open    MESH PREFIX THICKNESS FACETS    the closing of an open mesh, and a simplified mesh
//   figure_data sides   MESH PREFIX THICKNESS           colors of the two sides of a bowl, transferred from the
//                       closest points and by the map
//   figure_data texture MESH PREFIX THICKNESS FACETS    a simplified mesh with the texture coordinates of the mesh
//   figure_data truncate MESH PREFIX THICKNESS FACETS   the truncated mesh, and a simplified mesh
//   figure_data soup    PREFIX                          intersecting polygons, and a simplified proxy with their
//                       texture coordinates
//   figure_data excised PREFIX                          a ball with stray triangles, and the simplified ball
#include "../../../examples/Bspline_shell_3/broken_models.h"
#include "../../../benchmark/Bspline_shell_3/write_ply.h"

#include <CGAL/Bspline_shell_3/Editing/remesh_in_shell.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>
#include <CGAL/Bspline_shell_3/IO/write_VTU.h>
#include <CGAL/Bspline_shell_3/Mesh/replace_patches.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Soup/Excision_filter.h>
#include <CGAL/Bspline_shell_3/Soup/check_excision.h>
#include <CGAL/Bspline_shell_3/Soup/sample_soup_shares.h>
#include <CGAL/Bspline_shell_3/Support/CGAL_compatibility.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_corner_attribute.h>
#include <CGAL/certified_bspline_shell_3.h>
#include <CGAL/certified_shell_of_soup_3.h>
#include <CGAL/certified_soup_proxy_3.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/IO/Color.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>

#include <boost/property_map/function_property_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

typedef CGAL::Certified_bspline_shell_3 Shell;
typedef Shell::Point_3 Point;
typedef Mesh::Property_map<Mesh::Halfedge_index, Kernel::Point_2> Texture_coordinates;

void require(bool condition, const std::string& otherwise)
{
  if(!condition) throw std::runtime_error(otherwise);
}

Shell certified_shell(const Mesh& mesh, double thickness)
{
  Shell shell = CGAL::certified_bspline_shell_3(mesh, BS::parameters::relative_thickness(thickness));
  require(shell.is_certified(), shell.message());
  return shell;
}

Mesh simplified(Mesh mesh, const Shell& shell, std::size_t facets)
{
  const auto result = BS::simplify_in_shell(mesh, shell, BS::parameters::stop(BS::Facet_count_stop_predicate(facets)));
  require(bool(result), message(result.status));
  mesh.collect_garbage();
  return mesh;
}

// the field and the thresholds, exactly; points where the claim on the gradient fails; and numbers
void write_state(const std::string& prefix, const Shell& shell, double thickness)
{
  for(const auto& [name, field] :
      { std::pair("field", &shell.field()), std::pair("inner", &shell.inner_threshold().field()),
        std::pair("outer", &shell.outer_threshold().field()) })
    require(BS::write_VTU(prefix + "_" + name + ".vtu", *field) == BS::Shell_file_status::SUCCESS,
            "A field cannot be written.");
  std::ofstream failures(prefix + "_failures.txt"), numbers(prefix + "_numbers.txt");
  for(const BS::Certificate_witness& w : shell.report().certificate.witnesses)
    if(w.claim == BS::Claim::GRADIENT) failures << w.point[0] << " " << w.point[1] << " " << w.point[2] << "\n";
  const BS::Refinement_round& last = shell.report().rounds.back();
  numbers << last.cells << " " << last.thick_cells << " " << last.undecided_cells << " "
          << thickness * shell.report().unit << "\n";
  require(failures.flush() && numbers.flush(), "A round cannot be written.");
}

// A construction ends before the first round that is estimated to exceed the memory limit, and reports this estimate,
// which is the limit for one more round. The first limit is the smallest one that is accepted for the root cells.
void write_rounds(const Mesh& mesh, const std::string& prefix, double thickness)
{
  const Shell shell = certified_shell(mesh, thickness);
  const std::size_t rounds = shell.report().rounds.size();
  double limit = 1e4 * double(shell.report().surface_cells);
  for(std::size_t n = 1; n < rounds; ++n) {
    const Shell state = CGAL::certified_bspline_shell_3(
      mesh, BS::parameters::relative_thickness(thickness).memory_limit(limit));
    require(bool(state), state.message());
    require(state.report().rounds.size() == n, "The memory limit does not end the construction after this round.");
    write_state(prefix + "_" + std::to_string(n), state, thickness);
    limit = state.report().limit.bytes;
  }
  write_state(prefix + "_" + std::to_string(rounds), shell, thickness);
}

// Returns the part of the integral curve through a point that is in the shell. Consecutive points differ by `step` in
// the value of the field, and by less at the ends.
std::vector<Point> curve(const BS::Gradient_flow_3<Shell>& flow, const Point& p, double step)
{
  std::vector<Point> points = { p };
  for(double direction : { -1., 1. }) {
    for(double s = step; s > 1e-3 * step;) {
      const auto arrival = flow.trace(points.back(), *flow.shell().field().value(points.back()) + direction * s);
      if(arrival && flow.shell().bounded_side(arrival.point) != CGAL::ON_UNBOUNDED_SIDE)
        points.push_back(arrival.point);
      else s /= 2;
    }
    if(direction < 0) std::reverse(points.begin(), points.end());
  }
  return points;
}

// Writes curves, and the points where they meet both meshes. The curves pass through the vertices of the mesh, and
// through the points where its edges meet a plane: the one through the middle of the bounding box that is perpendicular
// to the shortest side.
void write_curves(const Mesh& mesh, const std::string& prefix, double thickness, std::size_t facets)
{
  const Shell shell = certified_shell(mesh, thickness);
  const Mesh coarse = simplified(mesh, shell, facets);
  require(write_mesh(prefix + "_simplified.ply", coarse), "A mesh cannot be written.");
  require(write_surface(prefix + "_inner.ply", shell, shell.inner_threshold()), "The inner surface was not written.");
  require(write_surface(prefix + "_outer.ply", shell, shell.outer_threshold()), "The outer surface was not written.");

  const CGAL::Bbox_3 box = CGAL::bbox_3(mesh.points().begin(), mesh.points().end());
  int axis = 0;
  for(int a : { 1, 2 })
    if((box.max)(a) - (box.min)(a) < (box.max)(axis) - (box.min)(axis)) axis = a;
  const double middle = ((box.min)(axis) + (box.max)(axis)) / 2;
  const BS::Gradient_flow_3<Shell> flow(shell);
  const BS::Shell_map_3<Shell, Mesh> map(shell, mesh, coarse);
  std::ofstream curves(prefix + "_curves.txt");
  curves.precision(10);
  const auto write_point = [&](const auto& p) { curves << p[0] << " " << p[1] << " " << p[2] << " "; };
  // the two points on the meshes, then the curve
  const auto write_curve = [&](const Kernel::Point_3& p) {
    const auto image = map.to_target()(p);
    require(bool(image), message(image.status));
    write_point(p);
    write_point(image.point);
    for(const Point& q : curve(flow, Point(p.x(), p.y(), p.z()), shell.thickness() / 20)) write_point(q);
    curves << "\n";
  };
  for(Mesh::Vertex_index v : mesh.vertices()) write_curve(mesh.point(v));
  for(Mesh::Edge_index e : mesh.edges()) {
    const Kernel::Point_3 &p = mesh.point(mesh.vertex(e, 0)), &q = mesh.point(mesh.vertex(e, 1));
    if((p[axis] < middle) != (q[axis] < middle)) write_curve(p + (middle - p[axis]) / (q[axis] - p[axis]) * (q - p));
  }
  require(bool(curves.flush()), "Curves cannot be written.");
}

void remesh(Mesh mesh, const std::string& prefix, double thickness, double edges)
{
  const Shell shell = certified_shell(mesh, thickness);
  auto sharp = mesh.add_property_map<Mesh::Edge_index, bool>("e:sharp", false).first;
  CGAL::Polygon_mesh_processing::detect_sharp_edges(mesh, 60, sharp);
  const auto report = BS::remesh_in_shell(mesh, shell.report().unit / edges, shell,
                                          BS::parameters::edge_is_constrained_map(sharp));
  require(bool(report), message(report.status));
  mesh.collect_garbage();
  require(write_mesh(prefix + "_remeshed.ply", mesh), "A mesh cannot be written.");
}

void close(const Mesh& mesh, const std::string& prefix, double thickness, std::size_t facets)
{
  const Shell shell = certified_shell(mesh, thickness);
  require(bool(shell.closing()), "The mesh is closed.");
  Mesh closing;
  std::vector<Mesh::Vertex_index> v;
  for(const auto& p : shell.closing()->points()) v.push_back(closing.add_vertex(Kernel::Point_3(p[0], p[1], p[2])));
  for(const auto& t : shell.closing()->triangles()) closing.add_face(v[t[0]], v[t[1]], v[t[2]]);
  require(write_mesh(prefix + "_closing.ply", closing)
            && write_mesh(prefix + "_simplified.ply", simplified(mesh, shell, facets)),
          "A mesh cannot be written.");
}

void truncate(const Mesh& mesh, const std::string& prefix, double thickness, std::size_t facets)
{
  const Shell shell = certified_shell(mesh, thickness);
  require(bool(shell.truncation()), "The mesh has no singular vertex.");
  Mesh truncated = mesh;
  BS::replace_patches(*shell.truncation(), truncated, truncated.points());
  truncated.collect_garbage();
  require(write_mesh(prefix + "_truncated.ply", truncated)
            && write_mesh(prefix + "_simplified.ply", simplified(mesh, shell, facets)),
          "A mesh cannot be written.");
}

// Writes the corners one by one, because each has its texture coordinates.
void write_textured(const std::string& file, const Mesh& mesh, Texture_coordinates uv)
{
  std::ofstream out(file);
  out.precision(10);
  for(Mesh::Face_index f : mesh.faces())
    for(Mesh::Halfedge_index h : mesh.halfedges_around_face(mesh.halfedge(f)))
      out << mesh.point(mesh.target(h)) << " " << uv[h] << "\n";
  require(bool(out.flush()), "A textured mesh cannot be written.");
}

// The texture is wrapped around the vertical axis through the middle of the bounding box. Facets that cross the seam at
// the back get the coordinates of one side.
void transfer_texture(Mesh mesh, const std::string& prefix, double thickness, std::size_t facets)
{
  const Shell shell = certified_shell(mesh, thickness);
  Mesh coarse = simplified(mesh, shell, facets);
  const CGAL::Bbox_3 box = CGAL::bbox_3(mesh.points().begin(), mesh.points().end());
  auto uv = mesh.add_property_map<Mesh::Halfedge_index, Kernel::Point_2>("h:uv").first;
  auto uv_on_coarse = coarse.add_property_map<Mesh::Halfedge_index, Kernel::Point_2>("h:uv").first;
  for(Mesh::Face_index f : mesh.faces()) {
    double first = 0;
    for(Mesh::Halfedge_index h : mesh.halfedges_around_face(mesh.halfedge(f))) {
      const Kernel::Point_3& p = mesh.point(mesh.target(h));
      double u = std::atan2(p.x() - (box.xmin() + box.xmax()) / 2, p.z() - (box.zmin() + box.zmax()) / 2)
                 / (2 * CGAL_PI);
      if(h == mesh.halfedge(f)) first = u;
      u += std::nearbyint(first - u);
      uv[h] = Kernel::Point_2(u, (p.y() - box.ymin()) / (box.ymax() - box.ymin()));
    }
  }
  const BS::Shell_map_3<Shell, Mesh> map(shell, mesh, coarse);
  const BS::Transfer_report report = BS::transfer_corner_attribute(map, uv, uv_on_coarse);
  require(bool(report), "Some facets have no texture coordinates.");
  write_textured(prefix + "_before.txt", mesh, uv);
  write_textured(prefix + "_after.txt", coarse, uv_on_coarse);
}

void write_proxy(const std::string& prefix)
{
  const Broken_model model = figure();
  const BS::Soup_proxy_3 proxy = CGAL::certified_soup_proxy_3(model.soup.points, model.soup.polygons);
  require(proxy.is_certified(), proxy.message());
  Mesh soup = proxy.soup().mesh(), coarse = simplified(proxy.mesh(), proxy.shell(), 1200);
  auto uv = soup.add_property_map<Mesh::Halfedge_index, Kernel::Point_2>("h:uv").first;
  auto uv_on_coarse = coarse.add_property_map<Mesh::Halfedge_index, Kernel::Point_2>("h:uv").first;
  auto color = soup.add_property_map<Mesh::Face_index, CGAL::IO::Color>("f:color").first;
  const BS::Shell_map_3 map = proxy.map(coarse);
  const BS::Soup_shares shares = BS::sample_soup_shares(proxy.map());
  for(Mesh::Face_index f : soup.faces()) {
    const std::size_t polygon = proxy.soup().polygon_of(f);
    const auto& points = model.soup.polygons[polygon];
    for(Mesh::Halfedge_index h : soup.halfedges_around_face(soup.halfedge(f))) {
      const auto at = std::find(points.begin(), points.end(), proxy.soup().point_of(soup.target(h)));
      const auto& t = model.texture[polygon][std::size_t(at - points.begin())];
      uv[h] = Kernel::Point_2(t[0], t[1]);
    }
    const BS::Soup_point p = shares.facets[f];
    color[f] = p == BS::Soup_point::CARRIED     ? CGAL::IO::Color(90, 170, 90)
               : p == BS::Soup_point::CONTINUED ? CGAL::IO::Color(235, 190, 60)
                                                : CGAL::IO::Color(170, 170, 170);
  }
  // The map refers to the mesh of the soup in the proxy, which has the same facets.
  auto uv_of = boost::make_function_property_map<Mesh::Halfedge_index>([&](Mesh::Halfedge_index h) { return uv[h]; });
  require(bool(BS::transfer_corner_attribute(map, uv_of, uv_on_coarse)), "Some facets have no texture coordinates.");
  write_textured(prefix + "_before.txt", soup, uv);
  write_textured(prefix + "_after.txt", coarse, uv_on_coarse);
  require(write_mesh(prefix + "_shares.ply", soup) && write_mesh(prefix + "_proxy.ply", proxy.mesh()),
          "A mesh cannot be written.");
}

void write_excised(const std::string& prefix)
{
  const BS::Shell_of_soup_3 found = CGAL::certified_shell_of_soup_3(ball_with_stray_triangles().soup);
  require(found.certification() == BS::Certification::EXCEPT_EXCISED, found.message());
  const BS::Excised_soup_3& soup = *found.excised;
  Mesh stray;
  for(std::size_t t : soup.excised_triangles()) {
    std::vector<Mesh::Vertex_index> corners;
    for(std::size_t v : soup.soup().triangles[t]) corners.push_back(stray.add_vertex(soup.soup().points[v]));
    stray.add_face(corners);
  }
  Mesh coarse = soup.mesh();
  auto is_constrained = coarse.add_property_map<Mesh::Edge_index, bool>("e:is_constrained", false).first;
  BS::constrain_pins(soup, is_constrained);
  const auto simplified = BS::simplify_in_shell(
    coarse, found.shell(), BS::parameters::edge_is_constrained_map(is_constrained).filter(BS::Excision_filter(soup)));
  require(bool(simplified), simplified.message());
  coarse.collect_garbage();
  require(bool(BS::check_replacement(soup, coarse)), "The simplified ball does not fit the excised triangles.");
  require(write_mesh(prefix + "_mesh.ply", soup.mesh()) && write_mesh(prefix + "_excised.ply", stray)
            && write_mesh(prefix + "_simplified.ply", coarse),
          "A mesh cannot be written.");
}

// Simplifies a bowl around the origin, and gives it one color inside and another outside. Transfers the colors back:
// each of 16 parts of a facet of the bowl has the color of the facet to which its middle is mapped.
void write_sides(const Mesh& mesh, const std::string& prefix, double thickness)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  typedef CGAL::AABB_face_graph_triangle_primitive<Mesh> Primitive;
  const Shell shell = certified_shell(mesh, thickness);
  Mesh coarse = simplified(mesh, shell, 0);
  auto color = coarse.add_property_map<Mesh::Face_index, CGAL::IO::Color>("f:color").first;
  for(Mesh::Face_index f : coarse.faces()) {
    const Kernel::Vector_3 from_center = coarse.point(coarse.source(coarse.halfedge(f))) - CGAL::ORIGIN;
    color[f] = PMP::compute_face_normal(f, coarse) * from_center < 0 ? CGAL::IO::Color(250, 200, 80)
                                                                     : CGAL::IO::Color(51, 107, 217);
  }
  require(write_mesh(prefix + "_painted.ply", coarse), "A mesh cannot be written.");

  const auto write_carried = [&](const std::string& file, const auto& facet_at) {
    const int k = 4;
    Mesh carried;
    auto color_of_part = carried.add_property_map<Mesh::Face_index, CGAL::IO::Color>("f:color").first;
    for(Mesh::Face_index f : mesh.faces()) {
      const Mesh::Halfedge_index h = mesh.halfedge(f);
      const auto point = [&](double i, double j) {
        return CGAL::barycenter(mesh.point(mesh.source(h)), (k - i - j) / k, mesh.point(mesh.target(h)), i / k,
                                mesh.point(mesh.target(mesh.next(h))), j / k);
      };
      const auto add = [&](double i, double j, double side) {
        const auto part = carried.add_face(carried.add_vertex(point(i, j)), carried.add_vertex(point(i + side, j)),
                                           carried.add_vertex(point(i, j + side)));
        color_of_part[part] = color[facet_at(point(i + side / 3, j + side / 3))];
      };
      for(int j = 0; j < k; ++j)
        for(int i = 0; i < k - j; ++i) {
          add(i, j, 1);
          if(i + j + 1 < k) add(i + 1, j + 1, -1);
        }
    }
    require(write_mesh(file, carried), "A mesh cannot be written.");
  };
  const CGAL::AABB_tree<BS::internal::AABB_traits_3<Kernel, Primitive> > tree(faces(coarse).begin(),
                                                                              faces(coarse).end(), coarse);
  write_carried(prefix + "_closest_point.ply",
                [&](const Kernel::Point_3& p) { return tree.closest_point_and_primitive(p).second; });
  const BS::Shell_map_3<Shell, Mesh> map(shell, mesh, coarse);
  write_carried(prefix + "_shell_map.ply", [&](const Kernel::Point_3& p) {
    const auto image = map.to_target()(p);
    require(bool(image), message(image.status));
    return image.location.first;
  });
}

int main(int argc, char** argv)
{
  try {
    const std::string what = argc > 1 ? argv[1] : "";
    if(what == "soup" && argc == 3) {
      write_proxy(argv[2]);
      return EXIT_SUCCESS;
    }
    if(what == "excised" && argc == 3) {
      write_excised(argv[2]);
      return EXIT_SUCCESS;
    }
    require(argc == (what == "rounds" || what == "sides" ? 5 : 6), "Wrong number of arguments.");
    const std::string prefix = argv[3];
    const double thickness = std::atof(argv[4]), number = argc > 5 ? std::atof(argv[5]) : 0;
    Mesh mesh;
    BS::Offending_simplices offenders;
    const BS::Shell_status read = BS::read_polygon_mesh(argv[2], mesh, offenders);
    require(read == BS::Shell_status::SUCCESS, message(read));
    CGAL::Polygon_mesh_processing::triangulate_faces(mesh);
    require(write_mesh(prefix + "_mesh.ply", mesh), "A mesh cannot be written.");
    if(what == "rounds") write_rounds(mesh, prefix, thickness);
    else if(what == "curves") write_curves(mesh, prefix, thickness, std::size_t(number));
    else if(what == "sides") write_sides(mesh, prefix, thickness);
    else if(what == "remesh") remesh(mesh, prefix, thickness, number);
    else if(what == "open") close(mesh, prefix, thickness, std::size_t(number));
    else if(what == "truncate") truncate(mesh, prefix, thickness, std::size_t(number));
    else if(what == "texture") transfer_texture(mesh, prefix, thickness, std::size_t(number));
    else throw std::runtime_error("There is no figure " + what + ".");
  } catch(const std::exception& error) {
    std::cerr << "figure_data: " << error.what() << std::endl;
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
