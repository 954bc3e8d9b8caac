// Transfers tangent fields at facets to the mesh simplified in its shell, and back. Angles to the same field, given by
// a formula, are in degrees. Prints one JSON object per line, for each mesh and symmetry (1: vectors, 4: crosses).
//
//   fields_benchmark [--thickness T] [MESH ...]
//
// "there" compares at the centroids of the simplified mesh, "back" at those of the mesh. "nearest" uses one vector per
// facet. "mean" uses samples_per_facet(16) there, and linear_reconstruction(true) back. "sampling" is the
// discretization error, which is not due to the map: the angle between the formula at 16 places of each facet of the
// simplified mesh, and at the centroid. Angles are means over the area.
#include "../meshes_in_shell.h"

#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_tangent_vectors.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

typedef Mesh::Property_map<Mesh::Face_index, Kernel::Vector_3> Vectors;

struct Triangle
{
  Triangle(const Mesh& mesh, Mesh::Face_index f)
  {
    const auto h = mesh.halfedge(f);
    p = mesh.point(mesh.source(h));
    q = mesh.point(mesh.target(h));
    r = mesh.point(mesh.target(mesh.next(h)));
    normal = CGAL::cross_product(q - p, r - p);
  }
  Kernel::Point_3 at(double a, double b, double c) const { return CGAL::barycenter(p, a, q, b, r, c); }
  Kernel::Point_3 centroid() const { return CGAL::centroid(p, q, r); }
  double area() const { return std::sqrt(normal.squared_length()) / 2; }

  Kernel::Point_3 p, q, r;
  Kernel::Vector_3 normal;
};

// A field around an axis, which turns slowly along it.
struct Formula
{
  explicit Formula(const CGAL::Bbox_3& box)
    : middle((box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2, (box.zmin() + box.zmax()) / 2),
      unit((std::max)({ box.x_span(), box.y_span(), box.z_span() }))
  {}

  Kernel::Vector_3 operator()(const Kernel::Point_3& p, const Kernel::Vector_3& normal) const
  {
    const Kernel::Vector_3 d = (p - middle) / unit, v = CGAL::cross_product(Kernel::Vector_3(0.4, 0.5, 1), d)
                                                        + 0.3 * Kernel::Vector_3(1, 0.7, -0.5);
    const double n = normal.squared_length();
    return n > 0 ? v - (v * normal / n) * normal : v;
  }

  Kernel::Point_3 middle;
  double unit;
};

// Returns the angle up to the field's rotational symmetry, in degrees.
double angle(const Kernel::Vector_3& u, const Kernel::Vector_3& v, const Kernel::Vector_3& normal, int symmetry)
{
  const double step = 360. / symmetry,
               a = std::atan2(CGAL::cross_product(u, v) * normal / std::sqrt(normal.squared_length()), u * v) * 180
                   / CGAL_PI;
  return std::abs(a - step * std::round(a / step));
}

struct Mean
{
  void add(double x, double weight)
  {
    sum += weight * x;
    total += weight;
  }
  double sum = 0, total = 0;
};
std::ostream& operator<<(std::ostream& out, const Mean& m)
{
  return out << m.sum / m.total;
}

Mean mean_angle(const Mesh& mesh, const Formula& formula, const Vectors& vectors, int symmetry)
{
  Mean mean;
  for(Mesh::Face_index f : mesh.faces()) {
    const Triangle t(mesh, f);
    if(t.area() > 0) mean.add(angle(formula(t.centroid(), t.normal), vectors[f], t.normal, symmetry), t.area());
  }
  return mean;
}

Mean sampling_angle(const Mesh& mesh, const Formula& formula, int symmetry)
{
  constexpr int parts = 4;
  Mean mean;
  for(Mesh::Face_index f : mesh.faces()) {
    const Triangle t(mesh, f);
    if(!(t.area() > 0)) continue;
    const Kernel::Vector_3 v = formula(t.centroid(), t.normal);
    for(int i = 0; i < parts; ++i)
      for(int j = 0; i + j < parts; ++j)
        for(int turned = 0; turned < (i + j + 1 < parts ? 2 : 1); ++turned) {
          const double a = (3 * i + 1 + turned) / (3. * parts), b = (3 * j + 1 + turned) / (3. * parts);
          mean.add(angle(v, formula(t.at(1 - a - b, a, b), t.normal), t.normal, symmetry), t.area());
        }
  }
  return mean;
}

void measure(const std::string& file, double thickness)
{
  Mesh mesh;
  std::optional<Shell> shell;
  if(read_triangles(file, mesh))
    shell = CGAL::certified_bspline_shell_3(mesh, BS::parameters::relative_thickness(thickness));
  Mesh coarse = mesh;
  if(!shell || !shell->is_certified() || !BS::simplify_in_shell(coarse, *shell)) {
    std::cout << "{\"mesh\":" << quoted(mesh_name(file)) << ",\"status\":\"no certified pair of meshes\"}" << std::endl;
    return;
  }
  coarse.collect_garbage();
  const Formula formula(CGAL::Polygon_mesh_processing::bbox(mesh));
  const BS::Shell_map_3<Shell, Mesh> map(*shell, mesh, coarse);
  const Vectors given = mesh.add_property_map<Mesh::Face_index, Kernel::Vector_3>("f:given").first,
                back = mesh.add_property_map<Mesh::Face_index, Kernel::Vector_3>("f:back").first,
                there = coarse.add_property_map<Mesh::Face_index, Kernel::Vector_3>("f:there").first;
  for(Mesh::Face_index f : mesh.faces()) {
    const Triangle t(mesh, f);
    given[f] = formula(t.centroid(), t.normal);
  }
  for(int symmetry : { 1, 4 }) {
    std::cout << "{\"mesh\":" << quoted(mesh_name(file)) << ",\"facets\":" << mesh.number_of_faces()
              << ",\"simplified\":" << coarse.number_of_faces() << ",\"symmetry\":" << symmetry
              << ",\"sampling\":" << sampling_angle(coarse, formula, symmetry);
    for(bool mean : { false, true }) {
      const std::size_t samples = mean ? 16 : 1;
      const auto first = BS::transfer_tangent_vectors(map, given, there,
                                                      BS::parameters::symmetry(symmetry).samples_per_facet(samples));
      const auto second = BS::transfer_tangent_vectors(map.inverse(), there, back,
                                                       BS::parameters::symmetry(symmetry).linear_reconstruction(mean));
      std::cout << ",\"" << (mean ? "mean" : "nearest")
                << "\":{\"there\":" << mean_angle(coarse, formula, there, symmetry)
                << ",\"back\":" << mean_angle(mesh, formula, back, symmetry)
                << ",\"lost\":" << first.failures.size() + second.failures.size() << "}";
    }
    std::cout << "}" << std::endl;
  }
}

int main(int argc, char** argv)
{
  print_JSON_numbers();
  double thickness = 0.01;
  std::vector<std::string> files;
  for(int i = 1; i < argc; ++i) {
    if(std::string(argv[i]) == "--thickness" && i + 1 < argc) thickness = std::atof(argv[++i]);
    else files.push_back(argv[i]);
  }
  if(!(thickness > 0)) {
    std::cerr << "Usage: fields_benchmark [--thickness T] [MESH ...]\n";
    return 2;
  }
  if(files.empty())
    for(const char* name : { "fandisk", "eight", "elephant", "bear", "anchor_dense" })
      files.push_back(std::string(MESHES "/") + name + ".off");
  for(const std::string& file : files) measure(file, thickness);
  return EXIT_SUCCESS;
}
