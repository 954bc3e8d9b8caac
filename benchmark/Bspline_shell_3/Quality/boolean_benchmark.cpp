// Measures Booleans of pairs of meshes: whether they get a certified shell, and how their operands' colors change if
// they are simplified as far as the shell allows. Prints one JSON object per line.
//
//   boolean_benchmark [--thickness T] [--distance D] [--points N] [FIRST SECOND ...]
//
// Default: ten pairs of meshes, the second one turned and moved (place() in operand_labels.h). Given meshes are not
// moved. There are four simplifications: `free` ignores the colors and gets them by transfer_face_labels().
// `along_curve` collapses edges of the intersection curve along the curve. `near_curve` does so only if the curve stays
// near (Line_filter). `protected` keeps all of these edges. In the last three, facets keep their labels. The thickness
// of the shell (default 0.01) and the distance of near_curve (default 0.001) are in units of the longest box side.
//
// - label_distance: largest distance of a facet's centroid on the Boolean from the operand with the facet's label
// - border_to_curve: distances from the border of the colors to the initial curve; on_surface: the same for the
//   border's image on the Boolean's mesh; curve_to_border: the opposite distances. Mean and maximum, in percent of the
//   longest box side.
// - wrong_area: percentage of N points (default 100000) of the simplified mesh whose color differs from that of their
//   image on the Boolean's mesh
#include "../AABB_tree_of.h"
#include "../meshes_in_shell.h"
#include "../../../examples/Bspline_shell_3/operand_labels.h"

#include <CGAL/Bspline_shell_3/Editing/Line_filter.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_face_labels.h>

#include <CGAL/AABB_halfedge_graph_segment_primitive.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Real_timer.h>

#include <functional>
#include <limits>
#include <sstream>

typedef BS::Shell_map_3<Shell, Mesh> Map;
typedef CGAL::AABB_halfedge_graph_segment_primitive<Mesh> Segment;
typedef AABB_tree_of<Kernel, Segment> Segment_tree;
typedef Map::Source_location Location;

struct Options
{
  double thickness = 0.01, distance = 0.001;
  std::size_t points = 100000;
};

// Returns the least quality: twice the inradius, divided by the circumradius.
double worst_quality(const Mesh& mesh)
{
  double worst = 1;
  for(Mesh::Face_index f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const auto &p = mesh.point(mesh.source(h)), &q = mesh.point(mesh.target(h)),
               &r = mesh.point(mesh.target(mesh.next(h)));
    const auto length = [](const auto& s, const auto& t) { return std::sqrt(CGAL::squared_distance(s, t)); };
    const double a = length(p, q), b = length(q, r), c = length(r, p);
    worst = (std::min)(worst, 16 * CGAL::squared_area(p, q, r) / ((a + b + c) * a * b * c));
  }
  return worst;
}

double label_distance(const Mesh& mesh, const Labels& labels, const std::array<const Mesh*, 2>& operands)
{
  double largest = 0;
  for(int label : { 0, 1 }) {
    std::vector<Kernel::Point_3> centroids;
    for(Mesh::Face_index f : mesh.faces()) {
      const auto h = mesh.halfedge(f);
      if(labels[f] == label)
        centroids.push_back(CGAL::centroid(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                                           mesh.point(mesh.target(mesh.next(h)))));
    }
    if(!centroids.empty())
      largest = (std::max)(
        largest, PMP::max_distance_to_triangle_mesh<CGAL::Sequential_tag>(centroids, *operands[std::size_t(label)]));
  }
  return largest;
}

// A mesh, its colors, and their border.
struct Colored
{
  Colored(const Mesh& m, Labels l, Curve c) : mesh(m), labels(l), curve(c)
  {
    std::vector<Mesh::Edge_index> edges;
    for(Mesh::Edge_index e : mesh.edges())
      if(curve[e]) edges.push_back(e);
    tree.insert(edges.begin(), edges.end(), mesh);
    tree.accelerate_distance_queries();
  }

  const Mesh& mesh;
  Labels labels;
  Curve curve;
  Segment_tree tree;
};

