// Checks shells of small meshes with tips and holes. The claims must hold on the closed and truncated mesh, and a copy
// of the mesh with lazy exact coordinates must get the same verdicts and images.
#ifndef CHECK_SHELLS_H
#define CHECK_SHELLS_H

#include "check_certificate.h"

#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

// Returns the boundary of a union of unit cubes, each beside the previous one. At turns, facets may face no common
// direction. If the boundary is not a surface, the mesh is empty.
inline Mesh random_cubes(CGAL::Random& random)
{
  std::vector<std::array<int, 3> > cubes(1, std::array<int, 3>{ 0, 0, 0 });
  for(int n = random.get_int(3, 5), last = -1; n > 0; --n) {
    int axis = random.get_int(0, 3);
    if(axis == last) axis = (axis + 1) % 3;
    last = axis;
    cubes.push_back(cubes.back());
    cubes.back()[std::size_t(axis)] += chance(random, 0.7) ? 1 : -1;
  }
  const std::set<std::array<int, 3> > all(cubes.begin(), cubes.end());
  Mesh mesh;
  std::map<std::array<int, 3>, CGAL::SM_Vertex_index> vertices;
  for(const std::array<int, 3>& cube : all)
    for(std::size_t a = 0; a < 3; ++a)
      for(int side = 0; side < 2; ++side) {
        std::array<int, 3> beyond = cube;
        beyond[a] += 2 * side - 1;
        if(all.count(beyond) > 0) continue;
        std::array<CGAL::SM_Vertex_index, 4> corner; // counterclockwise as seen from outside
        for(int n = 0; n < 4; ++n) {
          std::array<int, 3> p = cube;
          const int m = side == 1 ? n : 3 - n;
          p[a] += side;
          p[(a + 1) % 3] += m == 1 || m == 2;
          p[(a + 2) % 3] += m >= 2;
          const auto [place, is_new] = vertices.emplace(p, CGAL::SM_Vertex_index());
          if(is_new) place->second = mesh.add_vertex(Point_3(p[0], p[1], p[2]));
          corner[std::size_t(n)] = place->second;
        }
        for(int half = 0; half < 2; ++half)
          if(mesh.add_face(corner[0], corner[std::size_t(1 + half)], corner[std::size_t(2 + half)])
             == Mesh::null_face())
            return Mesh();
      }
  return mesh;
}

// Returns cubes whose facets are subdivided, with noise, of a random size.
inline Mesh random_scaled_cubes(CGAL::Random& random, double& unit)
{
  Mesh mesh = random_cubes(random);
  if(mesh.is_empty()) return mesh;
  mesh = subdivided(mesh);
  unit = std::ldexp(random.get_double(0.5, 1), random.get_int(-60, 61));
  const double noise = chance(random, 0.4) ? 0 : power_of_ten(random, -8, -1.5);
  for(auto v : mesh.vertices()) {
    const Point_3& p = mesh.point(v);
    const Vector moved = unit * (Vector(p.x(), p.y(), p.z()) + noise * random_vector(random));
    mesh.point(v) = Point_3(moved[0], moved[1], moved[2]);
  }
  return mesh;
}

// Removes a few facets.
inline void remove_facets(CGAL::Random& random, Mesh& mesh)
{
  for(int n = random.get_int(1, 5); n > 0; --n) {
    const CGAL::SM_Face_index f(std::uint32_t(random.get_int(0, int(mesh.number_of_faces()))));
    if(!mesh.is_removed(f)) CGAL::Euler::remove_face(mesh.halfedge(f), mesh);
  }
}

