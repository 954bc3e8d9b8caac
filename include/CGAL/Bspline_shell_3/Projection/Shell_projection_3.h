// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_SHELL_PROJECTION_3_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_SHELL_PROJECTION_3_H

#include <CGAL/Bspline_shell_3/Projection/Flow_status.h>
#include <CGAL/Bspline_shell_3/Projection/Gradient_flow_3.h>
#include <CGAL/Bspline_shell_3/Projection/Projection_target_3.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Integral_curve.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Support/for_each_point.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Polygon_mesh_processing/locate.h>
#include <CGAL/assertions.h>
#include <CGAL/number_utils.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Projection
 *
 * \brief the image of a point on a mesh, or the reason why there is none.
 */
template <typename TriangleMesh, typename Point_3>
struct Projected_point
{
  typedef Polygon_mesh_processing::Face_location<TriangleMesh, double> Location;

  Flow_status status = Flow_status::CANCELED;
  Location location = Location(boost::graph_traits<TriangleMesh>::null_face(), {});      ///< facet and barycentric coordinates
  Point_3 point;                       ///< in user coordinates
  double value = 0;                    ///< of the field at the image: the parameter along the curve

  explicit operator bool() const { return status == Flow_status::SUCCESS; }
};

/*!
 * \ingroup PkgBsplineShell3Projection
 *
 * \brief moves points of a shell along the integral curves of its field onto a mesh.
 *
 * If the mesh is certified (`Shell_certificate_3`), each curve meets it once, and so every point of the shell has one image. It
 * is traced in `double`s: each step is controlled so that the image is found up to a tolerance, and what cannot be found so
 * has a status that says why. A curve that the certificate says nothing about is followed just as well, as far as it stays in
 * the shell; where it meets the mesh several times, the image is one of the hits that have the gradient behind them.
 *
 * Const member functions may be called from several threads at once, and give the same result for a point whatever else is
 * asked for.
 *
 * \tparam Shell a `CGAL::Bspline_shell_3`
 * \tparam TriangleMesh a model of `FaceListGraph`
 */
template <typename Shell, typename TriangleMesh>
class Shell_projection_3
{
public:
  typedef typename Shell::Point_3 Point_3;
  typedef Projection_target_3<TriangleMesh> Target;
  typedef Projected_point<TriangleMesh, Point_3> Image;
  typedef typename Image::Location Location;
  typedef typename Target::Coordinates Coordinates;

  /// \pre `shell` outlives this object, and `target` is not null
  /// \param shell a shell
  /// \param target the mesh to project to, prepared; may be shared
  /// \param tolerance of the tracing, as for `Gradient_flow_3`, and how far an image may be from the end of the curve that was traced; user units; 0
  ///        stands for the default of `Gradient_flow_3`
  Shell_projection_3(const Shell& shell, std::shared_ptr<const Target> target, double tolerance = 0)
    : m_shell(&shell), m_target(std::move(target))
    , m_tolerance(tolerance > 0 ? tolerance : Gradient_flow_3<Shell>::default_tolerance * shell.report().unit)
  {
    CGAL_precondition(m_target != nullptr);
  }

  const Shell& shell() const { return *m_shell; }
  const Target& target() const { return *m_target; }
  double tolerance() const { return m_tolerance; }

  /// the image of a point.
  /// \tparam Point has three coordinates `p[0]`, `p[1]`, `p[2]`
  template <typename Point>
  Image operator()(const Point& p) const
  {
    Image image;
    if(!m_target->is_valid()) {
      image.status = Flow_status::INVALID_MESH;
      return image;
    }
    const Coordinates start = { CGAL::to_double(p[0]), CGAL::to_double(p[1]), CGAL::to_double(p[2]) };
    Curve curve(*m_shell, m_tolerance);
    image.status = curve.start(start);
    if(image.status != Flow_status::SUCCESS) return image;
    Hit hit;
    if(!walk(curve, hit) || !settle(curve, hit)) image.status = search(start, hit);
    if(image.status != Flow_status::SUCCESS) return image;

    Coordinates& weights = image.location.second;
    weights = hit.barycentric;
    double sum = 0;
    for(double& w : weights) sum += w = (std::max)(w, 0.);
    for(double& w : weights) w /= sum;
    const Coordinates x = m_target->point(hit.facet, weights);
    image.location.first = m_target->face_of(hit.facet);
    image.point = Point_3(x[0], x[1], x[2]);
    image.value = hit.value;
    return image;
  }

  /// the images of many points.
  /// \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`; the result is the same
  /// \tparam PointRange a random access range of points
  /// \tparam Visitor a model of `FlowVisitor`
  /// \return as many images, in the same order; those that were not sought because the visitor stopped are `CANCELED`
  template <typename ConcurrencyTag = Parallel_if_available_tag, typename PointRange, typename Visitor = Default_flow_visitor>
  std::vector<Image> project(const PointRange& points, Visitor&& visitor = Visitor()) const
  {
    std::vector<Image> images(std::size_t(std::end(points) - std::begin(points)));
    internal::for_each_point<ConcurrencyTag>(images.size(), [&](std::size_t n) -> decltype(auto) {
      return *(std::begin(points) + std::ptrdiff_t(n));
    }, visitor, [&](std::size_t n, const auto& p) { images[n] = (*this)(p); });
    return images;
  }

