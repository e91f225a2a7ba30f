# SPDX-License-Identifier: MIT
# Installs the libraries, their headers and the command, and the package for find_package(carom).
include(CMakePackageConfigHelpers)

set(carom_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/carom)

install(TARGETS carom_adjoint carom_ode_bridge carom_editing carom_formats EXPORT caromTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS carom_c_functions EXPORT caromTargets OBJECTS DESTINATION ${CMAKE_INSTALL_LIBDIR}/carom)
if(TARGET carom)
  install(TARGETS carom RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
# The pages that the command writes when it is built, where man and the shells look for them.
if(CAROM_PAGES)
  install(FILES ${CAROM_PAGES}/carom.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${CAROM_PAGES}/carom.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME carom)
  install(FILES ${CAROM_PAGES}/_carom DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
  install(FILES ${CAROM_PAGES}/carom.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
endif()
foreach(folder adjoint ode_bridge editing formats)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/carom
    FILES_MATCHING PATTERN "*.h")
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/generated/carom/version.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/carom/carom)

# What editors check documents with, and what goes with a copy of the program.
install(FILES ${PROJECT_SOURCE_DIR}/formats/scene.schema.json ${PROJECT_SOURCE_DIR}/formats/journal.schema.json
  DESTINATION ${CMAKE_INSTALL_DATADIR}/carom)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(EXPORT caromTargets NAMESPACE carom:: DESTINATION ${carom_package_dir})
configure_package_config_file(cmake/caromConfig.cmake.in ${PROJECT_BINARY_DIR}/caromConfig.cmake
  INSTALL_DESTINATION ${carom_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/caromConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/caromConfig.cmake
  ${PROJECT_BINARY_DIR}/caromConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/carom_solvers.cmake
  DESTINATION ${carom_package_dir})
