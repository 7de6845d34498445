# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
# cmake -D ROOT=<repository> -P layering.cmake: each folder includes only what it may know.
# The include path is the repository's root, so the compiler would not notice.
set(std "<[a-z_0-9]+>")
set(pdu_may "${std}|\"pdu/")
set(aoim_may "${std}|\"(pdu|aoim)/")
set(deadreckon_may "${std}|<Eigen/|\"(pdu|deadreckon)/")
set(haptics_may "${std}|<[a-z_]+\\.h>|<(sys|linux|libusb-1.0|Eigen|OpenMesh)/|\"(pdu|deadreckon|haptics)/")
set(src_may "<|\"(pdu|deadreckon|aoim|haptics|src)/")
set(tools_may "<|\"(pdu|deadreckon|aoim|haptics|src|tools)/")

set(wrong "")
foreach(folder pdu aoim deadreckon haptics src tools)
  file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/${folder}/*.hpp ${ROOT}/${folder}/*.cpp)
  foreach(file ${files})
    file(STRINGS ${ROOT}/${file} lines REGEX "^[ \t]*#[ \t]*include")
    foreach(line IN LISTS lines)
      if(NOT line MATCHES "include[ \t]*(${${folder}_may})")
        string(APPEND wrong "\n  ${file}: ${line}")
      endif()
    endforeach()
  endforeach()
endforeach()
if(wrong)
  message(FATAL_ERROR "A folder includes what it must not know (docs/architecture.md):${wrong}")
endif()
