# How a module, a program and a set of message types become targets: one way to do each.

# Warnings are for our own sources: never exported. GCC 12 sees uninitialized values in its own
# AVX-512 header (GCC bug 105593), and blames them on whoever uses Eigen.
add_library(wordgaze_warnings INTERFACE)
target_compile_options(wordgaze_warnings INTERFACE
  -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
  -Wno-uninitialized -Wno-maybe-uninitialized
  $<$<BOOL:${WORDGAZE_WERROR}>:-Werror>)

# wordgaze_module(name MODULES dir... LINK target... [PRIVATE target...] [OPTIONS flag...])
# A static library wordgaze::name from src/<dir>/*.cpp; an interface library while there are none.
function(wordgaze_module name)
  cmake_parse_arguments(arg "" "" "MODULES;LINK;PRIVATE;OPTIONS" ${ARGN})
  set(sources "")
  foreach(dir IN LISTS arg_MODULES)
    file(GLOB found CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/${dir}/*.cpp")
    list(APPEND sources ${found})
  endforeach()
  if(sources)
    set(kind STATIC)
    set(reach PUBLIC)
  else()
    set(kind INTERFACE)
    set(reach INTERFACE)
  endif()
  add_library(wordgaze_${name} ${kind} ${sources})
  add_library(wordgaze::${name} ALIAS wordgaze_${name})
  set_target_properties(wordgaze_${name} PROPERTIES EXPORT_NAME ${name})
  target_link_libraries(wordgaze_${name} ${reach} ${arg_LINK})
  if(sources)
    set_target_properties(wordgaze_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_link_libraries(wordgaze_${name} PRIVATE
      ${arg_PRIVATE} $<BUILD_INTERFACE:wordgaze_warnings>)
    target_compile_options(wordgaze_${name} PRIVATE ${arg_OPTIONS})
  endif()
endfunction()

# wordgaze_app(name): the program apps/name.cpp, linked with every module that is built.
function(wordgaze_app name)
  add_executable(${name} "${PROJECT_SOURCE_DIR}/apps/${name}.cpp")
  target_link_libraries(${name} PRIVATE
    wordgaze::io wordgaze::draw wordgaze::trace CLI11::CLI11 wordgaze_warnings
    nlohmann_json::nlohmann_json fmt::fmt)
  target_compile_definitions(${name} PRIVATE
    WORDGAZE_VERSION="${PROJECT_VERSION}" WORDGAZE_WITH_LCM=$<BOOL:${WORDGAZE_WITH_LCM}>)
  if(WORDGAZE_WITH_LCM)
    target_link_libraries(${name} PRIVATE wordgaze::lcm)
  endif()
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/wordgaze)
endfunction()
