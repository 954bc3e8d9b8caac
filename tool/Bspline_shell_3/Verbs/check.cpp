#include "Exit_code.h"
#include "Input.h"
#include "Json.h"
#include "verbs.h"

#include "../Carry/Mesh_origins.h"
#include "../Files/read_model.h"

#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Local_gap_3.h>
#include <CGAL/Bspline_shell_3/Soup/choose_excision.h>
#include <CGAL/Bspline_shell_3/Soup/repair_soup.h>
#include <CGAL/Bspline_shell_3/Soup/weld_soup.h>

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <iostream>
#include <limits>
#include <set>

namespace Tool {

namespace {

constexpr double largest_excised_share = 0.1; // default of `certified_shell_of_soup_3()`

const char* name(Element element)
{
  switch(element) {
    case Element::POINT: return "points";
    case Element::POLYGON: return "polygons";
    case Element::CORNER: return "corners";
  }
  return "";
}

// The thickness of walls and the width of gaps of a closed mesh.
struct Gaps
{
  bool are_known = false;
  double thinnest_wall = std::numeric_limits<double>::infinity(), narrowest_gap = thinnest_wall;
  double thin_area = 0; // share of the area where a wall or a gap is narrower than the shell
};

Gaps measure_gaps(const BS::Input_mesh_3& input, double thickness)
{
  Gaps gaps;
  gaps.are_known = true;
  const BS::Local_gap_3 gap(input);
  double area = 0, thin = 0;
  for(auto f : input.mesh().faces()) {
    const double wall = gap(f, CGAL::NEGATIVE), space = gap(f, CGAL::POSITIVE);
    gaps.thinnest_wall = (std::min)(gaps.thinnest_wall, wall);
    gaps.narrowest_gap = (std::min)(gaps.narrowest_gap, space);
    const double of_facet = CGAL::Polygon_mesh_processing::face_area(f, input.mesh());
    area += of_facet;
    if((std::min)(wall, space) < thickness) thin += of_facet;
  }
  gaps.thin_area = area > 0 ? thin / area : 0;
  return gaps;
}

struct Findings
{
  BS::Shell_status status = BS::Shell_status::NOT_BUILT; // of the polygons as a mesh
  BS::Offending_simplices offenders;                     // polygons and points, or facets of the repaired mesh
  BS::Soup_repairs repairs;
  BS::Weld_report weld;
  std::size_t components = 0, border_edges = 0, intersecting = 0;
  double excised_share = 0;
  Gaps gaps;
  std::string kind; // of shell that can be expected
};

Findings examine(const Model& model, double thickness)
{
  Findings found;
  Mesh mesh;
  BS::Weld_parameters welding;
  welding.thickness = thickness;
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
    BS::Input_mesh_3::Tolerated_defects tolerated;
    tolerated.singular_vertices = tolerated.orientation = true;
    BS::Input_mesh_3 input;
    if(!has_defects && found.border_edges == 0
       && input.build<CGAL::Parallel_if_available_tag>(mesh, mesh.points(), tolerated) == BS::Shell_status::SUCCESS)
      found.gaps = measure_gaps(input, thickness);
  }
  if(has_defects) {
    const BS::Excised_soup_3 excised = BS::choose_excision(BS::different_triangles(welded.soup));
    found.excised_share = excised ? excised.report().excised_area : 1;
    found.kind = found.excised_share <= largest_excised_share ? "excised" : "proxy";
  } else found.kind = found.border_edges > 0 ? "virtually closed" : "closed";
  return found;
}

// Here, `SUCCESS` means that the polygons form a mesh.
const char* mesh_message(BS::Shell_status status)
{
  return status == BS::Shell_status::SUCCESS ? "The polygons form a mesh." : message(status);
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
  if(!welding.empty()) std::cout << "welding     " << welding << "\n";
  if(found.components > 0)
    std::cout << "mesh        " << found.components << (found.components == 1 ? " component, " : " components, ")
              << found.border_edges << " border edges, " << found.intersecting << " facets intersect others\n";
  else std::cout << "mesh        " << mesh_message(found.status) << "\n";
  if(found.gaps.are_known)
    std::cout << "walls       thinnest " << found.gaps.thinnest_wall << "\n"
              << "gaps        narrowest " << found.gaps.narrowest_gap << "\n"
              << "            narrower than the shell (" << thickness << ") on " << 100 * found.gaps.thin_area
              << " % of the area\n";
  if(found.excised_share > 0)
    std::cout << "excision    " << 100 * found.excised_share << " % of the area has defects\n";
  std::cout << "shell       " << found.kind << std::endl;
}

} // namespace

int check(const Check_options& options)
{
  Model model;
  if(!read_input(options.input, model)) return WRONG_INPUT;
  constexpr double default_thickness = 0.01;
  const double unit = longest_side(model);
  const double thickness = options.thickness ? options.thickness->in_box(unit) : default_thickness * unit;
  const std::string format = extension_of(options.input).substr(1) + (model.encoding.empty() ? "" : ", ")
                             + model.encoding;
  std::size_t corners = model.first_corners().back();
  const Findings found = examine(model, thickness);
  if(found.kind.empty()) {
    complain(options.input, message(found.status), found.offenders);
    return WRONG_INPUT;
  }
  std::vector<std::string> attributes;
  for(const Attribute& a : model.attributes)
    attributes.push_back(a.name + " (" + name(a.element) + ", " + std::to_string(a.dimension()) + ")");
  if(options.writes_json) {
    Json json;
    json.add("input", options.input)
      .add("format", format)
      .add("points", model.soup.points.size())
      .add("polygons", model.soup.polygons.size())
      .add("corners", corners)
      .add("longest_side", unit)
      .add("attributes", attributes)
      .add("mesh_status", mesh_message(found.status))
      .add("facets", found.offenders.facets)
      .add("vertices", found.offenders.vertices)
      .add("components", found.components)
      .add("border_edges", found.border_edges)
      .add("intersecting_facets", found.intersecting)
      .add("excised_share", found.excised_share)
      .add("kind", found.kind);
    if(found.gaps.are_known)
      json.add("thinnest_wall", found.gaps.thinnest_wall)
        .add("narrowest_gap", found.gaps.narrowest_gap)
        .add("thin_area", found.gaps.thin_area);
    std::cout << json.text() << std::endl;
    return DONE;
  }
  std::cout << "file        " << format << "; " << model.soup.points.size() << " points, " << model.soup.polygons.size()
            << " polygons; longest side of the box " << unit << "\n";
  if(!attributes.empty()) {
    std::cout << "attributes ";
    for(const std::string& a : attributes) std::cout << " " << a;
    std::cout << "\n";
  }
  print(found, thickness);
  if(!found.offenders.facets.empty() || !found.offenders.vertices.empty())
    complain(options.input, mesh_message(found.status), found.offenders);
  return DONE;
}

} // namespace Tool
