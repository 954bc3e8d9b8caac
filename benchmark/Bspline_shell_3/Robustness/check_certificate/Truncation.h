// The replacement of tips of the user's mesh U, and the map h from U to the mesh A of the certificate.
#ifndef CHECK_CERTIFICATE_TRUNCATION_H
#define CHECK_CERTIFICATE_TRUNCATION_H

#include "Mesh.h"
#include "Reader.h"
#include "interval.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

// A facet as the coordinates of its corners, in the least of the three cyclic orders. Facets with the same corners and
// orientation are equal.
typedef std::array<Point, 3> Located_facet;

inline Located_facet located(const Point& a, const Point& b, const Point& c)
{
  return (std::min)({ Located_facet{ a, b, c }, Located_facet{ b, c, a }, Located_facet{ c, a, b } });
}

inline std::vector<Located_facet> located_facets(const Mesh& mesh)
{
  std::vector<Located_facet> facets;
  for(std::size_t f = 0; f < mesh.facet.size(); ++f) {
    const std::array<Point, 3> t = mesh.triangle(f);
    facets.push_back(located(t[0], t[1], t[2]));
  }
  std::sort(facets.begin(), facets.end());
  return facets;
}

// Returns the difference of two sorted ranges, as multisets.
inline std::vector<Located_facet> without(const std::vector<Located_facet>& facets,
                                          const std::vector<Located_facet>& removed)
{
  std::vector<Located_facet> rest;
  std::set_difference(facets.begin(), facets.end(), removed.begin(), removed.end(), std::back_inserter(rest));
  return rest;
}

// Facets of U at some vertices, the centers, are cut. Each center has a disc, whose rim consists of the cuts around the
// center. The disc is made of triangles between these and further points. The cores are the remaining parts of the cut
// facets, beyond the rims. On cores, h is affine in barycentric coordinates. A tip consists of the triangles between a
// center and its rim. Tip and disc have the same image in the plane, with the center at the origin; h maps one to the
// other through the plane. At all other points, h is the identity.
class Truncation
{
  typedef std::size_t Index;
  typedef std::array<Index, 3> Triple;
  typedef std::pair<Index, Index> Edge;
  typedef std::array<Rational, 3> Barycentric;
  typedef std::array<double, 2> Planar_point;

  struct Cut
  {
    Index center, first, second; // `second` is `none` on an edge
    double s, t;                 // shares of the way from the center to `first` and `second`
  };
  struct Core
  {
    Triple triangle;
    Index facet;
  };
  struct Disc
  {
    Index center;
    std::vector<Index> rim, facet; // the edges of the rim, and the cut facets that contain them
    std::vector<Triple> triangle;
    Index next(std::size_t i) const { return rim[(i + 1) % rim.size()]; }
  };
  static constexpr Index none = 4294967295u;

public:
  explicit Truncation(Reader& in)
  {
    const Integer most = 1 << 30;
    const Integer all_corners = in.integer(0, most), cuts = in.integer(0, most), inner = in.integer(0, most),
                  facets = in.integer(0, most), cores = in.integer(0, most), discs = in.integer(0, most),
                  points = all_corners + cuts + inner;
    in.end_line();
    corners = Index(all_corners);
    const auto index = [&](Integer size) { return Index(in.integer(0, size - 1)); };
    const auto triple = [&](Integer size) {
      Triple t;
      for(Index& p : t) p = index(size);
      return t;
    };
    for(Integer n = 0; n < points; ++n) {
      point.push_back(in.point());
      in.end_line();
    }
    for(Integer n = 0; n < cuts + inner; ++n) {
      planar.emplace_back();
      for(double& x : planar.back()) x = in.number();
      in.end_line();
    }
    for(Integer n = 0; n < cuts; ++n) {
      Cut c;
      c.center = index(all_corners);
      c.first = index(all_corners);
      c.second = Index(in.integer(0, Integer(none)));
      if(c.second >= corners && c.second != none) in.fail("an integer is out of range");
      c.s = in.number();
      c.t = in.number();
      cut.push_back(c);
      in.end_line();
    }
    for(Integer n = 0; n < facets; ++n) {
      cut_facet.push_back(triple(all_corners));
      in.end_line();
    }
    for(Integer n = 0; n < cores; ++n) {
      Core c;
      c.triangle = triple(points);
      c.facet = index(facets);
      core.push_back(c);
      in.end_line();
    }
    for(Integer n = 0; n < discs; ++n) {
      Disc d;
      d.center = index(all_corners);
      centers.insert(d.center);
      const Integer rim = in.integer(0, most), triangles = in.integer(0, most);
      in.end_line();
      for(Integer i = 0; i < rim; ++i) {
        d.rim.push_back(index(points));
        d.facet.push_back(index(facets));
        in.end_line();
      }
      for(Integer i = 0; i < triangles; ++i) {
        d.triangle.push_back(triple(points));
        in.end_line();
      }
      disc.push_back(std::move(d));
    }
  }

