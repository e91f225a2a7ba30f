# SPDX-License-Identifier: MIT
# cmake -DSOURCE=... -DBUILD=... -DWORK=... -DCOMPILER=... -P try_installed.cmake
# Does what somebody does who finds carom installed: installs the build BUILD under WORK, builds examples/consumer and the
# C++ program of the README against it, word for word, and runs both. What goes with the command is there, too.

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
  foreach(word simulate completion shooting alternatives)
    if(NOT text MATCHES ${word})
      message(FATAL_ERROR "share/${page} does not name ${word}")
    endif()
  endforeach()
endforeach()

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
foreach(command validate info simulate gradient check edit)
  run(${WORK}/installed/bin/carom ${command} ${WORK}/scene.json)
endforeach()
