# SPDX-License-Identifier: MIT
# generated/carom: <carom/carom.h>, which includes all public headers of the components that are built, and the folders
# of the components, so that <carom/adjoint/scene/scene.h> is found in a build as in what is installed.
set(carom_includes "")
foreach(component IN LISTS carom_components)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${component} ${PROJECT_BINARY_DIR}/generated/carom/${component} SYMBOLIC)
  get_target_property(headers carom_${component} HEADER_SET)
  foreach(header IN LISTS headers)
    cmake_path(RELATIVE_PATH header BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    string(APPEND carom_includes "#include \"${header}\"\n")
  endforeach()
endforeach()
configure_file(cmake/carom.h.in generated/carom/carom.h @ONLY)
