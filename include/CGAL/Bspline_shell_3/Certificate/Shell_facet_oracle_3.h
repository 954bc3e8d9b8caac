// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_SHELL_FACET_ORACLE_3_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_SHELL_FACET_ORACLE_3_H

#include <CGAL/Bspline_shell_3/Certificate/Field_predicates_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Placement_verdict.h>
#include <CGAL/Bspline_shell_3/Certificate/Second_order_bounds_3.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/Facet_estimator.h>
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include <CGAL/Bspline_shell_3/Mesh/facet_normal.h>
#include <CGAL/Bspline_shell_3/Mesh/fan_winding.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>
#include <CGAL/Bspline_shell_3/Support/power_of_two.h>

#include <CGAL/FPU.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/tags.h>

#include <boost/container/small_vector.hpp>
#include <boost/functional/hash.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Certificate
/// the accepted facets that a `Shell_facet_oracle_3` proves
enum class Facet_proofs
{
  ALL,
  WHERE_DOUBTFUL ///< facets that an estimate from a few samples does not clear: faster, but accepted facets must still
                 ///< be proved
};

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief accepts triangles that lie in a shell and face along the gradient, the first two claims of the certificate.
 * With `Facet_proofs::ALL`, these properties are proved for every accepted triangle.
 *
 * Proofs are based on `Second_order_bounds_3`. Rejections are not proofs: a triangle may be rejected although it is in
 * the shell, if the margin is within rounding errors or the proof would take too many bisections.
 *
 * With `Facet_proofs::WHERE_DOUBTFUL`, a facet is accepted without a proof if an estimate from a few samples clears it.
 * This mode is for edits that create many facets of which few remain, and whose results are certified as a whole.
 *
 * Const member functions may be called concurrently.
 *
 * \tparam Field a model of `BsplineField_3`
 * \tparam Threshold a model of `ShellThreshold`
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`, used for the facets at a
 *   vertex; all give the same verdicts
 */
template <typename Field = Hierarchical_bspline_field_3<>, typename Threshold = Constant_threshold,
          typename ConcurrencyTag = Sequential_tag>
class Shell_facet_oracle_3
{
public:
  typedef Second_order_bounds_3<Field, Threshold> Bounds;
  typedef Bspline_shell_3<Field, Threshold> Shell;
  typedef typename Field::Point_3 Point_3;
  typedef typename Bounds::Sample Sample;
  typedef typename Bounds::Facet_bounds Facet_bounds;

  /// a cache of verdicts on places: a rejected edge that is considered again usually has the same facets, and the
  /// places that are tried for an edge have the same link
  class Memory
  {
  public:
    /// \param most_places number of places for which facets are stored; one more place clears all of them
    explicit Memory(std::size_t most_places = 1 << 20) : m_most_places(most_places) {}

  private:
    friend class Shell_facet_oracle_3;
    typedef std::array<double, 3> Place;
    struct Facet
    {
      Point_3 q, r;
      Placement_verdict verdict;
    };
    struct Hash
    {
      std::size_t operator()(const Place& place) const { return boost::hash_range(place.begin(), place.end()); }
    };
    typedef boost::container::small_vector<Facet, 1> Facets;
    const Facets* facets_at(const Place& place) const
    {
      const auto found = m_facets.find(place);
      return found == m_facets.end() ? nullptr : &found->second;
    }
    void add(const Place& place, const Facet& facet)
    {
      constexpr std::size_t most_facets = 32; // limit at one place: each facet of a link is compared with all of them
      if(m_facets.size() == m_most_places && m_facets.count(place) == 0) m_facets.clear();
      Facets& facets = m_facets[place];
      if(facets.size() < most_facets) facets.push_back(facet);
    }
    void set_link(const std::vector<Point_3>& link)
    {
      if(m_link == link) return;
      m_link = link;
      m_samples.assign(link.size(), std::nullopt);
      m_rejecting.reset();
    }

    std::size_t m_most_places;
    std::unordered_map<Place, Facets, Hash> m_facets; // facets at each place
    std::vector<Point_3> m_link;                      // last link
    std::vector<std::optional<Sample> > m_samples;    // samples of its vertices, computed on demand
    // The vertex whose edge rejected the last place, and most likely rejects the next place as well.
    std::optional<std::size_t> m_rejecting;
  };

  /// constructs an oracle. If there is no shell, it rejects all facets.
  /// \pre the shell outlives this object, and its field does not change
  explicit Shell_facet_oracle_3(const Shell& shell, Facet_proofs proofs = Facet_proofs::ALL);
  explicit Shell_facet_oracle_3(const Shell&&, Facet_proofs = Facet_proofs::ALL) = delete; // the pointer would dangle

  const Shell& shell() const { return *m_shell; }

  /// returns which of the accepted facets are proved
  Facet_proofs proofs() const { return m_proofs; }

  /// returns the bounds on cells, which other examinations of facets in the shell can share
  const std::shared_ptr<const Bounds>& bounds() const { return m_bounds; }

  /// returns the sample of the field at a point
  Sample sample(const Point_3& p) const
  {
    Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);
    return m_bounds->sample(p);
  }

  /// judges the facets (`p`, `link[n]`, `link[n+1]`) around a vertex, which must all be accepted, and must wind around
  /// the gradient at `p` once.
  /// \param link the vertices of the link, in cyclic order
  /// \param memory a cache of earlier verdicts
  Placement_verdict operator()(const Point_3& p, const std::vector<Point_3>& link, Memory& memory) const;

  /// judges a single facet, with more effort: if the bounds do not decide, `Field_predicates_3` does
  Placement_verdict operator()(const Point_3& p, const Point_3& q, const Point_3& r) const
  {
    return (*this)(p, q, r, { sample(p), sample(q), sample(r) });
  }
  /// judges a single facet, given the samples of its corners by `sample()`
  Placement_verdict operator()(const Point_3& p, const Point_3& q, const Point_3& r,
                               const std::array<Sample, 3>& corners) const;

  /// returns how often a fan of facets, as above, winds around the gradient at `p`; 0 if a facet does not face along it
  std::size_t winding_number(const Point_3& p, const std::vector<Point_3>& link) const
  {
    return winding_number(p, sample(p), link);
  }
  /// returns the winding number, given the sample at `p`. The axis is so long that rounding changes its direction
  /// little.
  std::size_t winding_number(const Point_3& p, const Sample& at_p, const std::vector<Point_3>& link) const;

private:
  typedef typename Field::Cell_index Cell_index;
  typedef std::array<double, 3> Coordinates;

  // Points between the thresholds in other cells are outside the shell.
  bool is_in_cells(const Sample& s) const { return s.cell != Field::npos && m_shell->shell_cells()[s.cell]; }
  bool is_in(const Sample& s) const { return is_in_cells(s) && s.above >= 0 && s.below >= 0; }

  // Returns a normal, for edges in units of about the largest width of a cell. Otherwise, the product of the gradient
  // and the normal, which has the size of squared edges, could underflow or overflow.
  Coordinates rounded_normal(const Point_3& p, const Point_3& q, const Point_3& r) const
  {
    Coordinates u, v;
    for(int a = 0; a < 3; ++a) {
      u[a] = m_unit * (q[a] - p[a]);
      v[a] = m_unit * (r[a] - p[a]);
    }
    return internal::cross(u, v);
  }

  typedef internal::Facet_estimate Estimate;
  typedef internal::Facet_estimator<Bounds> Estimator;
  typedef typename Estimator::Samples Samples;
  Estimate estimate(const Samples& corners, const Samples& middles, const Coordinates& normal) const
  {
    if(m_proofs == Facet_proofs::ALL) return Estimate::DOUBTFUL;
    return Estimator(*m_bounds, normal)(corners, middles);
  }

  // Judges a facet whose corners are in the shell.
  // \param normal the normal of the facet, rounded
  Placement_verdict judge(const Samples& corners, const Samples& middles, const Coordinates& normal, const Point_3& p,
                          const Point_3& q, const Point_3& r) const
  {
    switch(estimate(corners, middles, normal)) {
      case Estimate::CLEAR: return Placement_verdict::ACCEPTED;
      case Estimate::LEAVES_SHELL: return Placement_verdict::LEAVES_SHELL;
      case Estimate::FACES_AWAY: return Placement_verdict::FACES_AWAY;
      case Estimate::DOUBTFUL: break;
    }
    const Facet_bounds found = m_bounds->examine({ *corners[0], *corners[1], *corners[2] }, facet_normal(p, q, r),
                                                 most_bisections);
    if(!found.is_contained) return Placement_verdict::LEAVES_SHELL;
    return found.is_transversal ? Placement_verdict::ACCEPTED : Placement_verdict::FACES_AWAY;
  }

  static constexpr std::size_t most_bisections = 4096;

  const Shell* m_shell;
  Facet_proofs m_proofs;
  Field_predicates_3<Field> m_predicates;
  std::shared_ptr<const Bounds> m_bounds;
  double m_largest_width = 0; // largest width of a cell
  double m_unit;              // power of two; its product with the largest width is about one
};

template <typename Field, typename Threshold, typename ConcurrencyTag>
Shell_facet_oracle_3<Field, Threshold, ConcurrencyTag>::Shell_facet_oracle_3(const Shell& shell, Facet_proofs proofs)
  : m_shell(&shell), m_proofs(proofs), m_predicates(shell.field()),
    m_bounds(shell.cell_bounds()
               ? shell.cell_bounds()
               : std::make_shared<const Bounds>(shell.field(), shell.inner_threshold(), shell.outer_threshold()))
{
  for(Cell_index c = 0; c < shell.field().number_of_cells(); ++c)
    m_largest_width = (std::max)(m_largest_width, shell.field().cell(c).width());
  m_unit = internal::reciprocal_power_of_two(m_largest_width);
}

template <typename Field, typename Threshold, typename ConcurrencyTag>
Placement_verdict Shell_facet_oracle_3<Field, Threshold, ConcurrencyTag>::operator()(const Point_3& p,
                                                                                     const std::vector<Point_3>& link,
                                                                                     Memory& memory) const
{
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // required by exact predicates
  internal::Run::poll();
  const std::size_t size = link.size();
  boost::container::small_vector<char, 16> is_known(size, 0);
  const typename Memory::Place place = { p[0], p[1], p[2] };
  if(const typename Memory::Facets* known = memory.facets_at(place))
    for(std::size_t n = 0; n < size; ++n)
      for(const typename Memory::Facet& facet : *known) {
        if(facet.q != link[n] || facet.r != link[(n + 1) % size]) continue;
        if(facet.verdict != Placement_verdict::ACCEPTED) return facet.verdict;
        is_known[n] = 1;
      }
  boost::container::small_vector<Coordinates, 16> normals(size, boost::container::default_init);
  for(std::size_t n = 0; n < size; ++n) normals[n] = rounded_normal(p, link[n], link[(n + 1) % size]);
  // The rejection of a facet by a point of an edge. For most facets, both ends of an edge at `p` are in the shell, and
  // the middle decides.
  struct Rejected
  {
    std::size_t facet;
    Placement_verdict verdict;
  };
  const auto rejected_at = [&](std::size_t n, const Sample& s) -> std::optional<Rejected> {
    if(!is_in(s)) return Rejected{ n, Placement_verdict::LEAVES_SHELL };
    for(std::size_t facet : { n, (n + size - 1) % size })
      if(!(Bounds::slope(s, normals[facet]) > 0)) return Rejected{ facet, Placement_verdict::FACES_AWAY };
    return std::nullopt;
  };
  memory.set_link(link);
  boost::container::small_vector<Sample, 16> middles(size, boost::container::default_init);
  Sample at_p = { place, Bounds::no_cell, -1, -1, {} }; // sampled only if it is needed
  const auto rejected_by_edge = [&](std::size_t n) {
    if(!memory.m_samples[n]) memory.m_samples[n] = m_bounds->sample(link[n]);
    std::optional<Rejected> rejected = rejected_at(n, *memory.m_samples[n]);
    if(rejected) return rejected;
    middles[n] = m_bounds->sample_middle(at_p, *memory.m_samples[n]);
    return rejected_at(n, middles[n]);
  };
  const std::optional<std::size_t> first = memory.m_rejecting;
  std::optional<Rejected> rejected;
  if(first) rejected = rejected_by_edge(*first);
  if(!rejected) {
    at_p = m_bounds->sample(p);
    if(!is_in(at_p)) return Placement_verdict::LEAVES_SHELL;
    for(std::size_t n = 0; n < size; ++n)
      if(!(Bounds::slope(at_p, normals[n]) > 0)) return Placement_verdict::FACES_AWAY;
    for(std::size_t n = 0; n < size && !rejected; ++n) {
      if(n == first) continue;
      rejected = rejected_by_edge(n);
      if(rejected) memory.m_rejecting = n;
    }
  }
  if(rejected) {
    memory.add(place, { link[rejected->facet], link[(rejected->facet + 1) % size], rejected->verdict });
    return rejected->verdict;
  }
  const std::size_t turns = winding_number(p, at_p, link);
  if(turns != 1) return turns == 0 ? Placement_verdict::FACES_AWAY : Placement_verdict::WINDS_TWICE;
  // The first rejected facet, in the order of the link, decides; facets after it may be skipped.
  boost::container::small_vector<Placement_verdict, 16> verdicts(size, Placement_verdict::ACCEPTED);
  std::atomic<std::size_t> first_rejected(size);
  const auto examine = [&](std::size_t n, std::size_t) {
    if(is_known[n] || n > first_rejected) return;
    const std::size_t m = (n + 1) % size;
    verdicts[n] = judge({ &at_p, &*memory.m_samples[n], &*memory.m_samples[m] }, { nullptr, &middles[m], &middles[n] },
                        normals[n], p, link[n], link[m]);
    if(verdicts[n] == Placement_verdict::ACCEPTED) return;
    for(std::size_t other = first_rejected; n < other;)
      if(first_rejected.compare_exchange_weak(other, n)) break;
  };
  // Facets in few cells take less time than starting other threads.
  constexpr double few = 3;
  const double extent = few * m_shell->field().cell(at_p.cell).width();
  const bool is_small = std::all_of(link.begin(), link.end(), [&](const Point_3& q) {
    return (std::max)({ std::abs(q[0] - p[0]), std::abs(q[1] - p[1]), std::abs(q[2] - p[2]) }) < extent;
  });
  if(is_small) internal::for_each_chunk<Sequential_tag>(size, 1, examine);
  else internal::for_each_chunk<ConcurrencyTag>(size, 1, examine);
  if(first_rejected == size) return Placement_verdict::ACCEPTED;
  for(std::size_t n = 0; n <= first_rejected; ++n)
    if(!is_known[n]) memory.add(place, { link[n], link[(n + 1) % size], verdicts[n] });
  return verdicts[first_rejected];
}

template <typename Field, typename Threshold, typename ConcurrencyTag>
Placement_verdict Shell_facet_oracle_3<Field, Threshold, ConcurrencyTag>::operator()(
  const Point_3& p, const Point_3& q, const Point_3& r, const std::array<Sample, 3>& corners) const
{
  internal::Run::poll();
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);
  if(CGAL::collinear(p, q, r)) return Placement_verdict::FACES_AWAY;
  for(const Sample& s : corners)
    if(!is_in_cells(s)) return Placement_verdict::LEAVES_SHELL;
  if(estimate({ &corners[0], &corners[1], &corners[2] }, {}, rounded_normal(p, q, r)) == Estimate::CLEAR)
    return Placement_verdict::ACCEPTED;
  const Facet_bounds found = m_bounds->examine(corners, facet_normal(p, q, r), most_bisections);
  if(found.leaves_shell) return Placement_verdict::LEAVES_SHELL;
  if(found.faces_away) return Placement_verdict::FACES_AWAY;
  const std::array<Point_3, 3> triangle = { p, q, r };
  if(!found.is_contained
     && m_predicates.values_within(triangle, m_shell->inner_threshold(), m_shell->outer_threshold()) != Verdict::PROVED)
    return Placement_verdict::LEAVES_SHELL;
  if(!found.is_transversal && m_predicates.crosses_upwards(triangle) != Verdict::PROVED)
    return Placement_verdict::FACES_AWAY;
  return Placement_verdict::ACCEPTED;
}

template <typename Field, typename Threshold, typename ConcurrencyTag>
std::size_t Shell_facet_oracle_3<Field, Threshold, ConcurrencyTag>::winding_number(
  const Point_3& p, const Sample& at_p, const std::vector<Point_3>& link) const
{
  const Coordinates gradient = internal::scaled_to_unit(at_p.gradient);
  const double length = internal::norm(gradient);
  if(!(length > 0)) return 0;
  const double s = 16 * m_largest_width / length;
  Coordinates on_axis;
  for(int a = 0; a < 3; ++a) {
    on_axis[a] = p[a] + s * gradient[a];
    if(!std::isfinite(on_axis[a])) return 0; // predicates require finite coordinates
  }
  return link_winding_number(p, Point_3(on_axis[0], on_axis[1], on_axis[2]), link);
}

#ifdef CGAL_BSPLINE_SHELL_3_INSTANCES
extern template class Shell_facet_oracle_3<>;
extern template class Shell_facet_oracle_3<Hierarchical_bspline_field_3<>,
                                           Spline_threshold<Hierarchical_bspline_field_3<> > >;
#ifdef CGAL_LINKED_WITH_TBB
extern template class Shell_facet_oracle_3<Hierarchical_bspline_field_3<>, Constant_threshold, Parallel_tag>;
extern template class Shell_facet_oracle_3<Hierarchical_bspline_field_3<>,
                                           Spline_threshold<Hierarchical_bspline_field_3<> >, Parallel_tag>;
#endif
#endif

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_SHELL_FACET_ORACLE_3_H
