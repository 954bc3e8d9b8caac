// Small generated polygon soups.
#ifndef BROKEN_MODELS_H
#define BROKEN_MODELS_H

#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

// Polygons, their parts, and texture coordinates at their corners.
struct Broken_model
{
  CGAL::Bspline_shells::Polygon_soup soup;
  std::vector<std::size_t> part;
  std::vector<std::vector<std::array<double, 2> > > texture;
};

typedef std::array<double, 3> Center;

inline void add_polygon(Broken_model& model, std::size_t part, const std::vector<std::size_t>& points,
                        const std::vector<std::array<double, 2> >& texture)
{
  model.soup.polygons.push_back(points);
  model.part.push_back(part);
  model.texture.push_back(texture);
}

// Adds a ball with longitude and latitude as texture coordinates, which have a seam.
inline void add_ball(Broken_model& model, std::size_t part, const Center& c, double radius, int around = 32)
{
  const double pi = 3.14159265358979323846;
  const std::size_t first = model.soup.points.size(), n = std::size_t(around), rows = n / 2;
  for(std::size_t j = 0; j <= rows; ++j)
    for(std::size_t i = 0; i < n; ++i) {
      const double a = 2 * pi * double(i) / double(n), b = pi * double(j) / double(rows);
      if((j == 0 || j == rows) && i > 0) continue;
      model.soup.points.emplace_back(c[0] + radius * std::sin(b) * std::cos(a),
                                     c[1] + radius * std::sin(b) * std::sin(a), c[2] + radius * std::cos(b));
    }
  const auto point = [&](std::size_t i, std::size_t j) {
    return j == 0 ? first : j == rows ? first + 1 + (rows - 1) * n : first + 1 + (j - 1) * n + i % n;
  };
  const auto uv = [&](double i, double j) { return std::array<double, 2>{ i / double(n), j / double(rows) }; };
  for(std::size_t j = 0; j < rows; ++j)
    for(std::size_t i = 0; i < n; ++i) {
      const double x = double(i), y = double(j);
      if(j == 0)
        add_polygon(model, part, { point(i, 0), point(i, 1), point(i + 1, 1) },
                    { uv(x + 0.5, 0), uv(x, 1), uv(x + 1, 1) });
      else if(j + 1 == rows)
        add_polygon(model, part, { point(i, j), point(i, rows), point(i + 1, j) },
                    { uv(x, y), uv(x + 0.5, y + 1), uv(x + 1, y) });
      else
        add_polygon(model, part, { point(i, j), point(i, j + 1), point(i + 1, j + 1), point(i + 1, j) },
                    { uv(x, y), uv(x, y + 1), uv(x + 1, y + 1), uv(x + 1, y) });
    }
}

// Adds a box of six facets with separate points, each facet too small by `gap`. Every second facet faces inward.
inline void add_box_with_gaps(Broken_model& model, std::size_t part, const Center& low, const Center& high, double gap)
{
  for(int axis = 0; axis < 3; ++axis)
    for(int side = 0; side < 2; ++side) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const std::size_t first = model.soup.points.size();
      for(int k = 0; k < 4; ++k) {
        Center p;
        p[axis] = side == 0 ? low[axis] : high[axis];
        p[u] = k == 1 || k == 2 ? high[u] - gap : low[u] + gap;
        p[v] = k >= 2 ? high[v] - gap : low[v] + gap;
        model.soup.points.emplace_back(p[0], p[1], p[2]);
      }
      add_polygon(model, part, { first, first + 1, first + 2, first + 3 }, { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } });
    }
}

// Two intersecting balls, as in Figure 16 of the paper.
inline Broken_model two_balls()
{
  Broken_model model;
  add_ball(model, 0, { -0.6, 0, 0 }, 1);
  add_ball(model, 1, { 0.6, 0, 0 }, 1);
  return model;
}

// A figure of intersecting parts with texture seams, as in games.
inline Broken_model figure()
{
  Broken_model model;
  add_ball(model, 0, { 0, 0, 0 }, 1);
  add_ball(model, 1, { 0, 0, 1.25 }, 0.62);
  add_ball(model, 2, { 0.95, 0, 0.45 }, 0.38);
  add_ball(model, 2, { -0.95, 0, 0.45 }, 0.38);
  add_ball(model, 3, { 0.45, 0.15, -0.95 }, 0.45);
  add_ball(model, 3, { -0.45, 0.15, -0.95 }, 0.45);
  add_ball(model, 4, { 0, -0.6, 1.25 }, 0.16);
  return model;
}

// A ball with two stray triangles: one is attached to an edge of the ball, the other one to a vertex.
inline Broken_model ball_with_stray_triangles()
{
  Broken_model model;
  add_ball(model, 0, { 0, 0, 0 }, 1);
  const auto add_triangle = [&](std::vector<std::size_t> points, const std::vector<Center>& others) {
    for(const Center& p : others) {
      points.push_back(model.soup.points.size());
      model.soup.points.emplace_back(p[0], p[1], p[2]);
    }
    add_polygon(model, 1, points, { { 0, 0 }, { 1, 0 }, { 0, 1 } });
  };
  const std::size_t p = model.soup.polygons[240][0], q = model.soup.polygons[240][1], top = 0;
  const auto middle = CGAL::midpoint(model.soup.points[p], model.soup.points[q]);
  add_triangle({ p, q }, { { 1.3 * middle.x(), 1.3 * middle.y(), 1.3 * middle.z() } });
  add_triangle({ top }, { { 0.2, 0, 1.3 }, { -0.2, 0, 1.4 } });
  return model;
}

// A machine part as written by a file converter: with gaps, inconsistent orientations, and duplicate facets.
inline Broken_model machine_part()
{
  Broken_model model;
  add_box_with_gaps(model, 0, { 0, 0, 0 }, { 3, 2, 0.4 }, 0.004);
  add_box_with_gaps(model, 1, { 0, 0, 0.3 }, { 0.4, 2, 2 }, 0.004);
  add_ball(model, 2, { 1.7, 1, 0.4 }, 0.6);
  const std::size_t polygons = model.soup.polygons.size();
  for(std::size_t n = 0; n < polygons; n += 7) {
    std::vector<std::size_t> turned(model.soup.polygons[n].rbegin(), model.soup.polygons[n].rend());
    add_polygon(model, model.part[n], turned, { model.texture[n].rbegin(), model.texture[n].rend() });
  }
  return model;
}

#endif // BROKEN_MODELS_H
