# SPDX-License-Identifier: MIT
# GMP and MPFR, the 50-digit arithmetic of the tests and charts, which ship no CMake package: PkgConfig::MPFR.

find_package(PkgConfig REQUIRED)
if(NOT TARGET PkgConfig::MPFR)
  pkg_check_modules(MPFR REQUIRED IMPORTED_TARGET GLOBAL mpfr gmp)
endif()
