# Most programs include these headers, and would spend a third of their compile time on them. A program that is compiled
# alone is not faster with precompiled headers. So only tests, which build all programs, have them.
if(is_top_level AND BUILD_TESTING)
  find_package(Catch2 2.13 REQUIRED)
  file(GENERATE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/precompiled_headers.cpp CONTENT "")
  add_library(precompiled_headers OBJECT ${CMAKE_CURRENT_BINARY_DIR}/precompiled_headers.cpp)
  target_link_libraries(precompiled_headers PRIVATE ${shell_target} Catch2::Catch2)
  target_precompile_headers(precompiled_headers PRIVATE
    <CGAL/Exact_predicates_inexact_constructions_kernel.h> <CGAL/Surface_mesh.h> <CGAL/boost/graph/IO/polygon_mesh_io.h>
    <CGAL/certified_shell_of_soup_3.h>
    <CGAL/Bspline_shell_3/Editing/remesh_in_shell.h> <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
    <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h> <CGAL/Bspline_shell_3/IO/write_shell.h>
    <CGAL/Bspline_shell_3/Projection/Shell_map_3.h> <CGAL/Bspline_shell_3/Surface/extract_shell_surface.h>
    <CGAL/Bspline_shell_3/Transfer/transfer_vertex_attribute.h> <catch2/catch.hpp>)
endif()
function(share_precompiled_headers program)
  if(TARGET precompiled_headers)
    target_precompile_headers(${program} REUSE_FROM precompiled_headers)
  endif()
endfunction()
