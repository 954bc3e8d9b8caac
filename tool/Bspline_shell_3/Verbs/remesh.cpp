#include "remesh.h"
#include "Edit_summary.h"
#include "Input.h"
#include "Remeshed.h"
#include "Result_model.h"
#include "number.h"

#include <CGAL/certified_shell_of_soup_3.h>

#include <functional>
#include <iostream>

namespace Tool {

namespace {

// Returns why some edges may have other lengths.
std::string message_of_end(const Remeshed& result, double thickness)
{
  switch(result.end) {
    case BS::Edit_termination::TARGET: return "All edges have about the requested length.";
    case BS::Edit_termination::SHELL:
      return "The shell prevents further changes: a larger --thickness than " + number(thickness)
             + " may bring more edges to the requested length.";
    case BS::Edit_termination::VISITOR:
      return "The time limit ended the remeshing: a larger --time-limit may bring more edges to the requested length.";
    case BS::Edit_termination::ITERATIONS: return "All iterations were done.";
    default: return "Borders, features, seams, and the topology prevent further changes.";
  }
}

} // namespace

Outcome remesh(const Remesh_options& options, bool writes_json)
{
  if(const Outcome output = check_output(options.output, { options.input }); !output) return output;
  Model model;
  if(!read_input(options.input, model)) return WRONG_INPUT;
  if(!is_writable(options.output)) return { CANNOT_WRITE, options.output, "The file cannot be written." };

  const Time_limit time(options.seconds);
  Progress progress;
  const double unit = longest_side(model);
  constexpr double default_thickness = 0.01;
  Edit_summary summary;
  summary.input = options.input;
  summary.output = options.output;
  summary.thickness = options.thickness ? options.thickness->in_box(unit) : default_thickness * unit;
  const BS::Shell_of_soup_3 found = CGAL::certified_shell_of_soup_3(
    model.soup, BS::parameters::thickness(summary.thickness).time_limit(options.seconds).visitor(std::ref(progress)));
  progress.clear();
  if(found.certification() == BS::Certification::NONE)
    return { found ? NOT_CERTIFIED : WRONG_INPUT, options.input, with_options(found.message()),
             found.offending_simplices };

  const double edge = options.edge->in_box(unit);
  const Remeshed result = remesh_in_shell(model, found, { edge, options.feature }, time, progress);
  if(!result) return { NOT_CERTIFIED, options.input, result.message };
  const Model output = carry_attributes(
    model, found, result.mesh, result.rejoined, options.carries_normals ? Normals::CARRIED : Normals::RECOMPUTED,
    summary.carried, [&](double fraction) { progress.show("attributes", fraction); });
  progress.clear();
  if(const Outcome written = write_result(output, options.output, { &model }, {}, summary.warnings); !written)
    return written;

  summary.facets_before = result.facets_before;
  summary.facets = result.facets;
  summary.distances = result.distances;
  summary.is_rounded = result.is_rounded;
  summary.limit = message_of_end(result, summary.thickness);
  summary.seconds = time.seconds();
  for(const Attribute& a : output.attributes) summary.attributes.push_back(a.name);
  if(writes_json) {
    Json json = json_of(summary, model, found);
    json.add("edge", edge)
      .add("mean_edge", result.mean_edge)
      .add("share_near_edge", result.share_near_target)
      .add("edges_on_features", result.features)
      .add("edges_on_lines", result.lines)
      .add("protects_lines", result.protects_lines);
    std::cout << json.text() << std::endl;
    return DONE;
  }
  const std::string about = result.protects_lines ? ", which keep their edges, because excised triangles touch some"
                                                  : "";
  print(summary, model, found,
        { { "edges", percent(result.share_near_target) + " from 4/5 to 4/3 of " + number(edge) + "; mean length "
                       + number(result.mean_edge) },
          { "lines", std::to_string(result.features) + " edges on features, " + std::to_string(result.lines)
                       + " on seams and borders of labels" + about } });
  return DONE;
}

} // namespace Tool
