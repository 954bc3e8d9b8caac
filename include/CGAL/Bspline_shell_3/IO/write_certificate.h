// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_WRITE_CERTIFICATE_H
#define CGAL_BSPLINE_SHELL_3_IO_WRITE_CERTIFICATE_H

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/IO/write_shell.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <ostream>
#include <string>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3IO
 *
 * \brief returns the checksum that identifies a mesh in a certificate file: that of the coordinates of all vertices and
 * of the vertex indices of all triangles.
 *
 * \param mesh a mesh without removed elements
 */
template <typename Point_3>
std::uint64_t mesh_checksum(const Surface_mesh<Point_3>& mesh)
{
  Checksum sum;
  for(auto v : mesh.vertices())
    for(int a = 0; a < 3; ++a) sum.add(double(mesh.point(v)[a]));
  for(auto f : mesh.faces())
    for(auto v : mesh.vertices_around_face(mesh.halfedge(f))) sum.add(std::uint32_t(v));
  return sum.value();
}

/*!
 * \ingroup PkgBsplineShell3IO
 *
 * \brief writes the data with which an independent program can check a certificate: the boxes of the cover with their
 * directions or centers, and the paths that prove the degree. See \ref BsplineShell3FileFormats.
 *
 * The file identifies the shell by the checksum of its text file. Call `write_shell()` after `certify()`, which may
 * replace the paths in the shell. The file also identifies the examined mesh of the certificate, which the caller must
 * write with 17 digits.
 *
 * \tparam Field, Threshold as for `write_shell()`
 *
 * \param out a stream opened with `std::ios::binary`
 * \param shell the shell
 * \param certificate a certificate for the shell's field and thresholds, verified for some mesh
 * \return whether all data was written
 */
template <typename Field, typename Threshold>
bool write_certificate(std::ostream& out, const Bspline_shell_3<Field, Threshold>& shell,
                       const Shell_certificate_3<Field, Threshold>& certificate)
{
  internal::File_output output(out);
  const auto word = [&](auto x) {
    output.text(" ");
    output.decimal(x);
  };
  const auto& mesh = certificate.examined_mesh();
  output.text("cubic_bspline_shell_certificate 3\nshell " + Checksum::text(shell_checksum(shell)) + "\nmesh");
  word(std::size_t(mesh.number_of_vertices()));
  word(std::size_t(mesh.number_of_faces()));
  output.text(" " + Checksum::text(mesh_checksum(mesh)) + "\nverdicts");
  for(int c = 0; c < 5; ++c) output.text(std::string(" ") + name(certificate.verdict(Claim(c))));

  const std::vector<Cover_box> no_boxes;
  const std::vector<Cover_box>& boxes = certificate.cover() ? certificate.cover()->boxes() : no_boxes;
  std::vector<std::size_t> order(boxes.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return boxes[a].cell < boxes[b].cell; });
  output.text("\nboxes");
  word(boxes.size());
  output.text("\n");
  for(std::size_t n : order) {
    const Cover_box& box = boxes[n];
    output.decimal(std::size_t(box.cell));
    word(std::size_t(box.depth));
    for(std::uint16_t i : box.position) word(std::size_t(i));
    if(box.kind == Box_kind::EXCLUDED) output.text(" x");
    else if(box.component == Cover_box::no_component) output.text(" o");
    else if(box.kind == Box_kind::UNDECIDED) output.text(" u");
    else {
      output.text(box.kind == Box_kind::MONOTONE ? " g" : box.kind == Box_kind::CRITICAL_BELOW ? " b" : " a");
      for(double x : box.proof) word(x);
    }
    output.text("\n");
  }
  // In files, components are numbered in the order of the examined mesh; in certificates, in that of the user's mesh. A
  // seed is a vertex of the first facet of its component.
  const auto& seeds = certificate.seeds();
  constexpr std::size_t none = std::size_t(-1);
  std::vector<std::size_t> component_of_seed(mesh.number_of_vertices(), none), number(seeds.size(), none), component;
  for(std::size_t c = 0; c < seeds.size(); ++c) component_of_seed[seeds[c]] = c;
  for(auto f : mesh.faces()) {
    const std::size_t c = component_of_seed[mesh.target(mesh.halfedge(f))];
    if(c == none || number[c] != none) continue;
    number[c] = component.size();
    component.push_back(c);
  }
  output.text("seeds");
  word(component.size());
  output.text("\n");
  for(std::size_t n = 0; n < component.size(); ++n) {
    output.decimal(n);
    word(std::size_t(seeds[component[n]]));
    output.text("\n");
  }
  output.text("covers");
  word(certificate.number_of_covers());
  output.text("\npaths");
  std::vector<Crossing_path> paths = certificate.paths();
  for(Crossing_path& path : paths) path.component = number[path.component];
  std::sort(paths.begin(), paths.end(),
            [](const Crossing_path& a, const Crossing_path& b) { return a.component < b.component; });
  word(paths.size());
  output.text("\n");
  for(const Crossing_path& path : paths) {
    output.decimal(path.component);
    word(path.triangle);
    for(double x : path.source) word(x);
    for(double x : path.target) word(x);
    output.text("\n");
  }
  output.text("checksum " + Checksum::text(output.checksum()) + "\n");
  return output.flush();
}

/// \ingroup PkgBsplineShell3IO
/// writes a certificate to a file. On failure, an existing file remains unchanged (`write_file()`).
template <typename Field, typename Threshold>
bool write_certificate(const std::string& file, const Bspline_shell_3<Field, Threshold>& shell,
                       const Shell_certificate_3<Field, Threshold>& certificate)
{
  return write_file(file, [&](std::ostream& out) { return write_certificate(out, shell, certificate); });
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_WRITE_CERTIFICATE_H
