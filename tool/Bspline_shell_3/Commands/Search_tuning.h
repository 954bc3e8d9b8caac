// Numbers that steer the search for a shell in which an edit or a transfer succeeds.
#ifndef TOOL_COMMANDS_SEARCH_TUNING_H
#define TOOL_COMMANDS_SEARCH_TUNING_H

namespace Tool {

// They affect the time and the number of facets; the result is proved whatever they are.
struct Search_tuning
{
  // --- thicknesses of edits

  // Largest number of shells. With a tolerance of 1 %, most models need one or two.
  int attempts = 4;
  // No attempt begins after this fraction of the time limit: an attempt in a thicker shell may take twice as long.
  double last_attempt = 1. / 3;
  // Largest thickness, relative to the longest side of the box. Cells of thicker shells are too coarse for most models.
  double thickest = 0.3;
  // The same for the first attempt: the shell of an intricate model does not exist, or takes long.
  double thickest_first = 0.05;
  // Least thickness, unless the user requests a thinner shell: most models would need more than a million cells.
  double thinnest = 1e-4;
  // Largest ratio of successive thicknesses.
  double thickening = 3;
  // Fraction of the tolerance at which the next thickness aims, as distances are about proportional to thicknesses.
  double aim = 0.9;
  // No thicker shell is tried if the distance is larger than this fraction of the tolerance: few facets would be saved.
  double slack = 0.75;

  // --- facets that are kept because the result is too far from them

  // Largest number of simplifications in one shell. Most models that need a repetition need one or two.
  int repetitions = 6;
  // Largest share of the facets that are kept. For more, a thinner shell has fewer facets.
  double largest_kept_share = 0.25;

  // --- thicknesses of transfers

  // Thickness relative to the distance of the meshes. Half of the shell lies on each side of the mesh, and it is
  // thinner than requested in some places.
  double thickness_per_distance = 2.5;
  // Least and largest thickness, relative to the longest side of the box.
  double thinnest_transfer = 0.01, thickest_transfer = 0.2;
  // Fractions of the area within smaller distances, which are tried if the largest distance is not proved everywhere.
  double most_of_the_area = 0.95, much_of_the_area = 0.75;
  // Thicknesses that differ by a smaller ratio are not both tried.
  double different = 0.8;
};

inline constexpr Search_tuning search_tuning = {};

} // namespace Tool

#endif // TOOL_COMMANDS_SEARCH_TUNING_H
