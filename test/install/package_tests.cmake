# Installs into a prefix under the build folder, then builds and runs test/install against it, as a
# user's project would.
set(prefix "${PROJECT_BINARY_DIR}/package/prefix")

add_test(NAME package.install
  COMMAND ${CMAKE_COMMAND} --install "${PROJECT_BINARY_DIR}" --prefix "${prefix}")
# package_test(name option...): the project with these options.
function(package_test name)
  add_test(NAME package.${name}
    COMMAND ${CMAKE_CTEST_COMMAND}
      --build-and-test "${CMAKE_CURRENT_SOURCE_DIR}/install" "${PROJECT_BINARY_DIR}/package/${name}"
      --build-generator "${CMAKE_GENERATOR}"
      --build-options
        "-DCMAKE_PREFIX_PATH=${prefix}"
        "-DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE}"
        "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}"
        "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}"
        ${ARGN}
      --test-command consumer)
  set_tests_properties(package.${name} PROPERTIES
    FIXTURES_REQUIRED installed_package LABELS package TIMEOUT 300)
endfunction()

package_test(consumer "-DWITH_LCM=${WORDGAZE_WITH_LCM}")
# The simulator needs Eigen alone: it builds where nothing else is found.
set(others "")
foreach(package IN ITEMS fmt nlohmann_json tomlplusplus Cairo LCM)
  list(APPEND others "-DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON")
endforeach()
package_test(simulator "-DSIMULATOR_ALONE=ON" ${others})

set_tests_properties(package.install PROPERTIES
  FIXTURES_SETUP installed_package LABELS package TIMEOUT 300)