// Points of the border, at most 1/1000 of the box apart, with the length that each represents.
struct Samples
{
  Samples(const Colored& colored, double unit)
  {
    const Mesh& mesh = colored.mesh;
    for(Mesh::Edge_index e : mesh.edges()) {
      if(!colored.curve[e]) continue;
      const Mesh::Halfedge_index h = mesh.halfedge(mesh.face(mesh.halfedge(e, 0)));
      const int first = mesh.halfedge(e, 0) == h ? 0 : mesh.halfedge(e, 0) == mesh.next(h) ? 1 : 2;
      const Kernel::Point_3 &p = mesh.point(mesh.source(mesh.halfedge(e, 0))),
                            &q = mesh.point(mesh.target(mesh.halfedge(e, 0)));
      const double length = std::sqrt(CGAL::squared_distance(p, q));
      const int parts = 1 + int(length / (0.001 * unit));
      for(int n = 0; n < parts; ++n) {
        const double t = (n + 0.5) / parts;
        Location location(mesh.face(mesh.halfedge(e, 0)), { 0, 0, 0 });
        location.second[std::size_t(first)] = 1 - t;
        location.second[std::size_t((first + 1) % 3)] = t;
        locations.push_back(location);
        points.push_back(p + t * (q - p));
        lengths.push_back(length / parts);
      }
    }
  }

  std::vector<Location> locations;
  std::vector<Kernel::Point_3> points;
  std::vector<double> lengths;
};

struct Distances
{
  void add(double distance, double length)
  {
    sum += distance * length;
    weight += length;
    largest = (std::max)(largest, distance);
  }
  std::string json(double unit) const
  {
    std::ostringstream out;
    out << "{\"mean\":" << 100 * sum / weight / unit << ",\"max\":" << 100 * largest / unit << "}";
    return out.str();
  }

  double sum = 0, weight = 0, largest = 0;
};

Distances distances(const Samples& from, const Colored& to)
{
  Distances result;
  for(std::size_t n = 0; n < from.points.size() && !to.tree.empty(); ++n)
    result.add(std::sqrt(to.tree.squared_distance(from.points[n])), from.lengths[n]);
  return result;
}

// Compares the colors of a simplified mesh with those before.
std::string compare(const Shell& shell, const Colored& before, const Colored& after, std::size_t number)
{
  const double unit = shell.report().unit;
  const auto back = Map(shell, before.mesh, after.mesh).inverse();
  const Samples border(after, unit), curve(before, unit);
  Distances on_surface;
  std::size_t lost = 0, wrong = 0;
  const auto images = back.project(border.locations);
  for(std::size_t n = 0; n < images.size(); ++n) {
    if(images[n] && !before.tree.empty())
      on_surface.add(std::sqrt(before.tree.squared_distance(images[n].point)), border.lengths[n]);
    else ++lost;
  }
  const auto locations = random_locations(after.mesh, number, 5);
  const auto origins = back.project(locations);
  for(std::size_t n = 0; n < origins.size(); ++n) {
    if(!origins[n]) ++lost;
    else if(before.labels[origins[n].location.first] != after.labels[locations[n].first]) ++wrong;
  }
  std::ostringstream out;
  out << "\"border_to_curve\":" << distances(border, before).json(unit) << ",\"on_surface\":" << on_surface.json(unit)
      << ",\"curve_to_border\":" << distances(curve, after).json(unit)
      << ",\"wrong_area\":" << 100 * double(wrong) / double(number) << ",\"lost\":" << lost;
  return out.str();
}

template <typename NamedParameters>
std::string simplify(const Shell& shell, const Colored& before, bool keeps_labels, std::size_t number,
                     const NamedParameters& np, Mesh& coarse)
{
  const auto result = BS::simplify_in_shell(coarse, shell, np);
  if(!result) return "{\"certified\":false,\"reason\":" + quoted(BS::message(result.status)) + "}";
  coarse.collect_garbage();
  const Labels labels = labels_of(coarse);
  const Curve border = curve_of(coarse);
  if(!keeps_labels)
    BS::transfer_face_labels(Map(shell, before.mesh, coarse), before.labels, labels,
                             BS::parameters::samples_per_facet(16).default_value(-1));
  std::size_t unlabeled = 0;
  for(Mesh::Face_index f : coarse.faces()) unlabeled += labels[f] < 0 ? 1 : 0;
  const std::size_t border_edges = mark_curve(coarse, labels, border);
  const Colored after(coarse, labels, border);
  std::ostringstream out;
  out << "{\"certified\":true,\"facets\":" << result.facets << ",\"constrained_edges\":" << result.constrained_edges
      << ",\"border_edges\":" << border_edges << ",\"unlabeled\":" << unlabeled << ","
      << compare(shell, before, after, number) << ",\"seconds\":" << result.total_seconds() << "}";
  return out.str();
}

