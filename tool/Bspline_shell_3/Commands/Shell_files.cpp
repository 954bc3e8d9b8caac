#include "Shell_files.h"

#include "../Carry/Mesh_origins.h"
#include "../Files/File_status.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/IO/write_certificate.h>
#include <CGAL/Bspline_shell_3/IO/write_shell.h>
#include <CGAL/Bspline_shell_3/Soup/sample_soup_shares.h>
#include <CGAL/Bspline_shell_3/Soup/write_report.h>
#include <CGAL/Bspline_shell_3/Surface/extract_shell_surface.h>

#include <CGAL/IO/Color.h>
#include <CGAL/IO/io.h>
#include <CGAL/IO/write_ply_points.h>
#include <CGAL/Surface_mesh/IO/OFF.h>
#include <CGAL/Surface_mesh/IO/PLY.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <sstream>
#include <utility>

namespace Tool {

namespace {

constexpr std::array<const char*, 10> endings = { ".shell",     ".json",           "_mesh.ply", "_inner.ply",
                                                  "_outer.ply", "_excised.ply",    "_soup.ply", ".shell.txt",
                                                  ".mesh.off",  ".certificate.txt" };
constexpr std::array<const char*, 3> failure_endings = { "_failed.json", "_failed_mesh.ply", "_failed_places.ply" };

// Adds those of the files that are not among the new ones without contents.
template <typename Endings>
void remove_others(const std::string& prefix, const Endings& of_files, Contents& files)
{
  for(const char* ending : of_files) {
    const std::string name = prefix + ending;
    if(std::none_of(files.begin(), files.end(), [&](const auto& file) { return file.first == name; }))
      files.emplace_back(name, std::nullopt);
  }
}

// Returns the text that a function writes to a stream.
template <typename Write>
std::string text_of(const Write& write)
{
  std::ostringstream out(std::ios::binary);
  out.precision(17);
  write(out);
  return out.str();
}

template <typename... Data>
std::string ply_of(const Data&... data)
{
  return text_of([&](std::ostream& out) {
    CGAL::IO::set_binary_mode(out);
    CGAL::IO::write_PLY(out, data...);
  });
}

std::string excised_triangles(const BS::Excised_soup_3& soup)
{
  BS::Polygon_soup::Polygons triangles;
  for(std::size_t t : soup.excised_triangles())
    triangles.emplace_back(soup.soup().triangles[t].begin(), soup.soup().triangles[t].end());
  return ply_of(soup.soup().points, triangles);
}

// Returns the triangles of the polygons around a proxy, colored by the images of their points.
std::string colored_soup(const BS::Soup_proxy_3& proxy, const BS::Soup_shares& shares)
{
  Mesh soup = proxy.soup().mesh();
  auto color = soup.add_property_map<Mesh::Face_index, CGAL::IO::Color>("f:color").first;
  std::size_t n = 0;
  for(auto f : soup.faces()) {
    const BS::Soup_point p = shares.facets[n++];
    color[f] = p == BS::Soup_point::CARRIED     ? CGAL::IO::green()
               : p == BS::Soup_point::CONTINUED ? CGAL::IO::yellow()
                                                : CGAL::IO::gray();
  }
  return ply_of(soup);
}

BS::Soup_shares shares_of(const BS::Shell_of_soup_3& found)
{
  return found.proxy ? BS::sample_soup_shares(found.proxy->map()) : BS::Soup_shares();
}

std::string report_of(const BS::Shell_of_soup_3& found, const BS::Soup_shares& shares, const std::string& input)
{
  return text_of([&](std::ostream& out) { BS::write_report(out, found, shares, input); });
}

} // namespace

Outcome check_shell_files(const std::string& prefix, const std::vector<std::string>& others)
{
  std::vector<std::string> names;
  for(const char* ending : endings) names.push_back(prefix + ending);
  for(const char* ending : failure_endings) names.push_back(prefix + ending);
  for(const std::string& file : names) {
    for(const std::string& other : others)
      if(file == other || is_same_file(file, other))
        return { WRONG_USAGE, other, "A file of the shell would replace this file: choose another prefix." };
    if(!is_writable(file)) return { CANNOT_WRITE, file, message(File_status::CANNOT_WRITE) };
  }
  return DONE;
}

Contents shell_files(const std::string& prefix, const BS::Shell_of_soup_3& found, const std::string& input,
                     bool includes_certificate)
{
  Contents files;
  const auto add = [&](const char* ending, std::string text) { files.emplace_back(prefix + ending, std::move(text)); };
  const BS::Soup_shares shares = shares_of(found);
  add(".shell", text_of([&](std::ostream& out) { BS::write_shell(out, found.shell(), BS::Shell_format::BINARY); }));
  add(".json", report_of(found, shares, input));
  add("_mesh.ply", ply_of(found.mesh()));
  const auto add_surface = [&](const char* ending, const Shell::Threshold& threshold) {
    Mesh surface;
    const BS::Level_set_status status = BS::extract_shell_surface<CGAL::Parallel_if_available_tag>(found.shell(),
                                                                                                   threshold, surface);
    if(status == BS::Level_set_status::SUCCESS) add(ending, ply_of(surface));
    else std::cerr << prefix << ending << ": " << message(status) << "\n";
  };
  add_surface("_inner.ply", found.shell().inner_threshold());
  add_surface("_outer.ply", found.shell().outer_threshold());
  if(found.excised) add("_excised.ply", excised_triangles(*found.excised));
  if(found.proxy) add("_soup.ply", colored_soup(*found.proxy, shares));
  if(includes_certificate) {
    BS::Shell_certificate_3<Shell::Field, Shell::Threshold> certificate(found.shell());
    certificate.verify(found.mesh());
    const auto write = [&](const char* ending, const auto& writer) { add(ending, text_of(writer)); };
    write(".shell.txt", [&](std::ostream& out) { BS::write_shell(out, found.shell(), BS::Shell_format::ASCII); });
    write(".mesh.off", [&](std::ostream& out) { out << certificate.examined_mesh(); });
    write(".certificate.txt", [&](std::ostream& out) { BS::write_certificate(out, found.shell(), certificate); });
  }
  remove_others(prefix, endings, files);
  remove_others(prefix, failure_endings, files);
  return files;
}

Outcome write_failure(const Outcome& outcome, const std::string& prefix, const BS::Shell_of_soup_3& found,
                      const std::string& input)
{
  Contents files;
  files.emplace_back(prefix + failure_endings[0], report_of(found, shares_of(found), input));
  if(found.mesh().number_of_faces() > 0) files.emplace_back(prefix + failure_endings[1], ply_of(found.mesh()));
  std::vector<Mesh::Point> places;
  for(const BS::Refinement_obstacle& o : found.shell().report().obstacles)
    places.emplace_back(o.point[0], o.point[1], o.point[2]);
  if(!places.empty()) files.emplace_back(prefix + failure_endings[2], ply_of(places));
  const std::string report = " The report is " + files.front().first
                             + (places.empty()
                                  ? "."
                                  : ", and places where the proof fails are in " + files.back().first + ".");
  remove_others(prefix, failure_endings, files);
  const std::string failed = write_files(files);
  Outcome result = outcome;
  result.message += failed.empty() ? report : " The report cannot be written to " + failed + ".";
  return result;
}

} // namespace Tool
