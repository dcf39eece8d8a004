# The installed package: find_package(wordgaze COMPONENTS env trace rl io draw lcm).
include(CMakePackageConfigHelpers)
set(wordgaze_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/wordgaze)

# A file of targets for each component, so that a user needs what the components in use need: the
# simulator, env, needs Eigen alone.
function(wordgaze_install component)
  install(TARGETS ${ARGN} EXPORT wordgaze_${component}Targets)
  install(EXPORT wordgaze_${component}Targets NAMESPACE wordgaze:: DESTINATION ${wordgaze_package_dir})
endfunction()

wordgaze_install(env wordgaze_core wordgaze_env)
foreach(component IN ITEMS trace rl io draw)
  wordgaze_install(${component} wordgaze_${component})
endforeach()
if(WORDGAZE_WITH_LCM)
  wordgaze_install(lcm wordgaze_lcm wordgaze_lcmtypes)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/lcmtypes/" DESTINATION ${CMAKE_INSTALL_DATADIR}/wordgaze/lcmtypes)
endif()

configure_package_config_file(cmake/wordgazeConfig.cmake.in wordgazeConfig.cmake
  INSTALL_DESTINATION ${wordgaze_package_dir})
write_basic_package_version_file(wordgazeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/wordgazeConfig.cmake ${PROJECT_BINARY_DIR}/wordgazeConfigVersion.cmake
  cmake/FindLCM.cmake cmake/FindCairo.cmake DESTINATION ${wordgaze_package_dir})
install(DIRECTORY include/wordgaze DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES package.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/wordgaze)
