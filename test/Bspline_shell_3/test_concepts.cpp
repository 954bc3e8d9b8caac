// The concepts: models with nothing but the required members can be used.
#include "fit_problem.h"
#include "test_meshes.h"

#include <CGAL/bspline_shell_3.h>
#include <CGAL/certified_bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Construction/level_bounds.h>
#include <CGAL/Bspline_shell_3/Construction/shell_component.h>
#include <CGAL/Bspline_shell_3/Fit/Conjugate_gradient_solver.h>
#include <CGAL/Bspline_shell_3/Fit/fit_field.h>
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Editing/remesh_in_shell.h>
#include <CGAL/Bspline_shell_3/Surface/extract_level_set.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_corner_attribute.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_face_labels.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_tangent_vectors.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_vertex_attribute.h>
#ifdef HAVE_CHOLMOD
#include <CGAL/Bspline_shell_3/Fit/Cholmod_solver.h>
#endif

#include <CGAL/Simple_cartesian.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace test_concepts {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace P = CGAL::Bspline_shells::parameters;
typedef CGAL::Bspline_shell_3<> Shell;

// SignedDistanceOracle_3: neither copyable nor assignable; points and numbers have only the required conversions
class Distance_archetype
{
public:
  class Point_3
  {
    friend class Distance_archetype;
    double m_x, m_y, m_z;
  public:
    Point_3(double x, double y, double z) : m_x(x), m_y(y), m_z(z) {}
    Point_3(const Point_3&) = delete;
    Point_3(Point_3&&) = default;
  };
  class FT
  {
    double m_value;
  public:
    explicit FT(double value, int) : m_value(value) {}
    operator double() const { return m_value; }
  };

  explicit Distance_archetype(double radius) : m_radius(radius) {}
  Distance_archetype(const Distance_archetype&) = delete;
  Distance_archetype& operator=(const Distance_archetype&) = delete;

  FT operator()(const Point_3& p) const
  {
    return FT(std::sqrt(p.m_x * p.m_x + p.m_y * p.m_y + p.m_z * p.m_z) - m_radius, 0);
  }

private:
  double m_radius;
};

double distance_to_ball(const Point_3& p)
{
  return std::sqrt(CGAL::squared_distance(p, Point_3(0, 0, 0))) - 0.95;
}

// Neither default-constructed, nor copied, nor assigned.
struct Unique
{
  explicit Unique(int) {}
  Unique(const Unique&) = delete;
  Unique& operator=(const Unique&) = delete;
};

// SPDSolver: dense Cholesky factorization
class Solver_archetype : Unique
{
public:
  using Unique::Unique;

  BS::Solver_status compute(const Eigen::SparseMatrix<double>& lower, const BS::Unknown_blocks&)
  {
    m_factor.compute(Eigen::MatrixXd(lower));
    return m_factor.info() == Eigen::Success ? BS::Solver_status::SUCCESS : BS::Solver_status::NOT_POSITIVE_DEFINITE;
  }
  BS::Solver_status solve(const Eigen::VectorXd& b, Eigen::VectorXd& x)
  {
    x = m_factor.solve(b);
    return BS::Solver_status::SUCCESS;
  }
  std::size_t iterations() const { return 1; }
  double residual() const { return 0; }

private:
  Eigen::LLT<Eigen::MatrixXd, Eigen::Lower> m_factor;
};

// ShellVisitor
class Visitor_archetype : Unique
{
public:
  using Unique::Unique;
  bool start_step(BS::Shell_step)
  {
    ++calls;
    return true;
  }
  int calls = 0;
};

// RemeshingVisitor
class Remeshing_visitor_archetype : Unique
{
public:
  using Unique::Unique;
  bool start_iteration(unsigned int) { return true; }
  bool go_on()
  {
    ++calls;
    return true;
  }
  int calls = 0;
};

// FlowVisitor
class Flow_visitor_archetype : Unique
{
public:
  using Unique::Unique;
  bool advance(std::size_t, std::size_t)
  {
    ++calls;
    return true;
  }
  int calls = 0;
};

// A value that can only be copied and, for seams, compared.
class Value_archetype
{
public:
  explicit Value_archetype(double value, int) : m_value(value) {}
  bool operator==(const Value_archetype& other) const { return m_value == other.m_value; }
  double m_value;
};

