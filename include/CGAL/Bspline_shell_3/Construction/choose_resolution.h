// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_CHOOSE_RESOLUTION_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_CHOOSE_RESOLUTION_H

#include <CGAL/Bspline_shell_3/Cells/Cell_complex_3.h>
#include <CGAL/Bspline_shell_3/Cells/Cell_hierarchy_3.h>
#include <CGAL/Bspline_shell_3/Construction/Refinement_parameters.h>
#include <CGAL/Bspline_shell_3/Construction/Resolution_tuning.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief fractions of the surface cells in which a mesh is bent or folded, by the area-weighted mean normal in a cell.
 */
struct Bend_shares
{
  double bent = 0; ///< cells with a mean normal shorter than 0.9, as at edges of 50 degrees and more
  /// cells with a mean normal shorter than 0.7, as at sharper edges, tips, and walls thinner than the cell
  double folded = 0;
};

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief returns the fractions of the surface cells in which a mesh is far from flat; takes time linear in the number
 * of pieces into which the cells cut the mesh.
 */
template <typename ConcurrencyTag>
Bend_shares bend_shares(const Input_mesh_3& mesh, const Lattice_3& lattice)
{
  const Cell_hierarchy_3 cells(Cell_complex_3(lattice, cells_entered_by_mesh<ConcurrencyTag>(mesh, lattice)));
  const Clipped_mesh_3 clipped = clip_mesh_to_cells<ConcurrencyTag>(mesh, cells);
  const std::vector<Clipped_mesh_3::Piece>& pieces = clipped.pieces();
  std::size_t all = 0;
  Bend_shares shares;
  for(std::size_t n = 0; n < pieces.size(); ++all) {
    const Cell_hierarchy_3::Index c = pieces[n].cell;
    std::array<double, 3> sum = {};
    double area = 0;
    for(; n < pieces.size() && pieces[n].cell == c; ++n) {
      const double a = clipped.area(pieces[n]);
      const std::array<double, 3>& normal = clipped.normal(pieces[n].facet);
      for(int i = 0; i < 3; ++i) sum[i] += a * normal[i];
      area += a;
    }
    const double length = internal::norm(sum);
    if(length < resolution_tuning.bent * area) ++shares.bent;
    if(length < resolution_tuning.folded * area) ++shares.folded;
  }
  shares.bent /= double(all);
  shares.folded /= double(all);
  return shares;
}

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief returns the number of root cells along the longest side of a mesh's bounding box with which refinement should
 * begin: 30, or 24 or 20 if most of the mesh is nearly flat in wider cells.
 *
 * If the width of cells is five times the thickness of the shell, a field follows a mesh closely enough except at
 * bends. Local corrections (`Certified_refinement`) suffice for a few bends. At many bends, cells would have to be
 * split together with their neighbors, and slightly more root cells take less time.
 *
 * \param thickness thickness of the shell, in the units of the coordinates
 */
template <typename ConcurrencyTag>
double choose_resolution(const Input_mesh_3& mesh, double thickness)
{
  const Resolution_tuning& t = resolution_tuning;
  if(!(mesh.unit() <= t.coarsest * t.widest_cell * thickness)) return t.finest;
  const Lattice_3 lattice = Lattice_3::off_the_ends(mesh.bbox(), mesh.unit() / t.coarsest);
  if(!lattice.is_exact()) return t.finest;
  const Bend_shares shares = bend_shares<ConcurrencyTag>(mesh, lattice);
  if(shares.folded > t.folded_cells) return t.finest;
  // Bends lie along curves, so their fraction grows with the width of cells.
  if(shares.bent <= t.bent_cells) return t.coarsest;
  return shares.bent * t.coarsest / t.middle <= t.bent_cells ? t.middle : t.finest;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_CHOOSE_RESOLUTION_H
