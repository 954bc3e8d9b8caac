// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SUPPORT_ARITHMETIC_SELF_TEST_H
#define CGAL_BSPLINE_SHELL_3_SUPPORT_ARITHMETIC_SELF_TEST_H

#include <CGAL/FPU.h>

#include <cfloat>
#include <limits>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Support
 *
 * \brief the result of `arithmetic_self_test()`: whether floating-point arithmetic has the properties that all proofs
 * assume.
 */
enum class Arithmetic_status
{
  SOUND,
  NOT_IEEE,        ///< `double` is not an IEEE 754 type, or results are kept in a wider format
  FLUSHES_TO_ZERO, ///< subnormal numbers are flushed to zero
  REORDERED, ///< the compiler reorders floating-point operations, as real numbers permit (`-ffast-math` or parts of it)
  ROUNDING_MODE_IGNORED, ///< the compiler assumes one rounding mode (no `-frounding-math`): exact predicates may fail
  NO_DIRECTED_ROUNDING   ///< the rounding mode has no effect: exact predicates fail
};

inline const char* message(Arithmetic_status status)
{
  switch(status) {
    case Arithmetic_status::SOUND: return "Floating-point arithmetic is sound.";
    case Arithmetic_status::NOT_IEEE:
      return "The type double does not have the arithmetic of IEEE 754: use another platform, or compile for SSE2 "
             "(-mfpmath=sse).";
    case Arithmetic_status::FLUSHES_TO_ZERO:
      return "Subnormal numbers are flushed to zero: compile without -ffast-math, and do not set flush-to-zero mode.";
    case Arithmetic_status::REORDERED: return "Floating-point operations are reordered: compile without -ffast-math.";
    case Arithmetic_status::ROUNDING_MODE_IGNORED:
      return "The compiler moves floating-point operations across changes of the rounding mode: compile with "
             "-frounding-math, as the CMake target CGAL::CGAL does.";
    case Arithmetic_status::NO_DIRECTED_ROUNDING:
      return "The rounding mode has no effect: compile with -frounding-math, as the CMake target CGAL::CGAL does, or "
             "use another platform.";
  }
  return "";
}

/*!
 * \ingroup PkgBsplineShell3Support
 *
 * \brief returns whether floating-point arithmetic is sound, from the macros of compiler options and from single
 * operations with known results.
 *
 * Unlike an assertion, the test works in every build. It takes less than a microsecond, and restores the rounding mode.
 *
 * The macros describe only the current translation unit. All files of a program that include the package must be
 * compiled with the same options, because the linker keeps one of several copies of a function. GCC 12 defines a macro
 * for each option. Clang and older versions of GCC may have none for `-frounding-math`; in this case, only the
 * operations are tested.
 */
inline Arithmetic_status arithmetic_self_test()
{
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)                            \
  || defined(__NO_SIGNED_ZEROS__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
  constexpr bool reorders = true;
#else
  constexpr bool reorders = false;
#endif
#if defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__) && !defined(__INTEL_COMPILER)                           \
  && !defined(__ROUNDING_MATH__)
  constexpr bool ignores_mode = true;
#else
  constexpr bool ignores_mode = false;
#endif
  if(reorders) return Arithmetic_status::REORDERED;
  if(ignores_mode) return Arithmetic_status::ROUNDING_MODE_IGNORED;
  typedef std::numeric_limits<double> Limits;
  if(!Limits::is_iec559 || Limits::digits != 53 || FLT_EVAL_METHOD != 0) return Arithmetic_status::NOT_IEEE;
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);
  // `volatile` forces the compiler to carry out the operations here, one by one.
  volatile double one = 1, least = Limits::min(), large = 1e16;
  volatile double half = least / 2;
  if(!(half > 0)) return Arithmetic_status::FLUSHES_TO_ZERO;
  // If the operations were reassociated, these would be one and true.
  const double x = one, y = large, z = -large;
  const double reordered = (x + y) + z;
  volatile double zero = 0;
  const double not_a_number = zero / zero;
  volatile bool equals_itself = not_a_number == not_a_number;
  if(reordered == 1 || equals_itself) return Arithmetic_status::REORDERED;
  double down, up;
  {
    Protect_FPU_rounding<true> guard(CGAL_FE_UPWARD);
    const double third = CGAL_IA_FORCE_TO_DOUBLE(one / CGAL_IA_FORCE_TO_DOUBLE(3.));
    up = third;
    down = -CGAL_IA_FORCE_TO_DOUBLE(-one / CGAL_IA_FORCE_TO_DOUBLE(3.));
  }
  return down < up ? Arithmetic_status::SOUND : Arithmetic_status::NO_DIRECTED_ROUNDING;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SUPPORT_ARITHMETIC_SELF_TEST_H
