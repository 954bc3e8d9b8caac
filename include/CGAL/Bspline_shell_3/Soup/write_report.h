// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_WRITE_REPORT_H
#define CGAL_BSPLINE_SHELL_3_SOUP_WRITE_REPORT_H

#include <CGAL/Bspline_shell_3/Shell/Shell_report.h>
#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/Soup_shares.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <ios>
#include <locale>
#include <ostream>
#include <string>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// Writes the members of a JSON object, one per line. Objects in it are written on a single line.
class JSON_object
{
public:
  JSON_object(std::ostream& out, bool is_outermost) : m_out(out), m_outermost(is_outermost) { m_out << "{"; }
  ~JSON_object() { m_out << (m_outermost ? "\n}\n" : "}"); }
  JSON_object(const JSON_object&) = delete;
  JSON_object& operator=(const JSON_object&) = delete;

  JSON_object& operator()(const char* name, const std::string& text)
  {
    begin(name) << '"';
    for(char c : text) {
      if(c == '"' || c == '\\') m_out << '\\';
      if(static_cast<unsigned char>(c) >= 0x20) m_out << c;
      else m_out << "\\u00" << (c >> 4) << "0123456789abcdef"[c & 15];
    }
    m_out << '"';
    return *this;
  }
  JSON_object& operator()(const char* name, const char* text) { return (*this)(name, std::string(text)); }
  JSON_object& operator()(const char* name, double x)
  {
    number(begin(name), x);
    return *this;
  }
  JSON_object& operator()(const char* name, std::size_t n)
  {
    begin(name) << n;
    return *this;
  }
  JSON_object& operator()(const char* name, bool b)
  {
    begin(name) << (b ? "true" : "false");
    return *this;
  }
  JSON_object& operator()(const char* name, const std::array<double, 3>& p)
  {
    begin(name);
    for(int a = 0; a < 3; ++a) number(m_out << (a == 0 ? "[" : ", "), p[a]);
    m_out << "]";
    return *this;
  }
  JSON_object& operator()(const char* name, const std::vector<std::size_t>& list)
  {
    begin(name) << "[";
    for(std::size_t n = 0; n < list.size(); ++n) m_out << (n == 0 ? "" : ", ") << list[n];
    m_out << "]";
    return *this;
  }
  // Begins a member; the caller writes its value.
  std::ostream& begin(const char* name)
  {
    m_out << (m_first ? "" : ",") << (m_outermost ? "\n  " : " ") << '"' << name << "\": ";
    m_first = false;
    return m_out;
  }

private:
  static void number(std::ostream& out, double x)
  {
    if(std::isfinite(x)) out << x;
    else out << "null";
  }

  std::ostream& m_out;
  bool m_outermost, m_first = true;
};

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief writes a report on a shell and its construction as a JSON object.
 *
 * The object contains the status, the kind of shell, a message, the repairs, the welding, sizes, claims, times and, if
 * the shell is not certified, the obstacles. It also contains the united parts, the number of excised triangles for
 * each reason, and the closed holes. For a proxy, it contains the share of the area that the proxy represents, and the
 * reason why the mesh itself has no certified shell. Lengths are in the units of the coordinates, and times in seconds.
 * Offending facets and vertices are `Shell_of_soup_3::offending_simplices`.
 *
 * \param out a stream; its format flags and locale are restored
 * \param result the shell
 * \param shares the shares of the area that the proxy represents, if there is one (`sample_soup_shares()`)
 * \param file name of the input file, in UTF-8
 * \return whether the report was written
 */
