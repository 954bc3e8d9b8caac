// Computes the smoothest field of vectors, lines, or crosses on a closed triangle mesh, and its singularities.
// Reference: F. Knoeppel, K. Crane, U. Pinkall, and P. Schroeder, Globally Optimal Direction Fields, 2013; here with
// one vector per facet.
#ifndef DIRECTION_FIELD_H
#define DIRECTION_FIELD_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/number_utils.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <cmath>
#include <complex>
#include <vector>

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
typedef Mesh::Property_map<Mesh::Face_index, Kernel::Vector_3> Vectors;

// A vertex around which N directions turn by `index` / N of a full turn.
struct Singularity
{
  Mesh::Vertex_index vertex;
  int index;
};

// Fields on a mesh without removed simplices. The vector of a facet represents the N directions with the same N-th
// power. Vectors are complex numbers; the real axis is along the facet's halfedge.
class Direction_field_space
{
  typedef std::complex<double> Complex;
public:
  Direction_field_space(const Mesh& mesh, int directions) : m_mesh(mesh), m_directions(directions) {}

  // Computes the field of a given norm that changes least across edges: an eigenvector of the connection Laplacian.
  // Vectors are long where the direction is well determined. Returns whether the field was found.
  bool find_smoothest(Vectors field) const
  {
    const Eigen::Index size = Eigen::Index(m_mesh.num_faces());
    std::vector<Eigen::Triplet<Complex> > entries;
    Eigen::VectorXd mass(size);
    double stiffness = 0;
    for(Mesh::Face_index f : m_mesh.faces()) mass[int(f)] = area(m_mesh.halfedge(f));
    for(Mesh::Edge_index e : m_mesh.edges()) {
      const Mesh::Halfedge_index h = m_mesh.halfedge(e), g = m_mesh.opposite(h);
      const int i = int(m_mesh.face(h)), j = int(m_mesh.face(g));
      // the length of the edge divided by the distance between the two centroids, in the unfolded plane
      const Eigen::Vector2d distance = centroid(h) + centroid(g) - Eigen::Vector2d(edge(h).norm(), 0);
      const double weight = edge(h).norm() / distance.norm();
      const Complex transport = std::polar(1., m_directions * turn(h));
      entries.emplace_back(i, i, weight);
      entries.emplace_back(j, j, weight);
      entries.emplace_back(j, i, -weight * transport);
      entries.emplace_back(i, j, -weight * std::conj(transport));
      stiffness += 2 * weight;
    }
    // A small shift keeps the matrix regular if a field can be constant, as on a flat torus.
    const double shift = 1e-9 * stiffness / mass.sum();
    for(int i = 0; i < size; ++i) entries.emplace_back(i, i, shift * mass[i]);
    Eigen::SparseMatrix<Complex> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<Complex> > solver(matrix);
    if(solver.info() != Eigen::Success) return false;

    // inverse power iteration
    Eigen::VectorXcd z = Eigen::VectorXcd::Ones(size);
    double value = 0, last = -1;
    for(int n = 0; n < 1000 && std::abs(value - last) > 1e-12 * value; ++n) {
      z = solver.solve(mass.cast<Complex>().cwiseProduct(z));
      z *= std::sqrt(mass.sum() / mass.dot(z.cwiseAbs2()));
      last = value;
      value = z.dot(matrix * z).real();
    }
    for(Mesh::Face_index f : m_mesh.faces()) {
      const double angle = std::arg(z[int(f)]) / m_directions;
      const Eigen::Vector3d x = edge(m_mesh.halfedge(f)).normalized(), y = normal(m_mesh.halfedge(f)).cross(x);
      const Eigen::Vector3d u = std::abs(z[int(f)]) * (std::cos(angle) * x + std::sin(angle) * y);
      field[f] = Kernel::Vector_3(u[0], u[1], u[2]);
    }
    return std::isfinite(value);
  }

  // Returns the singularities, whose indices add up to N times the Euler characteristic.
  std::vector<Singularity> singularities(Vectors field) const
  {
    std::vector<Singularity> result;
    for(Mesh::Vertex_index v : m_mesh.vertices()) {
      double sum = 2 * CGAL_PI * m_directions; // adds up curvature and changes of the field
      for(Mesh::Halfedge_index h : m_mesh.halfedges_around_target(m_mesh.halfedge(v)))
        sum += change(h, field) - m_directions * angle(m_mesh.opposite(h));
      const int index = int(std::lround(sum / (2 * CGAL_PI)));
      if(index != 0) result.push_back({ v, index });
    }
    return result;
  }

  // Returns the angle between two fields on a facet, in degrees.
  double angle(Mesh::Face_index f, Vectors first, Vectors second) const
  {
    return std::abs(std::arg(power(f, first) * std::conj(power(f, second)))) / m_directions * 180 / CGAL_PI;
  }

private:
  Eigen::Vector3d edge(Mesh::Halfedge_index h) const
  {
    const Kernel::Vector_3 e = m_mesh.point(m_mesh.target(h)) - m_mesh.point(m_mesh.source(h));
    return Eigen::Vector3d(e.x(), e.y(), e.z());
  }
  Eigen::Vector3d cross(Mesh::Halfedge_index h) const { return edge(h).cross(edge(m_mesh.next(h))); }
  Eigen::Vector3d normal(Mesh::Halfedge_index h) const { return cross(h).normalized(); }
  double area(Mesh::Halfedge_index h) const { return cross(h).norm() / 2; }
  // Returns the angle of the facet at the source.
  double angle(Mesh::Halfedge_index h) const { return std::atan2(cross(h).norm(), -edge(h).dot(edge(m_mesh.prev(h)))); }
  // Returns the centroid of the facet, relative to the source; axes are along the edge and into the facet.
  Eigen::Vector2d centroid(Mesh::Halfedge_index h) const
  {
    const Eigen::Vector3d to = (edge(h) - edge(m_mesh.prev(h))) / 3, x = edge(h).normalized();
    return Eigen::Vector2d(x.dot(to), normal(h).cross(x).dot(to));
  }

  // Returns the angle of a vector relative to the axes of the halfedge's facet.
  double polar_angle(Mesh::Halfedge_index h, const Eigen::Vector3d& v) const
  {
    const Mesh::Halfedge_index first = m_mesh.halfedge(m_mesh.face(h));
    const Eigen::Vector3d x = edge(first).normalized();
    return std::atan2(normal(first).cross(x).dot(v), x.dot(v));
  }
  // Returns the rotation from the axes of the halfedge's facet to those of the facet across the edge.
  double turn(Mesh::Halfedge_index h) const
  {
    return polar_angle(m_mesh.opposite(h), edge(h)) - polar_angle(h, edge(h));
  }

  Complex power(Mesh::Face_index f, Vectors field) const
  {
    const Eigen::Vector3d u(field[f].x(), field[f].y(), field[f].z());
    return std::polar(u.norm(), m_directions * polar_angle(m_mesh.halfedge(f), u));
  }
  // Returns the rotation of the N-th power across the edge. A half turn has the same sign from both sides.
  double change(Mesh::Halfedge_index h, Vectors field) const
  {
    const Mesh::Halfedge_index g = m_mesh.opposite(h);
    if(g < h) return -change(g, field);
    return std::arg(power(m_mesh.face(g), field)
                    * std::conj(power(m_mesh.face(h), field) * std::polar(1., m_directions * turn(h))));
  }

  const Mesh& m_mesh;
  int m_directions;
};

#endif // DIRECTION_FIELD_H
