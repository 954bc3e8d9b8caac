#include "Input.h"

#include "../Files/read_model.h"

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <iostream>

namespace Tool {

namespace {

void list_places(const char* kind, const std::vector<std::size_t>& places)
{
  constexpr std::size_t most = 10;
  if(places.empty()) return;
  std::cerr << kind << ":";
  for(std::size_t i = 0; i < (std::min)(places.size(), most); ++i) std::cerr << " " << places[i];
  if(places.size() > most) std::cerr << " ... (" << places.size() << " in total)";
  std::cerr << "\n";
}

} // namespace

void complain(const std::string& file, const std::string& message, const BS::Offending_simplices& offenders)
{
  std::cerr << file << ": " << message << std::endl;
  list_places("facets", offenders.facets);
  list_places("vertices", offenders.vertices);
}

bool read_input(const std::string& file, Model& model)
{
  const File_report report = read_model(file, model);
  for(const std::string& warning : report.warnings) std::cerr << file << ": " << warning << "\n";
  if(!report) complain(file + (report.line > 0 ? ", line " + std::to_string(report.line) : ""), message(report.status));
  return bool(report);
}

double longest_side(const Model& model)
{
  CGAL::Bbox_3 box;
  for(const auto& p : model.soup.points) box += p.bbox();
  return (std::max)({ box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin() });
}

} // namespace Tool
