// Symmetric_matrix.h: products are compared with Eigen's, and are the same for one and several threads.
#include <CGAL/Bspline_shell_3/Fit/internal/Symmetric_matrix.h>
#include "test_meshes.h"

#include <cstddef>
#include <vector>

namespace test_Symmetric_matrix {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef Eigen::SparseMatrix<double> Triangle;

// Returns the lower triangle of a matrix with about `entries` entries per column, and some empty columns.
Triangle random_triangle(CGAL::Random& random, int size, int entries)
{
  std::vector<Eigen::Triplet<double> > triplets;
  for(int c = 0; c < size; ++c) {
    if(random.get_int(0, 10) == 0) continue;
    triplets.emplace_back(c, c, random.get_double(1, 2));
    for(int n = 0; n < entries; ++n) triplets.emplace_back(random.get_int(c, size), c, random.get_double(-1, 1));
  }
  Triangle lower(size, size);
  lower.setFromTriplets(triplets.begin(), triplets.end());
  return lower;
}

} // namespace

TEST_CASE("Symmetric matrix: products with vectors agree with Eigen's, and do not depend on the number of threads")
{
  CGAL::Random random(5);
  for(int size : { 1, 2, 7, 100, 9000 })
    for(int entries : { 0, 3, 40 }) {
      const Triangle lower = random_triangle(random, size, entries);
      const Eigen::VectorXd x = Eigen::VectorXd::Random(size), y = Eigen::VectorXd::Random(size);
      const BS::internal::Symmetric_matrix<CGAL::Sequential_tag> A(lower);
      const BS::internal::Symmetric_matrix<CGAL::Parallel_if_available_tag> B(lower);
      const Eigen::VectorXd expected = lower.selfadjointView<Eigen::Lower>() * x;
      Eigen::VectorXd by_one(size), by_several(size), difference = y;
      by_one.noalias() = A * x;
      by_several.noalias() = B * x;
      difference -= A * x;
      CHECK((by_one - expected).cwiseAbs().maxCoeff() < 1e-12 * (1 + entries));
      CHECK((difference - (y - expected)).cwiseAbs().maxCoeff() < 1e-12 * (1 + entries));
      CHECK(by_one == by_several);
      by_one.noalias() = A * y; // sums of the last product must be discarded
      CHECK((by_one - lower.selfadjointView<Eigen::Lower>() * y).cwiseAbs().maxCoeff() < 1e-12 * (1 + entries));
    }
}
} // namespace test_Symmetric_matrix
