#include "Input.h"
#include "Json.h"
#include "Result_files.h"
#include "verbs.h"

#include "../Carry/Mesh_origins.h"
#include "../Files/File_status.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/IO/write_certificate.h>
#include <CGAL/Bspline_shell_3/IO/write_shell.h>
#include <CGAL/Bspline_shell_3/Soup/sample_soup_shares.h>
#include <CGAL/Bspline_shell_3/Soup/write_report.h>
#include <CGAL/Bspline_shell_3/Surface/extract_shell_surface.h>

#include <CGAL/IO/io.h>
#include <CGAL/Surface_mesh/IO/OFF.h>
#include <CGAL/Surface_mesh/IO/PLY.h>

#include <iostream>
#include <sstream>

namespace Tool {

namespace {

// Returns the text that a function writes to a stream.
template <typename Write>
std::string text_of(const Write& write)
{
  std::ostringstream out(std::ios::binary);
  out.precision(17);
  write(out);
  return out.str();
}

std::string ply_of(const Mesh& mesh)
{
  return text_of([&](std::ostream& out) {
    CGAL::IO::set_binary_mode(out);
    CGAL::IO::write_PLY(out, mesh);
  });
}

const char* const endings[] = { ".shell",       ".json",      "_mesh.ply", "_inner.ply",      "_outer.ply",
                                "_excised.ply", ".shell.txt", ".mesh.off", ".certificate.txt" };

std::string excised_triangles(const BS::Excised_soup_3& soup)
{
  BS::Polygon_soup::Polygons triangles;
  for(std::size_t t : soup.excised_triangles())
    triangles.emplace_back(soup.soup().triangles[t].begin(), soup.soup().triangles[t].end());
  return text_of([&](std::ostream& out) {
    CGAL::IO::set_binary_mode(out);
    CGAL::IO::write_PLY(out, soup.soup().points, triangles);
  });
}

} // namespace

Outcome shell(const Shell_options& options, const std::string& prefix, bool writes_json)
{
  for(const char* ending : endings)
    if(is_same_file(prefix + ending, options.input))
      return { WRONG_USAGE, options.input, "The results would replace the input: choose another prefix." };
  Model model;
  if(const Outcome read = read_input(options.input, model); !read) return read;
  if(!is_writable(prefix + endings[0]))
    return { CANNOT_WRITE, prefix + endings[0], message(File_status::CANNOT_WRITE) };
  Progress progress;
  BS::Shell_of_soup_3 found;
  const double thickness = thickness_of(options, longest_side(model));
  if(const Outcome outcome = find_shell(model, options, thickness, options.seconds, progress, found); !outcome)
    return outcome;

  const BS::Soup_shares shares = found.proxy ? BS::sample_soup_shares(found.proxy->map()) : BS::Soup_shares();
  BS::Shell_certificate_3<Shell::Field, Shell::Threshold> certificate(found.shell());
  certificate.verify(found.mesh());
  Contents files;
  const auto add = [&](const char* ending, std::string text) { files.emplace_back(prefix + ending, std::move(text)); };
  add(".shell", text_of([&](std::ostream& out) { BS::write_shell(out, found.shell(), BS::Shell_format::BINARY); }));
  add(".json", text_of([&](std::ostream& out) { BS::write_report(out, found, shares, options.input); }));
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
  // the input of an independent checker
  add(".shell.txt", text_of([&](std::ostream& out) { BS::write_shell(out, found.shell(), BS::Shell_format::ASCII); }));
  add(".mesh.off", text_of([&](std::ostream& out) { out << certificate.examined_mesh(); }));
  add(".certificate.txt", text_of([&](std::ostream& out) { BS::write_certificate(out, found.shell(), certificate); }));
  const std::string failed = write_files(files);
  if(!failed.empty()) return { CANNOT_WRITE, failed, message(File_status::CANNOT_WRITE) };

  std::vector<std::string> names;
  for(const auto& file : files) names.push_back(file.first);
  if(writes_json) {
    Json json;
    json.add("input", options.input)
      .add("certification", name(found.certification()))
      .add("kind", name(found.kind()))
      .add("facets", std::size_t(found.mesh().number_of_faces()))
      .add("cells", found.shell().report().cells)
      .add("thickness", found.shell().thickness())
      .add("files", names)
      .add("seconds", found.seconds);
    std::cout << json.text() << std::endl;
    return DONE;
  }
  std::cout << "shell       " << found.mesh().number_of_faces() << " facets, " << name(found.kind()) << "; "
            << found.shell().report().cells << " cells\n"
            << "thickness   " << found.shell().thickness() << " (" << 100 * found.shell().relative_thickness()
            << " % of the box)\n"
            << with_options(found.message()) << "\nfiles      ";
  for(const std::string& name : names) std::cout << " " << name;
  std::cout << std::endl;
  return DONE;
}

} // namespace Tool
