// Builds the shell of each mesh and certifies it. Prints one JSON object per line, even if a mesh is refused or a
// process dies: every mesh has a separate process.
//
//   certify_meshes FILE... [--thickness T] [--constant] [--gamma G] [--paper] [--no-proxy] [--no-truncation]
//                  [--cone-margin M] [--max-seconds S] [--max-memory-mb M] [--write-shells DIR] [--surfaces]
//
// By default, cells are refined until all claims are proved.
// --thickness: the requested thickness (default 0.01, of the longest box side).
// --constant: constant thresholds.
// --gamma: equal cells of this resolution, and constant thresholds.
// --paper: the paper's dense grid and energy.
// --no-truncation: singular vertices are accepted, but not truncated; meshes only.
// --max-seconds: the time limit; a process that takes 25 % more is killed.
// --write-shells: NAME.shell, NAME.shell.txt, NAME.mesh.off and NAME.certificate.txt, which check_certificate reads.
// --surfaces: the inner and the outer surface of each shell are extracted. "surfaces" has their numbers of components
// and Euler characteristics, with those of the mesh, and whether they are closed and 2-manifold.
// Thicknesses, eps1 and eps2 are in units of the longest box side; numbers that are not finite are null.
//
// The kind is "closed"; "truncated" if tips of the mesh are replaced; "virtually closed" for an open mesh, whose facets
// include those that close it; "excised" if triangles with defects were taken out; or "proxy", with sampled shares of
// the area, and the reason why the mesh itself has no shell. --no-proxy and --gamma accept meshes only, also with
// singular vertices. The status is "certified", "certified_except_excised", "not_certified" (the mesh lies in the
// shell, but another claim is not proved), "no_shell" (not even containment is proved), or "refused".
#include "../json.h"

#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>
#include <CGAL/Bspline_shell_3/IO/write_certificate.h>
#include <CGAL/Bspline_shell_3/IO/write_shell.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Soup/sample_soup_shares.h>
#include <CGAL/Bspline_shell_3/Support/keep_freed_memory.h>
#include <CGAL/Bspline_shell_3/Surface/extract_shell_surface.h>
#include <CGAL/bspline_shell_3.h>
#include <CGAL/certified_bspline_shell_3.h>
#include <CGAL/certified_shell_of_soup_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Real_timer.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

struct Options
{
  double gamma = 0, thickness = 0.01, max_seconds = 0, max_memory_mb = 0,
         cone_margin = BS::Certified_shell_parameters().least_cone_margin;
  bool paper = false, constant = false, proxy = true, truncation = true, surfaces = false;
  std::string directory;
};

std::string stem(const std::string& file)
{
  const std::string base = file.substr(file.find_last_of('/') + 1);
  return base.substr(0, base.find_last_of('.'));
}

double peak_mb()
{
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024.;
}

std::string list(const std::vector<std::size_t>& numbers)
{
  std::ostringstream out;
  out << "[";
  for(std::size_t n = 0; n < (std::min)(numbers.size(), std::size_t(10)); ++n) out << (n > 0 ? "," : "") << numbers[n];
  out << "]";
  return out.str();
}

// Returns NaN, which is printed as null, if x is not positive.
double if_positive(double x)
{
  return x > 0 ? x : std::numeric_limits<double>::quiet_NaN();
}

void print_refused(const std::string& file, const Options& options, const std::string& reason,
                   const BS::Offending_simplices& offenders, double seconds, double mb)
{
  std::cout << "{\"mesh\":" << quoted(file) << ",\"status\":\"refused\",\"reason\":" << quoted(reason)
            << ",\"gamma\":" << if_positive(options.gamma) << ",\"offending\":{\"facets\":" << list(offenders.facets)
            << ",\"vertices\":" << list(offenders.vertices) << "},\"seconds\":{\"total\":" << seconds
            << "},\"peak_mb\":" << mb << "}" << std::endl;
}

