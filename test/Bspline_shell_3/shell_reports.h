// Reports for shells that tests make of fields and certificates, without a construction.
#ifndef SHELL_REPORTS_H
#define SHELL_REPORTS_H

#include <CGAL/Bspline_shell_3/Shell/Cover_box.h>
#include <CGAL/Bspline_shell_3/Shell/Shell_report.h>

#include <cstddef>
#include <vector>

inline CGAL::Bspline_shells::Shell_report successful_report(
  double unit, const CGAL::Bspline_shells::Certificate_report& certificate = {})
{
  CGAL::Bspline_shells::Shell_report report;
  report.status = CGAL::Bspline_shells::Shell_status::SUCCESS;
  report.unit = unit;
  report.certificate = certificate;
  return report;
}

// Returns a mark for each cell that the boxes of a cover have in a component.
inline std::vector<char> cells_of_cover(const std::vector<CGAL::Bspline_shells::Cover_box>& boxes,
                                        std::size_t number_of_cells)
{
  std::vector<char> cells(number_of_cells, 0);
  for(const CGAL::Bspline_shells::Cover_box& box : boxes)
    if(box.component != CGAL::Bspline_shells::Cover_box::no_component) cells[box.cell] = 1;
  return cells;
}

#endif // SHELL_REPORTS_H
