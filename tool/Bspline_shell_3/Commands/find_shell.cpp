#include "find_shell.h"
#include "Input.h"

#include <CGAL/certified_shell_of_soup_3.h>

#include <functional>

namespace Tool {

double thickness_of(const Shell_options& options, double longest_side)
{
  constexpr double default_thickness = 0.01;
  return options.thickness ? options.thickness->in_box(longest_side) : default_thickness * longest_side;
}

Outcome find_shell(const Model& model, const Shell_options& options, double thickness, double seconds,
                   Progress& progress, BS::Shell_of_soup_3& found)
{
  std::optional<double> weld;
  if(options.weld) weld = options.weld->in_box(longest_side(model));
  found = CGAL::certified_shell_of_soup_3(model.soup, BS::parameters::thickness(thickness)
                                                        .time_limit(seconds)
                                                        .memory_limit(1e6 * options.megabytes)
                                                        .weld_tolerance(weld)
                                                        .largest_excised_share(options.excised_percentage / 100)
                                                        .visitor(std::ref(progress)));
  progress.clear();
  if(found.certification() != BS::Certification::NONE) return DONE;
  const bool is_late = found.status() == BS::Shell_status::TIME_LIMIT_EXCEEDED;
  return { is_late || found ? NOT_CERTIFIED : WRONG_INPUT, options.input,
           is_late ? "The time limit was reached before the shell was complete: raise --time-limit."
                   : with_options(found.message()),
           found.offending_simplices };
}

} // namespace Tool
