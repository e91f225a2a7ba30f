# SPDX-License-Identifier: MIT
# Ipopt, which is opened when the first edit is solved and not linked: IPOPT_INCLUDE_DIRS, IPOPT_VERSION, and
# CAROM_IPOPT_RUNTIME, the file to open.

find_package(PkgConfig REQUIRED)
pkg_check_modules(IPOPT REQUIRED ipopt)
find_library(CAROM_IPOPT_LIBRARY ipopt HINTS ${IPOPT_LIBRARY_DIRS} REQUIRED)
mark_as_advanced(CAROM_IPOPT_LIBRARY)

# The name that goes with the library's binary interface (libipopt.so.1): the plain one comes with development files only.
get_filename_component(folder ${CAROM_IPOPT_LIBRARY} DIRECTORY)
execute_process(COMMAND ${CMAKE_OBJDUMP} -p ${CAROM_IPOPT_LIBRARY} OUTPUT_VARIABLE headers ERROR_QUIET)
if(headers MATCHES "SONAME +([^ \n]+)")
  set(CAROM_IPOPT_RUNTIME ${folder}/${CMAKE_MATCH_1})
else()
  set(CAROM_IPOPT_RUNTIME ${CAROM_IPOPT_LIBRARY})
endif()
