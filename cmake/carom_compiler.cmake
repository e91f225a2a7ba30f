# SPDX-License-Identifier: MIT
# What every target of this project is compiled with.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Debug, RelWithDebInfo" FORCE)
endif()

# The same sources give the same bits on every machine: no fused multiply-add where the source does not say so.
add_compile_options(-ffp-contract=off)

# Eigen says itself where it takes two doubles at a time; a compiler that looks for more of it takes a tenth longer and
# finds nothing that is quicker (docs/decisions.md).
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  add_compile_options($<$<CONFIG:Release>:-fno-vectorize> $<$<CONFIG:Release>:-fno-slp-vectorize>)
endif()

add_compile_options(-Wall -Wextra -Wpedantic -Wshadow)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 finds these in std::string (GCC bug 105651) and in inlined Eigen expressions where there is nothing to find.
  add_compile_options(-Wno-restrict -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow)
endif()
if(CAROM_WARNINGS_AS_ERRORS)
  add_compile_options(-Werror)
endif()

if(CAROM_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  # A null or misaligned vector access ends the process all the same, the sizes of objects are the address sanitizer's,
  # and Eigen makes blocks of matrices without columns at offsets from null. Without these checks Eigen's expressions
  # take half the time to compile.
  add_compile_options(-fno-sanitize=null,alignment,object-size,pointer-overflow)
  add_link_options(-fsanitize=address,undefined)
endif()
if(CAROM_SANITIZE_THREADS)
  add_compile_options(-fsanitize=thread -fno-omit-frame-pointer)
  add_link_options(-fsanitize=thread)
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")  # GCC says by itself what it instruments; oneTBB and parallel.cpp ask for it
  add_compile_definitions($<$<BOOL:${CAROM_SANITIZE}>:__SANITIZE_ADDRESS__>
    $<$<BOOL:${CAROM_SANITIZE_THREADS}>:__SANITIZE_THREAD__>)
endif()
if(CAROM_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)  # the fuzz targets link its main program
endif()
if(CAROM_SANITIZE OR CMAKE_BUILD_TYPE STREQUAL "Debug")
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
endif()

# ccache, and an allocator for the compiler (cmake/compile says why).
find_program(CAROM_CCACHE ccache)
find_library(CAROM_COMPILER_ALLOCATOR mimalloc)
mark_as_advanced(CAROM_CCACHE CAROM_COMPILER_ALLOCATOR)
if(NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${PROJECT_SOURCE_DIR}/cmake/compile)
  if(CAROM_CCACHE)
    list(APPEND CMAKE_CXX_COMPILER_LAUNCHER --cache ${CAROM_CCACHE})
  endif()
  if(CAROM_COMPILER_ALLOCATOR)
    list(APPEND CMAKE_CXX_COMPILER_LAUNCHER --allocator ${CAROM_COMPILER_ALLOCATOR})
  endif()
  list(APPEND CMAKE_CXX_COMPILER_LAUNCHER ${PROJECT_SOURCE_DIR})
endif()

# The linker: mold takes a fraction of the time of the default one, with which nothing else changes. Before 2.4 it may protect a page
# that is not there, by chance of the layout, and such a program does not start (rui314/mold#1151); and 1.10.1 never ended on
# some programs, in their GNU hash tables.
find_program(CAROM_MOLD mold)
mark_as_advanced(CAROM_MOLD)
if(CAROM_MOLD AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  execute_process(COMMAND ${CAROM_MOLD} --version OUTPUT_VARIABLE mold_version)
  if(mold_version MATCHES "mold ([0-9]+[.][0-9]+)" AND CMAKE_MATCH_1 VERSION_GREATER_EQUAL 2.4)
    add_link_options(-fuse-ld=mold)
  endif()
endif()

# What reads, writes and prints spends its time elsewhere: with -O1 it is as fast to use and faster to build, and under the
# sanitizers it need not be optimised at all. Tests that compute for long need no more than -O2, others nothing: clang
# compiles them in half the time. Under the sanitizers running those would take longer than that saves. The bits are
# those of -O3.
function(carom_optimise_well target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O2>)
endfunction()
function(carom_optimise_lightly target)
  if(CAROM_SANITIZE OR CAROM_SANITIZE_THREADS)
    target_compile_options(${target} PRIVATE -O0)
  else()
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
endfunction()
function(carom_do_not_optimise target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O0>)
endfunction()

if(NOT CAROM_PCH)
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()
