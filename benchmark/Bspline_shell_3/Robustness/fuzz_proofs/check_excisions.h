// Checks excised soups: small meshes with random triangles at their edges and vertices, and through them. Every
// condition is compared with brute force on exact coordinates.
#ifndef CHECK_EXCISIONS_H
#define CHECK_EXCISIONS_H

#include "check_shells.h"

#include <CGAL/Bspline_shell_3/Soup/Excised_map_3.h>
#include <CGAL/Bspline_shell_3/Soup/Excision_filter.h>
#include <CGAL/Bspline_shell_3/Soup/check_excision.h>
#include <CGAL/Bspline_shell_3/Soup/rejoin_excised.h>
#include <CGAL/certified_shell_of_soup_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

// Triangles by coordinates, which identify vertices.
struct Located_complex
{
  typedef std::array<double, 3> Vertex;
  typedef std::array<Vertex, 2> Edge;
  typedef std::array<Vertex, 3> Facet;

  std::vector<Facet> facets; // oriented
  std::set<Vertex> vertices;
  std::set<Edge> edges, directed_edges; // undirected edges have the lesser end first
  std::set<Facet> sorted_facets;

  static Vertex located(const Point_3& p) { return { p.x(), p.y(), p.z() }; }
  static Edge sorted(const Edge& e) { return { (std::min)(e[0], e[1]), (std::max)(e[0], e[1]) }; }
  static Facet sorted(Facet f)
  {
    std::sort(f.begin(), f.end());
    return f;
  }
  static Facet turned(const Facet& f) { return { f[1], f[0], f[2] }; }
  static bool is_same_cycle(Facet a, const Facet& b)
  {
    for(int n = 0; n < 3; ++n) {
      if(a == b) return true;
      std::rotate(a.begin(), a.begin() + 1, a.end());
    }
    return false;
  }
  static std::array<Edge, 3> edges_of(const Facet& f)
  {
    return { Edge{ f[0], f[1] }, Edge{ f[1], f[2] }, Edge{ f[2], f[0] } };
  }

  void add(const Facet& f)
  {
    facets.push_back(f);
    sorted_facets.insert(sorted(f));
    vertices.insert(f.begin(), f.end());
    for(const Edge& e : edges_of(f)) {
      edges.insert(sorted(e));
      directed_edges.insert(e);
    }
  }
  template <typename Mesh>
  static Located_complex of(const Mesh& mesh)
  {
    Located_complex c;
    for(auto f : mesh.faces()) {
      const Triangle t = triangle_of(mesh, f);
      c.add({ located(t[0]), located(t[1]), located(t[2]) });
    }
    return c;
  }

  // Returns whether no facet has a repeated corner, and no two have the same corners.
  bool is_simplicial() const
  {
    for(const Facet& f : sorted_facets)
      if(f[0] == f[1] || f[1] == f[2]) return false;
    return sorted_facets.size() == facets.size();
  }
  // Returns whether each edge has at most one facet in each direction, and each vertex one fan.
  bool is_oriented_manifold() const
  {
    if(directed_edges.size() != 3 * facets.size()) return false;
    for(const Vertex& v : vertices) {
      std::map<Vertex, Vertex> next; // around the vertex
      std::set<Vertex> ends;
      for(const Facet& f : facets)
        for(std::size_t i = 0; i < 3; ++i)
          if(f[i] == v) {
            next[f[(i + 1) % 3]] = f[(i + 2) % 3];
            ends.insert(f[(i + 2) % 3]);
          }
      Vertex first = next.begin()->first;
      for(const auto& n : next)
        if(ends.count(n.first) == 0) first = n.first;
      std::size_t steps = 0;
      for(auto at = next.find(first); at != next.end() && steps <= next.size(); at = next.find(at->second)) {
        ++steps;
        if(at->second == first) break;
      }
      if(steps != next.size()) return false;
    }
    return true;
  }
  std::set<Edge> border() const
  {
    std::set<Edge> result;
    for(const Edge& e : directed_edges)
      if(directed_edges.count({ e[1], e[0] }) == 0) result.insert(e);
    return result;
  }
};

// Returns the elements that both sets have.
template <typename T>
std::set<T> common(const std::set<T>& a, const std::set<T>& b)
{
  std::set<T> result;
  for(const T& x : a)
    if(b.count(x) > 0) result.insert(x);
  return result;
}

