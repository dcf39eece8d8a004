# How a module, a program and a set of message types become targets: one way to do each.

# Warnings are for our own sources: never exported. GCC 12 sees uninitialized values in its own
# AVX-512 header (GCC bug 105593), and blames them on whoever uses Eigen.
add_library(wordgaze_warnings INTERFACE)
target_compile_options(wordgaze_warnings INTERFACE
  -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
  $<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized -Wno-maybe-uninitialized>
  $<$<BOOL:${WORDGAZE_WERROR}>:-Werror>)

# wordgaze_module(name [FOLDERS folder...] LINK target... [PRIVATE target...] [BUILT_WITH target...]
#                 [OPTIONS flag...])
# A static library wordgaze::name from src/<folder>/*.cpp (the folder of its name by default), which is
# also a component of the installed package. BUILT_WITH: headers that only our sources include.
function(wordgaze_module name)
  cmake_parse_arguments(arg "" "" "FOLDERS;LINK;PRIVATE;BUILT_WITH;OPTIONS" ${ARGN})
  if(NOT arg_FOLDERS)
    set(arg_FOLDERS ${name})
  endif()
  set(sources "")
  foreach(folder IN LISTS arg_FOLDERS)
    file(GLOB found CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/${folder}/*.cpp")
    list(APPEND sources ${found})
  endforeach()
  add_library(wordgaze_${name} STATIC ${sources})
  add_library(wordgaze::${name} ALIAS wordgaze_${name})
  set_target_properties(wordgaze_${name} PROPERTIES
    EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(wordgaze_${name} PUBLIC ${arg_LINK} PRIVATE ${arg_PRIVATE})
  foreach(target IN LISTS arg_BUILT_WITH ITEMS wordgaze_warnings)
    target_link_libraries(wordgaze_${name} PRIVATE $<BUILD_INTERFACE:${target}>)
  endforeach()
  target_compile_options(wordgaze_${name} PRIVATE ${arg_OPTIONS})
  set_property(GLOBAL APPEND PROPERTY wordgaze_components ${name})
endfunction()

# wordgaze_program(name LINKS other...): the program of apps/*.cpp, linked with every module that is
# built. The other names are links to it in the build folder, and choose the command of that name.
function(wordgaze_program name)
  cmake_parse_arguments(arg "" "" "LINKS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/apps/*.cpp")
  add_executable(${name} ${sources})
  target_link_libraries(${name} PRIVATE
    wordgaze::training wordgaze::trace wordgaze::draw wordgaze::page CLI11::CLI11 nlohmann_json::nlohmann_json
    fmt::fmt-header-only wordgaze_warnings)
  target_compile_definitions(${name} PRIVATE
    WORDGAZE_VERSION="${PROJECT_VERSION}" WORDGAZE_WITH_LCM=$<BOOL:${WORDGAZE_WITH_LCM}>)
  if(WORDGAZE_WITH_LCM)
    target_link_libraries(${name} PRIVATE wordgaze::lcm)
  endif()
  foreach(link IN LISTS arg_LINKS)
    add_custom_command(TARGET ${name} POST_BUILD
      COMMAND ${CMAKE_COMMAND} -E create_symlink ${name} "$<TARGET_FILE_DIR:${name}>/${link}"
      VERBATIM)
  endforeach()
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()
