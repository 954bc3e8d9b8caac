// Cells of different sizes at random places, and the places that they cover, for searches through all of them.
#ifndef RANDOM_HIERARCHIES_H
#define RANDOM_HIERARCHIES_H

#include <CGAL/Bspline_shell_3/Cells/Cell_hierarchy_3.h>

#include <CGAL/Random.h>

#include <array>
#include <cstdint>
#include <vector>

typedef CGAL::Bspline_shells::Cell_hierarchy_3 Hierarchy;
typedef CGAL::Bspline_shells::Cell_complex_3 Root_cells;
typedef CGAL::Bspline_shells::Lattice_3::Point Lattice_point;

// Returns the cells between two lattice points, both included, that satisfy a predicate.
template <typename Predicate>
Root_cells cells_where(const CGAL::Bspline_shells::Lattice_3& lattice, const Lattice_point& first,
                       const Lattice_point& last, const Predicate& is_included)
{
  std::vector<std::uint64_t> keys;
  for(int k = first[2]; k <= last[2]; ++k)
    for(int j = first[1]; j <= last[1]; ++j)
      for(int i = first[0]; i <= last[0]; ++i)
        if(is_included(i, j, k)) keys.push_back(CGAL::Bspline_shells::Lattice_key::encode(i, j, k));
  return Root_cells(lattice, keys);
}

inline Root_cells all_cells(const CGAL::Bspline_shells::Lattice_3& lattice, const Lattice_point& first,
                            const Lattice_point& last)
{
  return cells_where(lattice, first, last, [](int, int, int) { return true; });
}

// Returns all cells of a lattice through the origin.
inline Root_cells all_cells(double width, const Lattice_point& first, const Lattice_point& last)
{
  return all_cells(CGAL::Bspline_shells::Lattice_3::from_origin({ 0, 0, 0 }, width, first, last), first, last);
}

// Returns roughly the given share of the cells.
inline Root_cells some_cells(CGAL::Random& random, const CGAL::Bspline_shells::Lattice_3& lattice,
                             const Lattice_point& first, const Lattice_point& last, double share = 1)
{
  return cells_where(lattice, first, last, [&](int, int, int) { return share >= 1 || random.get_double() < share; });
}

// Returns random leaves of the finest existing level, so that levels grow.
inline std::vector<Hierarchy::Index> random_leaves(CGAL::Random& random, const Hierarchy& cells, int number)
{
  const Hierarchy::Index first = cells.first_leaf(cells.number_of_levels() - 1);
  std::vector<Hierarchy::Index> leaves;
  for(int n = 0; n < number; ++n)
    leaves.push_back(Hierarchy::Index(random.get_int(int(first), int(cells.number_of_cells()))));
  return leaves;
}

// Refines random leaves once for each level beyond the first, as far as levels are available.
inline Hierarchy random_hierarchy(CGAL::Random& random, const Root_cells& roots, int levels, int marked = 1)
{
  Hierarchy cells(roots);
  while(cells.number_of_levels() < levels && cells.number_of_levels() <= cells.max_level())
    cells = cells.refined(random_leaves(random, cells, marked));
  return cells;
}

// The cells of the finest level, each with the leaf that contains it.
class Smallest_cells
{
public:
  explicit Smallest_cells(const Hierarchy& cells) : m_finest(cells.number_of_levels() - 1)
  {
    for(int a = 0; a < 3; ++a) {
      m_first[a] = 1 << 30;
      m_last[a] = -(1 << 30);
    }
    for(Hierarchy::Index c = 0; c < cells.number_of_cells(); ++c)
      for(int a = 0; a < 3; ++a) {
        m_first[a] = (std::min)(m_first[a], begin(cells, c)[a]);
        m_last[a] = (std::max)(m_last[a], begin(cells, c)[a] + size(cells.level(c)) - 1);
      }
    m_leaf.assign(index(m_last) + 1, Hierarchy::npos);
    for(Hierarchy::Index c = 0; c < cells.number_of_cells(); ++c) {
      const Lattice_point p = begin(cells, c);
      for(int k = 0; k < size(cells.level(c)); ++k)
        for(int j = 0; j < size(cells.level(c)); ++j)
          for(int i = 0; i < size(cells.level(c)); ++i) {
            Hierarchy::Index& leaf = m_leaf[index({ p[0] + i, p[1] + j, p[2] + k })];
            overlaps += leaf != Hierarchy::npos;
            leaf = c;
            ++covered;
          }
    }
  }

  // Returns the side of a cell of a level, in smallest cells.
  int size(int level) const { return 1 << (m_finest - level); }
  Lattice_point begin(const Hierarchy& cells, Hierarchy::Index c) const
  {
    const Lattice_point& p = cells.lattice_point(c);
    const int s = size(cells.level(c));
    return { p[0] * s, p[1] * s, p[2] * s };
  }
  const Lattice_point& first() const { return m_first; }
  const Lattice_point& last() const { return m_last; }

  // Returns the leaf at a smallest cell; `npos` outside the cells.
  Hierarchy::Index leaf(const Lattice_point& p) const
  {
    for(int a = 0; a < 3; ++a)
      if(p[a] < m_first[a] || p[a] > m_last[a]) return Hierarchy::npos;
    return m_leaf[index(p)];
  }
  // Returns the leaf at the least corner of a cell of any level.
  Hierarchy::Index leaf(int level, const Lattice_point& p) const
  {
    return leaf({ p[0] * size(level), p[1] * size(level), p[2] * size(level) });
  }

  std::size_t covered = 0, overlaps = 0;

private:
  std::size_t index(const Lattice_point& p) const
  {
    return (std::size_t(p[2] - m_first[2]) * std::size_t(m_last[1] - m_first[1] + 1) + std::size_t(p[1] - m_first[1]))
             * std::size_t(m_last[0] - m_first[0] + 1)
           + std::size_t(p[0] - m_first[0]);
  }

  int m_finest;
  Lattice_point m_first, m_last;
  std::vector<Hierarchy::Index> m_leaf;
};

#endif // RANDOM_HIERARCHIES_H
