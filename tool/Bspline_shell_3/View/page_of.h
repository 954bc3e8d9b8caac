// The page that shows a model, a result beside it, and the shell around both.
#ifndef TOOL_VIEW_PAGE_OF_H
#define TOOL_VIEW_PAGE_OF_H

#include "Page.h"

#include "../Carry/Mesh_origins.h"
#include "../Files/Model.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace Tool {

struct View
{
  struct Side
  {
    std::string title;
    const Model* model;
  };
  struct Place
  {
    std::array<double, 3> point;
    std::string message;
  };
  std::string title;
  std::vector<Side> sides;      // one or two; they are drawn beside each other
  const Shell* shell = nullptr; // null if there is none
  Page::Lines report;
  std::vector<Place> places; // places to look at, for example those where the proof fails
  std::string places_title;
};

// Returns the page. It contains the field, such that curves are traced in the browser to about single precision. If the
// page would be larger than the limit, it contains the images of vertices instead, which the library computes. If
// necessary, the surfaces of the shell are left out as well. The report of the page lists the omitted parts.
// \param most_bytes limit of the size; the meshes are always included
// \pre the program contains the scripts of pages
std::string page_of(const View& view, std::size_t most_bytes = 20'000'000);

} // namespace Tool

#endif // TOOL_VIEW_PAGE_OF_H
