# Installs into a prefix under the build folder, then builds and runs test/install against it, as a
# user's project would.
set(prefix "${PROJECT_BINARY_DIR}/package/prefix")

add_test(NAME package.install
  COMMAND ${CMAKE_COMMAND} --install "${PROJECT_BINARY_DIR}" --prefix "${prefix}")
add_test(NAME package.consumer
  COMMAND ${CMAKE_CTEST_COMMAND}
    --build-and-test "${CMAKE_CURRENT_SOURCE_DIR}/install" "${PROJECT_BINARY_DIR}/package/consumer"
    --build-generator "${CMAKE_GENERATOR}"
    --build-options
      "-DCMAKE_PREFIX_PATH=${prefix}"
      "-DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE}"
      "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}"
      "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}"
      "-DWITH_LCM=${WORDGAZE_WITH_LCM}"
    --test-command consumer)

set_tests_properties(package.install PROPERTIES FIXTURES_SETUP installed_package)
set_tests_properties(package.consumer PROPERTIES FIXTURES_REQUIRED installed_package)
set_tests_properties(package.install package.consumer PROPERTIES LABELS package TIMEOUT 300)