inline Triangle triangle_at(const Located_complex::Facet& f)
{
  return { Point_3(f[0][0], f[0][1], f[0][2]), Point_3(f[1][0], f[1][1], f[1][2]), Point_3(f[2][0], f[2][1], f[2][2]) };
}

// Returns, exactly, whether two triangles with areas meet outside of their common vertices and edges.
inline bool overlap(const Located_complex::Facet& a, const Located_complex::Facet& b)
{
  for(std::size_t axis = 0; axis < 3; ++axis) {
    const auto less = [axis](const auto& p, const auto& q) { return p[axis] < q[axis]; };
    if((*std::max_element(a.begin(), a.end(), less))[axis] < (*std::min_element(b.begin(), b.end(), less))[axis]
       || (*std::max_element(b.begin(), b.end(), less))[axis] < (*std::min_element(a.begin(), a.end(), less))[axis])
      return false;
  }
  const Triangle s = triangle_at(a), t = triangle_at(b);
  std::vector<std::size_t> of_a, of_b; // corners that are not common
  for(std::size_t i = 0; i < 3; ++i) {
    if(std::find(b.begin(), b.end(), a[i]) == b.end()) of_a.push_back(i);
    if(std::find(a.begin(), a.end(), b[i]) == a.end()) of_b.push_back(i);
  }
  const auto meets = [](const Triangle& triangle, const Point_3& p, const Point_3& q) {
    return exact_crossing(triangle, p, q) != Crossing::NONE;
  };
  switch(of_a.size()) {
    case 0: return true;
    case 1: {
      // A part of the edge from the third corner to a common one, near the common one, would be in the other triangle.
      const std::size_t i = of_a[0], j = of_b[0];
      const Dyadic_vector p = dyadic(s[(i + 1) % 3]), edge = minus(dyadic(s[(i + 2) % 3]), p),
                          u = cross(edge, minus(dyadic(s[i]), p)), v = cross(edge, minus(dyadic(t[j]), p));
      const Dyadic_vector n = cross(u, v);
      return sign(n[0]) == 0 && sign(n[1]) == 0 && sign(n[2]) == 0 && sign(dot(u, v)) > 0;
    }
    case 2: return meets(t, s[of_a[0]], s[of_a[1]]) || meets(s, t[of_b[0]], t[of_b[1]]);
    default:
      for(std::size_t i = 0; i < 3; ++i)
        if(meets(t, s[i], s[(i + 1) % 3]) || meets(s, t[i], t[(i + 1) % 3])) return true;
      return false;
  }
}

class Excision_check
{
  typedef BS::Shell_of_soup_3::Shell Certified_shell;
  typedef BS::Shell_certificate_3<Certified_shell::Field, Certified_shell::Threshold> Certificate;
  typedef Exact_shell<Certified_shell::Threshold> Shell;
  typedef BS::Excised_soup_3 Soup;
  typedef Located_complex::Vertex Vertex;
  typedef Located_complex::Edge Edge;
  typedef Located_complex::Facet Facet;

public:
  Excision_check(Tally& tally, CGAL::Random& random) : m_tally(tally), m_random(random)
  {
    const Mesh mesh = random_mesh();
    if(mesh.is_empty()) return;
    make_soup(mesh);
    const BS::Shell_of_soup_3 found = CGAL::certified_shell_of_soup_3<CGAL::Sequential_tag>(
      m_input, BS::parameters::relative_thickness(power_of_ten(random, -2, -1.2))
                 .largest_excised_share(chance(random, 0.2) ? 0.1 : 1)
                 .effort_limit(3e4)
                 .offset(1e-30 * m_unit)); // too small, so that no time is spent on proxies
    m_tally.count(std::string("soup_") + (found ? std::string(name(found.kind())) : "without_shell"),
                  found.is_certified() || found.certification() == BS::Certification::EXCEPT_EXCISED
                    ? Verdict::PROVED
                    : Verdict::UNDECIDED);
    if(!found || found.kind() != BS::Shell_kind::EXCISED) return;
    m_soup = found.excised.get();
    m_shell = &found.shell();
    if(found.weld.is_none()) check_triangles();
    check_parts();
    check_status();
    const Shell exact(m_shell->field(), m_shell->inner_threshold(), m_shell->outer_threshold());
    check_certificate(exact, m_soup->mesh(), "excised");
    check_replacements(m_soup->mesh());
    simplify_and_check(exact);
  }

private:
  void expect(const std::string& kind, bool is_right, const std::string& what)
  {
    m_tally.count("excision_" + kind, is_right, what);
  }

