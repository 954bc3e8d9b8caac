// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_SHELL_FILE_STATUS_H
#define CGAL_BSPLINE_SHELL_3_IO_SHELL_FILE_STATUS_H

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3IO
 *
 * \brief how the reading or writing of a file of a shell went.
 */
enum class Shell_file_status
{
  SUCCESS,
  CANNOT_OPEN,           ///< there is no such file, or it must not be read
  CANNOT_WRITE,          ///< the file cannot be made, or not completed
  NOT_A_SHELL,           ///< the file is something else, or what is to be written is no shell
  VERSION_NOT_SUPPORTED, ///< the file is of another version
  OTHER_KIND,            ///< the file holds a shell with another kind of field or of thresholds
  DAMAGED                ///< the file was cut off or altered, or contradicts itself
};

/// \ingroup PkgBsplineShell3IO
/// what is wrong and what can be done about it, in one sentence
inline const char* message(Shell_file_status status)
{
  switch(status) {
    case Shell_file_status::SUCCESS: return "The file was read or written.";
    case Shell_file_status::CANNOT_OPEN: return "The file cannot be read: check its path and permissions.";
    case Shell_file_status::CANNOT_WRITE:
      return "The file cannot be written: check its folder, permissions and the free space.";
    case Shell_file_status::NOT_A_SHELL:
      return "This is no shell: the file holds something else, or no shell was built that could be written.";
    case Shell_file_status::VERSION_NOT_SUPPORTED:
      return "The file is of another version of the format: write it again with this version of the package.";
    case Shell_file_status::OTHER_KIND:
      return "The file holds a shell with another kind of field or of thresholds: read it into a shell of that type.";
    case Shell_file_status::DAMAGED:
      return "The file was cut off or altered, or contradicts itself: write or copy it again.";
  }
  return "";
}

/*!
 * \ingroup PkgBsplineShell3IO
 *
 * \brief how numbers are written: as they are, which is short and fast, or as text that people can read.
 */
enum class Shell_format
{
  BINARY,
  ASCII
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_SHELL_FILE_STATUS_H
