# Targets for what the headers need; read by the project and by its installed package, after CGAL, Eigen and TBB are found.
include(${CGAL_MODULES_DIR}/CGAL_Eigen3_support.cmake)
include(${CGAL_MODULES_DIR}/CGAL_TBB_support.cmake)      # makes a target if TBB was found

# The direct solver is optional: programs that include its header link Bspline_shell_3::Cholmod.
find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(CHOLMOD_LIBRARY cholmod)
mark_as_advanced(CHOLMOD_INCLUDE_DIR CHOLMOD_LIBRARY)
if(CHOLMOD_INCLUDE_DIR AND CHOLMOD_LIBRARY AND NOT TARGET Bspline_shell_3::Cholmod)
  add_library(Bspline_shell_3::Cholmod INTERFACE IMPORTED)
  target_include_directories(Bspline_shell_3::Cholmod INTERFACE ${CHOLMOD_INCLUDE_DIR})
  target_link_libraries(Bspline_shell_3::Cholmod INTERFACE ${CHOLMOD_LIBRARY})
endif()
