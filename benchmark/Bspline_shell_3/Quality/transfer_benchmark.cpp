// Compares the map between a mesh and the same mesh simplified in its shell with common methods that need no shell: the
// closest point, and the ray along the interpolated vertex normal. Prints one JSON object per line, for each mesh,
// method and direction.
//
//   transfer_benchmark [--points N] [--thickness T] [MESH ...]
//
// Default: 100000 points on elephant; shells of 1 % of the longest side of the mesh's box, which is the unit of all
// lengths here. The methods map a point p of the source as follows:
//
//   shell_map      Shell_map_3: along the integral curve through p
//   closest_point  to the point of the target that is closest to p
//   normal_ray     to the nearest intersection of the target with the line through p along the interpolated vertex
//                  normals. Both directions and both sides of facets are permitted. The distance is at most two
//                  thicknesses of the shell: the length in the shell of a line inclined to the gradient by 60 degrees,
//                  if the gradient is 1.
//
// None of the measured quantities depends on the shell:
//
//   faces_away     share of random points whose image is on a facet that faces away: the dot product of both facets'
//                  normals is negative. The two sides of a wall, or of a gap, face opposite ways; neighboring parts of
//                  both meshes face the same way. So this detects every image across a wall. It also counts correct
//                  images at creases sharper than 90 degrees.
//   wrong_sheet    the same without creases: no facet of the target that faces as the source does is connected with the
//                  image's facet by facets that meet a ball around the image. Its radius is twice the distance from
//                  the point to the image.
//   not_covered    share of random points without an image
//   folded         share of random points where the map turns over or flattens small triangles. These are similar to
//                  the point's facet, with edges of at most 1e-4. The image of a triangle is folded if it does not face
//                  as any facet of its corners' images. It is flat if its height over the longest edge is at most twice
//                  1e-9, the tolerance of Shell_map_3 for each corner.
//   torn           share of the area where the map jumps. The source's facets are subdivided into about N triangles.
//                  Edges of these are bisected 20 times; the half whose images are farther apart is kept. The map jumps
//                  if the images are finally farther apart than half of the edge. A continuous map would have to
//                  stretch it by 500000. Edges stretched to less than twice their length are not examined.
//   stretched      share of their area with an edge whose images are more than ten times as far apart
//   not_hit        share of random points q of the target that are not the image of a point. All candidates for that
//                  point are known: the image of q by the inverse map; points of the source on the target's normal at
//                  q; or solutions of a cubic equation for each nearby facet of the source. Each candidate is mapped;
//                  q is hit if an image is within 1e-6, far more than rounding errors.
//   round_trip     there and back by the same method: mean and largest distance of returned points from their start,
//                  and the share of lost points
//   microseconds   per random point, one thread; all methods process them in the same spatially sorted order
//
// Successive self-parameterization (Liu et al., "Surface Multigrid via Intrinsic Prolongation", 2021) is not compared.
// It updates a map during decimation, so it maps a mesh only to its own decimation, not to a given second mesh.
#include "../AABB_tree_of.h"
#include "../meshes_in_shell.h"

#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/locate.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Real_timer.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/spatial_sort.h>

#include <boost/math/tools/roots.hpp>
#include <boost/property_map/function_property_map.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace PMP = CGAL::Polygon_mesh_processing;
typedef Kernel::Point_3 Point;
typedef Kernel::Vector_3 Vector;
typedef std::array<double, 3> Weights; // barycentric coordinates
typedef AABB_tree_of<Kernel, CGAL::AABB_face_graph_triangle_primitive<Mesh> > Mesh_tree;

const double tolerance = 1e-9; // the tolerance of Shell_map_3, in units of the box

double distance(const Point& p, const Point& q)
{
  return std::sqrt(CGAL::squared_distance(p, q));
}

struct Place
{
  bool is_found = false;
  Mesh::Face_index facet;
  Weights weights = {};
  Point point;
};

// A mesh with the data used by the methods. Its tree is built before time is measured.
struct Surface
{
  explicit Surface(const Mesh& mesh) : mesh(mesh), tree(faces(mesh).begin(), faces(mesh).end(), mesh)
  {
    for(Mesh::Face_index f : mesh.faces()) facet_normals.push_back(PMP::compute_face_normal(f, mesh));
    for(Mesh::Vertex_index v : mesh.vertices()) vertex_normals.push_back(PMP::compute_vertex_normal(v, mesh));
    tree.build();
    tree.accelerate_distance_queries();
  }

