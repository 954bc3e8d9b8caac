// Checks Shell_certificate_3 on small meshes around a field similar to the distance from a point: spheres, double
// pyramids, stars that cover directions more than once, pairs of surfaces.
#ifndef CHECK_CERTIFICATE_H
#define CHECK_CERTIFICATE_H

#include "check_geometry.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>

#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/generators.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

typedef CGAL::Surface_mesh<Point_3> Mesh;

// Splits each facet into four.
inline Mesh subdivided(const Mesh& mesh)
{
  Mesh fine;
  std::vector<CGAL::SM_Vertex_index> at_vertex, at_edge;
  for(auto v : mesh.vertices()) at_vertex.push_back(fine.add_vertex(mesh.point(v)));
  for(auto e : mesh.edges())
    at_edge.push_back(fine.add_vertex(CGAL::midpoint(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1)))));
  for(auto f : mesh.faces()) {
    CGAL::SM_Vertex_index v[3], m[3];
    auto h = mesh.halfedge(f);
    for(int i = 0; i < 3; ++i, h = mesh.next(h)) {
      v[i] = at_vertex[mesh.source(h)];
      m[i] = at_edge[mesh.edge(h)];
    }
    fine.add_face(v[0], m[0], m[2]);
    fine.add_face(m[0], v[1], m[1]);
    fine.add_face(m[2], m[1], v[2]);
    fine.add_face(m[0], m[1], m[2]);
  }
  return fine;
}

// Returns an icosahedron on the unit sphere, with each facet sometimes split into four.
inline Mesh random_sphere(CGAL::Random& random, double noise)
{
  Mesh mesh;
  CGAL::make_icosahedron(mesh, Point_3(0, 0, 0), 1.);
  if(chance(random, 0.3)) mesh = subdivided(mesh);
  for(auto v : mesh.vertices()) {
    const Point_3& p = mesh.point(v);
    const Vector moved = Vector(p.x(), p.y(), p.z()).normalized() + noise * random_vector(random);
    mesh.point(v) = Point_3(moved[0], moved[1], moved[2]);
  }
  return mesh;
}