// Returns the first places where a claim is not proved.
std::string places(const BS::Certificate_report& certificate)
{
  std::ostringstream out;
  out << std::setprecision(8) << "[";
  std::size_t printed[5] = {};
  bool first = true;
  for(const BS::Certificate_witness& w : certificate.witnesses) {
    if(++printed[int(w.claim)] > 3) continue;
    out << (first ? "" : ",") << "{\"claim\":\"" << name(w.claim) << "\",\"verdict\":\"" << name(w.verdict)
        << "\",\"reason\":\"" << name(w.reason) << "\"";
    if(w.facet != w.none) out << ",\"facet\":" << w.facet;
    if(w.cell != w.none) out << ",\"cell\":" << w.cell;
    if(w.component != w.none) out << ",\"component\":" << w.component;
    if(w.reason == w.CROSSINGS) out << ",\"count\":" << w.count;
    if(w.reason == w.FACET && w.value.min <= w.value.max)
      out << ",\"value\":[" << w.value.min << "," << w.value.max << "]";
    out << ",\"point\":[" << w.point[0] << "," << w.point[1] << "," << w.point[2] << "]}";
    first = false;
  }
  out << "]";
  return out.str();
}

template <typename Shell, typename Certificate>
bool write_files(const std::string& file, const Options& options, const Shell& shell, const Certificate& certificate)
{
  if(options.directory.empty()) return true;
  const std::string prefix = options.directory + "/" + stem(file);
  return BS::write_shell(prefix + ".shell", shell) == BS::Shell_file_status::SUCCESS
         && BS::write_shell(prefix + ".shell.txt", shell) == BS::Shell_file_status::SUCCESS
         && BS::write_certificate(prefix + ".certificate.txt", shell, certificate)
         && BS::write_file(prefix + ".mesh.off", [&](std::ostream& out) {
              return CGAL::IO::write_OFF(out, certificate.examined_mesh(), CGAL::parameters::stream_precision(17));
            });
}

struct Topology
{
  bool is_closed_manifold;
  std::size_t components;
  long euler_characteristic;
};

Topology topology(const Mesh& mesh)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  std::vector<Mesh::Halfedge_index> pinched;
  PMP::non_manifold_vertices(mesh, std::back_inserter(pinched));
  std::vector<std::size_t> component(num_faces(mesh));
  return { CGAL::is_closed(mesh) && pinched.empty(),
           PMP::connected_components(mesh, CGAL::make_property_map(component)),
           long(mesh.number_of_vertices()) - long(mesh.number_of_edges()) + long(mesh.number_of_faces()) };
}

// Returns properties of the shell's two surfaces, and of the certified mesh without isolated vertices.
template <typename Shell, typename Certificate>
std::string surfaces(const Options& options, const Shell& shell, const Certificate& certificate)
{
  if(!options.surfaces) return "";
  Mesh mesh = certificate.examined_mesh();
  CGAL::Polygon_mesh_processing::remove_isolated_vertices(mesh);
  std::ostringstream out;
  const auto add = [&](const char* name, const Topology& t) {
    out << "\"" << name << "\":{\"closed_manifold\":" << (t.is_closed_manifold ? "true" : "false")
        << ",\"components\":" << t.components << ",\"euler_characteristic\":" << t.euler_characteristic << "}";
  };
  out << ",\"surfaces\":{";
  add("mesh", topology(mesh));
  CGAL::Real_timer timer;
  timer.start();
  for(bool outer : { false, true }) {
    Mesh surface;
    const BS::Level_set_status status = BS::extract_shell_surface<CGAL::Parallel_if_available_tag>(
      shell, outer ? shell.outer_threshold() : shell.inner_threshold(), surface);
    out << ",";
    if(status == BS::Level_set_status::SUCCESS) add(outer ? "outer" : "inner", topology(surface));
    else out << "\"" << (outer ? "outer" : "inner") << "\":" << quoted(message(status));
  }
  out << ",\"seconds\":" << timer.time() << "}";
  return out.str();
}