  Mesh random_mesh()
  {
    Mesh mesh;
    if(chance(m_random, 0.5)) {
      mesh = random_scaled_cubes(m_random, m_unit);
    } else {
      mesh = subdivided(random_sphere(m_random, chance(m_random, 0.3) ? 0 : power_of_ten(m_random, -8, -1.3)));
      m_unit = std::ldexp(m_random.get_double(0.5, 1), m_random.get_int(-60, 61));
      for(auto v : mesh.vertices()) mesh.point(v) = CGAL::ORIGIN + m_unit * (mesh.point(v) - CGAL::ORIGIN);
    }
    if(!mesh.is_empty() && chance(m_random, 0.4)) remove_facets(m_random, mesh);
    mesh.collect_garbage();
    return mesh;
  }

  std::size_t any(std::size_t size) { return std::size_t(m_random.get_int(0, int(size))); }
  std::size_t new_point(const Vector& v)
  {
    m_input.points.emplace_back(v[0], v[1], v[2]);
    return m_input.points.size() - 1;
  }
  Vector position(std::size_t p) const
  {
    return Vector(m_input.points[p].x(), m_input.points[p].y(), m_input.points[p].z());
  }
  // Returns a new point near another one.
  std::size_t near(std::size_t p) { return new_point(position(p) + 0.5 * m_unit * random_vector(m_random)); }

  // Adds random triangles to those of a mesh.
  void make_soup(const Mesh& mesh)
  {
    for(auto v : mesh.vertices()) m_input.points.push_back(mesh.point(v));
    for(auto f : mesh.faces()) {
      const auto h = mesh.halfedge(f);
      m_input.polygons.push_back(
        { std::size_t(mesh.source(h)), std::size_t(mesh.target(h)), std::size_t(mesh.target(mesh.next(h))) });
    }
    const std::size_t vertices = m_input.points.size(), facets = m_input.polygons.size();
    std::vector<std::size_t> border;
    for(auto v : mesh.vertices())
      if(mesh.is_border(v)) border.push_back(std::size_t(v));
    for(int n = m_random.get_int(1, 6); n > 0; --n) {
      const std::vector<std::size_t> t = m_input.polygons[any(facets)];
      const std::size_t v = !border.empty() && chance(m_random, 0.4) ? border[any(border.size())] : any(vertices),
                        w = !border.empty() && chance(m_random, 0.4) ? border[any(border.size())] : any(vertices);
      const Vector middle = (position(t[0]) + position(t[1]) + position(t[2])) / 3;
      const auto add = [this](std::size_t a, std::size_t b, std::size_t c) { m_input.polygons.push_back({ a, b, c }); };
      switch(m_random.get_int(0, 12)) {
        case 0: add(t[0], t[1], near(t[2])); break; // a fin
        case 1: add(v, near(v), near(v)); break;    // a thorn
        case 2: add(v, w, near(v)); break;          // a chord
        case 3: add(v, w, any(vertices)); break;    // between vertices
        case 4:                                     // through the surface
          add(new_point(middle + m_unit * random_vector(m_random)),
              new_point(middle + m_unit * random_vector(m_random)),
              new_point(middle + m_unit * random_vector(m_random)));
          break;
        case 5: add(t[1], t[2], t[0]); break; // a duplicate
        case 6: add(t[1], t[0], t[2]); break; // a reversed duplicate
        case 7: {                             // a facet turned over
          auto& facet = m_input.polygons[any(facets)];
          std::swap(facet[0], facet[1]);
          break;
        }
        case 8: { // a corner at a vertex's position; zeros with other signs
          const Vector p = position(v);
          add(new_point(Vector(p[0] == 0 ? -p[0] : p[0], p[1], p[2] == 0 ? -p[2] : p[2])), near(v), near(v));
          break;
        }
        case 9: add(new_point((position(t[0]) + position(t[1])) / 2), near(t[0]), near(t[0])); break; // touches an edge
        case 10: add(t[0], t[1], new_point((position(t[0]) + position(t[1])) / 2)); break;            // almost flat
        default: { // It has an edge of one facet and a vertex of another one: a pillow if they are adjacent.
          const auto& other = m_input.polygons[any(facets)];
          add(t[0], t[1], other[any(3)]);
          break;
        }
      }
    }
    if(chance(m_random, 0.3))
      for(std::size_t n = m_input.polygons.size(); n > 1; --n)
        std::swap(m_input.polygons[n - 1], m_input.polygons[any(n)]);
    if(chance(m_random, 0.2)) // Triangles do not share points.
      for(auto& polygon : m_input.polygons)
        for(std::size_t& p : polygon) p = new_point(position(p));
  }

