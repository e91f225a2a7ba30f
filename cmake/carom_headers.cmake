# SPDX-License-Identifier: MIT
# carom_headers(<name> LIBRARIES <target>... HEADERS <header>...): headers that are compiled once, as the target
# carom_headers_<name>; carom_use_headers(<target> <name>) compiles what a target has with them. A header of the project
# is named <like/this.h>, so that no path of this clone is written down. Whoever uses them is optimised where they are.
function(carom_headers name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LIBRARIES;HEADERS")
  set(source ${CMAKE_CURRENT_BINARY_DIR}/headers_${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "")
  add_library(carom_headers_${name} OBJECT ${source})
  target_include_directories(carom_headers_${name} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/generated)
  target_link_libraries(carom_headers_${name} PRIVATE ${arg_LIBRARIES})
  target_precompile_headers(carom_headers_${name} PRIVATE ${arg_HEADERS})
endfunction()

function(carom_use_headers target name)
  target_precompile_headers(${target} REUSE_FROM carom_headers_${name})
endfunction()
