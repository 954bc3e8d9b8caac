// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_INTERNAL_TRUNCATION_FILE_H
#define CGAL_BSPLINE_SHELL_3_IO_INTERNAL_TRUNCATION_FILE_H

#include <CGAL/Bspline_shell_3/IO/internal/File_input.h>
#include <CGAL/Bspline_shell_3/IO/internal/File_output.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Writes rows of numbers to a binary or text file, in the same order.
class Row_output
{
public:
  Row_output(File_output& out, bool is_binary) : m_out(out), m_is_binary(is_binary) {}

  template <typename... Numbers>
  void row(const Numbers&... numbers)
  {
    bool is_first = true;
    (put(numbers, is_first), ...);
    if(!m_is_binary) m_out.text("\n");
  }

private:
  void put(double x, bool& is_first)
  {
    separate(is_first);
    if(m_is_binary) m_out.binary(x);
    else m_out.decimal(x);
  }
  void put(std::uint32_t x, bool& is_first)
  {
    separate(is_first);
    if(m_is_binary) m_out.binary(x);
    else m_out.decimal(std::size_t(x));
  }
  void separate(bool& is_first)
  {
    if(!m_is_binary && !is_first) m_out.text(" ");
    is_first = false;
  }

  File_output& m_out;
  bool m_is_binary;
};

class Row_input
{
public:
  Row_input(File_input& in, bool is_binary) : m_in(in), m_is_binary(is_binary) {}

  // Returns false if the file does not have such a row.
  template <typename... Numbers>
  bool row(Numbers&... numbers)
  {
    if(m_is_binary) {
      ((numbers = m_in.binary<Numbers>()), ...);
      return !m_in.is_bad() && (std::isfinite(double(numbers)) && ...);
    }
    Words words(m_in.line());
    (words.number(numbers), ...);
    return words.are_complete();
  }

private:
  File_input& m_in;
  bool m_is_binary;
};

// Writes six zeros if there is no truncation.
inline void write_truncation(Row_output out, const Shell_truncation_3* truncation)
{
  const Shell_truncation_3 none;
  const Shell_truncation_3& t = truncation ? *truncation : none;
  const auto count = [](const auto& range) { return std::uint32_t(range.size()); };
  const std::size_t corners = t.number_of_corners(), inner = t.planar().size() - t.cuts().size();
  out.row(std::uint32_t(corners), count(t.cuts()), std::uint32_t(inner), count(t.cut_facets()), count(t.cores()),
          count(t.discs()));
  for(const auto& p : t.points()) out.row(p[0], p[1], p[2]);
  for(const auto& p : t.planar()) out.row(p[0], p[1]);
  for(const auto& c : t.cuts()) out.row(c.center, c.first, c.second, c.s, c.t);
  for(const auto& f : t.cut_facets()) out.row(f[0], f[1], f[2]);
  for(const auto& c : t.cores()) out.row(c.triangle[0], c.triangle[1], c.triangle[2], c.facet);
  for(const auto& d : t.discs()) {
    out.row(d.center, count(d.rim), count(d.triangles));
    for(std::size_t i = 0; i < d.rim.size(); ++i) out.row(d.rim[i], d.facets[i]);
    for(const auto& f : d.triangles) out.row(f[0], f[1], f[2]);
  }
}

// Reads a truncation, or null if the file has none. Its validity is not tested. Vectors grow as data is read; no memory
// is reserved for counts in the file.
// \return `false` if rows are missing
inline bool read_truncation(Row_input in, std::shared_ptr<const Shell_truncation_3>& truncation)
{
  typedef Shell_truncation_3 Truncation;
  std::uint32_t corners, cuts, inner, cut_facets, cores, discs;
  if(!in.row(corners, cuts, inner, cut_facets, cores, discs)) return false;
  truncation = nullptr;
  if((corners | cuts | inner | cut_facets | cores | discs) == 0) return true;
  std::vector<Truncation::Point> points;
  std::vector<Truncation::Planar_point> planar;
  std::vector<Truncation::Cut> cut;
  std::vector<Truncation::Triangle> cut_facet;
  std::vector<Truncation::Core> core;
  std::vector<Truncation::Disc> disc;
  for(std::uint64_t n = std::uint64_t(corners) + cuts + inner; n > 0; --n) {
    points.emplace_back();
    if(!in.row(points.back()[0], points.back()[1], points.back()[2])) return false;
  }
  for(std::uint64_t n = std::uint64_t(cuts) + inner; n > 0; --n) {
    planar.emplace_back();
    if(!in.row(planar.back()[0], planar.back()[1])) return false;
  }
  for(; cuts > 0; --cuts) {
    cut.emplace_back();
    if(!in.row(cut.back().center, cut.back().first, cut.back().second, cut.back().s, cut.back().t)) return false;
  }
  for(; cut_facets > 0; --cut_facets) {
    cut_facet.emplace_back();
    if(!in.row(cut_facet.back()[0], cut_facet.back()[1], cut_facet.back()[2])) return false;
  }
  for(; cores > 0; --cores) {
    core.emplace_back();
    auto& t = core.back().triangle;
    if(!in.row(t[0], t[1], t[2], core.back().facet)) return false;
  }
  for(; discs > 0; --discs) {
    disc.emplace_back();
    Truncation::Disc& d = disc.back();
    std::uint32_t rim, triangles;
    if(!in.row(d.center, rim, triangles)) return false;
    for(; rim > 0; --rim) {
      std::uint32_t point, facet;
      if(!in.row(point, facet)) return false;
      d.rim.push_back(point);
      d.facets.push_back(facet);
    }
    for(; triangles > 0; --triangles) {
      d.triangles.emplace_back();
      if(!in.row(d.triangles.back()[0], d.triangles.back()[1], d.triangles.back()[2])) return false;
    }
  }
  truncation = std::make_shared<const Truncation>(std::move(points), std::move(cut_facet), std::move(cut),
                                                  std::move(core), std::move(disc), std::move(planar));
  return true;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_INTERNAL_TRUNCATION_FILE_H