void measure(const std::string& name_0, const Mesh& first, const std::string& name_1, const Mesh& second,
             const std::string& operation, const Options& options)
{
  std::cout << "{\"first\":" << quoted(name_0) << ",\"second\":" << quoted(name_1)
            << ",\"operation\":" << quoted(operation) << ",\"facets\":[" << first.number_of_faces() << ","
            << second.number_of_faces() << "]";
  CGAL::Real_timer timer;
  timer.start();
  Mesh mesh;
  if(!compute(*operation_of(operation), first, second, mesh)) {
    std::cout << ",\"status\":\"no manifold\"}" << std::endl;
    return;
  }
  const double seconds = timer.time();
  const Labels labels = labels_of(mesh);
  const Curve curve = curve_of(mesh);
  const std::size_t curve_edges = mark_curve(mesh, labels, curve);
  const CGAL::Bbox_3 box = PMP::bbox(mesh);
  const double unit = (std::max)({ box.x_span(), box.y_span(), box.z_span() });
  std::cout << ",\"result\":{\"facets\":" << mesh.number_of_faces() << ",\"curve_edges\":" << curve_edges
            << ",\"worst_quality\":" << worst_quality(mesh)
            << ",\"label_distance\":" << label_distance(mesh, labels, { &first, &second }) / unit
            << ",\"seconds\":" << seconds << "}" << std::flush;

  const Shell shell = CGAL::certified_bspline_shell_3(mesh, BS::parameters::relative_thickness(options.thickness));
  std::cout << ",\"shell\":{\"certified\":" << (shell.is_certified() ? "true" : "false")
            << ",\"seconds\":" << shell.report().total_seconds();
  if(!shell.is_certified()) {
    const BS::Shell_report& report = shell.report();
    std::cout << ",\"reason\":" << quoted(shell.message()) << ",\"obstacles\":" << report.obstacles.size();
    if(!report.obstacles.empty())
      std::cout << ",\"narrowest\":" << quoted(message(report.obstacles[0], report.unit, report.refinement));
    std::cout << "}}" << std::endl;
    return;
  }
  const Colored before(mesh, labels, curve);
  std::cout << "},\"free\":";
  Mesh free = mesh;
  std::cout << simplify(shell, before, false, options.points, BS::parameters::stop(BS::Never_stop_predicate()), free)
            << std::flush;
  const auto with_curve = [&](const char* name, double distance, bool protects) {
    Mesh coarse = mesh;
    const BS::Line_filter filter(coarse, curve_of(coarse), distance);
    std::cout << ",\"" << name << "\":"
              << simplify(shell, before, true, options.points,
                          BS::parameters::edge_is_constrained_map(curve_of(coarse))
                            .protect_constraints(protects)
                            .filter(std::cref(filter)),
                          coarse)
              << std::flush;
  };
  with_curve("along_curve", std::numeric_limits<double>::infinity(), false);
  with_curve("near_curve", options.distance * shell.report().unit, false);
  with_curve("protected", 0, true);
  std::cout << "}" << std::endl;
}

int main(int argc, char** argv)
{
  print_JSON_numbers();
  Options options;
  std::vector<std::string> files;
  for(int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if(argument == "--thickness" && i + 1 < argc) options.thickness = std::atof(argv[++i]);
    else if(argument == "--distance" && i + 1 < argc) options.distance = std::atof(argv[++i]);
    else if(argument == "--points" && i + 1 < argc) options.points = std::size_t(std::atoll(argv[++i]));
    else files.push_back(argument);
  }
  const bool is_default = files.empty();
  if(is_default)
    for(const char* name : { "eight",    "eight",  "blobby",       "blobby", "knot1",   "sphere", "elephant",
                             "elephant", "bear",   "elephant",     "dino",   "homer",   "joint",  "couplingdown",
                             "pinion",   "handle", "anchor_dense", "rotor",  "fandisk", "fandisk" })
      files.push_back(MESHES "/" + std::string(name) + ".off");
  for(std::size_t n = 0; n + 1 < files.size(); n += 2) {
    Mesh first, second;
    if(read_triangles(files[n], first) && read_triangles(files[n + 1], second) && is_default) place(second, first);
    const std::string name_0 = mesh_name(files[n]), name_1 = mesh_name(files[n + 1]);
    if(!is_operand(first) || !is_operand(second)) {
      std::cout << "{\"first\":" << quoted(name_0) << ",\"second\":" << quoted(name_1) << ",\"status\":\"no solids\"}"
                << std::endl;
      continue;
    }
    set_labels(first, 0);
    set_labels(second, 1);
    for(const char* operation : { "union", "intersection", "difference" })
      measure(name_0, first, name_1, second, operation, options);
  }
  return EXIT_SUCCESS;
}