// AttributeInterpolation: copied and called
class Interpolation_archetype
{
public:
  explicit Interpolation_archetype(int) {}
  Interpolation_archetype& operator=(const Interpolation_archetype&) = delete;
  Interpolation_archetype(const Interpolation_archetype&) = default;
  Value_archetype operator()(const std::array<Value_archetype, 3>& v, const std::array<double, 3>& w) const
  {
    return Value_archetype(w[0] * v[0].m_value + w[1] * v[1].m_value + w[2] * v[2].m_value, 0);
  }
};

// A mapping of transferred values: neither copied nor assigned.
class Mapping_archetype : Unique
{
public:
  using Unique::Unique;
  Value_archetype operator()(const Value_archetype& value, const BS::Flow_differential& d) const
  {
    return Value_archetype(value.m_value * d.matrix.determinant(), 0);
  }
};

// BsplineField_3: a second model of the concept, with only the required members
class Field_archetype
{
protected:
  typedef BS::Hierarchical_bspline_field_3<> Model;
  Model m_model;

public:
  struct Geom_traits
  {};
  typedef double FT;
  typedef CGAL::Simple_cartesian<double>::Point_3 Point_3;
  typedef CGAL::Simple_cartesian<double>::Vector_3 Vector_3;
  typedef Model::Cell Cell;
  typedef Model::Cell_index Cell_index;
  static constexpr Cell_index npos = Model::npos;

  Field_archetype() = default;
  explicit Field_archetype(const Model& model, int) : m_model(model) {}

  const BS::Cell_hierarchy_3& cells() const { return m_model.cells(); }
  std::size_t number_of_cells() const { return m_model.number_of_cells(); }
  Cell cell(Cell_index c) const { return m_model.cell(c); }
  Cell_index locate(const Point_3& p) const { return m_model.locate(Model::Point_3(p.x(), p.y(), p.z())); }
  bool has_exact_cells() const { return m_model.has_exact_cells(); }
  template <typename Visitor>
  bool visit_neighbors(Cell_index c, int axis, bool positive, const Visitor& visit) const
  {
    return m_model.visit_neighbors(c, axis, positive, visit);
  }
  template <typename Visitor>
  bool visit_cells(const CGAL::Bbox_3& box, const Visitor& visit) const
  {
    return m_model.visit_cells(box, visit);
  }
  template <typename NT>
  std::array<NT, 64> bernstein_coefficients(Cell_index c) const
  {
    return m_model.bernstein_coefficients<NT>(c);
  }
  std::optional<FT> value(const Point_3& p) const { return m_model.value(Model::Point_3(p.x(), p.y(), p.z())); }
  std::optional<Vector_3> gradient(const Point_3&) const { return std::nullopt; }
  std::optional<Eigen::Matrix3d> hessian(const Point_3&) const { return std::nullopt; }
};

// FittableBsplineField_3: neither copied nor assigned
class Fittable_field_archetype : public Field_archetype
{
public:
  explicit Fittable_field_archetype(const Model& model) : Field_archetype(model, 0) {}
  Fittable_field_archetype(const Fittable_field_archetype&) = delete;
  Fittable_field_archetype& operator=(const Fittable_field_archetype&) = delete;

  int number_of_levels() const { return 1; }
  std::size_t number_of_points() const { return m_model.number_of_points(); }
  const BS::Lattice_set_3& points(int level) const { return m_model.points(level); }
  Cell_index first_point(int level) const { return m_model.first_point(level); }
  std::size_t number_of_coefficients() const { return m_model.number_of_coefficients(); }
  Cell_index coefficient_of_point(Cell_index n) const { return m_model.coefficient_of_point(n); }
  Cell_index point_of_coefficient(Cell_index n) const { return m_model.point_of_coefficient(n); }
  std::array<Cell_index, 16> coefficient_rows(Cell_index c) const { return m_model.coefficient_rows(c); }
  Eigen::VectorXd extend(const Eigen::VectorXd& x) const { return m_model.extend(x); }
  Eigen::VectorXd collect(const Eigen::VectorXd& all) const { return m_model.collect(all); }
  template <typename ConcurrencyTag>
  void set_coefficients(Eigen::VectorXd x)
  {
    m_model.set_coefficients<ConcurrencyTag>(std::move(x));
  }
};

template <typename Index>
struct Cell_visitor
{
  void operator()(Index) const {}
};