  std::array<Mesh::Vertex_index, 3> corners(Mesh::Face_index f) const
  {
    const auto h = mesh.halfedge(f);
    return { mesh.source(h), mesh.target(h), mesh.target(mesh.next(h)) };
  }
  Place place(Mesh::Face_index f, const Weights& w) const
  {
    const auto v = corners(f);
    return { true, f, w, CGAL::barycenter(mesh.point(v[0]), w[0], mesh.point(v[1]), w[1], mesh.point(v[2]), w[2]) };
  }
  Place place(Mesh::Face_index f, const Point& p) const
  {
    return { true, f, PMP::locate_in_face(p, f, mesh).second, p };
  }
  const Vector& normal(const Place& p) const { return facet_normals[p.facet]; }

  const Mesh& mesh;
  std::vector<Vector> facet_normals, vertex_normals;
  Mesh_tree tree;
};

// Each method returns the image of a place, and candidates for places with a given image.
struct Along_curve
{
  const BS::Shell_map_3<Shell, Mesh>&map, &inverse;

  static Place traced(const BS::Shell_map_3<Shell, Mesh>& map, const Place& p)
  {
    const auto image = map({ p.facet, p.weights });
    return { bool(image), image.location.first, image.location.second, image.point };
  }
  Place operator()(const Place& p) const { return traced(map, p); }
  std::vector<Place> origins(const Place& q) const
  {
    const Place p = traced(inverse, q);
    return p.is_found ? std::vector<Place>{ p } : std::vector<Place>();
  }
};

// Returns the intersections of the line through a point with a surface, up to a distance.
std::vector<Place> on_line(const Surface& surface, const Point& p, const Vector& direction, double farthest)
{
  std::vector<Mesh::Face_index> facets;
  const Vector way = farthest * direction;
  surface.tree.all_intersected_primitives(Kernel::Segment_3(p - way, p + way), std::back_inserter(facets));
  std::vector<Place> places;
  for(Mesh::Face_index f : facets) {
    const double slope = direction * surface.facet_normals[f];
    const double t = (surface.mesh.point(surface.corners(f)[0]) - p) * surface.facet_normals[f] / slope;
    if(std::abs(t) <= farthest) places.push_back(surface.place(f, p + t * direction));
  }
  return places;
}

struct To_closest_point
{
  const Surface &source, &target;
  double farthest;

  Place operator()(const Place& p) const
  {
    const auto closest = target.tree.closest_point_and_primitive(p.point);
    return target.place(closest.second, closest.first);
  }
  std::vector<Place> origins(const Place& q) const { return on_line(source, q.point, target.normal(q), farthest); }
};

struct Along_normal
{
  const Surface &source, &target;
  double farthest;

  Place operator()(const Place& p) const
  {
    const auto v = source.corners(p.facet);
    Vector n = CGAL::NULL_VECTOR;
    for(int i = 0; i < 3; ++i) n = n + p.weights[i] * source.vertex_normals[v[i]];
    if(!(n.squared_length() > 0)) return {};
    Place nearest;
    for(const Place& hit : on_line(target, p.point, n / std::sqrt(n.squared_length()), farthest))
      if(!nearest.is_found || CGAL::compare_distance_to_point(p.point, hit.point, nearest.point) == CGAL::SMALLER)
        nearest = hit;
    return nearest;
  }

  // A facet moved by t times its vertex normals is a triangle, whose plane contains q at zeros of a determinant, cubic
  // in t. As the interpolated normals may be shorter than 1, t may exceed `farthest`. Unless normals differ by more
  // than 120 degrees, it is at most twice as large.
  std::vector<Place> origins(const Place& q) const
  {
    std::vector<Mesh::Face_index> facets;
    const Vector reach(farthest, farthest, farthest);
    source.tree.all_intersected_primitives(Kernel::Iso_cuboid_3(q.point - reach, q.point + reach),
                                           std::back_inserter(facets));
    std::vector<Place> places;
    for(Mesh::Face_index f : facets) {
      const auto v = source.corners(f);
      Eigen::Matrix3d start, slope; // corners relative to q, in units of `farthest`
      for(int i = 0; i < 3; ++i)
        for(int a = 0; a < 3; ++a) {
          start(a, i) = (source.mesh.point(v[i])[a] - q.point[a]) / farthest;
          slope(a, i) = source.vertex_normals[v[i]][a];
        }
      const auto det = [&](double t) { return (start + t * slope).determinant(); };
      for(const auto& range : monotone_ranges(det(0), det(1), det(-1), slope.determinant())) {
        const double low = det(range.first), high = det(range.second);
        if(!((low <= 0 && high >= 0) || (low >= 0 && high <= 0)) || low == high) continue;
        const auto root = boost::math::tools::bisect(det, range.first, range.second,
                                                     boost::math::tools::eps_tolerance<double>(50));
        Eigen::Matrix<double, 4, 3> conditions;
        conditions << start + root.first * slope, Eigen::RowVector3d::Ones();
        const Eigen::Vector3d w = conditions.colPivHouseholderQr().solve(Eigen::Vector4d(0, 0, 0, 1));
        if(w.minCoeff() >= 0) places.push_back(source.place(f, Weights{ w[0], w[1], w[2] }));
      }
    }
    return places;
  }

