// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_CERTIFICATE_DRAFT_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_CERTIFICATE_DRAFT_H

#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>

#include <array>
#include <cstddef>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

inline std::array<double, 3> to_array(const Input_mesh_3::Triangle_mesh::Point& p)
{
  return { p.x(), p.y(), p.z() };
}

inline Verdict worse(Verdict a, Verdict b)
{
  if(a == Verdict::REFUTED || b == Verdict::REFUTED) return Verdict::REFUTED;
  return a == Verdict::UNDECIDED || b == Verdict::UNDECIDED ? Verdict::UNDECIDED : Verdict::PROVED;
}

inline Certificate_witness witness(Claim claim, Verdict verdict, Certificate_witness::Reason reason)
{
  Certificate_witness w;
  w.claim = claim;
  w.verdict = verdict;
  w.reason = reason;
  return w;
}

// A report under construction. Claims that were not examined are undecided.
struct Certificate_draft : Certificate_report
{
  // Sets the claim to proved; witnesses lower the verdict.
  void begin(Claim claim) { verdicts[std::size_t(claim)] = Verdict::PROVED; }

  // Lowers the claim's verdict.
  void conclude(Claim claim, Verdict found)
  {
    Verdict& verdict = verdicts[std::size_t(claim)];
    verdict = worse(verdict, found);
  }
  // Lowers the claim's verdict to the verdict of the witness.
  void conclude(const Certificate_witness& w)
  {
    conclude(w.claim, w.verdict);
    add(w);
  }
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_CERTIFICATE_DRAFT_H