// Returns the smallest and the largest threshold, or an empty range if the shell is empty.
template <typename Shell>
BS::Level_range threshold_range(const Shell& shell)
{
  BS::Level_range range;
  if constexpr(Shell::Threshold::is_constant) {
    range = { shell.inner_level(), shell.outer_level() };
  } else {
    for(std::size_t c = 0; c < shell.field().number_of_cells(); ++c) {
      if(!shell.shell_cells()[c]) continue;
      range.include(shell.inner_threshold().field().cell(c).coefficient_range().first);
      range.include(shell.outer_threshold().field().cell(c).coefficient_range().second);
    }
  }
  return range;
}

// Returns the outcomes for vertices whose facets barely face a common direction.
std::string truncation(const BS::Shell_report& r)
{
  typedef BS::Truncation_report::Outcome Outcome;
  if(r.truncation.vertices.empty()) return "";
  double before = 1, after = 1;
  for(const BS::Truncation_report::Vertex& v : r.truncation.vertices) {
    before = (std::min)(before, v.margin_before);
    if(v.outcome == Outcome::TRUNCATED) after = (std::min)(after, v.margin_after);
  }
  std::ostringstream out;
  out << ",\"truncation\":{";
  for(Outcome o : { Outcome::TRUNCATED, Outcome::ON_BORDER, Outcome::FOLDED_EDGE, Outcome::NO_DISC, Outcome::NO_SPACE })
    out << "\"" << name(o) << "\":" << r.truncation.number(o) << ",";
  out << "\"least_margin_before\":" << before << ",\"least_margin_after\":" << after << "}";
  return out.str();
}

// Returns the properties of a proxy.
std::string proxy_properties(const BS::Shell_of_soup_3& result)
{
  if(!result.proxy) return "";
  const BS::Proxy_report& r = result.proxy->report();
  const double unit = result.shell().report().unit;
  const BS::Soup_shares shares = BS::sample_soup_shares(result.proxy->map());
  std::ostringstream out;
  out << ",\"proxy\":{\"because\":" << quoted(result.mesh_message()) << ",\"alpha\":" << r.alpha / unit
      << ",\"offset\":" << r.offset / unit << ",\"wraps\":" << r.wraps << ",\"carried\":" << shares.carried
      << ",\"continued\":" << shares.continued << ",\"hidden\":" << shares.hidden << "}";
  return out.str();
}

// Returns the properties of an excision, also if it did not help.
std::string excision_properties(const BS::Shell_of_soup_3& result)
{
  const BS::Excision_report& r = result.excision_report;
  if(r.excised == 0) return "";
  std::ostringstream out;
  out << ",\"excision\":{\"excised\":" << r.excised << ",\"area\":" << r.excised_area
      << ",\"pinned_vertices\":" << r.pinned_vertices << ",\"pinned_edges\":" << r.pinned_edges
      << ",\"message\":" << quoted(result.excision_message()) << "}";
  return out.str();
}

// Returns the figures of each round of refinement: numbers of cells and facets, and the seconds of each step.
std::string rounds(const BS::Shell_report& report)
{
  std::ostringstream out;
  for(const BS::Refinement_round& r : report.rounds) {
    out << (out.tellp() > 0 ? "," : "") << "{\"cells\":" << r.cells << ",\"partial\":" << r.partial
        << ",\"thick\":" << r.thick_cells << ",\"sloping\":" << r.sloping_cells
        << ",\"sloping_left\":" << r.sloping_cells_left << ",\"failing_facets\":" << r.failing_facets
        << ",\"undecided\":" << r.undecided_cells << ",\"marked\":" << r.marked_cells << ",\"seconds\":{";
    constexpr std::array<const char*, 7> steps = { "cells",  "distance", "assembly",   "solver",
                                                   "slopes", "bounds",   "certificate" };
    for(std::size_t n = 0; n < steps.size(); ++n)
      out << (n > 0 ? "," : "") << "\"" << steps[n] << "\":" << r.seconds[n];
    out << "}}";
  }
  return "[" + out.str() + "]";
}

