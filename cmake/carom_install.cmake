# SPDX-License-Identifier: MIT
# Installs the libraries, their public headers and the command, the package for find_package(carom), and carom.pc.
include(CMakePackageConfigHelpers)

set(carom_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/carom)
set(carom_header_dir ${CMAKE_INSTALL_INCLUDEDIR}/carom)

# All libraries under one name.
add_library(carom_all INTERFACE)
add_library(carom::carom ALIAS carom_all)
set_target_properties(carom_all PROPERTIES EXPORT_NAME carom)
set(carom_reversed ${carom_components})
list(REVERSE carom_reversed)
list(TRANSFORM carom_reversed PREPEND carom_)
target_link_libraries(carom_all INTERFACE ${carom_reversed})

# A component is a library; its targets are exported apart, so that nobody needs what the others stand on.
foreach(component IN LISTS carom_components)
  install(TARGETS carom_${component} EXPORT carom_${component}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
    FILE_SET HEADERS DESTINATION ${carom_header_dir})
endforeach()
install(TARGETS carom_c_functions EXPORT carom_adjoint OBJECTS DESTINATION ${CMAKE_INSTALL_LIBDIR}/carom)
install(TARGETS carom_all EXPORT carom_all)
foreach(set IN LISTS carom_components ITEMS all)
  install(EXPORT carom_${set} FILE carom_${set}.cmake NAMESPACE carom:: DESTINATION ${carom_package_dir})
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/generated/carom/version.h ${PROJECT_BINARY_DIR}/generated/carom/carom.h
  DESTINATION ${carom_header_dir})

set(carom_has_draco OFF)
set(carom_has_meshoptimizer OFF)
if(CAROM_FORMATS AND draco_FOUND)
  set(carom_has_draco ON)
endif()
if(CAROM_FORMATS AND meshoptimizer_FOUND)
  set(carom_has_meshoptimizer ON)
endif()
configure_package_config_file(cmake/caromConfig.cmake.in ${PROJECT_BINARY_DIR}/caromConfig.cmake
  INSTALL_DESTINATION ${carom_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/caromConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/caromConfig.cmake
  ${PROJECT_BINARY_DIR}/caromConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/carom_solvers.cmake
  DESTINATION ${carom_package_dir})
set(carom_pc_libs "")
foreach(library IN LISTS carom_reversed)
  string(APPEND carom_pc_libs " -l${library}")
endforeach()
set(carom_pc_requires "")
if(carom_has_draco)
  string(APPEND carom_pc_requires " draco")
endif()
foreach(needs ode_bridge=ode ode_bridge=qhull_r editing=tbb formats=tinygltf)
  string(REPLACE "=" ";" needs ${needs})
  list(GET needs 0 component)
  list(GET needs 1 package)
  if(component IN_LIST carom_components)
    string(APPEND carom_pc_requires " ${package}")
  endif()
endforeach()
# Whoever links shared libraries needs nothing of what these link.
set(carom_pc_requires_private "")
set(carom_pc_libs_private "")
set(carom_dl "")
if(carom_has_meshoptimizer)
  set(carom_dl " -lmeshoptimizer")  # has no .pc
endif()
if(CAROM_EDITING)
  string(APPEND carom_dl " -ldl")  # Ipopt is opened when the first edit is solved
endif()
if(BUILD_SHARED_LIBS)
  set(carom_pc_requires_private "${carom_pc_requires}")
  set(carom_pc_libs_private "${carom_dl}")
  set(carom_pc_requires "")
else()
  string(APPEND carom_pc_libs "${carom_dl}")
endif()
# The file says where it is from, so that what was installed can be moved.
file(RELATIVE_PATH carom_pc_to_prefix ${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
configure_file(cmake/carom.pc.in ${PROJECT_BINARY_DIR}/carom.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/carom.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

if(TARGET carom)
  file(RELATIVE_PATH carom_to_libraries ${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_BINDIR} ${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR})
  set_target_properties(carom PROPERTIES INSTALL_RPATH "$<$<BOOL:${BUILD_SHARED_LIBS}>:$ORIGIN/${carom_to_libraries}>")
  install(TARGETS carom RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
# The pages that the command writes when it is built, where man and the shells look for them.
if(CAROM_PAGES)
  install(FILES ${CAROM_PAGES}/carom.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${CAROM_PAGES}/carom.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME carom)
  install(FILES ${CAROM_PAGES}/_carom DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
  install(FILES ${CAROM_PAGES}/carom.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
endif()

# What `carom studio` serves: its page, what that uses of three.js, and the example scenes with the meshes they name and
# their pictures. Without three.js (scripts/setup studio) the rest is installed, and the command says what is missing.
if(CAROM_STUDIO)
  set(carom_studio_dir ${CMAKE_INSTALL_DATADIR}/carom/studio)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/studio/page/ DESTINATION ${carom_studio_dir}/page FILES_MATCHING
    PATTERN "*.html" PATTERN "*.css" PATTERN "*.js" PATTERN "*.svg" PATTERN "*.png" PATTERN node_modules EXCLUDE)
  foreach(file LICENSE build/three.module.js build/three.core.js examples/jsm/controls/OrbitControls.js
      examples/jsm/lines/Line2.js examples/jsm/lines/LineGeometry.js examples/jsm/lines/LineMaterial.js
      examples/jsm/lines/LineSegments2.js examples/jsm/lines/LineSegmentsGeometry.js)
    cmake_path(GET file PARENT_PATH folder)
    install(FILES ${PROJECT_SOURCE_DIR}/studio/page/node_modules/three/${file}
      DESTINATION ${carom_studio_dir}/three/${folder} OPTIONAL)
  endforeach()
  foreach(content examples/scenes=scenes=json examples/assets=assets=obj examples/pictures=gallery=png)
    string(REPLACE "=" ";" content ${content})
    list(GET content 0 from)
    list(GET content 1 to)
    list(GET content 2 ending)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/${from}/ DESTINATION ${carom_studio_dir}/${to}
      FILES_MATCHING PATTERN "*.${ending}")
  endforeach()
endif()

# What editors check documents with, and what goes with a copy of the program.
if(CAROM_FORMATS)
  install(FILES
    ${PROJECT_SOURCE_DIR}/formats/documents/scene.schema.json
    ${PROJECT_SOURCE_DIR}/formats/documents/journal.schema.json
    DESTINATION ${CMAKE_INSTALL_DATADIR}/carom)
endif()
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR})
