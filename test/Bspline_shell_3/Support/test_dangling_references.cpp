// Objects that keep a reference to an argument do not accept temporaries, which would not live long enough.
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Certificate/Field_predicates_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Second_order_bounds_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_containment_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_cover_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_facet_oracle_3.h>
#include <CGAL/Bspline_shell_3/Editing/Shell_filter.h>
#include <CGAL/Bspline_shell_3/Editing/Shell_placement.h>
#include <CGAL/Bspline_shell_3/Mesh/Crossing_counter_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Mesh_signed_distance_3.h>
#include <CGAL/Bspline_shell_3/Projection/Gradient_flow_3.h>
#include <CGAL/Bspline_shell_3/Projection/Projection_target_3.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Projection/Soup_map_3.h>

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>

#include <memory>
#include <type_traits>

namespace test_dangling_references {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Hierarchical_bspline_field_3<> Field;
typedef BS::Spline_threshold<Field> Threshold;
typedef CGAL::Bspline_shell_3<Field, Threshold> Shell;

// Returns whether an object can be constructed from an lvalue `Argument` and others, but not from a temporary.
template <typename Object, typename Argument, typename... Others>
constexpr bool refuses_temporaries()
{
  return std::is_constructible<Object, Argument&, Others...>::value
         && std::is_constructible<Object, const Argument&, Others...>::value
         && !std::is_constructible<Object, Argument, Others...>::value
         && !std::is_constructible<Object, const Argument, Others...>::value;
}

typedef BS::Shell_map_3<Shell, Mesh> Map;
static_assert(refuses_temporaries<Map, Shell, const Mesh&, const Mesh&>());
static_assert(!std::is_constructible<Map, const Shell&, Mesh, const Mesh&>::value);
static_assert(!std::is_constructible<Map, const Shell&, const Mesh&, Mesh>::value);
static_assert(!std::is_constructible<Map, const Shell&, Mesh, Mesh>::value);
static_assert(!std::is_constructible<Map, Shell, Mesh, Mesh>::value);
typedef decltype(BS::parameters::tolerance(1.)) Parameters;
static_assert(std::is_constructible<Map, const Shell&, const Mesh&, const Mesh&, const Parameters&>::value);
static_assert(!std::is_constructible<Map, Shell, const Mesh&, const Mesh&, const Parameters&>::value);
static_assert(!std::is_constructible<Map, const Shell&, Mesh, const Mesh&, const Parameters&>::value);
static_assert(
  !std::is_constructible<Map, const Shell&, const Mesh&, Mesh, const Parameters&, const Parameters&>::value);
static_assert(refuses_temporaries<BS::Soup_map_3<Shell, Mesh>, Shell, const Mesh&, const Mesh&>());

typedef BS::Projection_target_3<Mesh> Target;
typedef boost::property_map<Mesh, CGAL::vertex_point_t>::const_type Points;
static_assert(refuses_temporaries<Target, Mesh, Points>());
typedef BS::Shell_projection_3<Shell, Mesh> Projection;
static_assert(refuses_temporaries<Projection, Shell, std::shared_ptr<const Target> >());
static_assert(refuses_temporaries<Projection, Shell, const Mesh&>());
static_assert(!std::is_constructible<Projection, const Shell&, Mesh>::value);
static_assert(!std::is_constructible<Projection, const Shell&, Mesh, const Parameters&>::value);
static_assert(refuses_temporaries<BS::Proxy_projection_3<Shell, Mesh>, Shell, std::shared_ptr<const Target>, double>());
static_assert(refuses_temporaries<BS::Soup_projection_3<Shell, Mesh>, Shell, std::shared_ptr<const Target> >());
static_assert(refuses_temporaries<BS::Gradient_flow_3<Shell>, Shell>());
static_assert(refuses_temporaries<BS::Gradient_flow_3<Shell>, Shell, double>());

typedef BS::Shell_certificate_3<Field, Threshold> Certificate;
static_assert(refuses_temporaries<Certificate, Shell>());
static_assert(refuses_temporaries<Certificate, Field, const Threshold&, const Threshold&>());
static_assert(refuses_temporaries<BS::Shell_containment_3<Field, Threshold>, Shell>());
typedef BS::Shell_facet_oracle_3<Field, Threshold> Oracle;
static_assert(refuses_temporaries<Oracle, Shell>());
static_assert(refuses_temporaries<Oracle, Shell, BS::Facet_proofs>());
static_assert(refuses_temporaries<BS::Shell_filter<Oracle>, Oracle>());
static_assert(refuses_temporaries<BS::Shell_filter<Oracle>, Shell>());
typedef CGAL::Surface_mesh_simplification::Midpoint_placement<Mesh> Midpoint;
static_assert(refuses_temporaries<BS::Shell_placement<Shell, Midpoint>, Shell>());
static_assert(refuses_temporaries<BS::Shell_cover_3<Field, Threshold>, Field, Threshold, Threshold>());
static_assert(refuses_temporaries<BS::Field_predicates_3<Field>, Field>());
static_assert(refuses_temporaries<BS::Second_order_bounds_3<Field, Threshold>, Field, Threshold, Threshold>());
static_assert(refuses_temporaries<BS::Crossing_counter_3, BS::Input_mesh_3::Triangle_mesh>());
static_assert(refuses_temporaries<BS::Mesh_signed_distance_3, BS::Input_mesh_3>());

} // namespace

TEST_CASE("Temporaries are rejected where references are kept")
{
  SUCCEED("The assertions above hold when this file is compiled.");
}
} // namespace test_dangling_references