// The interface of all fields.
template <typename Field>
void check_field_interface()
{
  typedef typename Field::Cell_index Cell_index;
  typedef typename Field::Cell Cell;
  typedef typename Field::Point_3 Point_3;
  static_assert(std::is_default_constructible_v<Field>);
  static_assert(std::is_copy_constructible_v<Field> && std::is_move_constructible_v<Field>);
  static_assert(std::is_integral_v<Cell_index>);
  static_assert(std::is_same_v<std::remove_cv_t<decltype(Field::npos)>, Cell_index>);
  typedef const Field& F;
  static_assert(std::is_same_v<decltype(std::declval<F>().number_of_cells()), std::size_t>);
  static_assert(std::is_same_v<decltype(std::declval<F>().cell(Cell_index())), Cell>);
  static_assert(std::is_same_v<decltype(std::declval<F>().locate(std::declval<const Point_3&>())), Cell_index>);
  static_assert(std::is_same_v<decltype(std::declval<F>().has_exact_cells()), bool>);
  static_assert(
    std::is_same_v<decltype(std::declval<F>().visit_neighbors(Cell_index(), 0, true, Cell_visitor<Cell_index>())),
                   bool>);
  static_assert(std::is_same_v<decltype(std::declval<F>().template bernstein_coefficients<float>(Cell_index())),
                               std::array<float, 64> >);
  static_assert(std::is_same_v<decltype(std::declval<F>().value(std::declval<const Point_3&>())),
                               std::optional<typename Field::FT> >);
  static_assert(std::is_same_v<decltype(std::declval<F>().gradient(std::declval<const Point_3&>())),
                               std::optional<typename Field::Vector_3> >);
  static_assert(std::is_same_v<decltype(std::declval<F>().hessian(std::declval<const Point_3&>())),
                               std::optional<Eigen::Matrix3d> >);
  static_assert(
    std::is_same_v<decltype(std::declval<F>().visit_cells(CGAL::Bbox_3(), Cell_visitor<Cell_index>())), bool>);
}

} // namespace

TEST_CASE("SignedDistanceOracle_3: the field gets its values from the archetype")
{
  const Distance_archetype oracle(0.95);
  BS::Energy_weights distance_only;
  distance_only.mu = 0;
  const Shell shell = CGAL::bspline_shell_3(
    sphere(1), P::resolution(8).energy_weights(distance_only).signed_distance_oracle(std::cref(oracle)));
  REQUIRE(shell);
  CHECK(*shell.field().value(Point_3(0.95, 0, 0)) == Approx(0).margin(0.01));
  CHECK(*shell.field().value(Point_3(0, 0, -1.2)) == Approx(0.25).margin(0.01));
}

TEST_CASE("SignedDistanceOracle_3: lambda expressions and functions are called with points of the usual kernel")
{
  const Distance_archetype archetype(0.95);
  const BS::Any_signed_distance_3 expected(archetype), function(distance_to_ball);
  const auto lambda = [](const Point_3& p) { return float(distance_to_ball(p)); };
  const auto generic = [](const auto& p) { return distance_to_ball(p); };
  const BS::Any_signed_distance_3 distances[] = { function, lambda, generic };
  const std::vector<Point_3> points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, -2, 3 } };
  for(const BS::Any_signed_distance_3& distance : distances) {
    double along[3];
    distance(points, along);
    for(int n = 0; n < 3; ++n) {
      CHECK(distance(points[n]) == Approx(expected(points[n])).epsilon(1e-6));
      CHECK(along[n] == distance(points[n]));
    }
  }
  const Shell shell = CGAL::bspline_shell_3(sphere(1), P::resolution(8).signed_distance_oracle(lambda));
  CHECK(shell);
  const auto certified = CGAL::certified_bspline_shell_3(
    sphere(1), P::resolution(8).signed_distance_oracle([](const Point_3& p) { return distance_to_ball(p); }));
  CHECK(certified);
}

TEST_CASE("SPDSolver: the archetype and the package's models yield the same shell")
{
  const Mesh mesh = sphere(1);
  const auto p = P::grid_spacing(0.5);
  Solver_archetype archetype(0);
  BS::Conjugate_gradient_solver<> iterative(1e-10);
  const Shell shell = CGAL::bspline_shell_3(mesh, p.spd_solver(std::ref(archetype))),
              other = CGAL::bspline_shell_3(mesh, p.spd_solver(std::ref(iterative)));
  REQUIRE(shell);
  REQUIRE(other);
  CHECK(shell.report().fit.iterations == 1);
  // Bounds are refined to 1e-4 of their range.
  CHECK(std::abs(shell.inner_level() - other.inner_level()) < 2e-4 * shell.thickness());
  CHECK(std::abs(shell.outer_level() - other.outer_level()) < 2e-4 * shell.thickness());
#ifdef HAVE_CHOLMOD
  BS::Cholmod_solver cholmod;
  const Shell direct = CGAL::bspline_shell_3(mesh, p.spd_solver(std::ref(cholmod)));
  REQUIRE(direct);
  CHECK(std::abs(shell.inner_level() - direct.inner_level()) < 2e-4 * shell.thickness());
  CHECK(std::abs(shell.outer_level() - direct.outer_level()) < 2e-4 * shell.thickness());
#endif
}

