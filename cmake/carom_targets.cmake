# SPDX-License-Identifier: MIT
# carom_library(<name>): the static library carom_<name> (alias carom::<name>) from all .cpp files of the current folder
# and its sub-folders. Include paths start at the project root: #include "adjoint/scene/scene.h".
function(carom_library name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.h)
  if(NOT sources)
    # A library needs at least one file.
    set(sources ${CMAKE_CURRENT_BINARY_DIR}/empty.cpp)
    file(CONFIGURE OUTPUT ${sources} CONTENT "")
  endif()
  add_library(carom_${name} STATIC ${sources} ${headers})
  add_library(carom::${name} ALIAS carom_${name})
  set_target_properties(carom_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(carom_${name} PUBLIC cxx_std_20)
  target_include_directories(carom_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/carom>)
  set_target_properties(carom_${name} PROPERTIES UNITY_BUILD ${CAROM_UNITY} UNITY_BUILD_BATCH_SIZE 8)
endfunction()
