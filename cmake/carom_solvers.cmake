# SPDX-License-Identifier: MIT
# ODE and qhull, which ship no CMake package: PkgConfig::ODE and PkgConfig::QHULL. Used by the build and by the installed
# package alike.

find_package(PkgConfig REQUIRED)
if(NOT TARGET PkgConfig::ODE)
  pkg_check_modules(ODE REQUIRED IMPORTED_TARGET GLOBAL ode)
endif()
if(NOT TARGET PkgConfig::QHULL)
  pkg_check_modules(QHULL REQUIRED IMPORTED_TARGET GLOBAL qhull_r)  # the reentrant C library
endif()
