#include "Input.h"
#include "Remeshed.h"
#include "Result_files.h"
#include "Result_model.h"
#include "Search_tuning.h"
#include "edit.h"
#include "number.h"
#include "commands.h"

#include <iostream>
#include <memory>
#include <string>

namespace Tool {

namespace {

// Returns why some edges may have other lengths.
std::string message_of_end(const Remeshed& result)
{
  switch(result.end) {
    case BS::Edit_termination::TARGET: return "All edges have about the requested length.";
    case BS::Edit_termination::SHELL:
      return "The shell prevents further changes: a larger --thickness than " + number(result.thickness)
             + " may bring more edges to the requested length.";
    case BS::Edit_termination::FILTER: return "Excised triangles prevent further changes.";
    case BS::Edit_termination::VISITOR:
      return "The time limit ended the remeshing: a larger --time-limit may bring more edges to the requested length.";
    case BS::Edit_termination::ITERATIONS: return "All iterations were done.";
    default: return "Borders, features, seams, and the topology prevent further changes.";
  }
}

} // namespace

Outcome remesh(const Remesh_options& options, bool writes_json)
{
  Model model;
  if(const Outcome opened = open_edit(options, model); !opened) return opened;
  const Time_limit time(options.seconds);
  Progress progress;
  const double unit = longest_side(model);
  if(options.edge->in_box(unit) > unit)
    return { WRONG_USAGE, options.input,
             "The length --edge is larger than the longest side of the box, " + number(unit) + ": use a smaller one." };
  Remesh_target target{ first_thickness(options, unit), options.edge->in_box(unit), options.feature,
                        rounds_coordinates(model, options.output), tolerance_of(options, unit) };
  Remeshed result;
  for(int attempt = 1;; ++attempt) {
    const auto found = std::make_shared<BS::Shell_of_soup_3>();
    if(const Outcome shell = find_shell(model, options, target.thickness, time.left(), progress, *found); !shell)
      return fail_edit(shell, options, model, *found);
    result = remesh_in_shell(model, found, target, time, progress);
    if(!result) return { NOT_CERTIFIED, options.input, result.message };
    const double distance = result.distances.largest();
    if(distance <= target.tolerance || options.thickness || found->proxy || attempt == search_tuning.attempts
       || time.seconds() > search_tuning.last_attempt * time.limit())
      break;
    const double next = search_tuning.aim * target.tolerance / distance * target.thickness;
    if(next < search_tuning.thinnest * unit) break;
    target.thickness = next;
  }
  if(const Outcome kept = check_tolerance(options, model, result); !kept) return kept;
  const BS::Shell_of_soup_3& found = *result.found;
  Edit_summary summary = summary_of(result, options.input, options.output);
  summary.limit = message_of_end(result);
  if(const Outcome written = write_edit(options, model, result, progress, summary); !written) return written;
  summary.seconds = time.seconds();
  if(writes_json) {
    Json json = json_of(summary, model, found);
    json.add("edge", target.edge)
      .add("mean_edge", result.mean_edge)
      .add("share_near_edge", result.share_near_target)
      .add("edges_on_features", result.features)
      .add("edges_on_lines", result.lines)
      .add("protects_lines", result.protects_lines);
    report_stream(options.output) << json.text() << std::endl;
    return DONE;
  }
  print(summary, model, found,
        { { "edges", percent(result.share_near_target) + " from 4/5 to 4/3 of " + number(target.edge) + "; mean length "
                       + number(result.mean_edge) },
          { "lines", std::to_string(result.features) + " edges on features, " + std::to_string(result.lines)
                       + " on seams and borders of labels"
                       + (result.protects_lines
                            ? ": not split or collapsed, because an excised triangle is attached to an inner edge"
                            : "") } });
  return DONE;
}

} // namespace Tool
