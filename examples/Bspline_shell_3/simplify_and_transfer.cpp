// The complete pipeline: builds the certified shell of the mesh in a file, or of a proxy, and simplifies the mesh in
// it. Transfers test colors and a test scalar at the vertices along the integral curves; attributes in the file are not
// read. Writes both meshes with their attributes, and the bounding surfaces of the shell; render_shell.py draws them.
#include "example_output.h"

#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_vertex_attribute.h>
#include <CGAL/Bspline_shell_3/Soup/Excision_filter.h>
#include <CGAL/Bspline_shell_3/Soup/rejoin_excised.h>
#include <CGAL/Bspline_shell_3/Soup/sample_soup_shares.h>
#include <CGAL/Bspline_shell_3/Soup/write_report.h>
#include <CGAL/certified_shell_of_soup_3.h>

#include <CGAL/IO/Color.h>
#include <CGAL/Real_timer.h>
#include <CGAL/subdivision_method_3.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iomanip>
#include <limits>
#include <locale>
#include <optional>
#include <vector>

typedef CGAL::Certified_bspline_shell_3 Shell;
typedef BS::Shell_map_3<Shell, Mesh> Map;

const char* const usage =
  "Usage: simplify_and_transfer FILE [--facets FACETS] [--thickness T] [--output PREFIX] [--time-limit SECONDS]\n"
  "                             [--memory-limit MB] [--threads N]\n"
  "Simplifies the mesh in FILE (OFF, OBJ, PLY or STL) in its shell, and transfers colors and a scalar field.\n"
  "  --facets FACETS         target number of facets (default: as few as the shell allows)\n"
  "  --thickness T           thickness of the shell, as a fraction of the longest side of the bounding box (default\n"
  "                          0.01); a thicker shell allows fewer facets\n"
  "  --output PREFIX         prefix of the file names (default: simplified)\n"
  "  --time-limit SECONDS    time limit for the shell and the simplification together (default: none)\n"
  "  --memory-limit MB       memory limit for the shell, in megabytes (default 4000)\n"
  "  --threads N             number of threads (default: all processors)\n"
  "Writes\n"
  "  PREFIX.json                 report on the repairs, the proxy and the shell\n"
  "  PREFIX_mesh.ply             the mesh of the shell: the repaired input without excised triangles, or a proxy\n"
  "  PREFIX_excised.ply          excised triangles, if any\n"
  "  PREFIX_simplified.ply       the simplified mesh\n"
  "  PREFIX_whole.ply            if triangles are excised: the simplified mesh and these triangles\n"
  "  PREFIX_detail.ply           the same surface, subdivided to show the transferred color of every point\n"
  "  PREFIX_simplified.json      numbers of facets, and errors of points after the round trip between both meshes\n"
  "  PREFIX_{inner,outer}.ply    the bounding surfaces of the shell\n"
  "  PREFIX_places.ply           if the shell is not certified: points where the proof fails\n"
  "The files are replaced together at the end. If the run fails (exit codes 3, 5, 6, 10 or more), the results of an\n"
  "earlier run are kept, and the names of the new files begin with PREFIX.failed.\n"
  "Exit codes\n"
  "  0   success\n"
  "  2   wrong usage\n"
  "  3   a file cannot be written\n"
  "  4   a bounding surface cannot be extracted; the other files are written\n"
  "  5   the shell is not certified\n"
  "  6   the mesh is not simplified\n"
  "  7   some points have no image; all files are written\n"
  "  10 or more    there is no shell: 10 + the number of the status (Shell_status)\n";

