// The claims, and their witnesses.
#ifndef CHECK_CERTIFICATE_CERTIFICATE_H
#define CHECK_CERTIFICATE_CERTIFICATE_H

#include "Mesh.h"
#include "Reader.h"
#include "Shell.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

struct Box
{
  std::size_t leaf;
  int depth;
  Position place; // the least corner relative to the leaf's, in edges of the box
  char kind;
  Point proof; // the direction, or the center relative to the least corner, in edges of the box

  Extent extent(const Shell& shell) const
  {
    const Leaf& l = shell.leaf[leaf];
    const Integer edge = l.edge() >> depth;
    Extent e;
    for(int axis = 0; axis < 3; ++axis) {
      e.low[axis] = l.position[axis] * l.edge() + place[axis] * edge;
      e.high[axis] = e.low[axis] + edge;
    }
    return e;
  }
  bool is_cover() const { return kind == 'g' || kind == 'b' || kind == 'a' || kind == 'u'; }
};

struct Path
{
  std::size_t component, facet;
  Point p, q;
};

struct Certificate
{
  Certificate(const std::string& name, const Shell& shell, const Mesh& mesh)
  {
    const std::string text = read_file(name);
    Reader in(name, text, true);
    in.expect("cubic_bspline_shell_certificate").expect("3").end_line();
    if(in.expect("shell").word() != shell.checksum) in.fail("the certificate is for another shell");
    in.end_line();
    const Integer vertices = in.expect("mesh").integer(0, 1 << 30), facets = in.integer(0, 1 << 30);
    if(std::size_t(vertices) != mesh.point.size() || std::size_t(facets) != mesh.facet.size()
       || in.word() != mesh.checksum)
      in.fail("the certificate is for another mesh");
    in.end_line();
    in.expect("verdicts");
    for(bool& claim : claimed) {
      const std::string verdict = in.word();
      claim = verdict == "proved";
      if(!claim && verdict != "refuted" && verdict != "undecided")
        in.fail("unknown verdict: expected \"proved\", \"refuted\" or \"undecided\"");
    }
    in.end_line();
    const Integer boxes = in.expect("boxes").integer(0, 1 << 30);
    in.end_line();
    for(Integer n = 0; n < boxes; ++n) {
      Box b;
      b.leaf = std::size_t(in.integer(box.empty() ? 0 : Integer(box.back().leaf), Integer(shell.leaf.size()) - 1));
      b.depth = int(in.integer(0, largest_depth));
      for(Integer& i : b.place) i = in.integer(0, (Integer(1) << b.depth) - 1);
      const std::string kind = in.word();
      if(kind.size() != 1 || !std::strchr("xgbauo", kind[0]))
        in.fail("unknown kind of box: expected x, g, b, a, u or o");
      b.kind = kind[0];
      b.proof = std::strchr("gba", b.kind) ? in.point() : Point{ 0, 0, 0 };
      box.push_back(b);
      in.end_line();
    }
    if(std::size_t(in.expect("seeds").integer(0, 1 << 30)) != mesh.components)
      in.fail("expected one seed for each component of the mesh");
    in.end_line();
    for(Integer n = 0; n < Integer(mesh.components); ++n) {
      in.integer(n, n);
      seed.push_back(std::size_t(in.integer(0, vertices - 1)));
      if(mesh.component[seed.back()] != std::size_t(n)) in.fail("a seed is not a vertex of its component");
      in.end_line();
    }
    covers = std::size_t(in.expect("covers").integer(0, 1 << 30));
    in.end_line();
    const Integer paths = in.expect("paths").integer(0, Integer(mesh.components));
    in.end_line();
    for(Integer n = 0; n < paths; ++n) {
      Path p;
      p.component = std::size_t(
        in.integer(path.empty() ? 0 : Integer(path.back().component) + 1, Integer(mesh.components) - 1));
      p.facet = std::size_t(in.integer(0, facets - 1));
      p.p = in.point();
      p.q = in.point();
      path.push_back(p);
      in.end_line();
    }
    in.end_file();
  }

  std::array<bool, 5> claimed;
  std::vector<Box> box;
  std::vector<std::size_t> seed; // a vertex of each component
  std::size_t covers = 0;
  std::vector<Path> path;
};

#endif // CHECK_CERTIFICATE_CERTIFICATE_H
