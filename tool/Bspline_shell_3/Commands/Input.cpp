#include "Input.h"

#include "../Files/read_model.h"

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <iostream>

namespace Tool {

Outcome read_input(const std::string& file, Model& model)
{
  const File_report report = read_model(file, model);
  for(const std::string& warning : report.warnings) std::cerr << file << ": " << warning << "\n";
  if(report) return {};
  BS::Offending_simplices offenders;
  offenders.facets = report.polygons;
  offenders.vertices = report.points;
  return { WRONG_INPUT, file + (report.line > 0 ? ", line " + std::to_string(report.line) : ""), message(report.status),
           offenders };
}

double longest_side(const Model& model)
{
  CGAL::Bbox_3 box;
  for(const auto& p : model.soup.points) box += p.bbox();
  return (std::max)({ box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin() });
}

} // namespace Tool