// Adds the distance from the vertex with the largest sum of coordinates, and stripes around this vertex.
void add_attributes(Mesh& mesh)
{
  auto distance = mesh.add_property_map<Mesh::Vertex_index, double>("v:distance", 0).first;
  auto color = mesh.add_property_map<Mesh::Vertex_index, CGAL::IO::Color>("v:color").first;
  const auto height = [&](Mesh::Vertex_index v) { return mesh.point(v).x() + mesh.point(v).y() + mesh.point(v).z(); };
  const Kernel::Point_3 top = mesh.point(*std::max_element(mesh.vertices().begin(), mesh.vertices().end(),
                                                           [&](auto v, auto w) { return height(v) < height(w); }));
  double largest = 0;
  for(auto v : mesh.vertices()) {
    distance[v] = std::sqrt(CGAL::squared_distance(mesh.point(v), top));
    largest = (std::max)(largest, distance[v]);
  }
  const std::array<std::array<double, 3>, 4> palette = {
    { { 253, 200, 60 }, { 225, 85, 85 }, { 125, 60, 150 }, { 35, 110, 170 } }
  };
  for(auto v : mesh.vertices()) {
    const double t = distance[v] / largest, at = 3 * t,
                 stripe = 0.65 + 0.35 * std::tanh(2 * std::cos(18 * CGAL_PI * t));
    const std::size_t i = (std::min)(std::size_t(at), std::size_t(2));
    std::array<unsigned char, 3> c;
    for(std::size_t a = 0; a < 3; ++a) {
      const double full = palette[i][a] + (at - double(i)) * (palette[i + 1][a] - palette[i][a]);
      c[a] = static_cast<unsigned char>(std::lround(stripe * full + (1 - stripe) * 255));
    }
    color[v] = CGAL::IO::Color(c[0], c[1], c[2]);
  }
}

// A mask of subdivision that splits facets into four, and does not change the surface.
struct Flat_mask
{
  const Mesh* mesh;

  void vertex_node(Mesh::Vertex_index v, Kernel::Point_3& p) const { p = mesh->point(v); }
  void edge_node(Mesh::Halfedge_index h, Kernel::Point_3& p) const
  {
    p = CGAL::midpoint(mesh->point(mesh->source(h)), mesh->point(mesh->target(h)));
  }
  void border_node(Mesh::Halfedge_index h, Kernel::Point_3& middle, Kernel::Point_3& end) const
  {
    edge_node(h, middle);
    vertex_node(mesh->target(h), end);
  }
};

// Simplifies the mesh of a shell. Excised triangles keep their contact with the mesh, and get no further one.
template <typename NamedParameters>
BS::Simplification_result<Mesh> simplify(Mesh& mesh, const BS::Shell_of_soup_3& found, const NamedParameters& np)
{
  if(!found.excised) return BS::simplify_in_shell(mesh, found.shell(), np);
  auto is_constrained = mesh.add_property_map<Mesh::Edge_index, bool>("e:is_constrained", false).first;
  BS::constrain_pins(*found.excised, is_constrained);
  const BS::Excision_filter filter(*found.excised, BS::New_contacts::REJECTED);
  const auto result = BS::simplify_in_shell(mesh, found.shell(),
                                            np.edge_is_constrained_map(is_constrained).filter(filter));
  mesh.remove_property_map(is_constrained);
  return result;
}

// Returns the attribute with this name, which is added if missing.
template <typename Value>
Mesh::Property_map<Mesh::Vertex_index, Value> attribute(Mesh& mesh, const std::string& name)
{
  return mesh.add_property_map<Mesh::Vertex_index, Value>(name).first;
}

// Transfers the attribute with this name from the source to the target. Prints and returns the number of vertices that
// have no image.
template <typename Value>
std::size_t carry_over(const Map& map, Mesh& source, Mesh& target, const std::string& name)
{
  const BS::Transfer_report report = BS::transfer_vertex_attribute(map, attribute<Value>(source, name),
                                                                   attribute<Value>(target, name));
  if(!report) {
    const auto& [vertex, status] = report.failures[0];
    std::cerr << name << ": " << report.failures.size() << " points have no image, the first at "
              << target.point(Mesh::Vertex_index(Mesh::size_type(vertex))) << ": " << message(status) << std::endl;
  }
  return report.failures.size();
}

struct Round_trip
{
  std::size_t points = 0, lost = 0;
  double farthest = 0; // largest distance from the start
};