  // Returns the parts of [-2, 2] on which a cubic polynomial is monotone. It is given by its values at 0, 1 and -1, and
  // its leading coefficient.
  static std::vector<std::pair<double, double> > monotone_ranges(double at_0, double at_1, double at_minus_1,
                                                                 double leading)
  {
    // the derivative is a t^2 + b t + c
    const double a = 3 * leading, b = at_1 + at_minus_1 - 2 * at_0, c = (at_1 - at_minus_1) / 2 - leading;
    std::vector<double> ends = { -2, 2 };
    const double discriminant = b * b - 4 * a * c;
    if(discriminant > 0) {
      const double q = -(b + std::copysign(std::sqrt(discriminant), b)) / 2;
      for(double t : { q / a, c / q })
        if(std::abs(t) < 2) ends.push_back(t);
    }
    std::sort(ends.begin(), ends.end());
    std::vector<std::pair<double, double> > ranges;
    for(std::size_t n = 1; n < ends.size(); ++n) ranges.emplace_back(ends[n - 1], ends[n]);
    return ranges;
  }
};

std::vector<Place> random_places(const Surface& surface, std::size_t number, unsigned int seed)
{
  std::vector<Place> places;
  for(const auto& location : random_locations(surface.mesh, number, seed))
    places.push_back(surface.place(location.first, location.second));
  const auto point = boost::make_function_property_map<Place>([](const Place& p) -> const Point& { return p.point; });
  CGAL::spatial_sort(places.begin(), places.end(), CGAL::Spatial_sort_traits_adapter_3<Kernel, decltype(point)>(point));
  return places;
}

struct Figures
{
  std::size_t points = 0, faces_away = 0, wrong_sheet = 0, not_covered = 0, folded = 0, lost = 0, not_hit = 0;
  double area = 0, torn = 0, stretched = 0; // areas of small triangles with images
  double round_trip = 0, farthest = 0, seconds = 0;
};

// Returns whether facets near the image of a point connect it with a facet that does not face away from a normal.
bool is_at_crease(const Surface& target, const Place& image, const Point& p, const Vector& normal)
{
  const double radius = 2 * distance(p, image.point);
  std::set<Mesh::Face_index> seen = { image.facet };
  std::vector<Mesh::Face_index> facets = { image.facet };
  while(!facets.empty()) {
    const Mesh::Face_index f = facets.back();
    facets.pop_back();
    if(target.facet_normals[f] * normal >= 0) return true;
    for(Mesh::Face_index g : target.mesh.faces_around_face(target.mesh.halfedge(f))) {
      if(g == Mesh::null_face() || !seen.insert(g).second) continue;
      const auto v = target.corners(g);
      const Kernel::Triangle_3 t(target.mesh.point(v[0]), target.mesh.point(v[1]), target.mesh.point(v[2]));
      if(CGAL::squared_distance(image.point, t) <= radius * radius) facets.push_back(g);
    }
  }
  return false;
}

// Returns whether small triangles at a place are turned over or flattened.
template <typename Method>
bool is_folded(const Method& there, const Surface& source, const Surface& target, const Place& p, double unit)
{
  const auto v = source.corners(p.facet);
  const auto longest_edge = [](const auto& t) {
    return (std::max)({ distance(t[0], t[1]), distance(t[1], t[2]), distance(t[2], t[0]) });
  };
  const std::array<Point, 3> facet = { source.mesh.point(v[0]), source.mesh.point(v[1]), source.mesh.point(v[2]) };
  const double scale = (std::min)(1., 1e-4 * unit / longest_edge(facet));
  std::array<Place, 3> images;
  std::array<Point, 3> t;
  for(int i = 0; i < 3; ++i) {
    Weights w;
    for(int j = 0; j < 3; ++j) w[j] = (1 - scale) * p.weights[j] + (i == j ? scale : 0);
    images[i] = there(source.place(p.facet, w));
    if(!images[i].is_found) return false;
    t[i] = images[i].point;
  }
  const Vector across = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
  const double flat = 2 * tolerance * unit * longest_edge(t);
  return std::none_of(images.begin(), images.end(),
                      [&](const Place& image) { return across * target.normal(image) > flat; });
}