template <typename Shell>
void print(const std::string& file, const char* kind, const Shell& shell, const BS::Certificate_report& certificate,
           const char* status, std::string reason, double seconds, bool written, const std::string& more = "")
{
  const BS::Shell_report& r = shell.report();
  const BS::Certificate_statistics& s = certificate.statistics;
  if(reason.empty())
    for(int c = 0; c < 5; ++c)
      if(certificate.verdicts[c] != BS::Verdict::PROVED)
        reason += (reason.empty() ? "" : ", ") + std::string(name(BS::Claim(c)));
  if(!r.rounds.empty() && r.refinement != BS::Refinement_status::CERTIFIED)
    reason += (reason.empty() ? "" : ". ") + std::string(message(r.refinement));
  if(r.limit.resource != BS::Refinement_resource::NONE) reason += " " + message(r.limit);
  const auto tier = [](const BS::Predicate_statistics& p) {
    std::ostringstream out;
    out << "{\"cell\":" << p.by_cell << ",\"form\":" << p.by_form << ",\"subdivided\":" << p.subdivisions << "}";
    return out.str();
  };
  const BS::Level_range thresholds = threshold_range(shell);
  const double certify = Shell::Threshold::is_constant ? s.seconds
                                                       : r.seconds[std::size_t(BS::Shell_step::CERTIFICATE)];
  std::cout << "{\"mesh\":" << quoted(file) << ",\"kind\":\"" << kind << "\"" << more
            << ",\"closing\":{\"caps\":" << r.closing.caps() << ",\"sheets\":" << r.closing.sheets
            << ",\"triangles\":" << r.closing.triangles << ",\"least_offset\":" << r.closing.least_offset / r.unit
            << "}" << truncation(r) << ",\"facets\":" << r.triangles << ",\"components\":" << r.components
            << ",\"status\":\"" << status << "\",\"reason\":" << quoted(reason) << ",\"gamma\":" << r.gamma
            << ",\"levels\":" << (r.rounds.empty() ? 1 : r.rounds.back().levels) << ",\"rounds\":" << r.rounds.size()
            << ",\"partial_rounds\":"
            << std::count_if(r.rounds.begin(), r.rounds.end(), [](const auto& round) { return round.partial; })
            << ",\"round_figures\":" << rounds(r) << ",\"cells\":" << r.cells << ",\"unknowns\":" << r.unknowns
            << ",\"eps1\":" << thresholds.min / r.unit << ",\"eps2\":" << thresholds.max / r.unit
            << ",\"thickness\":" << shell.relative_thickness() << ",\"narrowed_area\":" << r.narrowed_area
            << ",\"min_cone_margin\":" << certificate.least_cone_margin
            << ",\"singular_vertices\":" << certificate.singular_vertices.size() << ",\"certificate\":{";
  for(int c = 0; c < 5; ++c)
    std::cout << (c > 0 ? "," : "") << "\"" << name(BS::Claim(c)) << "\":\"" << name(certificate.verdicts[c]) << "\"";
  std::cout << "},\"violations\":{";
  for(int c = 0; c < 5; ++c)
    std::cout << (c > 0 ? "," : "") << "\"" << name(BS::Claim(c))
              << "\":" << certificate.number_of_witnesses[std::size_t(c)];
  std::cout << "},\"places\":" << places(certificate) << ",\"least_gradient\":" << certificate.least_gradient
            << ",\"displacement\":" << if_positive(certificate.displacement_bound / r.unit)
            << ",\"least_angle\":" << certificate.least_angle << ",\"tiers\":{\"containment\":" << tier(s.containment)
            << ",\"transversality\":" << tier(s.transversality) << ",\"gradient\":{\"cells\":" << s.cover_cells
            << ",\"excluded\":" << s.excluded_boxes << ",\"monotone\":" << s.monotone_boxes
            << ",\"critical\":" << s.critical_boxes << ",\"undecided\":" << s.undecided_boxes
            << ",\"depth\":" << s.deepest_box
            << "}},\"seconds\":{\"distance\":" << r.seconds[std::size_t(BS::Shell_step::DISTANCE)]
            << ",\"fit\":" << r.seconds[std::size_t(BS::Shell_step::FIT)] << ",\"certify\":" << certify
            << ",\"total\":" << seconds << "},\"peak_mb\":" << peak_mb()
            << (written ? "" : ",\"files\":\"cannot be written\"") << "}" << std::endl;
}

