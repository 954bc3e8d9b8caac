# The meshes that examples, tests and benchmarks run on: those of the Debian package libcgal-demo, unpacked once into
# the build folder. BSPLINE_SHELL_3_MESHES is where they are.
set(CGAL_DEMO_DATA /usr/share/doc/libcgal-dev/data.tar.gz CACHE FILEPATH "data.tar.gz of libcgal-demo")
set(BSPLINE_SHELL_3_MESHES ${CMAKE_BINARY_DIR}/data/meshes)
if(NOT EXISTS ${BSPLINE_SHELL_3_MESHES}/elephant.off)
  if(EXISTS ${CGAL_DEMO_DATA})
    # unpacked elsewhere and then renamed: the folder is there completely or not at all
    file(REMOVE_RECURSE ${CMAKE_BINARY_DIR}/data ${CMAKE_BINARY_DIR}/data.part)
    file(ARCHIVE_EXTRACT INPUT ${CGAL_DEMO_DATA} DESTINATION ${CMAKE_BINARY_DIR}/data.part)
    file(RENAME ${CMAKE_BINARY_DIR}/data.part/data ${CMAKE_BINARY_DIR}/data)
    file(REMOVE_RECURSE ${CMAKE_BINARY_DIR}/data.part)
  else()
    message(WARNING "The meshes of the examples and tests are missing, as ${CGAL_DEMO_DATA} does not exist: install "
                    "libcgal-demo, or set CGAL_DEMO_DATA. (A system without documentation does not install this file.)")
  endif()
endif()
