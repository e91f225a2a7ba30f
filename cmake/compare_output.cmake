# SPDX-License-Identifier: MIT
# cmake -DPROGRAM=... -DEXPECTED=... -DACTUAL=... -P compare_output.cmake
# Runs a program and compares its standard output with a stored text.

execute_process(COMMAND ${PROGRAM} OUTPUT_FILE ${ACTUAL} ERROR_VARIABLE errors RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} ended with ${result}\n${errors}")
endif()
if(NOT EXISTS ${EXPECTED})
  message(FATAL_ERROR "${EXPECTED} does not exist.\nIf the output is right: cp ${ACTUAL} ${EXPECTED}")
endif()
file(READ ${ACTUAL} actual)
file(READ ${EXPECTED} expected)
if(NOT "${actual}" STREQUAL "${expected}")
  message(FATAL_ERROR "The output is not ${EXPECTED}.\n--- expected\n${expected}\n--- found\n${actual}\n"
    "If the new output is right: cp ${ACTUAL} ${EXPECTED}")
endif()
