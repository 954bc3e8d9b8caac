// condense.h, Cell_colors.h, Normal_equations.h: equations for free coefficients are compared with the product of three
// matrices.
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Fit/Fitted_part.h>
#include <CGAL/Bspline_shell_3/Fit/internal/Cell_colors.h>
#include <CGAL/Bspline_shell_3/Fit/internal/Normal_equations.h>
#include <CGAL/Bspline_shell_3/Fit/internal/condense.h>
#include "random_hierarchies.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <vector>

namespace test_condense {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Hierarchical_bspline_field_3<> Field;
typedef Field::Cell_index Index;
typedef Eigen::Matrix<double, 64, 64> Local_matrix;
typedef Eigen::Matrix<double, 64, 1> Local_vector;
typedef Eigen::SparseMatrix<double> Matrix;

const BS::Lattice_3 lattice(CGAL::Bbox_3(9, -1, -4, 11, 2, 1), 0.3);

// Reproducible random equations of a leaf. They do not belong to a polynomial, so no entry is zero by coincidence.
struct Random_equations
{
  Local_matrix matrix;
  Local_vector rhs;

  explicit Random_equations(Index c)
  {
    CGAL::Random random(c + 1);
    for(int n = 0; n < 64; ++n) {
      rhs[n] = random.get_double(-1, 1);
      for(int m = 0; m <= n; ++m) matrix(n, m) = matrix(m, n) = random.get_double(-1, 1);
    }
  }
};

struct Assembled
{
  Matrix A;
  Eigen::VectorXd b;

  template <typename ConcurrencyTag>
  Assembled(const Field& field, ConcurrencyTag, const std::vector<char>* chosen = nullptr)
  {
    const BS::internal::Normal_equations<Field> equations(field, chosen);
    Matrix all;
    Eigen::VectorXd all_rhs;
    equations.template set_zero<ConcurrencyTag>(all, all_rhs);
    BS::internal::Cell_colors<Field>(field).template for_each_cell<ConcurrencyTag>([&](Index c) {
      const Random_equations local(c);
      equations.add(c, local.matrix, local.rhs, all, all_rhs);
    });
    BS::internal::condense<ConcurrencyTag>(field, equations, all, all_rhs, A, b);
  }
};

// Computes the sum over the leaves for all points, and reduces it to free coefficients.
void expected_equations(const Field& field, Eigen::MatrixXd& A, Eigen::VectorXd& b)
{
  const Eigen::Index size = Eigen::Index(field.number_of_coefficients()),
                     points = Eigen::Index(field.number_of_points());
  std::vector<Eigen::Triplet<double> > entries;
  for(Eigen::Index n = 0; n < size; ++n) {
    const Eigen::VectorXd column = field.extend(Eigen::VectorXd::Unit(size, n));
    for(Eigen::Index m = 0; m < points; ++m)
      if(column[m] != 0) entries.emplace_back(m, n, column[m]);
  }
  Matrix P(points, size), all(points, points);
  P.setFromTriplets(entries.begin(), entries.end());
  entries.clear();
  Eigen::VectorXd all_rhs = Eigen::VectorXd::Zero(points);
  for(Index c = 0; c < field.number_of_cells(); ++c) {
    const Random_equations local(c);
    const std::array<Index, 16> rows = field.coefficient_rows(c);
    for(int n = 0; n < 64; ++n) {
      all_rhs[rows[n / 4] + n % 4] += local.rhs[n];
      for(int m = 0; m < 64; ++m) entries.emplace_back(rows[n / 4] + n % 4, rows[m / 4] + m % 4, local.matrix(n, m));
    }
  }
  all.setFromTriplets(entries.begin(), entries.end());
  A = Eigen::MatrixXd(P.transpose() * all * P);
  b = P.transpose() * all_rhs;
}

// Checks that rows ascend from the diagonal, and that all chosen unknowns, and no others, have entries.
void check_lower_triangle(const Matrix& A, const std::vector<char>* chosen = nullptr)
{
  REQUIRE(A.isCompressed());
  const auto is_chosen = [&](Eigen::Index n) { return !chosen || (*chosen)[std::size_t(n)]; };
  std::size_t wrong = 0;
  for(int c = 0; c < A.outerSize(); ++c) {
    int last = c - 1;
    for(Matrix::InnerIterator it(A, c); it; ++it) {
      wrong += it.row() <= last || (last == c - 1 && it.row() != c) || !is_chosen(it.row());
      last = int(it.row());
    }
    wrong += is_chosen(c) != (last >= c);
  }
  CHECK(wrong == 0);
}

template <typename Equations, typename Other_equations>
void check_identical(const Equations& a, const Other_equations& b)
{
  const Eigen::Index size = a.A.nonZeros();
  REQUIRE(b.A.nonZeros() == size);
  CHECK(std::equal(a.A.valuePtr(), a.A.valuePtr() + size, b.A.valuePtr()));
  CHECK(std::equal(a.A.innerIndexPtr(), a.A.innerIndexPtr() + size, b.A.innerIndexPtr()));
  CHECK((a.b == b.b));
}

Field random_field(int seed, const Lattice_point& first, const Lattice_point& last, double share, int levels)
{
  CGAL::Random random(seed);
  return Field(random_hierarchy(random, some_cells(random, lattice, first, last, share), levels));
}

void check_condensed(const Field& field)
{
  REQUIRE((field.number_of_coefficients() < field.number_of_points()) == (field.number_of_levels() > 1));
  const Assembled found(field, CGAL::Sequential_tag());
  REQUIRE(std::size_t(found.A.rows()) == field.number_of_coefficients());
  REQUIRE(std::size_t(found.A.cols()) == field.number_of_coefficients());
  check_lower_triangle(found.A);
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
  expected_equations(field, A, b);
  Eigen::MatrixXd lower = A.triangularView<Eigen::Lower>();
  // Entries are sums of a few thousand products of size one.
  CHECK((Eigen::MatrixXd(found.A) - lower).cwiseAbs().maxCoeff() < 1e-12);
  CHECK((found.b - b).cwiseAbs().maxCoeff() < 1e-12);
  CHECK(lower.cwiseAbs().maxCoeff() > 1);
  if(field.number_of_levels() == 1) return;
  // Coefficients of different levels are coupled.
  double between_levels = 0;
  const Eigen::Index coarse = Eigen::Index(field.number_of_coefficients()) - 1;
  for(Eigen::Index c = 0; c < coarse; ++c)
    if(field.point_of_coefficient(Index(c)) < field.first_point(field.number_of_levels() - 2))
      between_levels = (std::max)(between_levels, A.col(c).tail(coarse - c).cwiseAbs().maxCoeff());
  CHECK(between_levels > 0.01);
}

} // namespace

