# SPDX-License-Identifier: MIT
# carom_batches(<variable> SIZE <count> SOURCES <source>...): puts into the variable what to compile for the sources: a
# file for each <count> of them that includes them, by paths relative to the project, so that it is the same in every
# clone (CMake's own unity builds name absolute ones). Sources with properties of their own, and generated ones, stay
# alone, and come last: what they share with a batch is linked from there. Call it after set_source_files_properties.
#   CAROM_ALONE ON, a property of sources: not in a batch, where many would wait for it
define_property(SOURCE PROPERTY CAROM_ALONE BRIEF_DOCS "Compiled alone")

function(carom_batches variable)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "SIZE" "SOURCES")
  set(compiled "")
  set(lone "")
  set(batch "")
  foreach(source IN LISTS arg_SOURCES)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    set(alone "")
    foreach(property CAROM_ALONE COMPILE_OPTIONS COMPILE_DEFINITIONS INCLUDE_DIRECTORIES SKIP_PRECOMPILE_HEADERS)
      get_source_file_property(value ${source} ${property})
      if(value)
        set(alone ON)
      endif()
    endforeach()
    cmake_path(IS_PREFIX PROJECT_SOURCE_DIR ${source} ours)
    cmake_path(IS_PREFIX PROJECT_BINARY_DIR ${source} generated)
    if(alone OR NOT CAROM_UNITY OR NOT ours OR generated OR NOT source MATCHES "\\.cpp$")
      list(APPEND lone ${source})
    else()
      list(APPEND batch ${source})
    endif()
  endforeach()

  list(LENGTH batch count)
  math(EXPR batches "(${count} + ${arg_SIZE} - 1) / ${arg_SIZE}")  # as even as they come
  set(index 0)
  foreach(source IN LISTS batch)
    math(EXPR number "${index} * ${batches} / ${count}")
    math(EXPR index "${index} + 1")
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    string(APPEND text_${number} "#include \"${source}\"\n")
  endforeach()
  set(number 0)
  while(number LESS batches)
    set(file ${CMAKE_CURRENT_BINARY_DIR}/batches/${variable}_${number}.cpp)
    file(CONFIGURE OUTPUT ${file} CONTENT "${text_${number}}" @ONLY)
    list(APPEND compiled ${file})
    math(EXPR number "${number} + 1")
  endwhile()
  set(${variable} ${compiled} ${lone} PARENT_SCOPE)
endfunction()