template <typename Threshold>
class Certificate_check
{
  typedef Exact_shell<Threshold> Shell;
  typedef typename Shell::Jets Jets;
  typedef BS::Shell_certificate_3<Field, Threshold> Certificate;

public:
  Certificate_check(Tally& tally, CGAL::Random& random) : m_tally(tally), m_random(random)
  {
    // Cells in a cube around a center, whose side is three units. All other random lengths are in this unit.
    const int half_cells = random.get_int(4, 7);
    m_unit = std::ldexp(random.get_double(0.5, 1),
                        chance(random, 0.95) ? random.get_int(-180, 181) : random.get_int(-300, 301));
    const double spacing = 1.5 * m_unit / half_cells;
    const Vector far = chance(random, 0.3)
                         ? Vector(random_vector(random) * m_unit * std::ldexp(1., random.get_int(0, 25)))
                         : Vector(Vector::Zero());
    const BS::Lattice_3 lattice(CGAL::Bbox_3(far[0], far[1], far[2], far[0], far[1], far[2]), spacing);
    if(!lattice.is_exact()) return;
    m_center = Vector(lattice.origin()[0], lattice.origin()[1], lattice.origin()[2]);
    const Root_cells roots = some_cells(random, lattice, { -half_cells, -half_cells, -half_cells },
                                        { half_cells - 1, half_cells - 1, half_cells - 1 });
    Field field = zero_field(random, roots);

    const Vector axes = Vector::Ones() + random.get_double(0, 0.2) * random_vector(random),
                 offset = 0.1 * random_vector(random);
    const double noise = chance(random, 0.5) ? 0 : power_of_ten(random, -16, -1);
    const double root_width = lattice.spacing() / m_unit;
    field.set_coefficients(m_unit * coefficients(field, [&](const Vector& u) {
                             const double x = (root_width * u - offset).cwiseProduct(axes).norm();
                             return std::isnan(x) ? 0 : x + noise * random.get_double(-1, 1);
                           }));
    make_mesh(axes, offset);
    for(auto f : m_mesh.faces())
      if(is_degenerate(triangle_of(m_mesh, f))) return;

    // thresholds at the extrema on the mesh, or beyond them
    BS::Level_range levels;
    for(auto f : m_mesh.faces()) {
      const Triangle t = triangle_of(m_mesh, f);
      for(int i = 0; i <= 6; ++i)
        for(int j = 0; i + j <= 6; ++j) {
          const auto value = field.value(Point_3((i * t[0][0] + j * t[1][0] + (6 - i - j) * t[2][0]) / 6,
                                                 (i * t[0][1] + j * t[1][1] + (6 - i - j) * t[2][1]) / 6,
                                                 (i * t[0][2] + j * t[1][2] + (6 - i - j) * t[2][2]) / 6));
          if(value) levels.include(*value);
        }
    }
    const auto slack = [&]() {
      return m_unit * (chance(random, 0.7) ? power_of_ten(random, -2, -0.6) : random_distance(random));
    };
    const double inner = levels.min - slack(), outer = levels.max + slack();
    if(!std::isfinite(inner) || !std::isfinite(outer)) return;
    if constexpr(Threshold::is_constant) {
      examine(field, Threshold(inner), Threshold(outer));
    } else {
      const auto vary = [&](double level, double direction) {
        const double bumps = chance(random, 0.5) ? 0 : power_of_ten(random, -3, 0.3), share = random.get_double(0, 0.2),
                     tilt = chance(random, 0.5) ? 0 : power_of_ten(random, -3, -1);
        const Vector towards = random_direction(random);
        Field threshold = field;
        threshold.set_coefficients(coefficients(field, [&](const Vector& u) {
          const double bump = chance(random, share) ? bumps * random.get_double(0, 1) : 0;
          return level + direction * m_unit * (bump + tilt * (1 + towards.dot(root_width * u) / 3));
        }));
        return Threshold(std::move(threshold));
      };
      examine(field, vary(inner, -1), vary(outer, 1));
    }
  }

private:
  void make_mesh(const Vector& axes, const Vector& offset)
  {
    const double noise = chance(m_random, 0.2) ? 0 : power_of_ten(m_random, -16, -0.7);
    const int shape = m_random.get_int(0, 10);
    if(shape < 5) m_mesh = random_sphere(m_random, noise);
    else if(shape < 7) m_mesh = random_bipyramid(m_random, m_random.get_int(3, 10), 1, noise, 1);
    else {
      const int sides[] = { 5, 7, 7, 8, 9 }, turns[] = { 2, 2, 3, 3, 2 },
                n = chance(m_random, 0.5) ? 0 : m_random.get_int(0, 5);
      m_is_star = true;
      m_mesh = random_bipyramid(m_random, sides[n], turns[n], (std::min)(noise, 0.03), 1);
    }
    if(chance(m_random, 0.1)) { // another surface inside
      m_is_pair = true;
      Mesh inner = random_sphere(m_random, 0);
      const double factor = m_random.get_double(0.7, 0.99);
      for(auto v : inner.vertices()) inner.point(v) = CGAL::ORIGIN + factor * (inner.point(v) - CGAL::ORIGIN);
      CGAL::copy_face_graph(inner, m_mesh);
    }
    for(auto v : m_mesh.vertices()) {
      const Point_3& p = m_mesh.point(v);
      const Vector moved = m_center + m_unit * (Vector(p.x(), p.y(), p.z()).cwiseQuotient(axes) + offset);
      m_mesh.point(v) = Point_3(moved[0], moved[1], moved[2]);
    }
  }

