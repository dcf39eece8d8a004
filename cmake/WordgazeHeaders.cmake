# Target check_headers: every public header compiles alone, with the warnings of our own sources.
# (CMake 3.23 has VERIFY_INTERFACE_HEADER_SETS for this; we ask for 3.22.)
file(GLOB_RECURSE headers CONFIGURE_DEPENDS
  RELATIVE "${PROJECT_SOURCE_DIR}/include" "${PROJECT_SOURCE_DIR}/include/wordgaze/*.hpp")
if(NOT WORDGAZE_WITH_LCM)
  list(FILTER headers EXCLUDE REGEX "^wordgaze/lcm/")
endif()

set(sources "")
foreach(header IN LISTS headers)
  set(source "${PROJECT_BINARY_DIR}/check_headers/${header}.cpp")
  file(CONFIGURE OUTPUT "${source}" CONTENT "#include \"@header@\"\n" @ONLY)
  list(APPEND sources "${source}")
endforeach()

add_library(check_headers OBJECT EXCLUDE_FROM_ALL ${sources})
target_compile_options(check_headers PRIVATE -O0)
target_link_libraries(check_headers PRIVATE
  wordgaze::io wordgaze::draw wordgaze::trace $<TARGET_NAME_IF_EXISTS:wordgaze::lcm> wordgaze_warnings)
