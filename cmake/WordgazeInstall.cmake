# The installed package: find_package(wordgaze COMPONENTS env trace rl io draw lcm).
include(CMakePackageConfigHelpers)
set(wordgaze_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/wordgaze)

install(TARGETS wordgaze_core wordgaze_env wordgaze_trace wordgaze_rl wordgaze_io wordgaze_draw
        EXPORT wordgazeTargets)
install(EXPORT wordgazeTargets NAMESPACE wordgaze:: DESTINATION ${wordgaze_package_dir})
if(WORDGAZE_WITH_LCM)
  install(TARGETS wordgaze_lcm wordgaze_lcmtypes EXPORT wordgazeLcmTargets)
  install(EXPORT wordgazeLcmTargets NAMESPACE wordgaze:: DESTINATION ${wordgaze_package_dir})
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
