# wordgaze-spy: lcm-spy with our message types and a drawing of what the agent looks at, where a JDK and LCM's jar are found (Debian's
# default-jdk-headless and liblcm-java). bin/wordgaze-spy finds share/java/wordgaze.jar beside itself, in
# the build folder as in a prefix.
find_program(JAVAC javac)
find_program(JAR jar)
find_file(LCM_JAR lcm.jar PATHS /usr/share/java /usr/local/share/java NO_DEFAULT_PATH)
if(NOT (JAVAC AND JAR AND LCM_JAR))
  return()
endif()

file(GLOB types CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/lcmtypes/*.lcm")
set(work "${PROJECT_BINARY_DIR}/spy")
set(jar "${PROJECT_BINARY_DIR}/share/java/wordgaze.jar")
set(plugin "${PROJECT_SOURCE_DIR}/spy/GazePlugin.java")
set(sources "")
foreach(type IN LISTS types)
  get_filename_component(name "${type}" NAME_WE)
  list(APPEND sources "${work}/wordgaze/${name}.java")
endforeach()
add_custom_command(OUTPUT "${jar}"
  COMMAND ${CMAKE_COMMAND} -E rm -rf "${work}"
  COMMAND ${CMAKE_COMMAND} -E make_directory "${work}/classes" "${PROJECT_BINARY_DIR}/share/java"
  COMMAND ${LCM_GEN} --java --jpath "${work}" ${types}
  COMMAND ${JAVAC} -nowarn -cp "${LCM_JAR}" -d "${work}/classes" ${sources} ${plugin}
  COMMAND ${JAR} cf "${jar}" -C "${work}/classes" .
  DEPENDS ${types} ${plugin} VERBATIM)
add_custom_target(wordgaze_spy ALL DEPENDS "${jar}")
configure_file("${PROJECT_SOURCE_DIR}/spy/wordgaze-spy" "${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/wordgaze-spy"
               COPYONLY)
install(PROGRAMS spy/wordgaze-spy DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES "${jar}" DESTINATION ${CMAKE_INSTALL_DATADIR}/java OPTIONAL)
