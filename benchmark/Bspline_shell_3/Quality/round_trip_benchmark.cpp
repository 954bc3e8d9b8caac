// Maps points from a mesh to another one in its shell and back: measures how far they arrive from their start, whether
// points are lost, whether small triangles keep their orientation, and jumps of the differential of the map. Prints one
// JSON object per line.
//
//   round_trip_benchmark [--points N] [MESH ...]
//
// Default: 100000 points on elephant. The second mesh is the first one with its vertices moved along the flow; a second
// line is for the first one, simplified as far as the shell allows. Points are random points, and all vertices,
// midpoints of edges and centroids of facets of both meshes. Lengths are in units of the longest box side.
#include "../meshes_in_shell.h"

#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <map>

typedef BS::Shell_map_3<Shell, Mesh> Map;
typedef std::vector<Kernel::Point_3> Points;

Points points_of(const Mesh& mesh, std::size_t number)
{
  Points points(mesh.points().begin(), mesh.points().end());
  for(Mesh::Edge_index e : mesh.edges())
    points.push_back(CGAL::midpoint(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
  const auto add = [&](Mesh::Face_index f, const std::array<double, 3>& w) {
    const auto h = mesh.halfedge(f);
    points.push_back(CGAL::barycenter(mesh.point(mesh.source(h)), w[0], mesh.point(mesh.target(h)), w[1],
                                      mesh.point(mesh.target(mesh.next(h))), w[2]));
  };
  for(Mesh::Face_index f : mesh.faces()) add(f, { 1, 1, 1 });
  for(const auto& location : random_locations(mesh, number, 7)) add(location.first, location.second);
  return points;
}

struct Round_trip
{
  std::size_t points = 0, lost = 0, triangles = 0, turned = 0;
  double farthest = 0;
  std::map<std::string, std::size_t> reasons;
};

// Maps points to the target of `there`, and from it to the target of `back`.
void travel(const Map::Projection_to_target& there, const Map::Projection_to_target& back, const Points& points,
            Round_trip& result)
{
  const double unit = there.shell().report().unit;
  const auto images = there.project(points);
  Points arrived;
  for(const auto& image : images) arrived.push_back(image.point);
  const auto returned = back.project(arrived);
  for(std::size_t n = 0; n < points.size(); ++n) {
    ++result.points;
    const BS::Flow_status status = images[n] ? returned[n].status : images[n].status;
    if(status != BS::Flow_status::SUCCESS) {
      ++result.lost;
      ++result.reasons[message(status)];
      continue;
    }
    result.farthest = (std::max)(result.farthest,
                                 std::sqrt(CGAL::squared_distance(points[n], returned[n].point)) / unit);
  }
  // Equilateral triangles across the gradient.
  const double size = 1e-5 * unit;
  Points corners;
  for(const Kernel::Point_3& p : points) {
    const Kernel::Vector_3 g = *there.shell().field().gradient(p);
    Kernel::Vector_3 u = CGAL::cross_product(g, std::abs(g.x()) < std::abs(g.y()) ? Kernel::Vector_3(1, 0, 0)
                                                                                  : Kernel::Vector_3(0, 1, 0));
    u = u / std::sqrt(u.squared_length());
    const Kernel::Vector_3 v = CGAL::cross_product(g, u) / std::sqrt(g.squared_length());
    corners.push_back(p + size * u);
    corners.push_back(p + size * (-0.5 * u + 0.866 * v));
    corners.push_back(p + size * (-0.5 * u - 0.866 * v));
  }
  const auto mapped = there.project(corners);
  for(std::size_t n = 0; n < points.size(); ++n) {
    // A corner can be outside the shell even if its point is inside.
    if(!images[n] || !mapped[3 * n] || !mapped[3 * n + 1] || !mapped[3 * n + 2]) continue;
    ++result.triangles;
    const Kernel::Vector_3 g = *there.shell().field().gradient(images[n].point);
    if(!(CGAL::cross_product(mapped[3 * n + 1].point - mapped[3 * n].point,
                             mapped[3 * n + 2].point - mapped[3 * n].point)
           * g
         > 0))
      ++result.turned;
  }
}

// Changes of the map's differential between neighboring points on straight lines in facets of the source.
struct Jumps
{
  double within_facets = 0; // changes of the map within a facet of the target
  double of_flow = 0;       // changes of the flow, also between facets
  double across_edges = 0;  // changes of the map between facets of the target
  double unexplained = 0;   // the part of across_edges that is not due to different normals
};

Jumps jumps(const Map& map, std::size_t lines)
{
  Jumps result;
  const double unit = map.shell().report().unit;
  const auto normal = [&](const Map::Target_image& image) {
    const auto& n = map.to_target().target().normal(map.to_target().target().facet_of(image.location.first));
    return Eigen::Vector3d(n[0], n[1], n[2]);
  };
  for(const auto& location : random_locations(map.source(), lines, 11)) {
    const auto h = map.source().halfedge(location.first);
    // Bisection finds two points in the facet, 1e-7 of the box apart, on both sides of the place where the image leaves
    // a facet of the target.
    const Map::Coordinates p = map.point(location);
    const Kernel::Vector_3 along = map.source().point(map.source().target(h))
                                   - map.source().point(map.source().source(h));
    const double length = std::sqrt(along.squared_length());
    const auto at = [&](double t) {
      return Map::Coordinates{ p[0] + t * along.x(), p[1] + t * along.y(), p[2] + t * along.z() };
    };
    double first = 0, last = 0.2;
    auto a = map.to_target()(at(first)), b = map.to_target()(at(last));
    if(!a || !b) continue;
    while((last - first) * length > 1e-7 * unit) {
      const double middle = (first + last) / 2;
      const auto m = map.to_target()(at(middle));
      if(!m) {
        a = m;
        break;
      }
      if(m.location.first == a.location.first) {
        first = middle;
        a = m;
      } else {
        last = middle;
        b = m;
      }
    }
    if(!a) continue; // the line leaves the shell
    const auto da = map.to_target().differential(at(first), a), db = map.to_target().differential(at(last), b);
    if(!da || !db) continue;
    const double size = da.matrix.norm();
    result.of_flow = (std::max)(result.of_flow, (da.onto_level_set() - db.onto_level_set()).norm() / size);
    const double jump = (da.onto_plane(normal(a)) - db.onto_plane(normal(b))).norm() / size;
    if(a.location.first == b.location.first) {
      result.within_facets = (std::max)(result.within_facets, jump);
    } else {
      result.across_edges = (std::max)(result.across_edges, jump);
      const double by_normals = (da.onto_plane(normal(a)) - da.onto_plane(normal(b))).norm() / size;
      result.unexplained = (std::max)(result.unexplained, std::abs(jump - by_normals));
    }
  }
  return result;
}

void measure(const std::string& name, const Shell& shell, const Mesh& mesh, const Mesh& second, const std::string& kind,
             std::size_t number)
{
  const Map map(shell, mesh, second);
  Round_trip trip;
  travel(map.to_target(), map.to_source(), points_of(mesh, number), trip);
  travel(map.to_source(), map.to_target(), points_of(second, number), trip);
  const Jumps jump = jumps(map, 2000);
  std::cout << "{\"mesh\":" << quoted(name) << ",\"facets\":" << mesh.number_of_faces() << ",\"second\":\"" << kind
            << "\",\"facets_of_second\":" << second.number_of_faces() << ",\"points\":" << trip.points
            << ",\"lost\":" << trip.lost << ",\"reasons\":{";
  bool comma = false;
  for(const auto& reason : trip.reasons) {
    std::cout << (comma ? "," : "") << "\"" << reason.first << "\":" << reason.second;
    comma = true;
  }
  std::cout << "},\"farthest\":" << trip.farthest << ",\"triangles\":" << trip.triangles
            << ",\"turned\":" << trip.turned << ",\"jumps\":{\"of_flow\":" << jump.of_flow
            << ",\"within_facets\":" << jump.within_facets << ",\"across_edges\":" << jump.across_edges
            << ",\"not_explained_by_normals\":" << jump.unexplained << "}}" << std::endl;
}

int main(int argc, char** argv)
{
  print_JSON_numbers();
  const Benchmark_arguments arguments(argc, argv, 100000, MESHES "/elephant.off");
  for_each_pair(arguments.files,
                [&](const std::string& name, const Shell& shell, const Mesh& mesh, const Mesh& moved, double part) {
                  measure(name, shell, mesh, moved, "moved by " + std::to_string(part), arguments.points);
                  Mesh coarse = mesh;
                  if(BS::simplify_in_shell(coarse, shell)) {
                    coarse.collect_garbage();
                    measure(name, shell, mesh, coarse, "simplified", arguments.points);
                  }
                });
  return EXIT_SUCCESS;
}