// Maps vertices and centroids of the source to the target and back.
template <typename Map_>
void travel(const Map_& map, Round_trip& trip)
{
  std::vector<typename Map_::Source_location> starts;
  for(auto v : map.source().vertices())
    starts.push_back(CGAL::Polygon_mesh_processing::locate_vertex<double>(v, map.source()));
  for(auto f : map.source().faces()) starts.push_back({ f, { 1 / 3., 1 / 3., 1 / 3. } });
  const auto images = map.project(starts);
  const auto back = map.inverse();
  for(std::size_t n = 0; n < starts.size(); ++n) {
    ++trip.points;
    const auto end = images[n] ? back(images[n].location) : typename Map_::Source_image();
    if(!images[n] || !end) {
      ++trip.lost;
      continue;
    }
    const auto start = map.point(starts[n]);
    trip.farthest = (std::max)(
      trip.farthest, std::sqrt(CGAL::squared_distance(Kernel::Point_3(start[0], start[1], start[2]), end.point)));
  }
}

struct Options
{
  std::string file, output = "simplified";
  std::size_t facets = 0, threads = 0;
  double thickness = 0.01, seconds = std::numeric_limits<double>::infinity(), megabytes = 4000;
};

// Computes and writes all results, and returns the exit code.
int run(const Options& options, const Results& results)
{
  BS::Polygon_soup soup;
  BS::Offending_simplices offenders;
  const BS::Shell_status read = BS::read_polygon_soup(options.file, soup, offenders);
  if(read != BS::Shell_status::SUCCESS) return refuse(read, message(read), offenders, options.file);

  // a shell in which the map between meshes is proved to be one-to-one
  Step_printer printer;
  CGAL::Real_timer timer;
  timer.start();
  const BS::Shell_of_soup_3 found = CGAL::certified_shell_of_soup_3(
    soup, BS::parameters::relative_thickness(options.thickness)
            .time_limit(options.seconds)
            .memory_limit(1e6 * options.megabytes)
            .visitor(std::ref(printer)));
  const Shell& shell = found.shell();
  Mesh mesh = found.mesh();
  printer.clear();
  const BS::Soup_shares shares = found.proxy ? BS::sample_soup_shares(found.proxy->map()) : BS::Soup_shares();
  const auto write_report = [&](std::ostream& out) { return BS::write_report(out, found, shares, options.file); };
  if(!write_result(results.pending(".json"), write_report)) return CANNOT_WRITE;
  if(!shell) return refuse(found.status(), found.message(), found.offending_simplices, options.file);
  if(found.certification() == BS::Certification::NONE) {
    std::cerr << found.message() << std::endl;
    if(shell.report().obstacles.empty()) list_witnesses(shell.report().certificate);
    const bool has_places = report_obstacles(shell.report(), results.pending("_places.ply"));
    return write_mesh(results.pending("_mesh.ply"), mesh) && has_places ? NOT_CERTIFIED : CANNOT_WRITE;
  }
  const double shell_seconds = timer.time();
  add_attributes(mesh);
  const bool has_mesh = write_mesh(results.pending("_mesh.ply"), mesh);
  const int inner = write_surface(results.pending("_inner.ply"), shell, shell.inner_threshold());
  const int outer = write_surface(results.pending("_outer.ply"), shell, shell.outer_threshold());
  if(!has_mesh || inner == CANNOT_WRITE || outer == CANNOT_WRITE) return CANNOT_WRITE;

  printer.show("simplification");
  constexpr double least_seconds = 1e-3; // time limits must be positive
  Mesh coarse = found.mesh();
  const double seconds_left = (std::max)(options.seconds - shell_seconds, least_seconds);
  const BS::Facet_count_stop_predicate stop(options.facets);
  const auto simplified = simplify(coarse, found, BS::parameters::stop(stop).time_limit(seconds_left));
  printer.clear();
  if(!simplified) {
    complain(simplified.message(), simplified.offending_simplices);
    if(simplified.status == BS::Edit_status::NOT_CERTIFIED) list_witnesses(simplified.certificate);
    return NOT_SIMPLIFIED;
  }
  coarse.collect_garbage();
  BS::Rejoined_soup_3 whole;
  if(found.excised) {
    whole = BS::rejoin_excised(*found.excised, coarse);
    if(!whole) {
      std::cerr << message(whole.verdict.status) << std::endl;
      return NOT_SIMPLIFIED;
    }
    const auto write_whole = [&](std::ostream& out) {
      CGAL::IO::set_binary_mode(out);
      return CGAL::IO::write_PLY(out, whole.soup.points, whole.soup.polygons);
    };
    if(!write_result(results.pending("_whole.ply"), write_whole)) return CANNOT_WRITE;
  }

  // Transfer attributes to the vertices of the coarse mesh, and to many points on its facets.
  timer.reset();
  Mesh detail = coarse;
  while(detail.number_of_faces() < 100000) CGAL::Subdivision_method_3::PTQ(detail, Flat_mask{ &detail }, 1);
  const Map to_coarse(shell, mesh, coarse), to_detail(shell, mesh, detail);
  const std::size_t lost = carry_over<double>(to_coarse, mesh, coarse, "v:distance")
                           + carry_over<CGAL::IO::Color>(to_coarse, mesh, coarse, "v:color")
                           + carry_over<CGAL::IO::Color>(to_detail, mesh, detail, "v:color");
  const double transfer_seconds = timer.time();
  Round_trip trip;
  travel(to_coarse, trip);
  travel(to_coarse.inverse(), trip);

  const auto write_simplified_report = [&](std::ostream& out) {
    out.imbue(std::locale::classic());
    out << "{\n  \"facets_before\": " << simplified.facets_before << ",\n  \"facets\": " << simplified.facets
        << ",\n  \"seconds\": " << simplified.total_seconds() << ",\n  \"lost\": " << lost
        << ",\n  \"round_trip\": { \"points\": " << trip.points << ", \"lost\": " << trip.lost
        << ", \"farthest\": " << trip.farthest << " }\n}\n";
    return bool(out);
  };
  if(!write_mesh(results.pending("_simplified.ply"), coarse) || !write_mesh(results.pending("_detail.ply"), detail)
     || !write_result(results.pending("_simplified.json"), write_simplified_report))
    return CANNOT_WRITE;

  const auto row = [](const char* what) -> std::ostream& { return std::cout << std::left << std::setw(14) << what; };
  std::cout << std::setprecision(3);
  print_repairs(found.repairs);
  if(found.proxy) print_reason(found);
  if(found.excised && !write_excised(results.pending("_excised.ply"), *found.excised)) return CANNOT_WRITE;
  row("mesh") << mesh.number_of_faces() << " facets, " << name(found.kind()) << "\n";
  if(found.excised) row("excised") << found.excision_message() << "\n";
  row("shell") << "certified; thickness " << 100 * shell.relative_thickness() << " % of the bounding box; "
               << shell.report().cells << " cells; " << shell_seconds << " s\n";
  row("simplified") << simplified.facets << " facets ("
                    << 100. * double(simplified.facets) / double(simplified.facets_before) << " %); certified; "
                    << simplified.total_seconds() << " s\n";
  if(options.facets > 0 && simplified.facets > options.facets) row("") << message(simplified.end) << "\n";
  row("transferred") << "distance and color at " << coarse.number_of_vertices() << " vertices, color at "
                     << detail.number_of_vertices() << " points; " << lost << " lost; " << transfer_seconds << " s\n";
  row("round trip") << trip.points << " points, " << trip.lost << " lost; maximum error "
                    << trip.farthest / shell.report().unit << " of the longest side of the bounding box\n";
  return lost > 0 ? int(POINTS_LOST) : (std::max)(inner, outer);
}

int main(int argc, char** argv)
{
  Options options;
  const auto code = Arguments(usage)
                      .required(options.file)
                      .option("--output", options.output)
                      .option("--facets", options.facets)
                      .option("--thickness", options.thickness)
                      .option("--time-limit", options.seconds)
                      .option("--memory-limit", options.megabytes)
                      .option("--threads", options.threads)
                      .read(argc, argv);
  if(code) return *code;
  const Results results(options.output,
                        { ".json", "_mesh.ply", "_inner.ply", "_outer.ply", "_places.ply", "_simplified.ply",
                          "_whole.ply", "_detail.ply", "_simplified.json", "_excised.ply" });
  if(const int refused = results.prepare(options.file)) return refused;
#ifdef CGAL_LINKED_WITH_TBB
  std::optional<tbb::global_control> control;
  if(options.threads > 0) control.emplace(tbb::global_control::max_allowed_parallelism, options.threads);
#endif
  return results.finish(run(options, results));
}