  // Returns whether nothing is replaced.
  bool is_empty() const { return point.empty() && cut_facet.empty() && core.empty() && disc.empty(); }

  // Returns the positions of all centers.
  std::set<Point> center_positions() const
  {
    std::set<Point> positions;
    for(Index p : centers) positions.insert(point[p]);
    return positions;
  }

  // Checks that h is a homeomorphism from the cut facets to the cores and discs, and does not move adjacent facets.
  void check() const
  {
    check_cuts();
    check_discs();
    check_points();
    check_cores();
    check_cut_facets();
    std::vector<std::vector<Triple>> parts(cut_facet.size());
    for(const Core& c : core) parts[c.facet].push_back(c.triangle);
    for(const Disc& d : disc)
      for(std::size_t i = 0; i < d.rim.size(); ++i) parts[d.facet[i]].push_back({ d.center, d.rim[i], d.next(i) });
    std::set<Edge> sides;
    for(Index f = 0; f < cut_facet.size(); ++f) check_parts(f, parts[f], sides);
    for(const Edge& e : sides)
      if((is_cut(e.first) || is_cut(e.second)) && sides.count(Edge(e.second, e.first)) == 0)
        throw Unconfirmed("T: no other facet is cut along the edge between points " + text(e));
    for(Index d = 0; d < disc.size(); ++d) {
      check_tip(d);
      check_disc(d);
    }
  }

  // A patch consists of discs with common cut facets, and these facets. A mesh contains all of a patch, or nothing of
  // it. Facets are sorted.
  struct Patch
  {
    std::vector<Located_facet> cut_facets, new_facets;
    std::set<Point> changed; // points that h removes or creates
  };
  std::vector<Patch> patches() const
  {
    std::vector<Index> first(cut_facet.size());
    for(Index f = 0; f < first.size(); ++f) first[f] = f;
    const auto find = [&](Index f) {
      while(first[f] != f) f = first[f] = first[first[f]];
      return f;
    };
    for(const Disc& d : disc)
      for(Index f : d.facet) first[find(f)] = find(d.facet[0]);
    std::map<Index, Patch> of;
    const auto place = [&](const Triple& t) { return located(point[t[0]], point[t[1]], point[t[2]]); };
    for(Index f = 0; f < cut_facet.size(); ++f) of[find(f)].cut_facets.push_back(place(cut_facet[f]));
    for(const Core& c : core) of[find(c.facet)].new_facets.push_back(place(c.triangle));
    for(const Disc& d : disc) {
      Patch& patch = of[find(d.facet[0])];
      patch.changed.insert(point[d.center]);
      for(Index p : d.rim) patch.changed.insert(point[p]);
      for(const Triple& t : d.triangle) {
        patch.new_facets.push_back(place(t));
        for(Index p : t) patch.changed.insert(point[p]);
      }
    }
    std::vector<Patch> all;
    for(auto& patch : of) {
      std::sort(patch.second.cut_facets.begin(), patch.second.cut_facets.end());
      std::sort(patch.second.new_facets.begin(), patch.second.new_facets.end());
      all.push_back(std::move(patch.second));
    }
    return all;
  }

  // Returns the patches that a mesh contains. The mesh must be the result of these patches for some U, with h as the
  // identity at all other points. Other facets must not meet the points that h changes, which are identified by their
  // coordinates.
  std::vector<Patch> patches_of(const Mesh& mesh) const
  {
    std::map<Point, Index> vertex;
    for(const auto& f : mesh.facet)
      for(Index v : f)
        if(vertex.emplace(mesh.point[v], v).first->second != v)
          throw Unconfirmed("T: two vertices of the mesh have the same coordinates");
    std::vector<Located_facet> facets = located_facets(mesh);
    std::vector<Patch> result;
    std::set<Point> changed;
    for(Patch& patch : patches()) {
      if(!std::includes(facets.begin(), facets.end(), patch.new_facets.begin(), patch.new_facets.end())) continue;
      changed.insert(patch.changed.begin(), patch.changed.end());
      facets = without(facets, patch.new_facets);
      result.push_back(std::move(patch));
    }
    for(const Located_facet& f : facets)
      for(const Point& p : f)
        if(changed.count(p) != 0)
          throw Unconfirmed("T: a facet outside the truncation has a corner that the truncation removes or creates");
    return result;
  }

private:
  bool is_cut(Index p) const { return p >= corners && p < corners + cut.size(); }
  bool is_center(Index p) const { return centers.count(p) != 0; }
  static std::string name(const char* what, Index n)
  {
    return std::string("T, ") + what + " " + std::to_string(n) + ": ";
  }
  static std::string text(const Edge& e) { return std::to_string(e.first) + " and " + std::to_string(e.second); }