  Facet facet_of(const BS::Polygon_soup::Points& points, const std::array<std::size_t, 3>& t) const
  {
    return { Located_complex::located(points[t[0]]), Located_complex::located(points[t[1]]),
             Located_complex::located(points[t[2]]) };
  }
  Facet excised_facet(std::size_t t) const { return facet_of(m_soup->soup().points, m_soup->soup().triangles[t]); }

  // The triangles are those of the input, each once.
  void check_triangles()
  {
    std::set<Facet> expected, given;
    for(const auto& p : m_input.polygons) {
      const Facet f = Located_complex::sorted(facet_of(m_input.points, { p[0], p[1], p[2] }));
      if(f[0] != f[1] && f[1] != f[2]) expected.insert(f);
    }
    bool has_same_origins = true;
    for(std::size_t t = 0; t < m_soup->soup().triangles.size(); ++t) {
      const Facet f = Located_complex::sorted(excised_facet(t));
      const auto& p = m_input.polygons[m_soup->soup().polygon_of[t]];
      has_same_origins = has_same_origins
                         && f == Located_complex::sorted(facet_of(m_input.points, { p[0], p[1], p[2] }));
      given.insert(f);
    }
    expect("triangles", given == expected && given.size() == m_soup->soup().triangles.size(),
           "the triangles are not those of the input");
    expect("origins", has_same_origins, "a triangle has the wrong polygon");
  }

  // The mesh consists of the kept triangles, is an oriented manifold, and does not intersect itself. Its vertices and
  // edges that belong to excised triangles are on the border, or pinned.
  void check_parts()
  {
    const Mesh& mesh = m_soup->mesh();
    m_kept = Located_complex::of(mesh);
    Located_complex kept, all;
    std::vector<std::size_t> excised;
    bool has_facets = true, has_area = true;
    for(std::size_t t = 0; t < m_soup->soup().triangles.size(); ++t) {
      const Facet f = excised_facet(t);
      all.add(f);
      if(m_soup->reasons()[t] != BS::Excision_reason::KEPT) {
        m_excised.add(f);
        excised.push_back(t);
        continue;
      }
      const Facet oriented = m_soup->is_reversed(t) ? Located_complex::turned(f) : f;
      kept.add(oriented);
      const auto face = m_soup->facet_of(t);
      has_facets = has_facets && face != Mesh::null_face() && m_soup->triangle_of(face) == t
                   && Located_complex::is_same_cycle(m_kept.facets[std::size_t(face)], oriented);
      has_area = has_area && !is_degenerate(triangle_at(f));
    }
    expect("mesh", has_facets && kept.facets.size() == m_kept.facets.size(), "the mesh is not the kept triangles");
    expect("complement", excised == m_soup->excised_triangles(), "the excised triangles are not the others");
    expect("simplicial", all.is_simplicial(), "the triangles are not a simplicial complex");
    expect("manifold", m_kept.is_oriented_manifold(), "the mesh is not an oriented manifold");
    expect("area", has_area, "a triangle without area is kept");
    bool overlaps = false;
    for(std::size_t m = 0; m < m_kept.facets.size() && !overlaps; ++m)
      for(std::size_t n = 0; n < m && !overlaps; ++n) overlaps = overlap(m_kept.facets[m], m_kept.facets[n]);
    expect("embedded", !overlaps, "kept triangles intersect");

    m_border = m_kept.border();
    std::set<Vertex> inner_vertices = common(m_kept.vertices, m_excised.vertices), pinned_vertices;
    std::set<Edge> inner_edges = common(m_kept.edges, m_excised.edges), pinned_edges;
    for(const Edge& e : m_border) {
      inner_edges.erase(Located_complex::sorted(e));
      for(const Vertex& v : e) inner_vertices.erase(v);
    }
    for(auto v : m_soup->pinned_vertices()) pinned_vertices.insert(Located_complex::located(mesh.point(v)));
    for(auto e : m_soup->pinned_edges())
      pinned_edges.insert(Located_complex::sorted(Edge{ Located_complex::located(mesh.point(mesh.vertex(e, 0))),
                                                        Located_complex::located(mesh.point(mesh.vertex(e, 1))) }));
    expect("pins", pinned_vertices == inner_vertices && pinned_edges == inner_edges, "the pins are wrong");
    m_tally.count(std::string("excised_soup") + (m_border.empty() ? "" : "_open")
                    + (pinned_vertices.empty() && pinned_edges.empty() ? "" : "_pinned")
                    + (m_shell->truncation() ? "_truncated" : ""),
                  Verdict::PROVED);
  }

