# The meshes that examples, tests and benchmarks run on: those of the Debian package libcgal-demo, unpacked once into
# the build folder. BSPLINE_SHELL_3_MESHES is where they are.
set(CGAL_DEMO_DATA /usr/share/doc/libcgal-dev/data.tar.gz CACHE FILEPATH "data.tar.gz of libcgal-demo")
set(BSPLINE_SHELL_3_MESHES ${CMAKE_BINARY_DIR}/data/meshes)
if(NOT EXISTS ${BSPLINE_SHELL_3_MESHES} AND EXISTS ${CGAL_DEMO_DATA})
  file(ARCHIVE_EXTRACT INPUT ${CGAL_DEMO_DATA} DESTINATION ${CMAKE_BINARY_DIR})
endif()
if(NOT EXISTS ${BSPLINE_SHELL_3_MESHES})
  message(WARNING "${CGAL_DEMO_DATA} not found: install libcgal-demo to have meshes for examples and tests")
endif()