  void check_cuts() const
  {
    for(Index n = 0; n < cut.size(); ++n) {
      const Cut& c = cut[n];
      if(!(c.s > 0 && c.t >= 0 && Rational(c.s) + Rational(c.t) < 1))
        throw Unconfirmed(name("cut", n) + "the cut is not between its corners");
      if((c.second == none) != (c.t == 0))
        throw Unconfirmed(name("cut", n)
                          + "T is zero although there is a second corner, or not zero although there is none");
    }
  }

  // Checks the points of the discs.
  void check_discs() const
  {
    std::set<Index> seen;
    std::vector<Index> disc_of(planar.size(), none);
    for(Index n = 0; n < disc.size(); ++n) {
      const Disc& d = disc[n];
      const std::string name = Truncation::name("disc", n);
      if(!seen.insert(d.center).second) throw Unconfirmed(name + "another disc has the same center");
      if(d.rim.size() < 3) throw Unconfirmed(name + "the rim has fewer than three points");
      for(Index p : d.rim) {
        if(!is_cut(p) || cut[p - corners].center != d.center)
          throw Unconfirmed(name + "point " + std::to_string(p) + " of the rim is not a cut around the center");
        if(disc_of[p - corners] != none)
          throw Unconfirmed(name + "point " + std::to_string(p) + " of the rim is in an earlier rim");
        disc_of[p - corners] = n;
      }
      for(const Triple& t : d.triangle)
        for(Index p : t) {
          if(p >= corners && !is_cut(p) && disc_of[p - corners] == none) disc_of[p - corners] = n;
          if(p < corners || disc_of[p - corners] != n)
            throw Unconfirmed(name + "point " + std::to_string(p) + " of a triangle is not a point of the disc");
        }
    }
    for(Index i = 0; i < planar.size(); ++i)
      if(disc_of[i] == none) throw Unconfirmed("T: point " + std::to_string(corners + i) + " is not in a disc");
  }

  // Common points of facets are identified by their coordinates. So no two vertices of U may have the same coordinates,
  // and no two of A.
  void check_points() const
  {
    std::map<Point, Index> before, after;
    for(Index p = 0; p < point.size(); ++p)
      if((p < corners && !before.emplace(point[p], p).second)
         || (!(p < corners && is_center(p)) && !after.emplace(point[p], p).second))
        throw Unconfirmed("T: point " + std::to_string(p) + " has the coordinates of another point");
  }

  void check_cores() const
  {
    for(Index n = 0; n < core.size(); ++n)
      for(Index p : core[n].triangle) {
        if(p >= corners && !is_cut(p)) throw Unconfirmed(name("core", n) + "a corner is in the interior of a disc");
        if(p < corners && is_center(p)) throw Unconfirmed(name("core", n) + "a corner is cut off");
      }
  }

  // Checks that U is a surface where it is cut: edges have one facet on each side. The remaining parts are checked in
  // A.
  void check_cut_facets() const
  {
    std::set<Edge> edges;
    for(Index f = 0; f < cut_facet.size(); ++f)
      for(int i = 0; i < 3; ++i) {
        const Edge e(cut_facet[f][i], cut_facet[f][(i + 1) % 3]);
        if(e.first == e.second) throw Unconfirmed(name("facet", f) + "the facet is degenerate");
        if(!edges.insert(e).second)
          throw Unconfirmed(name("facet", f) + "another facet is on the same side of an edge");
      }
  }

  // Returns the barycentric coordinates of a corner or a cut in a facet.
  Barycentric place(Index facet, Index p) const
  {
    const Triple& t = cut_facet[facet];
    const auto corner = [&](Index q) {
      const std::size_t i = std::size_t(std::find(t.begin(), t.end(), q) - t.begin());
      if(i == 3)
        throw Unconfirmed(name("facet", facet) + "point " + std::to_string(p) + " of a part is not in the facet");
      return i;
    };
    Barycentric b = { 0, 0, 0 };
    if(p < corners) {
      b[corner(p)] = 1;
      return b;
    }
    const Cut& c = cut[p - corners];
    const std::size_t center = corner(c.center), first = corner(c.first);
    const bool in_order = c.second == none ? first != center
                                           : first == (center + 1) % 3 && corner(c.second) == (center + 2) % 3;
    if(!in_order)
      throw Unconfirmed(name("facet", facet) + "the corners of point " + std::to_string(p) + " are in the wrong order");
    b[center] = 1 - (Rational(c.s) + Rational(c.t));
    b[first] = c.s;
    if(c.second != none) b[corner(c.second)] = c.t;
    return b;
  }

