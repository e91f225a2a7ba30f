# SPDX-License-Identifier: MIT
# ODE, qhull and Ipopt, which ship no CMake package: PkgConfig::ODE, PkgConfig::QHULL and PkgConfig::IPOPT.
# Used by the build and by the installed package alike.

find_package(PkgConfig REQUIRED)
if(NOT TARGET PkgConfig::ODE)
  pkg_check_modules(ODE REQUIRED IMPORTED_TARGET GLOBAL ode)
endif()
if(NOT TARGET PkgConfig::QHULL)
  pkg_check_modules(QHULL REQUIRED IMPORTED_TARGET GLOBAL qhull_r)  # the reentrant C library
endif()
if(NOT TARGET PkgConfig::IPOPT)
  pkg_check_modules(IPOPT REQUIRED IMPORTED_TARGET GLOBAL ipopt)
  # ipopt.pc also lists what libipopt.so itself was linked with (LAPACK, MUMPS, the Fortran run time), whose development
  # files need not be installed. The shared library brings them along.
  find_library(CAROM_IPOPT_LIBRARY ipopt HINTS ${IPOPT_LIBRARY_DIRS} REQUIRED)
  mark_as_advanced(CAROM_IPOPT_LIBRARY)
  set_target_properties(PkgConfig::IPOPT PROPERTIES
    INTERFACE_LINK_LIBRARIES "${CAROM_IPOPT_LIBRARY}"
    INTERFACE_LINK_DIRECTORIES ""
    INTERFACE_LINK_OPTIONS "")
endif()
