// A soup of triangles of which a part, a mesh, is replaced by another mesh. The other triangles are *excised*.
#ifndef CHECK_CERTIFICATE_EXCISION_H
#define CHECK_CERTIFICATE_EXCISION_H

#include "Mesh.h"
#include "Reader.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

class Excision
{
  typedef std::size_t Index;
  typedef std::array<Index, 3> Triple;
  typedef std::pair<Index, Index> Edge;

  // Triangles with their edges and vertices. Equal coordinates are one vertex.
  struct Complex
  {
    std::vector<Triple> triangles; // oriented, the least corner first
    std::map<Triple, Index> place; // by sorted corners
    std::set<Edge> edges;          // the lesser end first
    std::set<Index> vertices;

    // Returns the edges that no other triangle passes in the opposite direction.
    std::set<Edge> border() const
    {
      std::set<Edge> directed, result;
      for(const Triple& t : triangles)
        for(int i = 0; i < 3; ++i) directed.emplace(t[i], t[(i + 1) % 3]);
      for(const Edge& e : directed)
        if(directed.count(Edge(e.second, e.first)) == 0) result.insert(e);
      return result;
    }
  };

public:
  Excision(const Mesh& kept_mesh, const Mesh& soup, const Mesh& user_mesh, const Mesh& joined_soup)
  {
    kept = complex(kept_mesh, "KEPT");
    const Complex all = complex(soup, "SOUP");
    for(Index n = 0; n < kept.triangles.size(); ++n)
      if(all.place.count(sorted(kept.triangles[n])) == 0) fail("KEPT", n, "SOUP has no triangle with these corners");
    for(Index n = 0; n < all.triangles.size(); ++n)
      if(kept.place.count(sorted(all.triangles[n])) == 0) {
        add(all.triangles[n], n, excised);
        number_in_soup.push_back(n);
      }
    replacement = complex(user_mesh, "USER_MESH");
    // A triangle may be a facet of the user's mesh and excised at once, which is refused later.
    for(Index n = 0; n < joined_soup.facet.size(); ++n) joined.push_back(oriented(corners(joined_soup, n)));
  }

  // Checks that the meshes before and after the replacement have the same border, and the same vertices and edges, but
  // no triangles, in common with the excised triangles. Truncation moves the given tips, so that they must not be
  // corners of excised triangles.
  void check(const std::set<Point>& tips) const
  {
    check_joined();
    check_border();
    check_contact();
    for(const Point& p : tips) {
      const auto found = number.find(p);
      if(found != number.end() && excised.vertices.count(found->second) != 0)
        fail(text(found->second) + ": an excised triangle has this vertex, whose tip is truncated");
    }
  }

private:
  [[noreturn]] static void fail(const std::string& what) { throw Unconfirmed("E, " + what); }
  [[noreturn]] static void fail(const char* mesh, Index n, const std::string& what)
  {
    fail("triangle " + std::to_string(n) + " of " + mesh + ": " + what);
  }
  std::string text(Index vertex) const
  {
    char buffer[3 * 25 + 16];
    const Point& p = position[vertex];
    std::snprintf(buffer, sizeof buffer, "vertex (%.17g, %.17g, %.17g)", p[0], p[1], p[2]);
    return buffer;
  }
  std::string text(const Edge& e) const { return "edge from " + text(e.first) + " to " + text(e.second); }

  static Triple oriented(Triple t)
  {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  }
  static Triple sorted(Triple t)
  {
    std::sort(t.begin(), t.end());
    return t;
  }
  static std::array<Edge, 3> edges(const Triple& t)
  {
    return { std::minmax(t[0], t[1]), std::minmax(t[1], t[2]), std::minmax(t[2], t[0]) };
  }

  Triple corners(const Mesh& mesh, Index n)
  {
    Triple t;
    const std::array<Point, 3> points = mesh.triangle(n);
    for(int i = 0; i < 3; ++i) {
      const auto [place, is_new] = number.emplace(points[i], position.size());
      if(is_new) position.push_back(points[i]);
      t[i] = place->second;
    }
    return t;
  }

  static bool add(const Triple& t, Index n, Complex& to)
  {
    if(!to.place.emplace(sorted(t), n).second) return false;
    to.triangles.push_back(oriented(t));
    for(const Edge& e : edges(t)) to.edges.insert(e);
    to.vertices.insert(t.begin(), t.end());
    return true;
  }

  // No triangle may have two equal corners, and no two triangles the same three.
  Complex complex(const Mesh& mesh, const char* name)
  {
    Complex result;
    for(Index n = 0; n < mesh.facet.size(); ++n) {
      const Triple t = corners(mesh, n);
      if(t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) fail(name, n, "two corners have the same coordinates");
      if(!add(t, n, result))
        fail(name, n, "triangle " + std::to_string(result.place[sorted(t)]) + " has the same corners");
    }
    return result;
  }

  void check_joined() const
  {
    std::multiset<Triple> rest(joined.begin(), joined.end());
    const auto take = [&](const Triple& t) {
      const auto found = rest.find(t);
      if(found == rest.end()) return false;
      rest.erase(found);
      return true;
    };
    for(Index n = 0; n < replacement.triangles.size(); ++n)
      if(!take(replacement.triangles[n])) fail("USER_MESH", n, "JOINED lacks this facet");
    for(Index n = 0; n < excised.triangles.size(); ++n)
      if(!take(excised.triangles[n])) fail("SOUP", number_in_soup[n], "the triangle is excised, but JOINED lacks it");
    if(!rest.empty())
      fail("JOINED", Index(std::find(joined.begin(), joined.end(), *rest.begin()) - joined.begin()),
           "the triangle is neither a facet of USER_MESH nor excised, or JOINED has it twice");
  }

  void check_border() const
  {
    const std::set<Edge> before = kept.border(), after = replacement.border();
    for(const Edge& e : before)
      if(after.count(e) == 0) fail(text(e) + ": the edge is on the border of KEPT, but not of USER_MESH");
    for(const Edge& e : after)
      if(before.count(e) == 0) fail(text(e) + ": the edge is on the border of USER_MESH, but not of KEPT");
  }

  void check_contact() const
  {
    for(Index n = 0; n < excised.triangles.size(); ++n)
      if(replacement.place.count(sorted(excised.triangles[n])) != 0)
        fail("SOUP", number_in_soup[n], "the triangle is excised, but a facet of USER_MESH has the same corners");
    check_contact(kept.vertices, replacement.vertices, excised.vertices);
    check_contact(kept.edges, replacement.edges, excised.edges);
  }
  template <class Simplex>
  void check_contact(const std::set<Simplex>& before, const std::set<Simplex>& after,
                     const std::set<Simplex>& excised_ones) const
  {
    for(const Simplex& s : excised_ones) {
      if(before.count(s) != 0 && after.count(s) == 0)
        fail(text(s) + ": KEPT and an excised triangle have it in common, but USER_MESH lacks it");
      if(before.count(s) == 0 && after.count(s) != 0)
        fail(text(s) + ": USER_MESH and an excised triangle have it in common, but KEPT lacks it");
    }
  }

  std::map<Point, Index> number; // by position
  std::vector<Point> position;
  Complex kept, excised, replacement;
  std::vector<Index> number_in_soup; // positions of excised triangles
  std::vector<Triple> joined;        // the triangles after the replacement
};

#endif // CHECK_CERTIFICATE_EXCISION_H
