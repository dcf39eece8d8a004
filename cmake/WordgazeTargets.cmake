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
# A library wordgaze::name (BUILD_SHARED_LIBS says of which kind) from src/<folder>/*.cpp (the folder of its name by default), which is
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
  add_library(wordgaze_${name} ${sources})
  add_library(wordgaze::${name} ALIAS wordgaze_${name})
  set_target_properties(wordgaze_${name} PROPERTIES
    EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON DEFINE_SYMBOL "" VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}  # as long as it is 0.x
    INSTALL_RPATH "$ORIGIN")
  target_link_libraries(wordgaze_${name} PUBLIC ${arg_LINK} PRIVATE ${arg_PRIVATE})
  foreach(target IN LISTS arg_BUILT_WITH ITEMS wordgaze_warnings)
    target_link_libraries(wordgaze_${name} PRIVATE $<BUILD_INTERFACE:${target}>)
  endforeach()
  target_compile_options(wordgaze_${name} PRIVATE ${arg_OPTIONS})
  set_property(GLOBAL APPEND PROPERTY wordgaze_components ${name})
  set_property(GLOBAL PROPERTY wordgaze_${name}_needs ${arg_LINK} ${arg_PRIVATE})  # for pkg-config
endfunction()

# wordgaze_program(name LINKS other...): the program of apps/*.cpp, linked with every module that is
# built. The other names are links to it in the build folder and, installed, in lib/wordgaze, where
# `ros2 run wordgaze` looks; they choose the command of that name.
function(wordgaze_program name)
  cmake_parse_arguments(arg "" "" "LINKS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/apps/*.cpp")
  add_executable(${name} ${sources})
  target_link_libraries(${name} PRIVATE
    wordgaze::training wordgaze::trace wordgaze::draw wordgaze::page CLI11::CLI11 nlohmann_json::nlohmann_json
    fmt::fmt-header-only wordgaze_warnings)
  target_compile_definitions(${name} PRIVATE
    WORDGAZE_WITH_LCM=$<BOOL:${WORDGAZE_WITH_LCM}>)
  if(WORDGAZE_WITH_LCM)
    target_link_libraries(${name} PRIVATE wordgaze::lcm)
  endif()
  foreach(link IN LISTS arg_LINKS)
    add_custom_command(TARGET ${name} POST_BUILD
      COMMAND ${CMAKE_COMMAND} -E create_symlink ${name} "$<TARGET_FILE_DIR:${name}>/${link}"
      VERBATIM)
  endforeach()
  file(RELATIVE_PATH lib_to_bin "/p/lib/wordgaze" "/p/${CMAKE_INSTALL_BINDIR}")
  file(RELATIVE_PATH bin_to_lib "/p/${CMAKE_INSTALL_BINDIR}" "/p/${CMAKE_INSTALL_LIBDIR}")
  set_target_properties(${name} PROPERTIES INSTALL_RPATH "$ORIGIN/${bin_to_lib}")
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  foreach(link IN ITEMS ${name} LISTS arg_LINKS)
    set(made "${PROJECT_BINARY_DIR}/links/${link}")
    file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/links")
    file(CREATE_LINK "${lib_to_bin}/${name}" "${made}" SYMBOLIC)
    install(FILES "${made}" DESTINATION lib/wordgaze)
  endforeach()
endfunction()
