// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_EXAMINE_FACETS_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_EXAMINE_FACETS_H

#include <CGAL/Bspline_shell_3/Certificate/Facet_verdict.h>
#include <CGAL/Bspline_shell_3/Certificate/Field_predicates_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Second_order_bounds_3.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/Certificate_draft.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/Examined_shell.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/Recent_samples.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/facet_normal.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns a slope that some facet has, rounded. If facets are alike, it is not much larger than the smallest slope. No
// claim depends on it; it only limits the range in which slopes must be bounded closely.
template <typename Field, typename Threshold>
double least_slope_at_some_corners(const Second_order_bounds_3<Field, Threshold>& bounds, const Input_mesh_3& input,
                                   const std::vector<Input_mesh_3::Triangle_mesh::Face_index>& triangles)
{
  typedef Second_order_bounds_3<Field, Threshold> Bounds;
  constexpr std::size_t some = 512;
  double least = std::numeric_limits<double>::infinity();
  for(std::size_t n = 0; n < triangles.size(); n += 1 + triangles.size() / some) {
    const auto t = input.triangle(triangles[n]);
    const std::array<double, 3> normal = facet_normal(t[0], t[1], t[2]).direction;
    const double slope = Bounds::slope(bounds.sample(converted<typename Field::Point_3>(t[0])), normal) / norm(normal);
    if(slope > 0) least = (std::min)(least, slope);
  }
  return least;
}

struct Facet_examination
{
  std::vector<Facet_verdict> facets;
  double least_slope = 0; // smallest slope of a facet; infinite without facets
};

// Examines P1 and P2.
template <typename ConcurrencyTag, typename Field, typename Threshold>
Facet_examination examine_facets(const Examined_shell<Field, Threshold>& shell,
                                 const Second_order_bounds_3<Field, Threshold>& bounds, const Input_mesh_3& input,
                                 Certificate_draft& draft)
{
  typedef typename Field::Point_3 Point_3;
  typedef Input_mesh_3::Triangle_mesh Triangle_mesh;
  typedef Triangle_mesh::Face_index Face_index;
  const Triangle_mesh& mesh = input.mesh();
  const std::vector<Face_index> triangles(mesh.faces().begin(), mesh.faces().end());
  const std::size_t chunk = chunk_size(triangles.size(), 1024);
  struct Result
  {
    std::vector<Certificate_witness> witnesses;
    Predicate_statistics containment, transversality;
    double least_slope = std::numeric_limits<double>::infinity();
  };
  std::vector<Result> results((triangles.size() + chunk - 1) / chunk);
  std::vector<Facet_verdict> verdicts(triangles.size());
  constexpr std::size_t most_bisections = 65536; // large facets meet thousands of cells
  const double slope_somewhere = least_slope_at_some_corners(bounds, input, triangles);
  for_each_chunk<ConcurrencyTag>(triangles.size(), chunk, [&](std::size_t begin, std::size_t end) {
    Result& result = results[begin / chunk];
    Recent_samples<Second_order_bounds_3<Field, Threshold> > samples(bounds);
    for(std::size_t n = begin; n < end; ++n) {
      const auto t = input.triangle(triangles[n]);
      const std::array<Point_3, 3> triangle = { converted<Point_3>(t[0]), converted<Point_3>(t[1]),
                                                converted<Point_3>(t[2]) };
      const auto note = [&](Claim claim, Verdict verdict, const Witness& place) {
        Certificate_witness w = witness(claim, verdict,
                                        place.outside ? Certificate_witness::OUTSIDE : Certificate_witness::FACET);
        w.facet = input.facet_of_origin(triangles[n]);
        w.part = input.part_of_facet(w.facet);
        w.triangle = std::size_t(triangles[n]);
        w.point = place.point;
        w.value = place.value;
        result.witnesses.push_back(w);
      };
      const auto h = mesh.halfedge(triangles[n]); // points to the second corner
      // Slopes above this value need no close bound.
      const double close_slope = (std::min)(slope_somewhere, result.least_slope);
      const auto found = bounds.examine({ samples(mesh.source(h), triangle[0]), samples(mesh.target(h), triangle[1]),
                                          samples(mesh.target(mesh.next(h)), triangle[2]) },
                                        facet_normal(triangle[0], triangle[1], triangle[2]), most_bisections,
                                        close_slope);
      Witness w;
      verdicts[n].containment = Verdict::PROVED;
      if(!found.is_contained) {
        verdicts[n].containment = shell.predicates.values_within(triangle, shell.inner, shell.outer, &w,
                                                                 &result.containment);
        if(verdicts[n].containment != Verdict::PROVED) note(Claim::CONTAINMENT, verdicts[n].containment, w);
      }
      verdicts[n].transversality = Verdict::PROVED;
      verdicts[n].slope = found.slope;
      if(!found.is_transversal) {
        verdicts[n].slope = close_slope;
        verdicts[n].transversality = shell.predicates.crosses_upwards(triangle, &w, &result.transversality,
                                                                      &verdicts[n].slope);
        if(verdicts[n].transversality != Verdict::PROVED) note(Claim::TRANSVERSALITY, verdicts[n].transversality, w);
      }
      result.least_slope = (std::min)(result.least_slope, verdicts[n].slope);
    }
  });
  Facet_examination examination;
  examination.least_slope = std::numeric_limits<double>::infinity();
  for(const Result& result : results) {
    for(const Certificate_witness& w : result.witnesses) draft.add(w);
    draft.statistics.containment += result.containment;
    draft.statistics.transversality += result.transversality;
    examination.least_slope = (std::min)(examination.least_slope, result.least_slope);
  }
  // A facet has the worst verdict of its triangles, and so has the mesh. A facet without triangles is undecided.
  std::vector<Facet_verdict>& facets = examination.facets;
  facets.resize(input.number_of_facets_of_origin());
  std::vector<char> is_known(facets.size(), 0);
  draft.begin(Claim::CONTAINMENT);
  draft.begin(Claim::TRANSVERSALITY);
  for(std::size_t n = 0; n < triangles.size(); ++n) {
    draft.conclude(Claim::CONTAINMENT, verdicts[n].containment);
    draft.conclude(Claim::TRANSVERSALITY, verdicts[n].transversality);
    const std::size_t f = input.facet_of_origin(triangles[n]);
    Facet_verdict& facet = facets[f];
    if(!is_known[f]) {
      is_known[f] = 1;
      facet = verdicts[n];
    } else {
      facet.containment = worse(facet.containment, verdicts[n].containment);
      facet.transversality = worse(facet.transversality, verdicts[n].transversality);
      facet.slope = (std::min)(facet.slope, verdicts[n].slope);
    }
  }
  return examination;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_EXAMINE_FACETS_H