  void check_status()
  {
    expect("check", bool(BS::check_excision(*m_soup)), "the soup is not valid");
    expect("replacement_by_itself", bool(BS::check_replacement(*m_soup, m_soup->mesh())),
           "the mesh does not replace itself");
  }

  // Checks that the mesh is certified, and that truncation does not move vertices and edges of excised triangles.
  void check_certificate(const Shell& exact, const Mesh& mesh, const std::string& kind)
  {
    Certificate certificate(*m_shell);
    certificate.verify<CGAL::Sequential_tag>(mesh);
    expect(kind + "_certificate", certificate.is_certified(), "the mesh is not certified");
    if(!certificate.is_certified()) return;
    check_examined(m_tally, exact, certificate, kind);
    const Located_complex examined = Located_complex::of(certificate.examined_mesh());
    bool is_fixed = true;
    for(const Vertex& v : common(m_kept.vertices, m_excised.vertices))
      is_fixed = is_fixed && examined.vertices.count(v) > 0;
    for(const Edge& e : common(m_kept.edges, m_excised.edges)) is_fixed = is_fixed && examined.edges.count(e) > 0;
    expect(kind + "_contact", is_fixed, "truncation moves a vertex or an edge of an excised triangle");
  }

  // Returns whether a mesh satisfies the conditions of `check_replacement()`.
  bool can_replace(const Mesh& mesh) const
  {
    std::set<Vertex> vertices;
    for(auto v : mesh.vertices()) vertices.insert(Located_complex::located(mesh.point(v)));
    const Located_complex c = Located_complex::of(mesh);
    if(vertices.size() != mesh.number_of_vertices() || !c.is_simplicial() || !c.is_oriented_manifold()) return false;
    return c.border() == m_border && common(vertices, m_excised.vertices) == common(m_kept.vertices, m_excised.vertices)
           && common(c.vertices, m_excised.vertices) == common(m_kept.vertices, m_excised.vertices)
           && common(c.edges, m_excised.edges) == common(m_kept.edges, m_excised.edges)
           && common(c.sorted_facets, m_excised.sorted_facets).empty();
  }

  // Changes a mesh a few times, and checks whether it can still replace the mesh of the soup.
  void check_replacements(const Mesh& mesh)
  {
    const std::vector<Vertex> excised(m_excised.vertices.begin(), m_excised.vertices.end());
    for(int n = 0; n < 12; ++n) {
      Mesh changed = mesh;
      for(int step = m_random.get_int(1, 3); step > 0 && changed.number_of_faces() > 1; --step) {
        const CGAL::SM_Vertex_index v(std::uint32_t(any(changed.number_of_vertices())));
        const CGAL::SM_Halfedge_index h(std::uint32_t(any(changed.number_of_halfedges())));
        switch(m_random.get_int(0, 6)) {
          case 0: changed.point(v) = changed.point(v) + m_unit * CGAL::Vector_3<Kernel>(1e-3, 0, 1e-4); break;
          case 1: {
            if(excised.empty()) break;
            const Vertex& p = excised[any(excised.size())];
            changed.point(v) = Point_3(p[0], p[1], p[2]);
            break;
          }
          case 2: {
            const auto o = changed.opposite(h);
            if(!changed.is_border(h) && !changed.is_border(o)
               && changed.halfedge(changed.target(changed.next(h)), changed.target(changed.next(o)))
                    == Mesh::null_halfedge())
              CGAL::Euler::flip_edge(h, changed);
            break;
          }
          case 3:
            if(!changed.is_border(h)) {
              const Point_3 p = CGAL::midpoint(changed.point(changed.source(h)),
                                               changed.point(changed.target(changed.next(h))));
              changed.point(changed.target(CGAL::Euler::add_center_vertex(h, changed))) = p;
            }
            break;
          case 4:
            if(!changed.is_border(h) && chance(m_random, 0.3)) CGAL::Euler::remove_face(h, changed);
            break;
          default:
            if(CGAL::Euler::does_satisfy_link_condition(changed.edge(h), changed))
              CGAL::Euler::collapse_edge(changed.edge(h), changed);
            break;
        }
        changed.collect_garbage();
      }
      if(changed.number_of_faces() == 0) continue;
      const BS::Excision_verdict verdict = BS::check_replacement(*m_soup, changed);
      m_tally.count("replacement", verdict ? Verdict::PROVED : Verdict::REFUTED);
      if(bool(verdict) != can_replace(changed))
        m_tally.wrong("replacement", std::string("brute force has another result than: ") + message(verdict.status));
    }
  }

