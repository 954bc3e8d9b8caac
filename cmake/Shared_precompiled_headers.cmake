# Nearly all programs include these headers, and spend a third of their time on parsing them. One that is compiled alone is not faster with
# precompiled ones, and so they are made for tests only, which build all programs.
if(BUILD_TESTING)
  file(GENERATE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/precompiled_headers.cpp CONTENT "")
  add_library(precompiled_headers OBJECT ${CMAKE_CURRENT_BINARY_DIR}/precompiled_headers.cpp)
  target_link_libraries(precompiled_headers PRIVATE ${shell_target})
  target_precompile_headers(precompiled_headers PRIVATE <CGAL/Exact_predicates_inexact_constructions_kernel.h> <CGAL/Surface_mesh.h>
    <CGAL/certified_bspline_shell_3.h>)
endif()
function(share_precompiled_headers program)
  if(TARGET precompiled_headers)
    target_precompile_headers(${program} REUSE_FROM precompiled_headers)
  endif()
endfunction()