inline bool write_report(std::ostream& out, const Shell_of_soup_3& result, const Soup_shares& shares,
                         const std::string& file)
{
  const std::locale locale = out.imbue(std::locale::classic());
  const std::ios_base::fmtflags flags = out.flags(std::ios_base::dec);
  const std::streamsize precision = out.precision(10);
  {
    internal::JSON_object json(out, true);
    const auto object = [&](const char* name) {
      json.begin(name);
      return internal::JSON_object(out, false);
    };
    const Shell_report& r = result.shell().report();
    json("file", file)("status", result ? name(result.certification()) : "refused")("message", result.message());
    if(result) json("kind", name(result.kind()));
    const Soup_repairs& repairs = result.repairs;
    object("repairs")("merged_points", repairs.merged_points)("removed_polygons", repairs.removed_polygons)(
      "split_polygons", repairs.split_polygons)("duplicate_polygons", repairs.duplicate_polygons)(
      "reversed_polygons", repairs.reversed_polygons)("degenerate_facets", repairs.degenerate_facets)(
      "reversed_components", repairs.reversed_components);
    const Weld_report& weld = result.weld;
    if(!weld.is_none())
      object("weld")("unit", weld.unit)("tolerance", weld.tolerance)("welded_points", weld.welded_points)(
        "split_edges", weld.split_edges)("undone_clusters", weld.undone_clusters)(
        "border_edges_before", weld.border_edges_before)("border_edges_after", weld.border_edges_after);
    const Unite_report& unite = result.unite_report;
    if(unite.status != Unite_status::NOT_TRIED)
      object("united_parts")("message", message(unite))("facets", unite.offending_facets)("parts", unite.parts)(
        "solids", unite.solids)("united_solids", unite.united_solids)("groups", unite.groups)(
        "hidden_facets", unite.hidden_facets)("partly_hidden_facets", unite.partly_hidden_facets)(
        "coplanar_pairs", unite.coplanar_pairs)("hidden_area", unite.hidden_area)("seconds", unite.seconds);
    const Excision_report& excision = result.excision_report;
    if(excision.excised > 0) {
      internal::JSON_object of_excision = object("excision");
      of_excision("message", result.excision_message())("triangles", excision.triangles)("excised", excision.excised)(
        "excised_area", excision.excised_area)("pinned_vertices", excision.pinned_vertices)(
        "pinned_edges", excision.pinned_edges)("reversed", excision.reversed)("duplicates", excision.duplicates);
      for(std::size_t n = 1; n < number_of_excision_reasons; ++n)
        of_excision(name(Excision_reason(n)), excision.triangles_with[n]);
    }
    if(result.mesh_status != Shell_status::SUCCESS || result.proxy || result.excised) {
      const Offending_simplices& offenders = result.offending_simplices;
      object("mesh_itself")("message", result.mesh_message())("facets", offenders.facets)(
        "vertices", offenders.vertices)("near_duplicates", result.near_duplicates);
      if(!result.proxy && result.proxy_status != Shell_status::NOT_BUILT)
        object("no_proxy")("message", result.proxy_status == Shell_status::SUCCESS
                                        ? "The shell of the proxy is not certified."
                                        : message(result.proxy_status, result.invalid_parameter));
    }
    if(result.proxy) {
      const Proxy_report& proxy = result.proxy->report();
      object("proxy")("alpha", proxy.alpha)("offset", proxy.offset)("wraps", proxy.wraps)("carried", shares.carried)(
        "continued", shares.continued)("hidden", shares.hidden)("polygons_left_out",
                                                                result.proxy->soup().polygons_left_out());
    }
    if(result && result.shell().closing())
      object("closing")("holes", r.closing.holes.size())("caps", r.closing.caps())("sheets", r.closing.sheets)(
        "triangles", r.closing.triangles)("least_offset", r.closing.least_offset)("largest_offset",
                                                                                  r.closing.largest_offset);
    if(result && !r.truncation.vertices.empty()) {
      std::vector<std::size_t> truncated, others;
      for(const Truncation_report::Vertex& v : r.truncation.vertices)
        (v.outcome == Truncation_report::Outcome::TRUNCATED ? truncated : others).push_back(v.vertex);
      object("truncation")("vertices", truncated)("not_truncated", others);
    }
    if(result) {
      object("shell")("facets", r.triangles)("components", r.components)("thickness", result.shell().thickness())(
        "narrowed_area", r.narrowed_area)("cells", r.cells)("unknowns", r.unknowns)("rounds", r.rounds.size())("unit",
                                                                                                               r.unit);
      internal::JSON_object claims = object("claims");
      for(std::size_t c = 0; c < r.certificate.verdicts.size(); ++c)
        claims(name(Claim(c)), name(r.certificate.verdicts[c]));
    }
    json("seconds", result.seconds);
    if(r.limit.resource != Refinement_resource::NONE) json("limit", message(r.limit));
    if(!r.obstacles.empty()) {
      json.begin("obstacles") << "[";
      for(std::size_t n = 0; n < r.obstacles.size(); ++n) {
        const Refinement_obstacle& o = r.obstacles[n];
        out << (n == 0 ? "\n    " : ",\n    ");
        internal::JSON_object(out, false)("point", o.point)("message", message(o, r.unit, r.refinement));
      }
      out << "]";
    }
  }
  out.precision(precision);
  out.flags(flags);
  out.imbue(locale);
  return bool(out);
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_WRITE_REPORT_H
