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
 * \brief shares of the cells at a mesh, by its mean normal in a cell, weighted by area.
 */
struct Bend_shares
{
  double bent = 0; ///< where it is shorter than 0.9: at edges of 50 degrees and more
  /// where it is shorter than 0.7: at sharper edges, tips, and where walls are thinner than cells
  double folded = 0;
};

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief how many cells see a mesh that is far from flat.
 *
 * \tparam ConcurrencyTag as for `certified_bspline_shell_3()`; the result is the same
 * \param mesh the mesh
 * \param lattice of the cells
 * \cgalHeading{Cost} linear in the number of parts into which the cells cut the mesh
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
 * \brief the number of root cells per longest side of a mesh's box that refinement should begin with: 30, or fewer if
 * most of the mesh is nearly flat in wider cells.
 *
 * A field on cells five times as wide as the shell is thick follows a mesh closely enough but at bends; these are
 * mended by small changes if they are few (`Certified_refinement`). Otherwise cells would have to be halved, with those
 * around them, and a few more of equal size are cheaper.
 *
 * \tparam ConcurrencyTag as for `certified_bspline_shell_3()`; the result is the same
 * \param mesh the mesh
 * \param thickness of the shell, user units
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
  // there are bends along curves, and so their share grows with the width of cells
  if(shares.bent <= t.bent_cells) return t.coarsest;
  return shares.bent * t.coarsest / t.middle <= t.bent_cells ? t.middle : t.finest;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_CHOOSE_RESOLUTION_H