void certify(const std::string& file, const Options& options)
{
  CGAL::Real_timer timer;
  timer.start();
  const auto refuse = [&](BS::Shell_status status, const BS::Offending_simplices& offenders) {
    print_refused(file, options, message(status), offenders, timer.time(), peak_mb());
  };
  const double limit = options.max_memory_mb > 0
                         ? options.max_memory_mb * 1024 * 1024
                         : 0.8 * double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE));
  const double max_seconds = options.max_seconds > 0 ? options.max_seconds : std::numeric_limits<double>::infinity();
  const auto parameters = BS::parameters::relative_thickness(options.thickness)
                            .time_limit(max_seconds)
                            .constant_thresholds(options.constant)
                            .memory_limit(limit)
                            .least_cone_margin(options.cone_margin);
  BS::Offending_simplices offenders;
  if(options.gamma == 0 && options.proxy && options.truncation) {
    BS::Polygon_soup soup;
    const BS::Shell_status read = BS::read_polygon_soup(file, soup, offenders);
    if(read != BS::Shell_status::SUCCESS) return refuse(read, offenders);
    const BS::Shell_of_soup_3 result = CGAL::certified_shell_of_soup_3(soup, parameters);
    const double seconds = timer.time();
    if(!result) return refuse(result.status(), result.offending_simplices);
    BS::Shell_certificate_3 certificate(result.shell());
    if(!options.directory.empty() || options.surfaces) certificate.verify(result.mesh());
    const char* const status = result.is_certified()           ? "certified"
                               : result.shell().is_certified() ? "certified_except_excised"
                                                               : "not_certified";
    print(file, name(result.kind()), result.shell(), result.shell().report().certificate, status, "", seconds,
          write_files(file, options, result.shell(), certificate),
          proxy_properties(result) + excision_properties(result) + surfaces(options, result.shell(), certificate));
    return;
  }

  Mesh mesh;
  const BS::Shell_status read = BS::read_polygon_mesh(file, mesh, offenders);
  if(read != BS::Shell_status::SUCCESS) return refuse(read, offenders);
  if(options.gamma == 0) {
    const auto shell = CGAL::certified_bspline_shell_3(
      mesh, parameters.allow_singular_vertices(true).truncate(options.truncation));
    if(!shell) return refuse(shell.status(), shell.report().offending_simplices);
    const double seconds = timer.time();
    BS::Shell_certificate_3 certificate(shell);
    if(!options.directory.empty() || options.surfaces) certificate.verify(mesh);
    print(file,
          shell.closing()      ? "virtually closed"
          : shell.truncation() ? "truncated"
                               : "closed",
          shell, shell.report().certificate, shell.is_certified() ? "certified" : "not_certified", "", seconds,
          write_files(file, options, shell, certificate), surfaces(options, shell, certificate));
    return;
  }
  const auto shell = CGAL::bspline_shell_3(
    mesh, BS::parameters::resolution(options.gamma)
            .dense_grid(options.paper)
            .energy_weights(options.paper ? BS::Energy_weights::paper() : BS::Energy_weights())
            .allow_singular_vertices(true)
            .allow_open_shell(true)
            .memory_limit(limit));
  if(!shell) return refuse(shell.status(), shell.report().offending_simplices);
  BS::Shell_certificate_3<> certificate(shell);
  certificate.verify(mesh);
  const double seconds = timer.time();
  std::string reason;
  if(certificate.arithmetic() != BS::Arithmetic_status::SOUND) reason = message(certificate.arithmetic());
  else if(certificate.status() != BS::Shell_status::SUCCESS) reason = message(certificate.status());
  print(file, "closed", shell, certificate.report(), certificate.is_certified() ? "certified" : "not_certified", reason,
        seconds, write_files(file, options, shell, certificate), surfaces(options, shell, certificate));
}

