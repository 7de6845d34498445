# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
# Each test has one label. `fast`: in one process, without sockets of a network. `live`: sockets, whole programs, other tools.

# Tests of programs that speak on lo run each in a network namespace of its own where that is permitted, else one at a time.
set(reckon_apart unshare --net -- sh -c "ip link set lo up && exec \"$@\"" sh)
execute_process(COMMAND ${reckon_apart} true RESULT_VARIABLE reckon_no_namespaces OUTPUT_QUIET ERROR_QUIET)

# reckon_check(name fast|live [APART] COMMAND ..): a test that is a command. APART: its programs speak on lo.
function(reckon_check name label)
  cmake_parse_arguments(ARG "APART" "" "COMMAND" ${ARGN})
  if(ARG_APART AND "${reckon_no_namespaces}" STREQUAL "0")
    list(PREPEND ARG_COMMAND ${reckon_apart})
  endif()
  add_test(NAME ${name} COMMAND ${ARG_COMMAND})
  set_property(TEST ${name} PROPERTY LABELS ${label})
  if(ARG_APART AND NOT "${reckon_no_namespaces}" STREQUAL "0")
    set_property(TEST ${name} PROPERTY RESOURCE_LOCK lo)
  endif()
endfunction()

# reckon_suites(program LIVE SUITE..): each suite of a GoogleTest program becomes one test, PROGRAM.SUITE. Those that match a
# regular expression of LIVE are live, the others fast. ctest asks the program for its suites.
function(reckon_suites program)
  cmake_parse_arguments(ARG "" "" "LIVE" ${ARGN})
  list(JOIN ARG_LIVE "|" live)
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${program}_suites.cmake)
  file(GENERATE OUTPUT ${list} CONTENT "set(program ${program})
set(file \"$<TARGET_FILE:${program}>\")
set(folder \"${CMAKE_CURRENT_BINARY_DIR}\")
set(live \"^(${live})$\")
include(\"${PROJECT_SOURCE_DIR}/cmake/list_suites.cmake\")
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${list})
endfunction()
