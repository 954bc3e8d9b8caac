// Writes small certificates for check_certificate_test.py, of kinds that the meshes of libcgal-demo do not cover:
//
//   write_certificates DIRECTORY
//
//   varying, varying_hierarchy      varying thresholds, on equal cells and on cells of three sizes
//   components                      three components: a sphere in another one, and a third one beside them
//   simplified                      a mesh simplified in its shell, with the shell's own cover
//   steep_inner, steep_outer        a threshold with an overhang: P3 is not proved
//   truncated                       a mesh with two neighboring vertices whose facets face no common direction; also
//                                   the mesh before the truncation: truncated.user.off
//   excised                         a mesh simplified in its shell, in contact with excised triangles. Also the mesh
//                                   without the triangles that close it: excised.user.off; the mesh before the
//                                   simplification: excised.kept.off; it and the simplified mesh with the excised
//                                   triangles: excised.soup.off, excised.joined.off
//
// The exit code is 1 if a file cannot be written, or if a verdict differs from the expected one.
#include "coefficient_functions.h"
#include "finned_sphere.h"
#include "shell_reports.h"
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/IO/write_certificate.h>
#include <CGAL/Bspline_shell_3/IO/write_shell.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>
#include <CGAL/Bspline_shell_3/Soup/Excision_filter.h>
#include <CGAL/Bspline_shell_3/Soup/rejoin_excised.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <set>
#include <string>
#include <vector>

namespace BS = CGAL::Bspline_shells;
typedef BS::Hierarchical_bspline_field_3<> Field;
typedef std::function<double(const Point_3&)> Function;

const double width = 0.25; // for cells of level 0

// Returns the cells in a box around the origin on which the function is small.
Root_cells cells_near(const Function& f, double distance, const Lattice_point& size)
{
  const double x = size[0] * width, y = size[1] * width, z = size[2] * width;
  return cells_where(BS::Lattice_3(CGAL::Bbox_3(-x, -y, -z, x, y, z), width), { -size[0], -size[1], -size[2] },
                     { size[0] - 1, size[1] - 1, size[2] - 1 }, [&](int i, int j, int k) {
                       return std::abs(f(Point_3((i + 0.5) * width, (j + 0.5) * width, (k + 0.5) * width))) < distance;
                     });
}

// Sets each coefficient to the value of the function at its point.
Field spline(Field field, const Function& f)
{
  set_coefficients(field, [&](const Point_3& p, double) { return f(p); });
  return field;
}

bool write(const std::string& file, const Mesh& mesh)
{
  return BS::write_file(
    file, [&](std::ostream& out) { return CGAL::IO::write_OFF(out, mesh, CGAL::parameters::stream_precision(17)); });
}

template <typename Shell, typename Certificate>
bool write(const std::string& prefix, const Shell& shell, const Certificate& certificate,
           const std::set<BS::Claim>& not_proved = {})
{
  bool good = certificate.status() == BS::Shell_status::SUCCESS;
  for(int c = 0; c < 5; ++c)
    good = good && (certificate.verdict(BS::Claim(c)) != BS::Verdict::PROVED) == (not_proved.count(BS::Claim(c)) != 0);
  good = good && BS::write_shell(prefix + ".shell.txt", shell) == BS::Shell_file_status::SUCCESS
         && BS::write_certificate(prefix + ".certificate.txt", shell, certificate)
         && write(prefix + ".mesh.off", certificate.examined_mesh());
  if(!good) {
    std::cerr << prefix << " is not as expected:";
    for(int c = 0; c < 5; ++c) std::cerr << ' ' << name(certificate.verdict(BS::Claim(c)));
    std::cerr << '\n';
  }
  return good;
}

template <typename Threshold>
bool write(const std::string& prefix, const Field& f, const Threshold& inner, const Threshold& outer, const Mesh& mesh,
           const std::set<BS::Claim>& not_proved = {})
{
  const CGAL::Bspline_shell_3<Field, Threshold> shell(f, inner, outer, std::vector<char>(f.number_of_cells(), 1), {},
                                                      successful_report(2));
  BS::Shell_certificate_3<Field, Threshold> certificate(f, inner, outer);
  certificate.verify(mesh);
  return write(prefix, shell, certificate, not_proved);
}