TEST_CASE("ShellVisitor: the archetype is called in each step")
{
  Visitor_archetype visitor(0);
  REQUIRE(CGAL::bspline_shell_3(sphere(1), P::grid_spacing(0.5).visitor(std::ref(visitor))));
  CHECK(visitor.calls == 5);
}

TEST_CASE("BsplineField_3: bounds, shells and level sets require no more of a field than the archetype has")
{
  check_field_interface<BS::Hierarchical_bspline_field_3<> >();
  check_field_interface<BS::Hierarchical_bspline_field_3<CGAL::Simple_cartesian<double> > >();
  check_field_interface<Field_archetype>();

  const Mesh mesh = sphere(1);
  const Shell shell = CGAL::bspline_shell_3(mesh, P::grid_spacing(0.25));
  REQUIRE(shell);
  const Field_archetype field(shell.field(), 0);
  BS::Input_mesh_3 input;
  REQUIRE(input.build<CGAL::Sequential_tag>(mesh, get(CGAL::vertex_point, mesh), {}) == BS::Shell_status::SUCCESS);
  const BS::Clipped_mesh_3 clipped = BS::clip_mesh_to_cells<CGAL::Sequential_tag>(input, field.cells());

  const BS::Facet_ranges ranges = BS::facet_ranges<CGAL::Sequential_tag>(field, clipped);
  CHECK(ranges.mesh.min == shell.report().facets_bound.min);
  CHECK(ranges.mesh.max == shell.report().facets_bound.max);
  CHECK(BS::edge_range<CGAL::Sequential_tag>(field, clipped).min == shell.report().edges.min);

  const BS::Level_range levels = { shell.inner_level(), shell.outer_level() };
  const BS::Shell_component component = BS::shell_component(field, clipped.cells(), levels);
  CHECK(component.cells == shell.shell_cells());
  CHECK(component.border_cells.empty());

  BS::Shell_report report = shell.report();
  const CGAL::Bspline_shell_3<Field_archetype> other(field, levels, component.cells, ranges.facet, report);
  REQUIRE(other);
  CHECK(other.bounded_side(Field_archetype::Point_3(0, 0, 0)) == CGAL::ON_UNBOUNDED_SIDE);
  for(auto v : mesh.vertices()) {
    const Point_3& p = mesh.point(v);
    CHECK(other.bounded_side(Field_archetype::Point_3(p.x(), p.y(), p.z())) == shell.bounded_side(p));
  }
  CHECK_FALSE(CGAL::Bspline_shell_3<Field_archetype>());
  BS::Shell_certificate_3<Field_archetype> certificate(other);
  BS::Shell_certificate_3<> same_certificate(shell);
  CHECK(certificate.verify<CGAL::Sequential_tag>(mesh) == same_certificate.verify<CGAL::Sequential_tag>(mesh));
  CHECK(certificate.verdict(BS::Claim::CONTAINMENT) == BS::Verdict::PROVED);
  CHECK(certificate.least_gradient() == same_certificate.least_gradient());

  CGAL::Surface_mesh<Point_3> level_set, same_set;
  BS::extract_level_set<CGAL::Sequential_tag>(field, shell.outer_level(), level_set);
  BS::extract_level_set<CGAL::Sequential_tag>(shell.field(), shell.outer_level(), same_set);
  CHECK(level_set.number_of_faces() > 0);
  CHECK(level_set.number_of_faces() == same_set.number_of_faces());
}

