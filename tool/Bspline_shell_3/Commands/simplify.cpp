#include "Input.h"
#include "Result_files.h"
#include "edit.h"
#include "number.h"
#include "commands.h"

#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace Tool {

namespace {

// Returns which limit ended the simplification, and which one would allow fewer facets.
std::string message_of_limit(const Simplified& result)
{
  switch(result.limit) {
    case Limit::FACETS: return "The requested number of facets ended the simplification.";
    case Limit::TOLERANCE: return "The tolerance ended the simplification: a larger --tolerance allows fewer facets.";
    case Limit::TIME: return "The time limit ended the simplification: a larger --time-limit allows fewer facets.";
    case Limit::SHELL:
      return "The shell ended the simplification: a larger --thickness than " + number(result.thickness)
             + " may allow fewer facets.";
    case Limit::LINES:
      return "Seams, borders of labels, or excised triangles ended the simplification; with --facets, seams "
             "and borders of labels are dropped if the number cannot be reached otherwise.";
    case Limit::MESH: return "No remaining edge can be collapsed without changing the topology or a border.";
  }
  return "";
}

} // namespace

Outcome simplify(const Simplify_options& options, bool writes_json)
{
  Model model;
  if(const Outcome opened = open_edit(options, model); !opened) return opened;
  const Time_limit time(options.seconds);
  Progress progress;
  Simplified result;
  if(const Outcome simplified = simplify_model(model, options, time, progress, result); !simplified)
    return result.found ? fail_edit(simplified, options, model, *result.found) : simplified;
  const BS::Shell_of_soup_3& found = *result.found;
  if(const Outcome kept = check_tolerance(options, model, result); !kept) return kept;

  Edit_summary summary = summary_of(result, options.input, options.output);
  summary.reaches_target = (options.facets == 0 && options.ratio == 0) || result.limit == Limit::FACETS;
  summary.removed_border_edges = result.removed_border_edges;
  summary.limit = message_of_limit(result);
  if(const Outcome written = write_edit(options, model, result, progress, summary); !written) return written;
  summary.seconds = time.seconds();
  if(writes_json) {
    Json json = json_of(summary, model, found);
    json.add("edges_on_lines", result.lines)
      .add("keeps_lines", result.keeps_lines)
      .add("cuts_lines", result.cut && result.cut->cut);
    report_stream(options.output) << json.text() << std::endl;
    return DONE;
  }
  std::vector<std::pair<std::string, std::string> > lines;
  if(result.cut && result.cut->cut)
    lines.emplace_back(
      "lines",
      std::to_string(result.lines) + " edges, along which facets were cut"
        + (result.cut->gaps > 0 ? "; " + std::to_string(result.cut->gaps) + " parts of lines have no image" : ""));
  else if(result.cut) lines.emplace_back("lines", "were not cut. " + with_options(message(result.cut->cut.status)));
  else if(options.cuts_lines) lines.emplace_back("lines", "were not cut, because a proxy was simplified");
  if(result.keeps_lines && !result.cut && result.lines > 0)
    lines.emplace_back("lines", "seams and borders of labels (" + std::to_string(result.lines)
                                  + " edges of the file) are kept as edges");
  if(!result.keeps_lines)
    lines.emplace_back("lines", "were not kept: with them, the requested number of facets cannot be reached");
  if(result.removed_border_edges > 0)
    lines.emplace_back("border", "has " + std::to_string(result.removed_border_edges) + " edges fewer");
  print(summary, model, found, lines);
  return DONE;
}

} // namespace Tool