template <typename Field>
bool write_varying(
  const std::string& prefix, const Field& cells, const Mesh& mesh, const std::set<BS::Claim>& not_proved = {},
  const Function& inner_bump = [](const Point_3&) { return 0.; },
  const Function& outer_bump = [](const Point_3&) { return 0.; })
{
  typedef BS::Spline_threshold<Field> Threshold;
  const Field f = spline(cells, [](const Point_3& p) { return distance(p, CGAL::ORIGIN) - 1; });
  return write(prefix, f,
               Threshold(spline(cells, [&](const Point_3& p) { return -0.2 + 0.1 * p.z() + inner_bump(p); })),
               Threshold(spline(cells, [&](const Point_3& p) { return 0.25 - 0.1 * p.x() * p.y() + outer_bump(p); })),
               mesh, not_proved);
}

// Writes the certificate of a mesh's shell, whose singular vertices are truncated.
bool write_truncated(const std::string& prefix, const Mesh& mesh, std::size_t singular_vertices)
{
  std::size_t singular = 0;
  for(auto v : mesh.vertices()) singular += BS::vertex_cone(mesh, v) ? 0 : 1;
  const CGAL::Certified_bspline_shell_3 shell = CGAL::certified_bspline_shell_3<CGAL::Sequential_tag>(
    mesh, BS::parameters::resolution(6).relative_thickness(0.1));
  BS::Shell_certificate_3 certificate(shell);
  certificate.verify<CGAL::Sequential_tag>(mesh);
  return singular == singular_vertices && shell.truncation() && shell.truncation()->discs().size() == singular
         && write(prefix, shell, certificate) && write(prefix + ".user.off", mesh);
}

bool write(const std::string& file, const std::vector<Point_3>& points,
           const std::vector<std::vector<std::size_t> >& triangles)
{
  return BS::write_file(file, [&](std::ostream& out) {
    return CGAL::IO::write_OFF(out, points, triangles, CGAL::parameters::stream_precision(17));
  });
}

// Simplifies the mesh of a soup in its shell, and writes its certificate, and the meshes and soups before and after.
template <typename Excised>
bool write_excised(const std::string& prefix, const Excised& ball, std::size_t facets)
{
  const BS::Excised_soup_3& soup = ball.soup;
  Mesh coarse = soup.mesh();
  auto is_constrained = coarse.add_property_map<CGAL::SM_Edge_index, bool>("e:is_constrained", false).first;
  BS::constrain_pins(soup, is_constrained);
  const auto result = BS::simplify_in_shell<CGAL::Sequential_tag>(
    coarse, ball.shell,
    BS::parameters::stop(BS::Facet_count_stop_predicate(facets))
      .edge_is_constrained_map(is_constrained)
      .filter(BS::Excision_filter(soup)));
  coarse.collect_garbage();
  const BS::Rejoined_soup_3 joined = BS::rejoin_excised(soup, coarse);
  BS::Shell_certificate_3 certificate(ball.shell);
  certificate.template verify<CGAL::Sequential_tag>(coarse);
  std::vector<std::vector<std::size_t> > triangles;
  for(const auto& t : soup.soup().triangles) triangles.emplace_back(t.begin(), t.end());
  return result && joined && write(prefix, ball.shell, certificate) && write(prefix + ".user.off", coarse)
         && write(prefix + ".kept.off", soup.mesh()) && write(prefix + ".soup.off", soup.soup().points, triangles)
         && write(prefix + ".joined.off", joined.soup.points, joined.soup.polygons);
}

