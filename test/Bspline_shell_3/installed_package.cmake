# Installs the package to a new prefix, then configures, builds and runs the consumer project against it: header-only,
# and with the compiled library if there is one. The library has assertions, the project does not. Results must agree in
# every bit.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE error)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${output}${error}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()
file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE}/test/Bspline_shell_3/consumer -B ${WORK}/build -G ${GENERATOR} -Wno-dev
    -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCGAL_DIR=${CGAL_DIR} -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS_DEBUG=-O0 -DNDEBUG")
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
set(expected "${output}")
if(EXISTS ${WORK}/build/consumer_of_library)
  run(${WORK}/build/consumer_of_library)
  if(NOT output STREQUAL expected)
    message(FATAL_ERROR "The compiled library and the headers compute different results.")
  endif()
endif()