  std::size_t contacts_of(const Mesh& mesh) const
  {
    std::size_t contacts = 0;
    const Located_complex c = Located_complex::of(mesh);
    for(const Facet& e : m_excised.facets)
      if(!is_degenerate(triangle_at(e)))
        for(const Facet& f : c.facets) contacts += overlap(f, e);
    return contacts;
  }

  void simplify_and_check(const Shell& exact)
  {
    Mesh coarse = m_soup->mesh();
    auto is_constrained = coarse.add_property_map<CGAL::SM_Edge_index, bool>("e:is_constrained", false).first;
    BS::constrain_pins(*m_soup, is_constrained);
    const bool adds_no_contacts = m_random.get_bool();
    const BS::Excision_filter filter(*m_soup,
                                     adds_no_contacts ? BS::New_contacts::REJECTED : BS::New_contacts::ALLOWED);
    const auto result = BS::simplify_in_shell<CGAL::Sequential_tag>(
      coarse, *m_shell, BS::parameters::edge_is_constrained_map(is_constrained).filter(filter));
    m_tally.count("simplified", result ? Verdict::PROVED : Verdict::UNDECIDED);
    if(!result) return;
    coarse.collect_garbage();
    expect("replacement", can_replace(coarse), "the simplified mesh cannot replace the mesh");
    const BS::Rejoined_soup_3 whole = BS::rejoin_excised(*m_soup, coarse);
    expect("rejoined", bool(whole), "the simplified mesh is not accepted");
    if(!whole) return;
    check_rejoined(coarse, whole);
    check_certificate(exact, coarse, "simplified");
    const std::size_t before = contacts_of(m_soup->mesh()), after = contacts_of(coarse);
    expect("contacts", BS::number_of_contacts(whole) == after, "the number of contacts is wrong");
    if(adds_no_contacts) expect("new_contacts", after <= before, "the filter allowed new contacts");
    check_replacements(coarse);
    check_map(coarse, whole);
  }

  // The facets of the mesh and the excised triangles, bit for bit, with no other vertex in common than before.
  void check_rejoined(const Mesh& mesh, const BS::Rejoined_soup_3& whole)
  {
    const Located_complex c = Located_complex::of(mesh);
    const auto& points = whole.soup.points;
    std::vector<std::array<std::size_t, 3> > triangles;
    for(const auto& p : whole.soup.polygons) triangles.push_back({ p[0], p[1], p[2] });
    bool is_right = whole.facets == c.facets.size() && triangles.size() == whole.facets + m_excised.facets.size();
    for(std::size_t t = 0; t < triangles.size() && is_right; ++t)
      is_right = facet_of(points, triangles[t])
                 == (t < whole.facets ? c.facets[t] : m_excised.facets[t - whole.facets]);
    expect("rejoined_triangles", is_right, "the triangles are not those of the mesh and the excised ones");
    std::set<Vertex> vertices;
    for(const Point_3& p : points) vertices.insert(Located_complex::located(p));
    expect("rejoined_points", vertices.size() == points.size(), "two points have the same coordinates");
    std::set<std::size_t> of_mesh, of_excised;
    for(std::size_t t = 0; t < triangles.size(); ++t)
      (t < whole.facets ? of_mesh : of_excised).insert(triangles[t].begin(), triangles[t].end());
    expect("rejoined_contact", common(of_mesh, of_excised).size() == common(m_kept.vertices, m_excised.vertices).size(),
           "the parts have other vertices in common than before");
  }

  Vector point(const Facet& f, const std::array<double, 3>& b) const
  {
    Vector p = Vector::Zero();
    for(std::size_t i = 0; i < 3; ++i) p += b[i] * Vector(f[i][0], f[i][1], f[i][2]);
    return p;
  }

