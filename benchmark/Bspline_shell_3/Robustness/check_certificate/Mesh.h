// The mesh, and its connected components.
#ifndef CHECK_CERTIFICATE_MESH_H
#define CHECK_CERTIFICATE_MESH_H

#include "Reader.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

class Disjoint_sets
{
public:
  explicit Disjoint_sets(std::size_t size) : parent(size) { std::iota(parent.begin(), parent.end(), std::size_t(0)); }
  std::size_t find(std::size_t i)
  {
    while(parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  void join(std::size_t i, std::size_t j) { parent[find(i)] = find(j); }

private:
  std::vector<std::size_t> parent;
};

struct Mesh
{
  explicit Mesh(const std::string& name)
  {
    const std::string text = read_file(name);
    Reader in(name, text, false);
    in.expect("OFF");
    const Integer points = in.integer(0, 1 << 30), facets = in.integer(1, 1 << 30);
    in.integer(0, (std::numeric_limits<Integer>::max)());
    for(Integer n = 0; n < points; ++n) point.push_back(in.point());
    for(Integer n = 0; n < facets; ++n) {
      if(in.integer(0, 1 << 30) != 3) in.fail("a facet is not a triangle");
      std::array<std::uint32_t, 3> f;
      for(std::uint32_t& v : f) v = std::uint32_t(in.integer(0, points - 1));
      facet.push_back(f);
    }
    in.end_file();

    std::string bytes;
    const auto append = [&](std::uint64_t number, int size) {
      while(size-- > 0) {
        bytes += char(number & 255);
        number >>= 8;
      }
    };
    for(const Point& p : point)
      for(double x : p) {
        std::uint64_t bits;
        std::memcpy(&bits, &x, sizeof x);
        append(bits, 8);
      }
    for(const auto& f : facet)
      for(std::uint32_t v : f) append(v, 4);
    checksum = hexadecimal(crc64(bytes.data(), bytes.size()));

    Disjoint_sets sets(point.size());
    for(const auto& f : facet) {
      sets.join(f[0], f[1]);
      sets.join(f[0], f[2]);
    }
    // Components are numbered by their first facets; vertices without facets have none.
    std::vector<std::size_t> number(point.size(), none);
    for(const auto& f : facet)
      if(number[sets.find(f[0])] == none) number[sets.find(f[0])] = components++;
    for(std::size_t v = 0; v < point.size(); ++v) component.push_back(number[sets.find(v)]);
  }
  std::array<Point, 3> triangle(std::size_t f) const
  {
    return { point[facet[f][0]], point[facet[f][1]], point[facet[f][2]] };
  }

  // Returns whether every edge has two facets that pass it in opposite directions.
  bool is_closed_and_oriented() const
  {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edge, opposite;
    for(const auto& f : facet)
      for(int i = 0; i < 3; ++i) {
        if(f[i] == f[(i + 1) % 3]) return false;
        edge.emplace_back(f[i], f[(i + 1) % 3]);
        opposite.emplace_back(f[(i + 1) % 3], f[i]);
      }
    std::sort(edge.begin(), edge.end());
    std::sort(opposite.begin(), opposite.end());
    return edge == opposite && std::adjacent_find(edge.begin(), edge.end()) == edge.end();
  }

  static constexpr std::size_t none = std::size_t(-1);
  std::vector<Point> point;
  std::vector<std::array<std::uint32_t, 3>> facet;
  std::vector<std::size_t> component; // one number per vertex
  std::size_t components = 0;
  std::string checksum;
};

#endif // CHECK_CERTIFICATE_MESH_H
