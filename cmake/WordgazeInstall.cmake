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

configure_package_config_file(cmake/wordgazeConfig.cmake.in wordgazeConfig.cmake
  INSTALL_DESTINATION ${wordgaze_package_dir})
write_basic_package_version_file(wordgazeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/wordgazeConfig.cmake ${PROJECT_BINARY_DIR}/wordgazeConfigVersion.cmake
  cmake/FindLCM.cmake cmake/FindCairo.cmake cmake/FindHttplib.cmake DESTINATION ${wordgaze_package_dir})
install(DIRECTORY include/wordgaze DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES package.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/wordgaze)
