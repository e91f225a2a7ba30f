# SPDX-License-Identifier: MIT
# cmake -DSOURCE=... -DBUILD=... -DWORK=... -DCOMPILER=... -P try_installed.cmake
# Does what somebody does who finds carom installed: installs the build BUILD under WORK, builds examples/consumer and the
# C++ program of the README against it, word for word, and runs both; builds that program with what pkg-config says, too.
# Every installed header compiles alone, and all of them in one file. What goes with the command is there. Parts of the
# sources are configured alone, and as a part of another project.

function(run)
  execute_process(COMMAND ${ARGV} OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    list(JOIN ARGV " " words)
    message(FATAL_ERROR "${words}\nended with ${result}:\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/installed)

foreach(page man/man1/carom.1 bash-completion/completions/carom zsh/site-functions/_carom
    fish/vendor_completions.d/carom.fish)
  if(NOT EXISTS ${WORK}/installed/share/${page})
    message(FATAL_ERROR "share/${page} was not installed")
  endif()
  file(READ ${WORK}/installed/share/${page} text)
  foreach(word simulate completion alternatives threads)
    if(NOT text MATCHES ${word})
      message(FATAL_ERROR "share/${page} does not name ${word}")
    endif()
  endforeach()
endforeach()

foreach(file share/carom/scene.schema.json share/carom/journal.schema.json share/doc/carom/LICENSE share/doc/carom/NOTICE)
  if(NOT EXISTS ${WORK}/installed/${file})
    message(FATAL_ERROR "${file} was not installed")
  endif()
endforeach()

# The studio finds its page, and three.js where that was installed before: with both it comes to the scene, which is not
# there.
foreach(file page/index.html page/main.js page/view/view.js scenes/mug.json assets/mug.obj gallery/mug.png)
  if(NOT EXISTS ${WORK}/installed/share/carom/studio/${file})
    message(FATAL_ERROR "share/carom/studio/${file} was not installed")
  endif()
endforeach()
function(studio_says command expected)
  execute_process(COMMAND ${command} studio --no-open nowhere.json
    OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE result)
  if(NOT result EQUAL 1 OR NOT output MATCHES "${expected}")
    message(FATAL_ERROR "${command} studio ended with ${result} and said:\n${output}\nexpected: ${expected}")
  endif()
endfunction()

# From a build as it is beside its sources: its share leads there, and to three.js once that is installed.
set(built ${WORK}/built/share/carom/studio)
file(MAKE_DIRECTORY ${built})
file(COPY ${BUILD}/carom DESTINATION ${WORK}/built)
file(CREATE_LINK ${SOURCE}/studio/page ${built}/page SYMBOLIC)
file(CREATE_LINK ${WORK}/nowhere ${built}/three SYMBOLIC)
set(without_npm "three.js is not installed .*: run scripts/setup studio in the sources of carom")
studio_says(${WORK}/built/carom "${without_npm}")
if(EXISTS ${SOURCE}/studio/page/node_modules/three/LICENSE)
  file(REMOVE ${built}/three)
  file(CREATE_LINK ${SOURCE}/studio/page/node_modules/three ${built}/three SYMBOLIC)
  studio_says(${WORK}/built/carom "found no file 'nowhere.json'")
  studio_says(${WORK}/installed/bin/carom "found no file 'nowhere.json'")
  if(NOT EXISTS ${WORK}/installed/share/carom/studio/three/LICENSE)
    message(FATAL_ERROR "the licence of three.js was not installed")
  endif()
  file(REMOVE_RECURSE ${WORK}/installed/share/carom/studio/three)
endif()
studio_says(${WORK}/installed/bin/carom "${without_npm}")

# Headers: the public ones alone, each of which needs no other; Eigen's, which nearly all include, are compiled once.
set(include ${WORK}/installed/include/carom)
file(GLOB_RECURSE headers RELATIVE ${include} ${include}/*)
list(LENGTH headers count)
if(count LESS 40)
  message(FATAL_ERROR "only ${count} headers were installed")
endif()
set(all "")
foreach(header IN LISTS headers)
  if(NOT header MATCHES "\\.h$")
    message(FATAL_ERROR "${header} is installed; it is no public header")
  endif()
  string(MAKE_C_IDENTIFIER ${header} name)
  file(WRITE ${WORK}/headers/alone/${name}.cpp "#include \"${header}\"\n")
  string(APPEND all "#include \"${header}\"\n")
endforeach()
file(WRITE ${WORK}/headers/alone/all.cpp "${all}int main() { return 0; }\n")
# By <carom/...>, beside the paths of before; macros that say the version.
file(WRITE ${WORK}/headers/alone/umbrella.cpp "#include <carom/version.h>
#if CAROM_VERSION < 100 || CAROM_VERSION != 10000 * CAROM_VERSION_MAJOR + 100 * CAROM_VERSION_MINOR + CAROM_VERSION_PATCH
#error CAROM_VERSION
#endif
#include <carom/editing/edit.h>
#include \"editing/edit.h\"
#include <carom/carom.h>
carom::Edit* edit = nullptr;
carom::OdeContacts* contacts = nullptr;
carom::Document* document = nullptr;
")
file(WRITE ${WORK}/headers/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)
project(headers LANGUAGES CXX)
find_package(carom REQUIRED COMPONENTS formats)
file(GLOB sources alone/*.cpp)
add_library(headers OBJECT \${sources})
target_compile_options(headers PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Werror)
target_precompile_headers(headers PRIVATE <Eigen/Geometry>)
target_link_libraries(headers PRIVATE carom::formats carom::ode_bridge)
")
run(${CMAKE_COMMAND} -S ${WORK}/headers -B ${WORK}/headers/build -G Ninja -DCMAKE_CXX_COMPILER=${COMPILER}
  -DCMAKE_BUILD_TYPE=Debug -DCMAKE_PREFIX_PATH=${WORK}/installed)
run(${CMAKE_COMMAND} --build ${WORK}/headers/build)

# One component needs no package of the others; a component that there is not is named.
file(WRITE ${WORK}/component/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)
project(component LANGUAGES CXX)
find_package(carom REQUIRED COMPONENTS adjoint)
if(TARGET carom::editing OR TARGET TBB::tbb OR TARGET PkgConfig::ODE)
  message(FATAL_ERROR \"the component adjoint brought more than itself\")
endif()
find_package(carom COMPONENTS adjoint studio9)
if(carom_FOUND)
  message(FATAL_ERROR \"there is no component studio9\")
endif()
")
run(${CMAKE_COMMAND} -S ${WORK}/component -B ${WORK}/component/build -G Ninja -DCMAKE_CXX_COMPILER=${COMPILER}
  -DCMAKE_PREFIX_PATH=${WORK}/installed)

# Of the sources alone: adjoint needs Eigen, and no other package is looked for; as a part of another project carom builds
# neither tests nor benchmarks.
set(none "")
foreach(package Boost CLI11 GTest PkgConfig TBB TinyGLTF benchmark nlohmann_json valijson)
  list(APPEND none -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/adjoint_alone -G Ninja -DCMAKE_CXX_COMPILER=${COMPILER}
  -DCAROM_ODE_BRIDGE=OFF -DCAROM_EDITING=OFF ${none})
file(WRITE ${WORK}/parent/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)
project(parent LANGUAGES CXX)
add_subdirectory(${SOURCE} carom EXCLUDE_FROM_ALL)
if(CAROM_TESTS OR CAROM_BENCH OR TARGET carom_bench OR NOT TARGET carom::carom)
  message(FATAL_ERROR \"tests or benchmarks are built in another project\")
endif()
")
run(${CMAKE_COMMAND} -S ${WORK}/parent -B ${WORK}/parent/build -G Ninja -DCMAKE_CXX_COMPILER=${COMPILER})

file(READ ${SOURCE}/README.md readme)
if(NOT readme MATCHES "```cpp\n(#include[^`]*)```")
  message(FATAL_ERROR "README.md has no C++ program")
endif()
file(WRITE ${WORK}/readme.cpp "${CMAKE_MATCH_1}")
if(NOT readme MATCHES "```json\n([^`]*)```")
  message(FATAL_ERROR "README.md has no scene")
endif()
file(WRITE ${WORK}/scene.json "${CMAKE_MATCH_1}")

run(${CMAKE_COMMAND} -S ${SOURCE}/examples/consumer -B ${WORK}/build -G Ninja -DCMAKE_CXX_COMPILER=${COMPILER}
  -DCMAKE_BUILD_TYPE=Debug -DCMAKE_PREFIX_PATH=${WORK}/installed -DCONSUMER_SOURCES=${WORK}/readme.cpp)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/readme)
run(${WORK}/build/consumer ${WORK}/scene.json)

file(GLOB_RECURSE pc ${WORK}/installed/*/carom.pc)
cmake_path(GET pc PARENT_PATH pc_folder)
set(ENV{PKG_CONFIG_PATH} ${pc_folder})
# Shared libraries in a folder that the loader does not know: as docs/install.md says.
set(rpath "")
file(GLOB shared ${WORK}/installed/*/libcarom_adjoint.so ${WORK}/installed/lib/*/libcarom_adjoint.so)
if(shared)
  set(rpath "-Wl,-rpath,$(pkg-config --variable=libdir carom)")
endif()
run(sh -c "${COMPILER} '${WORK}/readme.cpp' -o '${WORK}/readme_by_pkg_config' $(pkg-config --cflags --libs carom) ${rpath}")
run(${WORK}/readme_by_pkg_config)
foreach(command validate info simulate gradient check edit)
  run(${WORK}/installed/bin/carom ${command} ${WORK}/scene.json)
endforeach()
