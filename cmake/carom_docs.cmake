# SPDX-License-Identifier: MIT
# The target docs: the reference of the public headers, as HTML in docs/api of the build folder. Any public name that is
# not documented is an error. Needs Doxygen (scripts/setup docs).
find_package(Doxygen QUIET)
if(NOT Doxygen_FOUND)
  return()
endif()

set(carom_doc_inputs ${PROJECT_SOURCE_DIR}/docs/api/main_page.md ${PROJECT_SOURCE_DIR}/docs/api/examples.dox
  ${PROJECT_BINARY_DIR}/generated/carom/version.h)
foreach(folder IN LISTS carom_components)
  get_target_property(headers carom_${folder} HEADER_SET)
  list(APPEND carom_doc_inputs ${headers})
endforeach()

set(DOXYGEN_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/docs)
set(DOXYGEN_HTML_OUTPUT api)
set(DOXYGEN_PROJECT_NAME carom)
set(DOXYGEN_STRIP_FROM_PATH ${PROJECT_SOURCE_DIR})
set(DOXYGEN_EXAMPLE_PATH ${PROJECT_SOURCE_DIR}/examples)
set(DOXYGEN_EXAMPLE_PATTERNS *.cpp)
set(DOXYGEN_EXAMPLE_RECURSIVE YES)
set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
set(DOXYGEN_SORT_MEMBER_DOCS NO)
set(DOXYGEN_HAVE_DOT NO)
set(DOXYGEN_QUIET YES)
set(DOXYGEN_WARN_IF_UNDOCUMENTED YES)
set(DOXYGEN_WARN_AS_ERROR FAIL_ON_WARNINGS)
set(DOXYGEN_GENERATE_TAGFILE ${PROJECT_BINARY_DIR}/docs/carom.tag)
doxygen_add_docs(docs ${carom_doc_inputs} USE_STAMP_FILE COMMENT "API reference in docs/api")

if(CAROM_TESTS)
  add_test(NAME docs.reference COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR} --target docs)
  set_tests_properties(docs.reference PROPERTIES LABELS docs FIXTURES_SETUP reference)
  find_program(CAROM_PYTHON python3)
  mark_as_advanced(CAROM_PYTHON)
  if(CAROM_PYTHON)
    add_test(NAME docs.names COMMAND ${CAROM_PYTHON} ${PROJECT_SOURCE_DIR}/tests/build/reference_names.py
      ${PROJECT_BINARY_DIR}/docs/carom.tag ${carom_doc_inputs})
    set_tests_properties(docs.names PROPERTIES LABELS docs FIXTURES_REQUIRED reference)
  else()
    message(STATUS "no python3: the test that all public names are in the reference is left out")
  endif()
endif()