int main(int argc, char** argv)
{
  if(argc != 2) {
    std::cerr << "Usage: write_certificates DIRECTORY\n";
    return 2;
  }
  const std::string directory = std::string(argv[1]) + "/";
  bool good = true;

  // around the unit sphere
  const Function around = [](const Point_3& p) { return distance(p, CGAL::ORIGIN) - 1; };
  const Root_cells roots = cells_near(around, 0.6, { 8, 8, 8 });
  const Field equal(roots);
  CGAL::Random random(1);
  good = write_varying(directory + "varying", equal, sphere(1)) && good;
  good = write_varying(directory + "varying_hierarchy", Field(random_hierarchy(random, roots, 3)), sphere(1)) && good;
  const Field more(cells_near(around, 0.7, { 8, 8, 8 })); // the overhang does not reach their border
  for(bool inner : { true, false }) {
    const Point_3 place = inner ? Point_3(0, 0.5, 0.5) : Point_3(0, 0.75, 1);
    const Function bump = [&](const Point_3&p) { return p == place ? inner ? -2. : 3. : 0.; },
                   none = [](const Point_3&) { return 0.; };
    good = write_varying(directory + (inner ? "steep_inner" : "steep_outer"), more, sphere(1), { BS::Claim::GRADIENT },
                         inner ? bump : none, inner ? none : bump)
           && good;
  }

  // Claims that are not proved: two small spheres in the shell of a large one, and a vertex outside the shell.
  {
    const Field f = spline(equal, around);
    const BS::Constant_threshold inner(-0.2), outer(0.2);
    const Mesh small = joined(sphere(1, 0.1, Point_3(1, 0, 0)), sphere(1, 0.1, Point_3(-1, 0, 0)));
    good = write(directory + "small_spheres", f, inner, outer, small,
                 { BS::Claim::TRANSVERSALITY, BS::Claim::ONE_SHEET, BS::Claim::DEGREE_ONE })
           && good;
    Mesh pointed = sphere(1);
    Point_3& tip = pointed.point(*pointed.vertices().begin());
    tip = CGAL::ORIGIN + 1.4 * (tip - CGAL::ORIGIN);
    good = write(directory + "pointed", f, inner, outer, pointed,
                 { BS::Claim::CONTAINMENT, BS::Claim::GRADIENT, BS::Claim::ONE_SHEET, BS::Claim::DEGREE_ONE })
           && good;
  }

  // The critical point of a quadratic function is slightly beyond a threshold, so almost all of its box is in the
  // shell. With the opposite sign, it is beyond the other threshold. No path is found, as none begins close enough to
  // the critical point.
  for(double sign : { 1., -1. }) {
    const Point_3 center(0.03, 0.05, -0.04);
    const Function squared = [&](const Point_3& p) { return sign * (CGAL::squared_distance(p, center) - 1) / 2; };
    Mesh ball = sphere(1, 1, center);
    if(sign < 0) ball = reversed(ball);
    const Field f = spline(Field(cells_near(squared, 0.7, { 8, 8, 8 })), squared);
    const double critical = f.value(center).value(), radius = 0.035;
    const BS::Constant_threshold beside(critical + sign * radius * radius / 2), far(sign * 0.2);
    good = write(directory + (sign > 0 ? "critical_below" : "critical_above"), f, sign > 0 ? beside : far,
                 sign > 0 ? far : beside, ball, { BS::Claim::DEGREE_ONE })
           && good;
    // If the threshold is closer to the critical value, all claims are proved.
    Mesh aside = sphere(1);
    if(sign < 0) aside = reversed(aside);
    good = write(directory + (sign > 0 ? "ball" : "ball_inwards"), f, BS::Constant_threshold(sign > 0 ? -0.44 : -0.2),
                 BS::Constant_threshold(sign > 0 ? 0.2 : 0.44), aside)
           && good;
  }

  // the volume between two spheres, and a third sphere
  const Point_3 place(-1, 0, 0), beside(1.5, 0, 0);
  const Function f = [&](const Point_3& p) {
    return (std::min)((std::max)(distance(p, place) - 1.25, 0.5 - distance(p, place)), distance(p, beside) - 0.6);
  };
  const Mesh mesh = joined(joined(reversed(sphere(1, 0.5, place)), sphere(1, 1.25, place)), sphere(1, 0.6, beside));
  const Field field = spline(Field(cells_near(f, 0.5, { 12, 8, 8 })), f);
  good = write(directory + "components", field, BS::Constant_threshold(-0.1), BS::Constant_threshold(0.15), mesh)
         && good;

  // a mesh simplified in its shell
  Mesh simplified = sphere(2);
  const CGAL::Certified_bspline_shell_3 shell = CGAL::certified_bspline_shell_3<CGAL::Sequential_tag>(
    simplified, BS::parameters::resolution(6).relative_thickness(0.1));
  const auto result = BS::simplify_in_shell<CGAL::Sequential_tag>(
    simplified, shell, BS::parameters::stop(BS::Facet_count_stop_predicate(80)));
  BS::Shell_certificate_3 certificate(shell);
  certificate.verify<CGAL::Sequential_tag>(simplified);
  good = result && shell.proved_cover() && write(directory + "simplified", shell, certificate) && good;

  good = write_truncated(directory + "truncated", screw(5), 2) && good;
  good = write_excised(directory + "excised", Finned_sphere_of_size<2>(), 200) && good;
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