  void examine(const Field& field, const Threshold& inner, const Threshold& outer)
  {
    const Shell shell(field, inner, outer);
    Certificate certificate(field, inner, outer);
    certificate.template verify<CGAL::Sequential_tag>(m_mesh);
    if(certificate.status() != BS::Shell_status::SUCCESS) {
      m_tally.count("certificate", Verdict::UNDECIDED);
      return;
    }
    Verdict worst = Verdict::PROVED;
    for(int c = 0; c < 5; ++c) {
      const Verdict v = certificate.verdict(BS::Claim(c));
      m_tally.count(std::string("claim_") + BS::name(BS::Claim(c)), v);
      if(v == Verdict::REFUTED) worst = v;
      else if(v == Verdict::UNDECIDED && worst == Verdict::PROVED) worst = v;
    }
    m_tally.count(m_is_star ? "certificate_of_star" : "certificate", worst);
    if((worst == Verdict::PROVED) != certificate.is_certified())
      m_tally.wrong("certificate", "the result contradicts the claims");
    if(certificate.is_certified()) check_certified(shell, certificate);
    check_facets(shell, certificate);
    if(chance(m_random, 0.3)) check_scaled(field, inner, outer, certificate);
    for(const BS::Certificate_witness& w : certificate.witnesses())
      if(w.verdict == Verdict::REFUTED) check_refuted(shell, certificate, w);
  }

  static Field scaled(Field field, int exponent)
  {
    Eigen::VectorXd x = field.coefficients();
    for(double& c : x) c = std::ldexp(c, exponent);
    field.set_coefficients(std::move(x));
    return field;
  }
  static BS::Constant_threshold scaled(const BS::Constant_threshold& threshold, int exponent)
  {
    return BS::Constant_threshold(std::ldexp(threshold.level(), exponent));
  }
  static BS::Spline_threshold<Field> scaled(const BS::Spline_threshold<Field>& threshold, int exponent)
  {
    return BS::Spline_threshold<Field>(scaled(threshold.field(), exponent));
  }

  // Scales the field and the thresholds by a power of two. Claims must be the same, and bounds scaled exactly. Near the
  // limits of the range of numbers, fewer claims may be proved, and the angle may be bounded on smaller parts.
  void check_scaled(const Field& field, const Threshold& inner, const Threshold& outer, const Certificate& certificate)
  {
    const int exponent = m_random.get_int(-1050, 1000), size = std::ilogb(m_unit);
    if(std::abs(exponent + size) > 1050) return;
    const Field scaled_field = scaled(field, exponent);
    Certificate other(scaled_field, scaled(inner, exponent), scaled(outer, exponent));
    other.template verify<CGAL::Sequential_tag>(m_mesh);
    // the exponents must have room for values, slopes and second derivatives
    constexpr int room = 800;
    const bool has_room = std::abs(exponent + size) < room && std::abs(exponent) < room
                          && std::abs(exponent - size) < room;
    constexpr double same = 1 + 1e-12;
    bool is_right = other.least_angle() <= sampled_angle(field)
                    && other.displacement_bound() * same >= certificate.displacement_bound();
    for(int c = 0; c < 5; ++c)
      is_right = is_right
                 && (other.verdict(BS::Claim(c)) == certificate.verdict(BS::Claim(c))
                     || (!has_room && other.verdict(BS::Claim(c)) == Verdict::UNDECIDED));
    if(has_room) {
      is_right = is_right && other.least_gradient() == std::ldexp(certificate.least_gradient(), exponent)
                 && other.least_angle() == certificate.least_angle()
                 && other.displacement_bound() == certificate.displacement_bound();
      for(std::size_t n = 0; n < certificate.facets().size(); ++n)
        is_right = is_right && other.facets()[n].slope == std::ldexp(certificate.facets()[n].slope, exponent);
    }
    m_tally.count(has_room ? "scaled_certificate" : "scaled_certificate_without_room", is_right,
                  "wrong after scaling by 2^" + std::to_string(exponent));
  }

  // Returns the least angle between the gradient and the facets at samples.
  double sampled_angle(const Field& field) const
  {
    constexpr int parts = 8;
    double least = 1; // sine
    for(auto f : m_mesh.faces()) {
      const Triangle t = triangle_of(m_mesh, f);
      const Vector n = rounded_normal(t).normalized();
      for(int i = 0; i <= parts; ++i)
        for(int j = 0; i + j <= parts; ++j) {
          std::array<double, 3> p;
          for(std::size_t a = 0; a < 3; ++a) p[a] = (i * t[0][a] + j * t[1][a] + (parts - i - j) * t[2][a]) / parts;
          least = (std::min)(least, n.dot(rounded_gradient(field, p).normalized()));
        }
    }
    return std::asin(least) + 1e-9; // the samples are rounded
  }

