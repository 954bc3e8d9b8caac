#include "Exit_code.h"
#include "Input.h"
#include "Json.h"
#include "Progress.h"
#include "Result_files.h"
#include "Simplified.h"
#include "verbs.h"

#include "../Carry/carry_attributes.h"
#include "../Files/write_model.h"

#include <CGAL/Bspline_shell_3/Soup/provenance.h>

#include <CGAL/Real_timer.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <utility>

namespace Tool {

namespace {

constexpr double default_thickness = 0.01; // fraction of the longest side of the bounding box

// Returns the number of triangles into which the polygons are split.
std::size_t number_of_triangles(const Model& model)
{
  std::size_t number = 0;
  for(const auto& polygon : model.soup.polygons) number += polygon.size() < 3 ? 0 : polygon.size() - 2;
  return number;
}

// Simplifies a model, and returns the result and the thickness of its shell. With a tolerance, several
// thicknesses are tried, and the result with the fewest facets is returned. The distance to a result is about as large
// as the thickness: thicker shells are tried while much of the tolerance is left, and thinner ones while it is
// exceeded.
std::pair<std::unique_ptr<Simplified>, double> simplify_model(const Model& model, const Simplify_options& options,
                                                              Progress& progress)
{
  constexpr int attempts = 4;
  constexpr double aim = 0.9, slack = 0.75; // fractions of the tolerance
  const double unit = longest_side(model);
  const double tolerance = options.tolerance ? options.tolerance->in_box(unit) : 0;
  CGAL::Real_timer timer;
  timer.start();
  Simplify_target target;
  target.thickness = options.thickness   ? options.thickness->in_box(unit)
                     : options.tolerance ? tolerance
                                         : default_thickness * unit;
  target.facets = options.facets > 0 ? options.facets
                                     : std::size_t(std::ceil(options.ratio * double(number_of_triangles(model))));
  target.rounds_coordinates = model.coordinates == Number_type::FLOAT32 || has_single_precision(options.output);
  std::pair<std::unique_ptr<Simplified>, double> best;
  bool is_kept = false; // whether the best result keeps the tolerance
  for(int attempt = 0; attempt < attempts; ++attempt) {
    target.seconds = options.seconds - timer.time();
    if(attempt > 0 && !(target.seconds > 0)) break;
    auto result = std::make_unique<Simplified>();
    simplify_model(model, target, progress, *result);
    progress.clear();
    const bool is_simplified = result->status == Simplify_status::SUCCESS;
    if(is_kept && !is_simplified) break;
    const double distance = result->distances.largest(), thickness = target.thickness;
    const bool keeps_tolerance = is_simplified && distance <= tolerance;
    const bool may_continue = is_simplified && options.tolerance && !options.thickness && !result->found.proxy
                              && distance > 0 && (!keeps_tolerance || result->end == BS::Edit_termination::SHELL);
    target.thickness *= aim * tolerance / distance;
    if(!is_kept || (keeps_tolerance && result->facets < best.first->facets)) best = { std::move(result), thickness };
    const bool was_kept = std::exchange(is_kept, is_kept || keeps_tolerance);
    if(!may_continue || (keeps_tolerance && distance > slack * tolerance) || (was_kept && !keeps_tolerance)) break;
  }
  return best;
}

std::string number(double x)
{
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.4g", x);
  return buffer;
}

// Returns which limit ended the simplification, and which one would allow fewer facets.
std::string limit_message(const Simplify_options& options, const Simplified& result, double thickness)
{
  if(result.end == BS::Edit_termination::STOP_PREDICATE)
    return "The requested number of facets ended the simplification.";
  if(result.end == BS::Edit_termination::MESH) return message(result.end);
  if(result.end == BS::Edit_termination::FILTER)
    return "Seams, borders of labels, or excised triangles ended the simplification; --facets gives up seams and "
           "borders if necessary.";
  const bool has_tolerance = options.tolerance && !options.thickness;
  return has_tolerance ? "The tolerance ended the simplification: a larger --tolerance allows fewer facets."
                       : "The shell ended the simplification: a larger --thickness than " + number(thickness)
                           + " allows fewer facets.";
}

Json changes(const Model& model, const BS::Shell_of_soup_3& found)
{
  std::vector<std::size_t> number(std::size_t(BS::Polygon_change::WRAPPED) + 1, 0);
  for(BS::Polygon_change change : BS::provenance(model.soup, found)) ++number[std::size_t(change)];
  Json json;
  for(std::size_t c = 0; c < number.size(); ++c)
    if(number[c] > 0) json.add(name(BS::Polygon_change(c)), number[c]);
  return json;
}

} // namespace

int simplify(const Simplify_options& options)
{
  Model model;
  if(!is_supported(options.output)) {
    complain(options.output, message(File_status::UNSUPPORTED));
    return WRONG_USAGE;
  }
  if(is_same_file(options.input, options.output)) {
    complain(options.output, "The result would replace the input: choose another name.");
    return WRONG_USAGE;
  }
  if(!read_input(options.input, model)) return WRONG_INPUT;
  if(!is_writable(options.output)) {
    complain(options.output, message(File_status::CANNOT_WRITE));
    return CANNOT_WRITE;
  }

  CGAL::Real_timer timer;
  timer.start();
  Progress progress;
  const auto [result, thickness] = simplify_model(model, options, progress);
  const BS::Shell_of_soup_3& found = result->found;
  if(result->status != Simplify_status::SUCCESS) {
    complain(options.input, result->message, found.offending_simplices);
    return result->status == Simplify_status::NO_SHELL ? WRONG_INPUT : NOT_CERTIFIED;
  }
  if(options.tolerance && result->distances.largest() > options.tolerance->in_box(longest_side(model))) {
    complain(options.input,
             "The tolerance is not kept: the distance is at most " + number(result->distances.largest()) + ". "
               + (found.proxy
                    ? "The polygons are not a mesh, so that a proxy around them was simplified. " + found.mesh_message()
                    : "Use a thinner shell (--thickness)."));
    return NOT_CERTIFIED;
  }

  Carry_report carried;
  Model output = carry_attributes(model, found, result->mesh, result->rejoined,
                                  options.carries_normals ? Normals::CARRIED : Normals::RECOMPUTED, carried,
                                  [&](double fraction) { progress.show("attributes", fraction); });
  progress.clear();
  const Written_files written = write_model(output, options.output);
  for(const auto& file : written.files)
    if(std::any_of(model.files.begin(), model.files.end(),
                   [&](const std::string& input) { return is_same_file(file.first, input); })) {
      complain(file.first, "The result would replace a part of the input: choose another name.");
      return WRONG_USAGE;
    }
  const std::string failed = write_files(written.files);
  if(!failed.empty()) {
    complain(failed, message(File_status::CANNOT_WRITE));
    return CANNOT_WRITE;
  }

  for(const std::string& warning : written.warnings) std::cerr << options.output << ": " << warning << "\n";
  std::ostream& out = report_stream(options.output);
  const std::string limit = limit_message(options, *result, thickness);
  if(options.writes_json) {
    Json json;
    json.add("input", options.input)
      .add("output", options.output)
      .add("certification", name(found.certification()))
      .add("kind", name(found.kind()))
      .add("facets_before", result->facets_before)
      .add("facets", result->facets)
      .add("distance_to_result", result->distances.to_second)
      .add("distance_to_input", result->distances.to_first)
      .add("thickness", thickness)
      .add("limit", limit)
      .add("polygons", changes(model, found))
      .add("attributes", written.attributes)
      .add("warnings", written.warnings)
      .add("edges_on_lines", result->lines)
      .add("gave_up_lines", result->gave_up_lines)
      .add("facets_across_seams", carried.facets_across_seams)
      .add("points_without_image", carried.points_without_image)
      .add("seconds", timer.time());
    out << json.text() << std::endl;
    return DONE;
  }
  const bool is_split = number_of_triangles(model) != model.soup.polygons.size();
  out << "facets      " << result->facets << " of " << result->facets_before
      << (is_split ? " triangles, into which the " + std::to_string(model.soup.polygons.size())
                       + " polygons of the file are split"
                   : "")
      << "\n"
      << "distance    at most " << number(result->distances.largest()) << " between any point of one surface and "
      << "the other (" << number(100 * result->distances.largest() / longest_side(model)) << " % of the box)\n"
      << "map         one-to-one" << (found.proxy ? " from the proxy" : "") << ", " << name(found.certification())
      << "; " << name(found.kind()) << "\n";
  if(found.excised) out << "excised     " << found.excision_message() << "\n";
  if(found.proxy) out << "proxy       " << found.mesh_message() << "\n";
  if(!written.attributes.empty()) {
    out << "attributes ";
    for(const std::string& name : written.attributes) out << " " << name;
    out << "\n";
  }
  if(carried.facets_across_seams > 0)
    out << "seams       " << carried.facets_across_seams << " facets lie across a seam\n";
  if(carried.points_without_image > 0)
    out << "            " << carried.points_without_image << " points have the values of the nearest points\n";
  if(result->gave_up_lines) out << "lines       were not kept, because the requested number of facets needs them\n";
  if(model.coordinates == Number_type::FLOAT32 && !result->is_rounded && !has_single_precision(options.output))
    out << "coordinates are of type double, because rounding to float would invalidate the proof\n";
  out << "limit       " << limit << std::endl;
  return DONE;
}

} // namespace Tool