  /// the differential, at a point, of the flow to its image: `Flow_differential::onto_plane()` with the facet's normal, or
  /// `Flow_differential::onto_level_set()`, which does not jump between facets. \pre `image` is the image of `p`
  template <typename Point>
  Flow_differential differential(const Point& p, const Image& image) const
  {
    CGAL_precondition(bool(image));
    return Gradient_flow_3<Shell>(*m_shell, m_tolerance).differential(p, image.value);
  }

private:
  typedef internal::Integral_curve<Shell, internal::Flow_velocity> Curve;
  typedef typename Target::Index Index;

  struct Hit
  {
    Index facet = Target::npos;
    double value = 0;                   // of the field
    Coordinates barycentric = {};
    double outside = std::numeric_limits<double>::infinity();     // of the facet, a distance
  };

  static double dot(const Coordinates& u, const Coordinates& v) { return u[0]*v[0] + u[1]*v[1] + u[2]*v[2]; }

  // Where the curve passes the plane of the facet: Newton's method on the last step, as on a line nothing is left to do after one
  // iteration. Fails if that is not during the step; `s` is then a guess of where.
  bool pass_plane(const Curve& curve, Index facet, double& s, Coordinates& x) const
  {
    const double speed = curve.speed(), rate = dot(m_target->normal(facet), curve.derivative());
    const double precision = newton_precision * m_tolerance / speed;
    double first = curve.begin(), last = curve.value();
    if(first > last) std::swap(first, last);
    s = curve.value();
    x = curve.state();
    double ds = -m_target->height(facet, x) / rate;
    for(int i = 0; i < 20; ++i) {
      s += ds;
      if(!(s >= first - precision && s <= last + precision)) return false;
      if(std::abs(ds) <= precision) {
        for(int a = 0; a < 3; ++a) x[a] += ds * curve.derivative()[a];
        return true;
      }
      x = curve.at((std::min)((std::max)(s, first), last));
      ds = -m_target->height(facet, x) / rate;
    }
    return false;
  }

  // From the facet where the tangent meets the target, over edges, to the one where the curve does. Gives up rather than err.
  bool walk(Curve& curve, Hit& best) const
  {
    const double above = curve.room(true), below = curve.room(false);
    Index facet = m_target->facet_on_line(curve.state(), curve.derivative(), below, above, bend * (above - below) * curve.speed());
    if(facet == Target::npos) return false;
    Index previous = Target::npos;
    for(int moves = 0; moves < max_moves; ++moves) {
      Hit hit;
      hit.facet = facet;
      Coordinates x;
      while(true) {
        if(!(dot(m_target->normal(facet), curve.derivative()) > 0)) return false;
        if(pass_plane(curve, facet, hit.value, x)) break;
        if(++moves >= max_moves) return false;
        const double goal = curve.value() + overshoot * (hit.value - curve.value());
        if(curve.step(goal) != Flow_status::SUCCESS && !pass_plane(curve, facet, hit.value, x)) return false;
      }
      const auto position = m_target->position(facet, x);
      hit.outside = position.outside;
      if(hit.outside < best.outside) best = hit;
      if(hit.outside <= 0) return true;
      const Index next = m_target->neighbor(facet, position.edge);
      if(next == Target::npos || next == previous) break;
      previous = facet;
      facet = next;
    }
    return best.facet != Target::npos;
  }

  // Ends the curve at the facet that was found, where it passes its plane: tells whether that is on the facet and in the shell, up to the
  // tolerance.
  bool settle(Curve& curve, Hit& hit) const
  {
    double goal = hit.value;
    for(int i = 0; i < 50; ++i) {
      const double low = (std::min)(curve.begin(), curve.value()), high = (std::max)(curve.begin(), curve.value());
      if(goal >= low && goal <= high) curve.cut(goal);
      else if(curve.step(goal) != Flow_status::SUCCESS) return false;
      if(curve.value() != goal) continue;
      Coordinates x = curve.state();
      const double ds = -m_target->height(hit.facet, x) / dot(m_target->normal(hit.facet), curve.derivative());
      goal += ds;
      if(!(std::abs(ds) * curve.speed() <= newton_precision * m_tolerance)) continue;
      for(int a = 0; a < 3; ++a) x[a] += ds * curve.derivative()[a];
      const auto position = m_target->position(hit.facet, x);
      hit.value = goal;
      hit.barycentric = position.nearest;
      const Coordinates image = m_target->point(hit.facet, position.nearest);
      const Coordinates off = { image[0] - x[0], image[1] - x[1], image[2] - x[2] };
      return dot(off, off) <= m_tolerance * m_tolerance && curve.is_within_thresholds(x, goal)
          && curve.drift(x, goal) * curve.speed() <= m_tolerance;
    }
    return false;
  }