  void check_certified(const Shell& shell, const Certificate& certificate)
  {
    if(m_is_star) m_tally.wrong("certificate_of_star", "wrongly certified");
    if(CGAL::Polygon_mesh_processing::does_self_intersect(m_mesh))
      m_tally.wrong("certificate", "the mesh intersects itself");
    // Rays from one surface to the other are in the shell.
    if(m_is_pair) m_tally.wrong("certificate", "a component contains two surfaces");
    const std::vector<CGAL::SM_Face_index> faces(m_mesh.faces().begin(), m_mesh.faces().end());
    for(int n = 0; n < 8; ++n) {
      const auto count = crossings_of_path(
        shell, triangle_of(m_mesh, faces[std::size_t(m_random.get_int(0, int(faces.size())))]), true);
      if(count) m_tally.count("path", *count == 1, "the path crosses the mesh " + std::to_string(*count) + " times");
    }
    // Displacements and the least gradient are bounds for the whole shell; here, they are checked on the mesh.
    const Dyadic bound(certificate.least_gradient());
    for(auto f : faces) {
      const Triangle t = triangle_of(m_mesh, f);
      const auto steep_enough = [&](const Jets& j) {
        return dot(j.f.gradient, j.f.gradient) >= bound * bound * j.scale * j.scale;
      };
      const auto size = [&](const std::array<double, 3>& p) { return rounded_gradient(shell.field(), p).norm(); };
      bool is_right = true;
      for(const Barycentric<3>& b : worst_points(t, size, 6, 1))
        is_right = is_right && shell.ask(exact_point(t, b), steep_enough) == Shell::HOLDS;
      m_tally.count("least_gradient_of_certificate", is_right, "wrong on" + describe(t));
    }
  }

  void check_facets(const Shell& shell, const Certificate& certificate)
  {
    std::size_t number = 0;
    for(auto f : m_mesh.faces()) {
      const auto& verdict = certificate.facets()[number++];
      const Triangle t = triangle_of(m_mesh, f);
      const Vector n = rounded_normal(t);
      const Exact_slope exact(t);
      const auto margin = [&](const std::array<double, 3>& p) {
        return (std::min)(shell.above_inner(p), shell.below_outer(p));
      };
      const auto slope = [&](const std::array<double, 3>& p) { return n.dot(rounded_gradient(shell.field(), p)); };
      const auto is_in = [](const Jets& j) { return j.f.value >= j.inner.value && j.f.value <= j.outer.value; };
      const auto faces_along = [&](const Jets& j) {
        return exact(j.f, j.scale, verdict.transversality == Verdict::PROVED ? verdict.slope : 0);
      };
      check_facet("facet_containment", verdict.containment, shell, t, margin, is_in);
      check_facet("facet_transversality", verdict.transversality, shell, t, slope, faces_along);
    }
  }

  template <typename Margin, typename Holds>
  void check_facet(const std::string& kind, Verdict verdict, const Shell& shell, const Triangle& t,
                   const Margin& margin, const Holds& holds)
  {
    m_tally.count(kind, verdict);
    if(verdict == Verdict::UNDECIDED) return;
    if(verdict == Verdict::REFUTED) {
      if(!fails_somewhere(shell, t, margin, holds))
        m_tally.wrong(kind, "refuted, but no failure was found on" + describe(t));
      return;
    }
    for(const Barycentric<3>& b : worst_points(t, margin))
      if(shell.ask(exact_point(t, b), holds) != Shell::HOLDS) {
        m_tally.wrong(kind, "wrongly proved on" + describe(t));
        return;
      }
  }