  template <class P>
  static int orientation(const P& a, const P& b, const P& c, int first)
  {
    const auto x = [&](const P& p) { return Rational(Rational(p[first]) - Rational(a[first])); };
    const auto y = [&](const P& p) { return Rational(Rational(p[first + 1]) - Rational(a[first + 1])); };
    return Rational(x(b) * y(c) - y(b) * x(c)).sign();
  }

  // Returns the edges of triangles that no other triangle passes in the opposite direction.
  static std::set<Edge> border(const std::vector<Triple>& triangles, const std::string& name)
  {
    std::set<Edge> edges, border;
    for(const Triple& t : triangles)
      for(int i = 0; i < 3; ++i)
        if(!edges.emplace(t[i], t[(i + 1) % 3]).second)
          throw Unconfirmed(name + "two triangles are on the same side of an edge");
    for(const Edge& e : edges)
      if(edges.count(Edge(e.second, e.first)) == 0) border.insert(e);
    return border;
  }

  // Checks that the parts of a facet, tips and cores, cover it once. Parts are oriented like the facet, and their
  // border goes around the facet once. So its winding number proves the claim.
  void check_parts(Index f, const std::vector<Triple>& parts, std::set<Edge>& sides) const
  {
    const std::string name = Truncation::name("facet", f);
    const Triple& t = cut_facet[f];
    std::map<Index, Barycentric> at;
    for(const Triple& p : parts) {
      for(Index q : p)
        if(at.count(q) == 0) at.emplace(q, place(f, q));
      if(!(orientation(at[p[0]], at[p[1]], at[p[2]], 1) > 0))
        throw Unconfirmed(name + "a part is reversed or degenerate");
    }
    const std::set<Edge> edges = border(parts, name);
    std::size_t steps = 0;
    Index p = t[0];
    for(int side = 0; side < 3; ++side) {
      const int last = (side + 1) % 3, off = (side + 2) % 3;
      while(p != t[last]) {
        // There must be exactly one edge of the border that begins here.
        const auto e = edges.lower_bound(Edge(p, 0));
        if(e == edges.end() || e->first != p || (std::next(e) != edges.end() && std::next(e)->first == p))
          throw Unconfirmed(name + "the parts do not end at the sides");
        const Index q = e->second;
        if(at[p][off] != 0 || at[q][off] != 0 || !(at[p][last] < at[q][last]))
          throw Unconfirmed(name + "the parts do not end at the sides");
        p = q;
        ++steps;
      }
    }
    if(steps != edges.size()) throw Unconfirmed(name + "the parts leave gaps");
    sides.insert(edges.begin(), edges.end());
  }

  // Checks that the triangles between the origin and the rim fill a polygon once. The polygon is star-shaped: each
  // angle is less than half a turn, and only one edge crosses the positive x-axis.
  void check_tip(Index n) const
  {
    const Disc& d = disc[n];
    int turns = 0;
    for(std::size_t i = 0; i < d.rim.size(); ++i) {
      const Planar_point &p = planar[d.rim[i] - corners], &q = planar[d.next(i) - corners];
      if(!(orientation(Planar_point{ 0, 0 }, p, q, 0) > 0))
        throw Unconfirmed(name("disc", n) + "in the plane, the rim does not turn around the center");
      turns += p[1] < 0 && q[1] >= 0 ? 1 : 0;
    }
    if(turns != 1)
      throw Unconfirmed(name("disc", n) + "in the plane, the rim winds around the center " + std::to_string(turns)
                        + " times");
  }

  // Checks that the triangles of the disc fill the same polygon once, by the same argument as for parts of facets.
  void check_disc(Index n) const
  {
    const Disc& d = disc[n];
    for(const Triple& t : d.triangle)
      if(!(orientation(planar[t[0] - corners], planar[t[1] - corners], planar[t[2] - corners], 0) > 0))
        throw Unconfirmed(name("disc", n) + "in the plane, a triangle is reversed or degenerate");
    std::set<Edge> rim;
    for(std::size_t i = 0; i < d.rim.size(); ++i) rim.emplace(d.rim[i], d.next(i));
    if(border(d.triangle, name("disc", n)) != rim)
      throw Unconfirmed(name("disc", n) + "the triangles do not end at the rim");
  }

  Index corners = 0;                // the number of vertices of U
  std::vector<Point> point;         // corners of cut facets, cuts, points within discs
  std::vector<Planar_point> planar; // all points except corners
  std::vector<Cut> cut;
  std::vector<Triple> cut_facet;
  std::vector<Core> core;
  std::vector<Disc> disc;
  std::set<Index> centers;
};

#endif // CHECK_CERTIFICATE_TRUNCATION_H
