#include "Edit_summary.h"
#include "Input.h"
#include "Outcome.h"
#include "Result_files.h"
#include "number.h"

#include "../Files/write_model.h"

#include <CGAL/Bspline_shell_3/Soup/provenance.h>

#include <iomanip>
#include <iostream>

namespace Tool {

namespace {

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

Edit_summary summary_of(const Edited& result, const std::string& input, const std::string& output)
{
  Edit_summary summary;
  summary.input = input;
  summary.output = output;
  summary.facets_before = result.facets_before;
  summary.facets = result.facets;
  summary.distances = result.distances;
  summary.thickness = result.thickness;
  summary.is_rounded = result.is_rounded;
  return summary;
}

Json json_of(const Edit_summary& summary, const Model& model, const BS::Shell_of_soup_3& found)
{
  Json json;
  json.add("input", summary.input)
    .add("output", summary.output)
    .add("certification", name(found.certification()))
    .add("kind", name(found.kind()))
    .add("facets_before", summary.facets_before)
    .add("facets", summary.facets)
    .add("reaches_target", summary.reaches_target)
    .add("distance_to_result", summary.distances.to_second)
    .add("distance_to_input", summary.distances.to_first)
    .add("thickness", summary.thickness)
    .add("limit", summary.limit)
    .add("polygons", changes(model, found))
    .add("attributes", summary.attributes)
    .add("warnings", summary.warnings)
    .add("is_rounded", summary.is_rounded)
    .add("removed_border_edges", summary.removed_border_edges)
    .add("facets_across_seams", summary.carried.facets_across_seams)
    .add("points_without_image", summary.carried.points_without_image)
    .add("seconds", summary.seconds);
  return json;
}

void print(const Edit_summary& summary, const Model& model, const BS::Shell_of_soup_3& found,
           const std::vector<std::pair<std::string, std::string> >& lines)
{
  std::ostream& out = report_stream(summary.output);
  const auto line = [&out](const std::string& title) -> std::ostream& {
    return out << std::left << std::setw(12) << title;
  };
  const double distance = summary.distances.largest();
  const std::size_t polygons = model.soup.polygons.size();
  line("facets") << summary.facets << " of " << summary.facets_before
                 << (polygons == summary.facets_before
                       ? ""
                       : " triangles, into which the " + std::to_string(polygons) + " polygons of the file are split")
                 << (summary.reaches_target ? "" : ": the requested number is not reached") << "\n";
  line("distance") << "at most " << number(distance) << " between any point of one surface and the other ("
                   << percent(distance / longest_side(model)) << " of the box)\n";
  line("map") << "one-to-one" << (found.proxy ? " from the proxy" : "")
              << (summary.removed_border_edges > 0 ? ", except for strips along the border" : "") << ", "
              << name(found.certification()) << "; " << name(found.kind()) << "\n";
  const std::string welding = message(found.weld);
  if(!welding.empty()) line("welding") << with_options(welding) << "\n";
  if(found.excised) line("excised") << with_options(found.excision_message()) << "\n";
  if(found.proxy) line("proxy") << with_options(found.mesh_message()) << "\n";
  if(!summary.attributes.empty()) {
    line("attributes");
    for(std::size_t n = 0; n < summary.attributes.size(); ++n) out << (n > 0 ? " " : "") << summary.attributes[n];
    out << "\n";
  }
  if(summary.carried.facets_across_seams > 0)
    line("seams") << summary.carried.facets_across_seams << " facets straddle a seam\n";
  if(summary.carried.points_without_image > 0)
    line("") << summary.carried.points_without_image << " points have the values of the nearest points\n";
  for(const auto& [title, text] : lines) line(title) << text << "\n";
  if(!summary.is_rounded && has_single_precision(summary.output))
    line("coordinates") << "are rounded to float in the file, for which nothing is proved: use another format\n";
  else if(!summary.is_rounded && model.coordinates == Number_type::FLOAT32)
    line("coordinates") << "are of type double, because rounding to float would invalidate the proof\n";
  line("limit") << summary.limit << std::endl;
}

} // namespace Tool