// Checks the claims of a certificate on the closed and truncated mesh.
template <typename Shell, typename Certificate>
void check_examined(Tally& tally, const Shell& shell, const Certificate& certificate, const std::string& kind)
{
  typedef typename Shell::Jets Jets;
  const auto& mesh = certificate.examined_mesh();
  if(!CGAL::is_closed(mesh)) tally.wrong(kind, "an open mesh is certified");
  if(CGAL::Polygon_mesh_processing::does_self_intersect(mesh)) tally.wrong(kind, "the mesh intersects itself");
  for(auto f : mesh.faces()) {
    const Triangle t = triangle_of(mesh, f);
    const Vector n = rounded_normal(t);
    const Exact_slope slope(t);
    const auto margin = [&](const std::array<double, 3>& p) {
      return (std::min)(shell.above_inner(p), shell.below_outer(p));
    };
    const auto rise = [&](const std::array<double, 3>& p) { return n.dot(rounded_gradient(shell.field(), p)); };
    const auto is_in = [](const Jets& j) { return j.f.value >= j.inner.value && j.f.value <= j.outer.value; };
    const auto rises = [&](const Jets& j) { return slope(j.f, j.scale, 0); };
    bool is_right = true;
    for(const Barycentric<3>& b : worst_points(t, margin, 3, 1))
      is_right = is_right && shell.ask(exact_point(t, b), is_in) == Shell::HOLDS;
    for(const Barycentric<3>& b : worst_points(t, rise, 3, 1))
      is_right = is_right && shell.ask(exact_point(t, b), rises) == Shell::HOLDS;
    tally.count(kind + "_facet", is_right, "wrong on" + describe(t));
  }
}

class Shell_check
{
  typedef CGAL::Certified_bspline_shell_3 Certified_shell;
  typedef Certified_shell::Field Field;
  typedef Certified_shell::Threshold Threshold;
  typedef BS::Shell_certificate_3<Field, Threshold> Certificate;
  typedef Exact_shell<Threshold> Shell;
  typedef CGAL::Exact_predicates_exact_constructions_kernel Lazy_kernel;
  typedef CGAL::Surface_mesh<Lazy_kernel::Point_3> Lazy_mesh;

public:
  Shell_check(Tally& tally, CGAL::Random& random) : m_tally(tally), m_random(random)
  {
    m_mesh = random_scaled_cubes(random, m_unit);
    if(m_mesh.is_empty()) return;
    if(chance(random, 0.5)) remove_facets(random, m_mesh);
    m_mesh.collect_garbage();
    const Certified_shell shell = CGAL::certified_bspline_shell_3<CGAL::Sequential_tag>(
      m_mesh, BS::parameters::relative_thickness(power_of_ten(random, -2, -1.2)));
    const std::string kind = std::string("shell") + (shell.closing() ? "_closed" : "")
                             + (shell.truncation() ? "_truncated" : "");
    m_tally.count(kind, shell.is_certified() ? Verdict::PROVED : Verdict::UNDECIDED);
    if(!shell.is_certified()) return;
    const Shell exact(shell.field(), shell.inner_threshold(), shell.outer_threshold());
    Certificate certificate(shell);
    if(!certificate.verify<CGAL::Sequential_tag>(m_mesh)) {
      m_tally.wrong(kind, "the mesh that the shell was built for is not certified");
      return;
    }
    check_examined(m_tally, exact, certificate, kind);
    check_lazy_mesh(shell, certificate);
    check_moved(exact, shell);
    check_images(shell);
  }

private:
  // Returns the mesh with lazy exact coordinates, which are known as intervals.
  static Lazy_mesh lazy(const Mesh& mesh)
  {
    Lazy_mesh result;
    const Lazy_kernel::FT third = Lazy_kernel::FT(1) / 3;
    const auto number = [&](double x) { return Lazy_kernel::FT(x) * third * 3; };
    for(auto v : mesh.vertices()) {
      const Point_3& p = mesh.point(v);
      result.add_vertex(Lazy_kernel::Point_3(number(p.x()), number(p.y()), number(p.z())));
    }
    for(auto f : mesh.faces()) {
      // A new facet has the halfedge to its first vertex: that of `f`, so that locations are the same.
      const auto h = mesh.halfedge(f);
      result.add_face(mesh.target(h), mesh.target(mesh.next(h)), mesh.source(h));
    }
    return result;
  }