TEST_CASE("FittableBsplineField_3: a fit requires no more of a field than the archetype has")
{
  typedef CGAL::Sequential_tag Tag;
  Fit_problem problem(sphere(2), 8);
  Fittable_field_archetype other(problem.field);
  BS::Conjugate_gradient_solver<Tag> solver;
  Energy energy = problem.energy();
  BS::Fit_energy<Fittable_field_archetype> other_energy(other, problem.samples, problem.clipped, problem.gamma(),
                                                        all_four_terms());
  CHECK(BS::fit_field<Tag>(problem.field, energy, solver, energy.initial_guess<Tag>()).status
        == BS::Solver_status::SUCCESS);
  CHECK(BS::fit_field<Tag>(other, other_energy, solver, other_energy.initial_guess<Tag>()).status
        == BS::Solver_status::SUCCESS);
  for(Field::Cell_index c = 0; c < other.number_of_cells(); ++c)
    CHECK(std::equal(other.cell(c).coefficients(), other.cell(c).coefficients() + 64,
                     problem.field.cell(c).coefficients()));
}

TEST_CASE("RemeshingVisitor: the archetype is called")
{
  Mesh mesh = sphere(1);
  const Shell shell = CGAL::bspline_shell_3(mesh, P::resolution(8));
  REQUIRE(shell);
  Remeshing_visitor_archetype visitor(0);
  CHECK(BS::remesh_in_shell(mesh, 1, shell, P::visitor(std::ref(visitor))).message() != "");
  CHECK(visitor.calls > 0);
}

TEST_CASE("FlowVisitor, AttributeInterpolation: the archetypes are called")
{
  Mesh mesh = sphere(1);
  const Shell shell = CGAL::bspline_shell_3(mesh, P::resolution(8));
  REQUIRE(shell);
  const BS::Shell_map_3<Shell, Mesh> map(shell, mesh, mesh);
  Flow_visitor_archetype visitor(0);
  const Interpolation_archetype interpolation(0);
  const Mapping_archetype mapping(0);

  const Value_archetype none(-1, 0);
  auto v = mesh.add_property_map<Mesh::Vertex_index, Value_archetype>("v:from", none).first,
       v2 = mesh.add_property_map<Mesh::Vertex_index, Value_archetype>("v:to", none).first;
  auto h = mesh.add_property_map<Mesh::Halfedge_index, Value_archetype>("h:from", none).first,
       h2 = mesh.add_property_map<Mesh::Halfedge_index, Value_archetype>("h:to", none).first;
  auto f = mesh.add_property_map<Mesh::Face_index, Value_archetype>("f:from", none).first,
       f2 = mesh.add_property_map<Mesh::Face_index, Value_archetype>("f:to", none).first;
  auto d = mesh.add_property_map<Mesh::Vertex_index, double>("v:d", 2.).first;
  auto w = mesh.add_property_map<Mesh::Face_index, Vector_3>("f:w", Vector_3(1, 0, 0)).first;
  for(auto x : mesh.vertices()) v[x] = Value_archetype(double(std::size_t(x)), 0);
  for(auto x : mesh.halfedges()) h[x] = Value_archetype(double(std::size_t(x)), 0);
  for(auto x : mesh.faces()) f[x] = Value_archetype(double(std::size_t(x)), 0);

  int calls = 0;
  const auto check = [&](const BS::Transfer_report& report) {
    CHECK(report);
    CHECK(visitor.calls > calls);
    calls = visitor.calls;
  };
  check(BS::transfer_vertex_attribute(map, v, v2, P::interpolation(interpolation).visitor(std::ref(visitor))));
  for(auto x : mesh.vertices()) CHECK(v2[x].m_value == Approx(v[x].m_value).margin(1e-9));
  // The differential of the identity is the identity.
  check(BS::transfer_vertex_attribute(
    map, v, v2, P::interpolation(interpolation).mapping(std::cref(mapping)).visitor(std::ref(visitor))));
  for(auto x : mesh.vertices()) CHECK(v2[x].m_value == Approx(v[x].m_value).margin(1e-6));
  check(BS::average_vertex_attribute(map, d, d, P::visitor(std::ref(visitor))));
  check(BS::transfer_face_labels(map, f, f2, P::visitor(std::ref(visitor))));
  for(auto x : mesh.faces()) CHECK(f2[x] == f[x]);
  check(BS::transfer_corner_attribute(map, h, h2, P::interpolation(interpolation).visitor(std::ref(visitor))));
  for(auto x : mesh.halfedges()) CHECK(h2[x].m_value == Approx(h[x].m_value).margin(1e-6));
  check(BS::transfer_tangent_vectors(map, w, w, P::visitor(std::ref(visitor))));
  std::vector<Point_3> points(3, mesh.point(Mesh::Vertex_index(0)));
  map.to_target().project(points, visitor);
  CHECK(visitor.calls > calls);
}
} // namespace test_concepts
