# Installs into a prefix under the build folder, then builds and runs test/install and test/extend
# against it, as a user's projects would.
set(prefix "${PROJECT_BINARY_DIR}/package/prefix")

add_test(NAME package.install
  COMMAND ${CMAKE_COMMAND} --install "${PROJECT_BINARY_DIR}" --prefix "${prefix}")
set_tests_properties(package.install PROPERTIES
  FIXTURES_SETUP installed_package LABELS package TIMEOUT 300)

# wordgaze_consumer(name folder options TEST command...)
function(wordgaze_consumer name folder options)
  cmake_parse_arguments(arg "" "" "TEST" ${ARGN})
  add_test(NAME package.${name}
    COMMAND ${CMAKE_CTEST_COMMAND}
      --build-and-test "${folder}" "${PROJECT_BINARY_DIR}/package/${name}"
      --build-generator "${CMAKE_GENERATOR}"
      --build-options
        "-DCMAKE_PREFIX_PATH=${prefix}"
        "-DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE}"
        "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}"
        "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}"
        ${options}
      --test-command ${arg_TEST})
  set_tests_properties(package.${name} PROPERTIES
    FIXTURES_REQUIRED installed_package LABELS package TIMEOUT 600)
endfunction()

wordgaze_consumer(consumer "${CMAKE_CURRENT_SOURCE_DIR}/install"
  "-DWITH_LCM=${WORDGAZE_WITH_LCM}" TEST consumer)
wordgaze_consumer(eigen_alone "${CMAKE_CURRENT_SOURCE_DIR}/install/eigen_alone"
  "-DMODEL=${PROJECT_SOURCE_DIR}/models/single-attention.safetensors"
  TEST ${CMAKE_CTEST_COMMAND} --output-on-failure)
wordgaze_consumer(extend "${CMAKE_CURRENT_SOURCE_DIR}/extend"
  "-DMODEL=${PROJECT_SOURCE_DIR}/models/single-attention.safetensors"
  TEST ${CMAKE_CTEST_COMMAND} --output-on-failure)