// Certifies in a separate process, and reports if the process dies.
void certify_apart(const std::string& file, const Options& options)
{
  CGAL::Real_timer timer;
  timer.start();
  std::cout.flush();
  const pid_t child = fork();
  if(child == 0) {
    constexpr double late = 1.25; // some passes of CGAL exceed the limit
    if(options.max_seconds > 0) alarm(static_cast<unsigned int>(std::ceil(late * options.max_seconds)));
    try {
      certify(file, options);
    } catch(const std::exception& e) {
      print_refused(file, options, std::string("Exception: ") + e.what(), BS::Offending_simplices(), timer.time(),
                    peak_mb());
    }
    _exit(0);
  }
  int status = 0;
  struct rusage usage = {};
  if(child < 0 || wait4(child, &status, 0, &usage) < 0) {
    print_refused(file, options, "The process could not be started.", BS::Offending_simplices(), 0, 0);
    return;
  }
  if(WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  const bool late = WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM;
  print_refused(file, options,
                late ? "The time limit was reached."
                     : "The process ended with signal " + std::to_string(WTERMSIG(status)) + ".",
                BS::Offending_simplices(), timer.time(), usage.ru_maxrss / 1024.);
}

int main(int argc, char** argv)
{
  BS::keep_freed_memory();
  print_JSON_numbers();
  Options options;
  std::vector<std::string> files;
  bool usable = true;
  const auto positive = [&](const char* text) {
    char* end;
    const double x = std::strtod(text, &end);
    usable = usable && end != text && *end == '\0' && std::isfinite(x) && x > 0;
    return x;
  };
  for(int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    const bool has_value = i + 1 < argc;
    if(arg == "--paper") options.paper = true;
    else if(arg == "--constant") options.constant = true;
    else if(arg == "--no-proxy") options.proxy = false;
    else if(arg == "--no-truncation") options.truncation = false;
    else if(arg == "--surfaces") options.surfaces = true;
    else if(arg == "--cone-margin" && has_value) options.cone_margin = positive(argv[++i]);
    else if(arg == "--thickness" && has_value) options.thickness = positive(argv[++i]);
    else if(arg == "--gamma" && has_value) options.gamma = positive(argv[++i]);
    else if(arg == "--max-seconds" && has_value) options.max_seconds = positive(argv[++i]);
    else if(arg == "--max-memory-mb" && has_value) options.max_memory_mb = positive(argv[++i]);
    else if(arg == "--write-shells" && has_value) options.directory = argv[++i];
    else if(arg.compare(0, 2, "--") == 0) usable = false;
    else files.push_back(arg);
  }
  if(options.paper && options.gamma == 0) options.gamma = 50;
  if(!usable || files.empty()) {
    std::cerr << "Usage: certify_meshes FILE... [--thickness T] [--constant] [--gamma G] [--paper] [--no-proxy] "
                 "[--no-truncation] [--cone-margin M] [--max-seconds S] [--max-memory-mb M] [--write-shells DIR] "
                 "[--surfaces]\n";
    return 2;
  }
  for(const std::string& file : files) certify_apart(file, options);
  return EXIT_SUCCESS;
}
