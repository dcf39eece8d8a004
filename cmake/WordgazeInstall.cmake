# The installed package: find_package(wordgaze COMPONENTS env policy evaluation training trace io draw lcm).
# Each component is an export set of its own, so that asking for one needs only what that one needs.
include(CMakePackageConfigHelpers)
set(wordgaze_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/wordgaze)

get_property(components GLOBAL PROPERTY wordgaze_components)
foreach(component IN ITEMS core LISTS components)
  set(targets wordgaze_${component})
  if(component STREQUAL "lcm")
    list(APPEND targets wordgaze_lcmtypes)
  endif()
  install(TARGETS ${targets} EXPORT wordgaze_${component})
  install(EXPORT wordgaze_${component} FILE wordgaze_${component}.cmake NAMESPACE wordgaze::
          DESTINATION ${wordgaze_package_dir})
endforeach()
if(WORDGAZE_WITH_LCM)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/lcmtypes/" DESTINATION ${CMAKE_INSTALL_DATADIR}/wordgaze/lcmtypes)
endif()

# wordgaze-<component>.pc: the same for whoever does not use CMake.
file(RELATIVE_PATH pc_to_prefix "/p/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/p")
foreach(component IN ITEMS core LISTS components)
  get_property(needs GLOBAL PROPERTY wordgaze_${component}_needs)
  set(requires "")
  set(libraries "-L\${libdir} -lwordgaze_${component}")
  foreach(need IN LISTS needs)
    if(need MATCHES "^wordgaze::(.*)")
      list(APPEND requires "wordgaze-${CMAKE_MATCH_1}")
    elseif(need STREQUAL "Cairo::Cairo")
      string(APPEND libraries " -lcairo")
    elseif(need STREQUAL "LCM::lcm")
      string(APPEND libraries " -llcm")  # Debian's lcm.pc wants glib, which linking does not
    endif()
  endforeach()
  set(flags "")
  if(component STREQUAL "core")
    set(requires eigen3)
    set(libraries "-pthread")
    set(flags "-pthread -I\${includedir} -DEIGEN_STACK_ALLOCATION_LIMIT=1048576")
    if(WORDGAZE_NATIVE)
      string(APPEND flags " -march=native")
    endif()
  elseif(component STREQUAL "policy")
    set(flags "-DWORDGAZE_COMPILED=1")
  elseif(component STREQUAL "lcm")
    set(flags "-I\${includedir}/wordgaze/lcmtypes")
  endif()
  list(JOIN requires ", " requires)
  configure_file(cmake/wordgaze.pc.in wordgaze-${component}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/wordgaze-${component}.pc
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()

configure_package_config_file(cmake/wordgazeConfig.cmake.in wordgazeConfig.cmake
  INSTALL_DESTINATION ${wordgaze_package_dir})
write_basic_package_version_file(wordgazeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/wordgazeConfig.cmake ${PROJECT_BINARY_DIR}/wordgazeConfigVersion.cmake
  cmake/FindLCM.cmake cmake/FindCairo.cmake cmake/FindHttplib.cmake DESTINATION ${wordgaze_package_dir})
install(DIRECTORY include/wordgaze DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES package.xml LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/wordgaze)
install(DIRECTORY models configs DESTINATION ${CMAKE_INSTALL_DATADIR}/wordgaze)
# With this file ROS 2 knows the package: `ros2 run wordgaze wordgaze`, `ros2 pkg prefix wordgaze`.
file(WRITE "${PROJECT_BINARY_DIR}/ament_index/wordgaze" "")
install(FILES "${PROJECT_BINARY_DIR}/ament_index/wordgaze"
        DESTINATION share/ament_index/resource_index/packages)
