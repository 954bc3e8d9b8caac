// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_WRITE_FILE_H
#define CGAL_BSPLINE_SHELL_3_IO_WRITE_FILE_H

#include <cstdio>
#include <fstream>
#include <ios>
#include <string>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3IO
 *
 * \brief writes a file under a temporary name, and renames it when it is complete. If the write is interrupted or
 * fails, an existing file remains unchanged, and there is no incomplete file under the final name.
 *
 * \param file path of the file
 * \param write called with a `std::ostream&`; returns whether it succeeded
 * \return whether the file exists and is complete
 */
template <typename Writer>
bool write_file(const std::string& file, const Writer& write)
{
  const std::string partial = file + ".part";
  bool complete = false;
  {
    std::ofstream out(partial, std::ios::binary);
    complete = out && write(static_cast<std::ostream&>(out));
    out.close();
    complete = complete && !out.fail();
  }
  complete = complete && std::rename(partial.c_str(), file.c_str()) == 0;
  if(!complete) std::remove(partial.c_str());
  return complete;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_WRITE_FILE_H
