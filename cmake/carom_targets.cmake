# SPDX-License-Identifier: MIT
# carom_library(<name> SIZE <count> HEADERS <name> [PUBLIC_HEADERS <header>...]): the library carom_<name> (alias
# carom::<name>) from all .cpp files of the current folder and its sub-folders, in batches of SIZE at most. Include paths
# start at the project root: #include "adjoint/scene/scene.h". The public headers, which are installed, end in .h and are
# listed one by one, so that nothing becomes public by accident; private ones end in .hpp. HEADERS are those of
# carom_headers that it is compiled with.
function(carom_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "SIZE;HEADERS" PUBLIC_HEADERS)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  if(NOT sources)
    # A library needs at least one file.
    set(sources ${CMAKE_CURRENT_BINARY_DIR}/empty.cpp)
    file(CONFIGURE OUTPUT ${sources} CONTENT "")
  endif()
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/*.h)
  set(unlisted ${headers})
  list(REMOVE_ITEM unlisted ${arg_PUBLIC_HEADERS})
  if(unlisted)
    message(FATAL_ERROR "${name}/CMakeLists.txt: ${unlisted} is not listed as a public header; private ones end in .hpp")
  endif()
  carom_batches(${name} SIZE ${arg_SIZE} SOURCES ${sources})
  add_library(carom_${name} ${${name}})  # static or shared, as BUILD_SHARED_LIBS says
  add_library(carom::${name} ALIAS carom_${name})
  target_sources(carom_${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${arg_PUBLIC_HEADERS})
  set_target_properties(carom_${name} PROPERTIES EXPORT_NAME ${name}
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}  # see docs/install.md
    DEFINE_SYMBOL "")  # of which headers compiled once know nothing
  target_compile_features(carom_${name} PUBLIC cxx_std_20)
  target_include_directories(carom_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/carom>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  carom_use_headers(carom_${name} ${arg_HEADERS})
endfunction()
