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
 * \brief the outcome of reading or writing a shell file.
 */
enum class Shell_file_status
{
  SUCCESS,
  CANNOT_OPEN,           ///< the file does not exist or is not readable
  CANNOT_WRITE,          ///< the file cannot be created or completed
  NOT_A_SHELL,           ///< the file is not a shell file, or there is no valid shell to write
  VERSION_NOT_SUPPORTED, ///< the file has another version of the format
  OTHER_KIND,            ///< the file contains a shell with another type of thresholds
  DAMAGED                ///< the file is truncated, altered, or inconsistent
};

/// \ingroup PkgBsplineShell3IO
/// returns a sentence that describes the problem and a remedy
inline const char* message(Shell_file_status status)
{
  switch(status) {
    case Shell_file_status::SUCCESS: return "The file was read or written.";
    case Shell_file_status::CANNOT_OPEN: return "The file cannot be read: check its path and permissions.";
    case Shell_file_status::CANNOT_WRITE:
      return "The file cannot be written: check its folder, its permissions and the free space.";
    case Shell_file_status::NOT_A_SHELL:
      return "There is no shell: the file to be read contains something else, or the shell to be written was not "
             "built.";
    case Shell_file_status::VERSION_NOT_SUPPORTED:
      return "The file has another version of the format: write it again with this version of the package.";
    case Shell_file_status::OTHER_KIND:
      return "The file contains a shell with another type of thresholds: read it into a shell of that type.";
    case Shell_file_status::DAMAGED: return "The file is truncated, altered or inconsistent: write or copy it again.";
  }
  return "";
}

/*!
 * \ingroup PkgBsplineShell3IO
 *
 * \brief the number format of a file: compact and fast binary, or readable text.
 */
enum class Shell_format
{
  BINARY,
  ASCII
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_SHELL_FILE_STATUS_H
