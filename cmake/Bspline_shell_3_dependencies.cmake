# What the headers need; read by the project and by its installed package.
include(CMakeFindDependencyMacro)
find_dependency(CGAL 5.5)
find_dependency(Eigen3 3.4)
include(CGAL_Eigen3_support)
find_package(TBB QUIET)
if(TBB_FOUND)
  include(CGAL_TBB_support)
endif()

# The direct solver is optional: programs that include its header link Bspline_shell_3::Cholmod.
find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(CHOLMOD_LIBRARY cholmod)
mark_as_advanced(CHOLMOD_INCLUDE_DIR CHOLMOD_LIBRARY)
if(CHOLMOD_INCLUDE_DIR AND CHOLMOD_LIBRARY AND NOT TARGET Bspline_shell_3::Cholmod)
  add_library(Bspline_shell_3::Cholmod INTERFACE IMPORTED)
  target_include_directories(Bspline_shell_3::Cholmod INTERFACE ${CHOLMOD_INCLUDE_DIR})
  target_link_libraries(Bspline_shell_3::Cholmod INTERFACE ${CHOLMOD_LIBRARY})
endif()
