#include "Input.h"
#include "Json.h"
#include "distance_bound.h"
#include "number.h"
#include "commands.h"

#include "../Carry/Mesh_origins.h"
#include "../Carry/Triangulated_model.h"
#include "../Files/read_model.h"

#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Local_gap_3.h>
#include <CGAL/Bspline_shell_3/Soup/choose_excision.h>
#include <CGAL/Bspline_shell_3/Soup/repair_soup.h>
#include <CGAL/Bspline_shell_3/Soup/unite_parts.h>
#include <CGAL/Bspline_shell_3/Soup/weld_soup.h>

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/for_each.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <iostream>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace Tool {

namespace {

const char* name(Element element)
{
  switch(element) {
    case Element::POINT: return "points";
    case Element::POLYGON: return "polygons";
    case Element::CORNER: return "corners";
  }
  return "";
}

// Returns an attribute with its components, or with its labels if these have texts.
std::string describe(const Attribute& a)
{
  constexpr std::size_t most = 8;
  std::vector<std::string> items;
  for(const std::string& label : a.names)
    if(!label.empty()) items.push_back("\"" + label + "\"");
  if(items.empty() && a.dimension() > 1) items = a.components;
  std::string text = a.name + " (" + name(a.element);
  for(std::size_t n = 0; n < (std::min)(items.size(), most); ++n) text += (n == 0 ? ": " : ", ") + items[n];
  if(items.size() > most) text += ", and " + std::to_string(items.size() - most) + " more";
  return text + ")";
}

// Returns the first part of a message of the library, which ends with an advice after a colon.
std::string without_advice(const std::string& message)
{
  return message.substr(0, message.find(':'));
}

// The thickness of walls and the width of gaps of a closed mesh, which are searched up to a limit.
struct Gaps
{
  double limit = 0; // 0 if they are not known
  double thinnest_wall = 0, narrowest_gap = 0;
  double narrow_area = 0; // share of the area where a wall or a gap is narrower than the shell

  // Returns an infinite width if there is none below the limit.
  double if_found(double width) const { return width < limit ? width : std::numeric_limits<double>::infinity(); }
};

Gaps measure_gaps(const BS::Input_mesh_3& input, double thickness)
{
  constexpr double limit = 4; // relative to the thickness; wider places do not affect the shell
  Gaps gaps;
  gaps.limit = gaps.thinnest_wall = gaps.narrowest_gap = limit * thickness;
  const BS::Local_gap_3 gap(input);
  std::vector<std::pair<double, double> > of_facets(input.mesh().number_of_faces()); // wall and gap
  std::vector<Mesh::size_type> facets(of_facets.size());
  std::iota(facets.begin(), facets.end(), 0);
  CGAL::for_each<CGAL::Parallel_if_available_tag>(facets, [&](Mesh::size_type& n) {
    const BS::Input_mesh_3::Face_index f(n);
    of_facets[n] = { gap(f, CGAL::NEGATIVE, gaps.limit), gap(f, CGAL::POSITIVE, gaps.limit) };
    return true;
  });
  double area = 0, narrow = 0;
  for(Mesh::size_type n : facets) {
    const auto [wall, space] = of_facets[n];
    gaps.thinnest_wall = (std::min)(gaps.thinnest_wall, wall);
    gaps.narrowest_gap = (std::min)(gaps.narrowest_gap, space);
    const double of_facet = CGAL::Polygon_mesh_processing::face_area(BS::Input_mesh_3::Face_index(n), input.mesh());
    area += of_facet;
    if((std::min)(wall, space) < thickness) narrow += of_facet;
  }
  gaps.narrow_area = area > 0 ? narrow / area : 0;
  return gaps;
}

// Numbers of edges at which polygons do not form a closed surface.
struct Defective_edges
{
  std::size_t with_one_polygon = 0, with_several_polygons = 0; // several: more than two
};

Defective_edges count_defective_edges(const BS::Polygon_soup& soup)
{
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> number;
  for(const auto& polygon : soup.polygons)
    for(std::size_t i = 0; i < polygon.size(); ++i)
      ++number[std::minmax({ polygon[i], polygon[(i + 1) % polygon.size()] })];
  Defective_edges edges;
  for(const auto& edge : number) {
    edges.with_one_polygon += edge.second == 1;
    edges.with_several_polygons += edge.second > 2;
  }
  return edges;
}

struct Findings
{
  BS::Shell_status status = BS::Shell_status::NOT_BUILT; // status of the polygons as a mesh
  BS::Offending_simplices offenders;                     // polygons and points, or facets of the repaired mesh
  BS::Soup_repairs repairs;
  BS::Weld_report weld;
  std::size_t components = 0, border_edges = 0, intersecting = 0; // numbers for a mesh
  Defective_edges edges;                                          // numbers for polygons that are not a mesh
  double excised_share = 0;
  Gaps gaps;
  std::string kind; // kind of the shell that can be expected
};

Findings examine(const Model& model, const Shell_options& options, double thickness)
{
  Findings found;
  Mesh mesh;
  BS::Weld_parameters welding;
  welding.thickness = thickness;
  if(options.weld) welding.tolerance = options.weld->in_box(longest_side(model));
  found.status = BS::repair_soup(model.soup, mesh, found.repairs, found.offenders);
  switch(found.status) {
    case BS::Shell_status::EMPTY_MESH:
    case BS::Shell_status::NOT_FINITE:
    case BS::Shell_status::COORDINATES_OUT_OF_RANGE:
    case BS::Shell_status::INVALID_PARAMETER: return found;
    default: break;
  }
  const BS::Welded_soup welded = BS::weld_soup(model.soup, welding);
  found.weld = welded.report;
  if(!found.weld.is_none()) found.status = BS::repair_soup(welded.soup, mesh, found.repairs, found.offenders);
  bool has_defects = found.status != BS::Shell_status::SUCCESS;
  if(!has_defects) {
    auto component = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:component").first;
    found.components = CGAL::Polygon_mesh_processing::connected_components(mesh, component);
    for(auto e : mesh.edges()) found.border_edges += mesh.is_border(e);
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index> > pairs;
    CGAL::Polygon_mesh_processing::self_intersections<CGAL::Parallel_if_available_tag>(mesh, std::back_inserter(pairs));
    std::set<std::size_t> facets;
    for(const auto& pair : pairs) facets.insert({ pair.first, pair.second });
    found.intersecting = facets.size();
    if(!facets.empty()) {
      found.status = BS::Shell_status::SELF_INTERSECTION;
      found.offenders.facets.assign(facets.begin(), facets.end());
    }
    has_defects = !facets.empty();
    BS::United_mesh united;
    if(has_defects && found.border_edges == 0 && BS::unite_parts<CGAL::Parallel_if_available_tag>(mesh, united)) {
      found.kind = "united";
      return found;
    }
    BS::Input_mesh_3::Tolerated_defects tolerated;
    tolerated.singular_vertices = tolerated.orientation = true;
    BS::Input_mesh_3 input;
    if(!has_defects && found.border_edges == 0
       && input.build<CGAL::Parallel_if_available_tag>(mesh, mesh.points(), tolerated) == BS::Shell_status::SUCCESS)
      found.gaps = measure_gaps(input, thickness);
  }
  if(has_defects) {
    if(found.components == 0) found.edges = count_defective_edges(welded.soup);
    const BS::Excised_soup_3 excised = BS::choose_excision(BS::different_triangles(welded.soup));
    found.excised_share = excised ? excised.report().excised_area : 1;
    found.kind = 100 * found.excised_share <= options.excised_percentage ? "excised" : "proxy";
  } else found.kind = found.border_edges > 0 ? "virtually closed" : "closed";
  return found;
}

// Here, `SUCCESS` means that the polygons form a mesh.
const char* mesh_message(BS::Shell_status status)
{
  return status == BS::Shell_status::SUCCESS ? "The polygons form a mesh." : message(status);
}

// Returns the place of the shell, as the end of a sentence.
std::string message_of_kind(const std::string& kind)
{
  const std::string otherwise = " If this shell is not certified, a closed proxy is wrapped around the polygons.";
  if(kind == "closed") return "around the whole mesh.";
  if(kind == "virtually closed") return "around the whole open mesh; its borders are kept." + otherwise;
  if(kind == "united") return "around the union of the parts that intersect.";
  if(kind == "excised") return "around the mesh without its defects, which stay as they are." + otherwise;
  return "around a closed proxy that wraps the polygons, because there are too many defects. A larger --excise may "
         "avoid the proxy.";
}

void print(const Findings& found, double thickness)
{
  const auto line = [](std::size_t number, const char* what) {
    if(number > 0) std::cout << "repaired    " << number << " " << what << "\n";
  };
  line(found.repairs.merged_points, "coincident points merged");
  line(found.repairs.removed_polygons, "polygons with fewer than three distinct points removed");
  line(found.repairs.split_polygons, "polygons with repeated points split");
  line(found.repairs.duplicate_polygons, "duplicate polygons removed");
  line(found.repairs.reversed_polygons, "polygons reversed");
  line(found.repairs.degenerate_facets, "degenerate facets removed");
  const std::string welding = message(found.weld);
  if(!welding.empty()) std::cout << "welding     " << with_options(welding) << "\n";
  if(found.components > 0)
    std::cout << "mesh        " << found.components << (found.components == 1 ? " component, " : " components, ")
              << found.border_edges << " border edges, " << found.intersecting << " intersecting facets\n";
  else
    std::cout << "mesh        none. " << without_advice(mesh_message(found.status)) << ".\n"
              << "edges       " << found.edges.with_one_polygon << " with one polygon, "
              << found.edges.with_several_polygons << " with more than two\n";
  if(found.gaps.limit > 0) {
    const auto width = [&](const char* what, double x) {
      std::cout << what << (x < found.gaps.limit ? "narrowest " : "none narrower than ") << x << "\n";
    };
    width("walls       ", found.gaps.thinnest_wall);
    width("gaps        ", found.gaps.narrowest_gap);
    std::cout << "            narrower than the shell (" << thickness << ") on " << 100 * found.gaps.narrow_area
              << " % of the area\n";
  }
  if(found.excised_share > 0) std::cout << "defects     on " << percent(found.excised_share) << " of the area\n";
  std::cout << "shell       " << found.kind << ": " << message_of_kind(found.kind) << std::endl;
}

} // namespace

Outcome check(const Check_options& options, bool writes_json)
{
  Model model, other;
  if(const Outcome read = read_input(options.input, model); !read) return read;
  if(!options.other.empty())
    if(const Outcome read = read_input(options.other, other); !read) return read;
  const double unit = longest_side(model), thickness = thickness_of(options, unit);
  const std::string format = model.format + (model.encoding.empty() ? "" : ", ") + model.encoding;
  const std::size_t corners = model.first_corners().back();
  const Findings found = examine(model, options, thickness);
  if(found.kind.empty()) return { WRONG_INPUT, options.input, with_options(message(found.status)), found.offenders };
  std::vector<std::string> attributes;
  for(const Attribute& a : model.attributes) attributes.push_back(describe(a));
  Distance_bounds distances;
  if(!options.other.empty()) {
    constexpr double resolution = 1e-5; // relative to the longest side of the bounding box
    const Triangulated_model first(model), second(other);
    for(const auto& side : { std::make_pair(&options.input, &first), std::make_pair(&options.other, &second) })
      if(side.second->mesh().number_of_faces() == 0) return { WRONG_INPUT, *side.first, "No polygon has an area." };
    distances = distance_bounds(first.mesh(), second.mesh(), resolution * unit,
                                std::numeric_limits<double>::infinity());
  }
  if(writes_json) {
    Json json;
    json.add("input", options.input)
      .add("format", format)
      .add("points", model.soup.points.size())
      .add("polygons", model.soup.polygons.size())
      .add("corners", corners)
      .add("longest_side", unit)
      .add("attributes", attributes)
      .add("mesh_status", with_options(mesh_message(found.status)))
      .add("facets", found.offenders.facets)
      .add("vertices", found.offenders.vertices)
      .add("components", found.components)
      .add("border_edges", found.border_edges)
      .add("intersecting_facets", found.intersecting)
      .add("edges_with_one_polygon", found.edges.with_one_polygon)
      .add("edges_with_several_polygons", found.edges.with_several_polygons)
      .add("excised_share", found.excised_share)
      .add("kind", found.kind);
    if(found.gaps.limit > 0)
      json.add("search_limit", found.gaps.limit)
        .add("thinnest_wall", found.gaps.if_found(found.gaps.thinnest_wall))
        .add("narrowest_gap", found.gaps.if_found(found.gaps.narrowest_gap))
        .add("narrow_area", found.gaps.narrow_area);
    if(!options.other.empty())
      json.add("distance_to_other", distances.to_second).add("distance_from_other", distances.to_first);
    std::cout << json.text() << std::endl;
    return DONE;
  }
  std::cout << "file        " << format << "; " << model.soup.points.size() << " points, " << model.soup.polygons.size()
            << " polygons; longest side of the box " << unit << "\n";
  if(!attributes.empty()) {
    std::cout << "attributes  " << attributes[0] << "\n";
    for(std::size_t n = 1; n < attributes.size(); ++n) std::cout << "            " << attributes[n] << "\n";
  }
  print(found, thickness);
  if(!options.other.empty())
    std::cout << "distance    at most " << number(distances.to_second) << " from any point of this file to "
              << options.other << ", and at most " << number(distances.to_first) << " in the opposite direction"
              << std::endl;
  if(found.status == BS::Shell_status::SUCCESS) return DONE;
  return { DONE, options.input, without_advice(message(found.status)) + ".", found.offenders };
}

} // namespace Tool