  // A point of the target is its own image, also on facets so steep that rounding moves where the curve passes their planes out of them.
  bool find_facet_at(const Coordinates& start, Hit& best) const
  {
    Curve curve(*m_shell, m_tolerance);
    curve.start(start);
    const double margin = newton_precision * m_tolerance;       // as precisely as curves end at facets
    double least = margin;
    best = Hit();
    const Bbox_3 box(start[0] - margin, start[1] - margin, start[2] - margin, start[0] + margin, start[1] + margin, start[2] + margin);
    m_target->visit_facets(box, [&](Index facet) {
      if(!(dot(m_target->normal(facet), curve.derivative()) > 0)) return;
      Hit hit;
      hit.facet = facet;
      hit.value = curve.value();
      hit.barycentric = m_target->position(facet, start).nearest;
      const Coordinates image = m_target->point(facet, hit.barycentric);
      hit.outside = std::hypot(image[0] - start[0], image[1] - start[1], image[2] - start[2]);
      if(!(hit.outside <= least)) return;
      least = hit.outside;
      best = hit;
    });
    return best.facet != Target::npos;
  }

  // along the whole curve through a point, all facets near it
  Flow_status search(const Coordinates& start, Hit& best) const
  {
    if(find_facet_at(start, best)) return Flow_status::SUCCESS;
    best = Hit();
    bool wrong_way = false;
    Flow_status failure = Flow_status::LEAVES_SHELL;
    for(const double direction : { 1., -1. }) {
      Curve curve(*m_shell, m_tolerance);
      curve.start(start);
      Flow_status status = Flow_status::SUCCESS;
      while(status == Flow_status::SUCCESS && best.outside > 0) {
        status = curve.step(direction * std::numeric_limits<double>::infinity());
        look_at_step(curve, best, wrong_way);
      }
      if(best.outside <= 0) break;
      if(status != Flow_status::LEAVES_SHELL) failure = status;
    }
    if(best.facet != Target::npos) {
      Curve curve(*m_shell, m_tolerance);
      curve.start(start);
      const bool is_inside = best.outside <= 0;
      if(settle(curve, best)) return Flow_status::SUCCESS;
      if(is_inside) return Flow_status::TOO_MANY_STEPS;       // there is an image, but it is not found with the accuracy asked for
    }
    return wrong_way ? Flow_status::FACES_WRONG_WAY : failure;
  }

  void look_at_step(const Curve& curve, Hit& best, bool& wrong_way) const
  {
    const double first = curve.begin(), last = curve.value();
    const Coordinates x0 = curve.at(first), x1 = curve.at(last);
    Bbox_3 box(x0[0], x0[1], x0[2], x0[0], x0[1], x0[2]);
    constexpr int parts = 4;
    for(int i = 1; i <= parts; ++i) {
      const Coordinates x = curve.at(first + (last - first) * i / parts);
      box += Bbox_3(x[0], x[1], x[2], x[0], x[1], x[2]);
    }
    const double margin = m_tolerance + std::abs(last - first) * curve.speed() / 4;
    box = Bbox_3(box.xmin() - margin, box.ymin() - margin, box.zmin() - margin,
                 box.xmax() + margin, box.ymax() + margin, box.zmax() + margin);
    m_target->visit_facets(box, [&](Index facet) {
      const Coordinates& n = m_target->normal(facet);
      const double near = m_tolerance * std::sqrt(dot(n, n));
      if(!(near > 0)) return;       // without an area
      double s0 = first, s1 = last, h0 = m_target->height(facet, x0), h1 = m_target->height(facet, x1);
      if(!(near > 0) || ((h0 < 0) == (h1 < 0) && std::abs(h0) > near && std::abs(h1) > near)) return;
      Hit hit;
      hit.facet = facet;
      hit.value = std::abs(h0) <= std::abs(h1) ? s0 : s1;
      Coordinates x = std::abs(h0) <= std::abs(h1) ? x0 : x1;
      if((h0 < 0) != (h1 < 0))
        for(int i = 0; i < 100 && s1 != s0; ++i) {       // regula falsi, the Illinois variant
          hit.value = s1 - h1 * (s1 - s0) / (h1 - h0);
          x = curve.at(hit.value);
          const double h = m_target->height(facet, x);
          if(std::abs(h) <= newton_precision * near) break;
          if((h < 0) == (h1 < 0)) h0 /= 2;
          else { s0 = s1; h0 = h1; }
          s1 = hit.value;
          h1 = h;
        }
      hit.outside = m_target->position(facet, x).outside;
      if(!(hit.outside < best.outside && hit.outside <= search_tolerance * m_tolerance) || !curve.is_within_thresholds(x, hit.value)) return;
      if(dot(n, curve.derivative()) > 0) best = hit;
      else if(hit.outside <= m_tolerance) wrong_way = true;
    });
  }

  static constexpr int max_moves = 64;
  static constexpr double overshoot = 1.1;
  static constexpr double bend = 0.1;                   // of a curve, as a part of its length
  static constexpr double newton_precision = 1e-3;      // of the tolerance
  static constexpr double search_tolerance = 100;       // of it, for what is less exact within steps

  const Shell* m_shell;
  std::shared_ptr<const Target> m_target;
  double m_tolerance;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_SHELL_PROJECTION_3_H