  // Points come back, excised ones exactly. The vertices and edges that both parts have in common do not move.
  void check_map(const Mesh& coarse, const BS::Rejoined_soup_3& whole)
  {
    const BS::Excised_map_3<Certified_shell> map(*m_shell, *m_soup, coarse, whole);
    std::vector<Facet> facets;
    for(const auto& p : whole.soup.polygons) facets.push_back(facet_of(whole.soup.points, { p[0], p[1], p[2] }));
    const std::size_t size = m_soup->soup().triangles.size();
    const auto off = [&](const Vector& p, const Vector& q) { return (p - q).cwiseAbs().maxCoeff() / m_unit; };
    constexpr double tolerance = 1e-6;
    const auto random_coordinates = [&] {
      std::array<double, 3> b = { m_random.get_double(0, 1), m_random.get_double(0, 1), m_random.get_double(0, 1) };
      const double sum = b[0] + b[1] + b[2];
      for(double& x : b) x /= sum;
      return b;
    };
    for(int n = 0; n < 60; ++n) {
      const bool is_forward = n % 2 == 0;
      const std::size_t t = chance(m_random, 0.2) ? is_forward
                                                      ? m_soup->excised_triangles()[any(m_excised.facets.size())]
                                                      : whole.facets + any(m_excised.facets.size())
                                                  : any(is_forward ? size : facets.size());
      const BS::Triangle_location start = { t, random_coordinates() };
      const BS::Triangle_image image = is_forward ? map(start) : map.inverse(start);
      const BS::Triangle_image back = !image ? image : is_forward ? map.inverse(image.location) : map(image.location);
      m_tally.count("excised_image", back ? Verdict::PROVED : Verdict::UNDECIDED);
      const bool is_excised = is_forward ? m_soup->is_excised(t) : t >= whole.facets;
      if(image && image.is_excised != is_excised) m_tally.wrong("excised_image", "the image is in the wrong part");
      if(!back) {
        if(is_excised) m_tally.wrong("excised_image", "a point of an excised triangle has no image");
        continue;
      }
      const auto facet = [&](bool is_of_soup, std::size_t triangle) {
        return is_of_soup ? excised_facet(triangle) : facets[triangle];
      };
      const Vector p = point(facet(is_forward, t), start.coordinates);
      const double error = off(p, point(facet(is_forward, back.location.triangle), back.location.coordinates));
      if(!(error < tolerance))
        m_tally.wrong("excised_image", "the error after the round trip is " + std::to_string(error));
      if(is_excised
         && (back.location.triangle != t || back.location.coordinates != start.coordinates
             || facet(is_forward, t) != facet(!is_forward, image.location.triangle)
             || image.location.coordinates != start.coordinates))
        m_tally.wrong("excised_image", "a point of an excised triangle moved");
    }
    const auto contact = common(m_kept.vertices, m_excised.vertices);
    const auto edges = common(m_kept.edges, m_excised.edges);
    for(std::size_t t = 0; t < size; ++t) {
      if(m_soup->is_excised(t)) continue;
      const Facet f = excised_facet(t);
      for(std::size_t i = 0; i < 3; ++i) {
        std::array<double, 3> b = { 0, 0, 0 };
        const std::size_t j = (i + 1) % 3;
        b[i] = 1;
        if(edges.count(Located_complex::sorted(Edge{ f[i], f[j] })) > 0) {
          b[i] = m_random.get_double(0, 1);
          b[j] = 1 - b[i];
        } else if(contact.count(f[i]) == 0) continue;
        const BS::Triangle_image image = map({ t, b });
        m_tally.count("contact_image", image ? Verdict::PROVED : Verdict::UNDECIDED);
        if(image && !(off(point(f, b), point(facets[image.location.triangle], image.location.coordinates)) < tolerance))
          m_tally.wrong("contact_image", "a point of an excised triangle's border moved");
      }
    }
  }

  Tally& m_tally;
  CGAL::Random& m_random;
  double m_unit = 1;
  BS::Polygon_soup m_input;
  const Soup* m_soup = nullptr;
  const Certified_shell* m_shell = nullptr;
  Located_complex m_kept, m_excised;
  std::set<Edge> m_border; // directed border edges of the mesh
};

#endif // CHECK_EXCISIONS_H