// Returns whether the map jumps between two places of a facet, whose images are given.
template <typename Method>
bool is_torn(const Method& there, const Surface& source, const Place& p, const Place& q, const Place& image_of_p,
             const Place& image_of_q)
{
  const double length = distance(p.point, q.point);
  if(distance(image_of_p.point, image_of_q.point) < 2 * length) return false;
  Place a = p, b = q, image_of_a = image_of_p, image_of_b = image_of_q;
  for(int n = 0; n < 20; ++n) {
    Weights w;
    for(int i = 0; i < 3; ++i) w[i] = (a.weights[i] + b.weights[i]) / 2;
    const Place middle = source.place(p.facet, w), image = there(middle);
    if(!image.is_found) return true;
    if(CGAL::squared_distance(image.point, image_of_a.point) > CGAL::squared_distance(image.point, image_of_b.point)) {
      b = middle;
      image_of_b = image;
    } else {
      a = middle;
      image_of_a = image;
    }
  }
  return distance(image_of_a.point, image_of_b.point) > length / 2;
}

// Subdivides the facets of the source into about `number` triangles, and finds torn and stretched ones.
template <typename Method>
void map_small_triangles(const Method& there, const Surface& source, std::size_t number, Figures& result)
{
  const double area = PMP::area(source.mesh);
  for(Mesh::Face_index f : source.mesh.faces()) {
    const double share = PMP::face_area(f, source.mesh) / area;
    const int k = (std::max)(1, int(std::ceil(std::sqrt(share * double(number)))));
    std::vector<Place> places, images;
    for(int j = 0; j <= k; ++j)
      for(int i = 0; i <= k - j; ++i)
        places.push_back(source.place(f, Weights{ double(k - i - j) / k, double(i) / k, double(j) / k }));
    for(const Place& p : places) images.push_back(there(p));
    const auto index = [k](int i, int j) { return std::size_t(j * (2 * k + 3 - j) / 2 + i); };
    const auto examine = [&](const std::array<std::size_t, 3>& v) {
      for(std::size_t n : v)
        if(!images[n].is_found) return;
      bool torn = false, stretched = false;
      for(int i = 0; i < 3; ++i) {
        const std::size_t a = v[i], b = v[(i + 1) % 3];
        stretched = stretched
                    || distance(images[a].point, images[b].point) > 10 * distance(places[a].point, places[b].point);
        torn = torn || is_torn(there, source, places[a], places[b], images[a], images[b]);
      }
      const double part = share / (double(k) * k);
      result.area += part;
      result.torn += torn ? part : 0;
      result.stretched += stretched ? part : 0;
    };
    for(int j = 0; j < k; ++j)
      for(int i = 0; i < k - j; ++i) {
        examine({ index(i, j), index(i + 1, j), index(i, j + 1) });
        if(i + j + 1 < k) examine({ index(i + 1, j), index(i + 1, j + 1), index(i, j + 1) });
      }
  }
}

template <typename Method>
bool is_hit(const Method& there, const Place& q, double unit)
{
  for(const Place& p : there.origins(q)) {
    const Place image = there(p);
    if(image.is_found && distance(image.point, q.point) < 1e-6 * unit) return true;
  }
  return false;
}

template <typename Method>
Figures measure(const Method& there, const Method& back, const Surface& source, const Surface& target,
                std::size_t number, double unit)
{
  Figures result;
  const std::vector<Place> places = random_places(source, number, 3);
  std::vector<Place> images(places.size());
  CGAL::Real_timer timer;
  timer.start();
  std::transform(places.begin(), places.end(), images.begin(), there);
  result.seconds = timer.time();
  result.points = places.size();
  for(std::size_t n = 0; n < places.size(); ++n) {
    if(!images[n].is_found) {
      ++result.not_covered;
      ++result.lost;
      continue;
    }
    if(source.normal(places[n]) * target.normal(images[n]) < 0) {
      ++result.faces_away;
      if(!is_at_crease(target, images[n], places[n].point, source.normal(places[n]))) ++result.wrong_sheet;
    }
    if(is_folded(there, source, target, places[n], unit)) ++result.folded;
    const Place returned = back(images[n]);
    if(!returned.is_found) {
      ++result.lost;
      continue;
    }
    const double way = distance(places[n].point, returned.point) / unit;
    result.round_trip += way;
    result.farthest = (std::max)(result.farthest, way);
  }
  map_small_triangles(there, source, number, result);
  for(const Place& q : random_places(target, number, 5)) result.not_hit += is_hit(there, q, unit) ? 0 : 1;
  return result;
}