  void check_lazy_mesh(const Certified_shell& shell, const Certificate& certificate)
  {
    Certificate of_lazy(shell);
    of_lazy.verify<CGAL::Sequential_tag>(lazy(m_mesh));
    const bool is_same = of_lazy.is_certified() && of_lazy.least_angle() == certificate.least_angle()
                         && of_lazy.examined_mesh().number_of_faces() == certificate.examined_mesh().number_of_faces();
    m_tally.count("lazy_certificate", is_same, "the results differ");
  }

  // Moves one vertex. If the mesh is still certified, the claims must hold, and the vertex must not be on a border.
  void check_moved(const Shell& exact, const Certified_shell& shell)
  {
    for(int n = 0; n < 3; ++n) {
      Mesh moved = m_mesh;
      const CGAL::SM_Vertex_index v(std::uint32_t(m_random.get_int(0, int(moved.number_of_vertices()))));
      const Point_3& p = moved.point(v);
      const Vector step = m_unit * power_of_ten(m_random, -15, -1) * random_vector(m_random);
      const Point_3 q(p.x() + step[0], p.y() + step[1], p.z() + step[2]);
      if(p == q) continue;
      moved.point(v) = q;
      Certificate certificate(shell);
      certificate.verify<CGAL::Sequential_tag>(moved);
      m_tally.count("shell_moved", certificate.is_certified() ? Verdict::PROVED : Verdict::UNDECIDED);
      if(!certificate.is_certified()) continue;
      if(moved.is_border(v)) m_tally.wrong("shell_moved", "a mesh with another border is certified");
      check_examined(m_tally, exact, certificate, "shell_moved");
    }
  }

  void check_images(const Certified_shell& shell)
  {
    Mesh coarse = m_mesh;
    if(BS::simplify_in_shell<CGAL::Sequential_tag>(coarse, shell).status != BS::Edit_status::SUCCESS) return;
    coarse.collect_garbage();
    const Lazy_mesh lazy_source = lazy(m_mesh), lazy_target = lazy(coarse);
    const BS::Shell_map_3<Certified_shell, Mesh> map(shell, m_mesh, coarse);
    const BS::Shell_map_3<Certified_shell, Lazy_mesh> lazy_map(shell, lazy_source, lazy_target);
    const auto inverse = map.inverse();
    m_tally.count("lazy_map", map.status() == lazy_map.status(), "the statuses differ");
    for(int n = 0; n < 60; ++n) {
      std::array<double, 3> b = { m_random.get_double(0, 1), m_random.get_double(0, 1), m_random.get_double(0, 1) };
      if(chance(m_random, 0.3)) b[std::size_t(m_random.get_int(0, 3))] *= 100; // near a vertex
      const double sum = b[0] + b[1] + b[2];
      for(double& x : b) x /= sum;
      const CGAL::SM_Face_index f(std::uint32_t(m_random.get_int(0, int(m_mesh.number_of_faces()))));
      const auto image = map({ f, b });
      const auto of_lazy = lazy_map({ f, b });
      const bool is_same = image.status == of_lazy.status && image.location == of_lazy.location
                           && image.point == of_lazy.point;
      m_tally.count("lazy_image", is_same, "the results differ");
      const auto back = image ? inverse(image.location) : image;
      m_tally.count("image", back ? Verdict::PROVED : Verdict::UNDECIDED);
      if(!back) continue;
      double off = 0;
      const auto point = map.point({ f, b });
      for(std::size_t a = 0; a < 3; ++a) off = (std::max)(off, std::abs(point[a] - back.point[a]));
      if(!(off < 1e-6 * m_unit))
        m_tally.wrong("image", "the error after the round trip is " + std::to_string(off / m_unit));
    }
  }

  Tally& m_tally;
  CGAL::Random& m_random;
  Mesh m_mesh;
  double m_unit = 1;
};

#endif // CHECK_SHELLS_H