TEST_CASE("Condensed equations: equations of all points are restricted correctly to the free coefficients")
{
  SECTION("two levels") check_condensed(random_field(1, { -5, -1, -1 }, { 3, 0, 0 }, 1, 2));
  SECTION("two levels, with holes") check_condensed(random_field(2, { -4, -2, -1 }, { 3, 1, 1 }, 0.6, 2));
  SECTION("three levels") check_condensed(random_field(3, { -6, 0, -1 }, { 5, 1, 0 }, 1, 3));
  SECTION("four levels, deep at one end")
  {
    Hierarchy cells(all_cells(lattice, { -5, -1, 0 }, { 4, 0, 0 }));
    const std::array<double, 3> end = cells.corner(0);
    while(cells.number_of_levels() < 4) cells = cells.refined({ cells.locate(end) });
    check_condensed(Field(cells));
  }
}

TEST_CASE("Condensed equations: the equations do not depend on the number of threads, bit for bit")
{
  const Field field = random_field(5, { -6, -3, -2 }, { 4, 1, 1 }, 0.9, 3);
  REQUIRE(field.number_of_cells() > 1000); // enough for several chunks
  const Assembled sequential(field, CGAL::Sequential_tag());
  check_lower_triangle(sequential.A);
  for(int run = 0; run < 3; ++run) check_identical(sequential, Assembled(field, CGAL::Parallel_if_available_tag()));
}

TEST_CASE(
  "Condensed equations: without dependent coefficients, the condensed equations are the equations of all points")
{
  CGAL::Random random(6);
  const Root_cells roots = some_cells(random, lattice, { -4, -2, -2 }, { 3, 1, 1 }, 0.7);
  const Field uniform(roots);
  const Field field{ Hierarchy(roots) };
  const Assembled a(uniform, CGAL::Sequential_tag());
  const Assembled b(field, CGAL::Sequential_tag());
  check_lower_triangle(a.A);
  check_identical(a, b);
}

TEST_CASE("Condensed equations: for chosen points, their entries are unchanged, and other entries are zero")
{
  CGAL::Random random(31);
  for(int n = 0; n < 4; ++n) {
    const Field field(random_hierarchy(random, some_cells(random, lattice, { 0, 0, 0 }, { 3, 3, 3 }, 0.8), 1 + n % 3));
    const BS::Fitted_part part(field, random_leaves(random, field.cells(), 1));
    const Assembled all(field, CGAL::Sequential_tag()), chosen(field, CGAL::Sequential_tag(), &part.points);
    check_lower_triangle(chosen.A, &part.coefficients);
    const Eigen::MatrixXd expected = all.A, found = chosen.A;
    std::size_t entries = 0;
    for(Eigen::Index c = 0; c < expected.cols(); ++c)
      for(Eigen::Index r = c; r < expected.rows(); ++r) {
        const bool both = part.coefficients[std::size_t(r)] && part.coefficients[std::size_t(c)];
        if(found(r, c) != (both ? Approx(expected(r, c)).margin(1e-12) : Approx(0).margin(0))) FAIL(r << " " << c);
        entries += both && expected(r, c) != 0;
      }
    CHECK(std::size_t(chosen.A.nonZeros()) >= entries);
    CHECK(chosen.A.nonZeros() <= all.A.nonZeros());
    CHECK(entries > 64);
  }
}
} // namespace test_condense
