#include "Corner_groups.h"

#include <algorithm>
#include <cmath>

namespace Tool {

namespace {

bool is_interpolated(const Attribute& a)
{
  return a.element != Element::POLYGON && (a.kind == Kind::REAL || a.kind == Kind::COLOR);
}

// Returns, for each component, the difference that rounding of interpolated values may cause.
std::vector<double> rounding_of(const Attribute& a)
{
  constexpr double relative = 1e-9;
  std::vector<double> largest(a.dimension(), 0);
  for(std::size_t n = 0; n < a.values.size(); ++n)
    if(!std::isnan(a.values[n]))
      largest[n % a.dimension()] = (std::max)(largest[n % a.dimension()], std::abs(a.values[n]));
  for(double& x : largest) x *= relative;
  return largest;
}

bool are_equal(const std::vector<double>& a, const std::vector<double>& b, const std::vector<double>& rounding)
{
  for(std::size_t i = 0; i < a.size(); ++i)
    if(std::isnan(a[i]) != std::isnan(b[i]) || std::abs(a[i] - b[i]) > rounding[i]) return false;
  return true;
}

bool is_seam(const std::vector<std::size_t>& group, const Mesh& mesh, Mesh::Edge_index e)
{
  const auto h = mesh.halfedge(e), g = mesh.opposite(h);
  return group[h] != group[mesh.prev(g)] || group[mesh.prev(h)] != group[g];
}

} // namespace

std::vector<std::size_t> corner_groups(const std::vector<const Attribute*>& attributes, const Mixer& mixer,
                                       const Mesh& mesh, const Mesh_origins& origins)
{
  std::vector<std::vector<double> > rounding;
  for(const Attribute* a : attributes) rounding.push_back(rounding_of(*a));
  std::vector<std::size_t> group(mesh.num_halfedges(), 0);
  for(auto v : mesh.vertices()) {
    std::vector<std::vector<std::vector<double> > > found; // by group and attribute
    for(auto h : mesh.halfedges_around_target(mesh.halfedge(v))) {
      if(mesh.is_border(h)) continue;
      std::vector<std::vector<double> > values;
      for(const Attribute* a : attributes) values.push_back(mixer(*a, origins.at(h)));
      const auto has_values = [&](const auto& other) {
        for(std::size_t i = 0; i < values.size(); ++i)
          if(!are_equal(values[i], other[i], rounding[i])) return false;
        return true;
      };
      const auto same = std::find_if(found.begin(), found.end(), has_values);
      group[h] = std::size_t(same - found.begin());
      if(same == found.end()) found.push_back(std::move(values));
    }
  }
  return group;
}

std::vector<const Attribute*> attributes_with_seams(const Model& model, const Mesh& mesh, const Mesh_origins& origins)
{
  const Mixer mixer(model);
  std::vector<const Attribute*> found;
  for(const Attribute& a : model.attributes) {
    if(!is_interpolated(a)) continue;
    const std::vector<std::size_t> group = corner_groups({ &a }, mixer, mesh, origins);
    if(std::any_of(group.begin(), group.end(), [](std::size_t g) { return g > 0; })) found.push_back(&a);
  }
  return found;
}

std::vector<char> find_lines(const Model& model, const Mesh& mesh, const Mesh_origins& origins)
{
  const Mixer mixer(model);
  std::vector<char> is_line(mesh.num_edges(), 0);
  const auto add = [&](const auto& is_on_line) {
    std::vector<char> found(mesh.num_edges(), 0);
    for(auto e : mesh.edges()) found[e] = !mesh.is_border(e) && is_on_line(e);
    if(2 * std::count(found.begin(), found.end(), 1) > std::ptrdiff_t(found.size())) return;
    for(std::size_t n = 0; n < found.size(); ++n) is_line[n] = is_line[n] || found[n];
  };
  for(const Attribute* a : attributes_with_seams(model, mesh, origins)) {
    const std::vector<std::size_t> group = corner_groups({ a }, mixer, mesh, origins);
    add([&](Mesh::Edge_index e) { return is_seam(group, mesh, e); });
  }
  for(const Attribute& a : model.attributes) {
    if(a.element != Element::POLYGON || (a.kind != Kind::LABEL && a.kind != Kind::COLOR)) continue;
    const std::vector<double> no_rounding(a.dimension(), 0);
    const auto value = [&](Mesh::Face_index f) {
      const double* const v = a[origins.polygon_of(f)];
      return std::vector<double>(v, v + a.dimension());
    };
    add([&](Mesh::Edge_index e) {
      return !are_equal(value(mesh.face(mesh.halfedge(e))), value(mesh.face(mesh.opposite(mesh.halfedge(e)))),
                        no_rounding);
    });
  }
  return is_line;
}

} // namespace Tool