  // Returns the algebraic number of crossings of a segment through a facet, or nothing if none is found. The field
  // increases on the segment from below the shell to above it.
  std::optional<int> crossings_of_path(const Shell& shell, const Triangle& t, bool anywhere)
  {
    double b[3] = { 1, 1, 1 };
    if(anywhere)
      for(double& x : b) x = m_random.get_double(0.05, 1);
    const double sum = b[0] + b[1] + b[2];
    std::array<double, 3> middle;
    for(int a = 0; a < 3; ++a) middle[a] = (b[0] * t[0][a] + b[1] * t[1][a] + b[2] * t[2][a]) / sum;
    const Vector g = rounded_gradient(shell.field(), middle),
                 direction = g / g.norm() + (anywhere ? 0.2 : 0) * random_vector(m_random);
    const auto along = [&](double s) {
      return Point_3(middle[0] + s * direction[0], middle[1] + s * direction[1], middle[2] + s * direction[2]);
    };
    for(double length = m_unit / 32; length < m_unit; length *= 1.2) {
      const Point_3 p = along(-length), q = along(length);
      const bool is_through = shell.ask(dyadic(p), [](const Jets& j) { return j.f.value < j.inner.value; })
                                == Shell::HOLDS
                              && shell.ask(dyadic(q), [](const Jets& j) { return j.f.value > j.outer.value; })
                                   == Shell::HOLDS;
      if(!is_through) continue;
      for(int n = 0; n <= 64; ++n) {
        const Point_3 x = along(length * (n / 32. - 1));
        if(!(direction.dot(rounded_gradient(shell.field(), { x[0], x[1], x[2] })) > 0)) return std::nullopt;
      }
      int count = 0;
      for(auto f : m_mesh.faces()) {
        const Crossing crossing = exact_crossing(triangle_of(m_mesh, f), p, q);
        if(crossing == Crossing::TOUCHES) return std::nullopt;
        count += crossing == Crossing::UPWARDS ? 1 : crossing == Crossing::DOWNWARDS ? -1 : 0;
      }
      return count;
    }
    return std::nullopt;
  }

  void check_refuted(const Shell& shell, const Certificate& certificate, const BS::Certificate_witness& w)
  {
    typedef BS::Certificate_witness Witness;
    if(w.reason == Witness::CROSSINGS) {
      const auto& mesh = certificate.examined_mesh();
      const auto count = crossings_of_path(shell, triangle_of(mesh, CGAL::SM_Face_index(std::uint32_t(w.triangle))),
                                           false);
      if(w.count == 1) m_tally.wrong("claim_degree_one", "refuted by one crossing");
      if(count && *count != w.count) m_tally.wrong("claim_degree_one", "refuted by a wrong count");
    }
    if(w.reason == Witness::CRITICAL_POINT) {
      // Newton's method must stay nearby.
      std::array<double, 3> x = w.point;
      const auto c = Field::Cell_index(w.cell);
      const auto cell = shell.field().cell(c);
      for(int step = 0; step < 20; ++step) {
        const auto jet = cell.second_order_jet(x);
        Eigen::Matrix3d h;
        h << jet.hessian[0], jet.hessian[3], jet.hessian[4], jet.hessian[3], jet.hessian[1], jet.hessian[5],
          jet.hessian[4], jet.hessian[5], jet.hessian[2];
        const Vector moved = h.fullPivLu().solve(Vector(jet.gradient[0], jet.gradient[1], jet.gradient[2]));
        for(int a = 0; a < 3; ++a) x[a] -= moved[a];
      }
      const Vector distance(x[0] - w.point[0], x[1] - w.point[1], x[2] - w.point[2]);
      bool is_right = distance.norm() < 0.2 * cell.width();
      if(is_right && shell.is_defined(c)) {
        const Jets j = shell.jets(c, dyadic(x));
        is_right = j.f.value >= j.inner.value && j.f.value <= j.outer.value;
      }
      if(!is_right)
        m_tally.wrong("claim_gradient",
                      "no critical point near" + describe(std::array<std::array<double, 3>, 1>{ w.point }));
    }
    if(w.reason == Witness::TWO_SHEETS) {
      if(!m_is_pair) m_tally.wrong("claim_one_sheet", "refuted for a single surface");
    }
  }

  Tally& m_tally;
  CGAL::Random& m_random;
  double m_unit = 1;
  Vector m_center;
  Mesh m_mesh;
  bool m_is_star = false, m_is_pair = false;
};

#endif // CHECK_CERTIFICATE_H
