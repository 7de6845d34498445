# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
# The files of the viewer's page become part of the program, each compressed and plain; one file of assembler takes them in.
# A new one is a file in page/, without a line here.
enable_language(ASM)
find_program(GZIP gzip REQUIRED)
set(page ${CMAKE_CURRENT_SOURCE_DIR}/viewer/page)
set(made ${CMAKE_CURRENT_BINARY_DIR}/page)
file(MAKE_DIRECTORY ${made})
file(GLOB page_files CONFIGURE_DEPENDS ${page}/*.html ${page}/*.css ${page}/*.js ${page}/third_party/libraries.js)
list(SORT page_files)
set(page_rows)
set(packed_files)
foreach(file ${page_files})
  cmake_path(GET file FILENAME name)
  set(packed ${made}/${name}.gz)
  add_custom_command(OUTPUT ${packed} COMMAND ${GZIP} -9nc ${file} > ${packed} DEPENDS ${file} VERBATIM)
  string(APPEND page_rows "        .asciz \"/${name}\"\n        .8byte 2f - 1f, 3f - 2f\n1:      .incbin \"${packed}\"\n2:      .incbin \"${file}\"\n3:\n")
  list(APPEND packed_files ${packed})
endforeach()
configure_file(${CMAKE_CURRENT_SOURCE_DIR}/viewer/page_archive.S.in ${made}/page_archive.S @ONLY)
set_source_files_properties(${made}/page_archive.S PROPERTIES OBJECT_DEPENDS "${packed_files}")
target_sources(reckon_viewer PRIVATE ${made}/page_archive.S)