void print(const std::string& mesh, const std::string& method, const std::string& direction, const Surface& source,
           const Surface& target, const Shell& shell, double requested_thickness, const Figures& f)
{
  const double points = double(f.points), returned = double(f.points - f.lost);
  std::cout << "{\"mesh\":" << quoted(mesh) << ",\"method\":\"" << method << "\",\"direction\":\"" << direction
            << "\",\"facets\":" << source.mesh.number_of_faces()
            << ",\"facets_of_target\":" << target.mesh.number_of_faces()
            << ",\"thickness\":{\"requested\":" << requested_thickness
            << ",\"largest\":" << shell.report().thickness / shell.report().unit
            << ",\"narrowed_area\":" << shell.report().narrowed_area << "},\"points\":" << f.points
            << ",\"faces_away\":" << double(f.faces_away) / points
            << ",\"wrong_sheet\":" << double(f.wrong_sheet) / points
            << ",\"not_covered\":" << double(f.not_covered) / points << ",\"folded\":" << double(f.folded) / points
            << ",\"torn\":" << f.torn / f.area << ",\"stretched\":" << f.stretched / f.area
            << ",\"not_hit\":" << double(f.not_hit) / points << ",\"round_trip\":{\"lost\":" << double(f.lost) / points
            << ",\"mean\":" << f.round_trip / returned << ",\"farthest\":" << f.farthest
            << "},\"microseconds\":" << 1e6 * f.seconds / points << "}" << std::endl;
}

void compare(const std::string& file, double thickness, std::size_t points)
{
  const auto give_up = [&](const std::string& reason) {
    std::cout << "{\"mesh\":" << quoted(mesh_name(file)) << ",\"status\":" << quoted(reason) << "}" << std::endl;
  };
  Mesh mesh;
  if(!read_triangles(file, mesh)) return give_up("no mesh");
  const Shell shell = CGAL::certified_bspline_shell_3(mesh, BS::parameters::relative_thickness(thickness));
  if(!shell.is_certified()) return give_up("no certified shell");
  Mesh simplified = mesh;
  const auto result = BS::simplify_in_shell(simplified, shell);
  if(!result) return give_up(message(result.status));
  simplified.collect_garbage();

  const double unit = shell.report().unit;
  const Surface fine(mesh), coarse(simplified);
  const BS::Shell_map_3<Shell, Mesh> map(shell, mesh, simplified), inverse = map.inverse();
  const auto measure_both_ways = [&](const std::string& name, const auto& to_coarse, const auto& to_fine) {
    print(mesh_name(file), name, "to simplified", fine, coarse, shell, thickness,
          measure(to_coarse, to_fine, fine, coarse, points, unit));
    print(mesh_name(file), name, "from simplified", coarse, fine, shell, thickness,
          measure(to_fine, to_coarse, coarse, fine, points, unit));
  };
  const double farthest = 2 * shell.thickness();
  measure_both_ways("shell_map", Along_curve{ map, inverse }, Along_curve{ inverse, map });
  measure_both_ways("closest_point", To_closest_point{ fine, coarse, farthest },
                    To_closest_point{ coarse, fine, farthest });
  measure_both_ways("normal_ray", Along_normal{ fine, coarse, farthest }, Along_normal{ coarse, fine, farthest });
}

int main(int argc, char** argv)
{
  print_JSON_numbers();
  double thickness = 0.01;
  std::size_t points = 100000;
  std::vector<std::string> files;
  for(int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    if(arg == "--points" && i + 1 < argc) points = std::size_t(std::atoll(argv[++i]));
    else if(arg == "--thickness" && i + 1 < argc) thickness = std::atof(argv[++i]);
    else files.push_back(arg);
  }
  if(!(points > 0 && thickness > 0)) {
    std::cerr << "Usage: transfer_benchmark [--points N] [--thickness T] [MESH ...]\n";
    return 2;
  }
  if(files.empty()) files.push_back(MESHES "/elephant.off");
  for(const std::string& file : files) compare(file, thickness, points);
  return EXIT_SUCCESS;
}
