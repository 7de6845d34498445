# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
# cmake -D BUILD=<Reckon's build folder> -D SOURCE=<this folder> -D CXX=<compiler> -D PKG_CONFIG=<program>
#   -P consumer.cmake: installs into a stage what `./run build` makes, without reckon-bench, then uses it as other projects do.
cmake_policy(VERSION 3.25)
set(work ${BUILD}/consumer)
set(stage ${work}/stage)
file(REMOVE_RECURSE ${work})
set(programs decoder peer honey fog own_names)

function(do)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE failed OUTPUT_VARIABLE words ERROR_VARIABLE words)
  if(failed)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "failed: ${command}\n${words}")
  endif()
endfunction()
set(configure ${CMAKE_COMMAND} -S ${SOURCE} -G Ninja -D CMAKE_PREFIX_PATH=${stage} -D CMAKE_CXX_COMPILER=${CXX}
  -D CMAKE_BUILD_TYPE=Release)

# The install scripts of the build folder, for a folder without reckon-bench.
file(GLOB_RECURSE scripts RELATIVE ${BUILD} ${BUILD}/cmake_install.cmake ${BUILD}/*/cmake_install.cmake)
list(FILTER scripts EXCLUDE REGEX "^(consumer|_CPack_Packages)/")
foreach(script IN LISTS scripts)
  file(READ ${BUILD}/${script} text)
  string(REPLACE "include(\"${BUILD}/" "include(\"${work}/scripts/" text "${text}")
  string(REPLACE "${BUILD}/reckon-bench" "${work}/absent/reckon-bench" text "${text}")
  file(WRITE ${work}/scripts/${script} "${text}")
endforeach()
do(${CMAKE_COMMAND} -D CMAKE_INSTALL_PREFIX=${stage} -P ${work}/scripts/cmake_install.cmake)
do(${stage}/bin/reckon --version)
if(EXISTS ${stage}/bin/reckon-bench)
  message(FATAL_ERROR "reckon-bench is not hidden from the install scripts")
endif()
execute_process(COMMAND ${CMAKE_COMMAND} -E env PATH=/usr/bin:/bin ${stage}/bin/reckon bench INPUT_FILE /dev/null
  RESULT_VARIABLE status ERROR_VARIABLE words)
if(NOT status EQUAL 3 OR NOT words MATCHES "Debian package reckon")
  message(FATAL_ERROR "an installed reckon without reckon-bench does not name its package: ${status} ${words}")
endif()
foreach(file man/man1/reckon.1 bash-completion/completions/reckon reckon/wireshark/reckon.lua)
  if(NOT EXISTS ${stage}/share/${file})
    message(FATAL_ERROR "share/${file} is not installed")
  endif()
endforeach()
file(GLOB beside RELATIVE ${stage}/include ${stage}/include/*)
if(NOT beside STREQUAL reckon)
  message(FATAL_ERROR "include/ holds more than reckon/: ${beside}")
endif()

# Public headers and what they include, no more.
file(GLOB_RECURSE headers RELATIVE ${stage}/include ${stage}/include/*.hpp ${stage}/include/*.h)
foreach(header IN LISTS headers)
  file(STRINGS ${stage}/include/${header} lines REGEX "^#include \"reckon/")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^#include \"(.*)\".*$" "\\1" included "${line}")
    if(NOT included IN_LIST headers)
      message(FATAL_ERROR "${header} includes ${included}, which is not installed")
    endif()
  endforeach()
endforeach()
# The example of a driver is built as its page says, in C.
do(${CXX} -x c -shared -fPIC -Wall -Wextra -Werror -I${stage}/include -o ${work}/dummy_device.so
  ${stage}/share/doc/reckon-dev/examples/dummy_device.c)
# What a board includes is C of its own.
do(${CXX} -x c -std=c99 -fsyntax-only -Wall -Wextra -Wconversion -Wno-unused-function -pedantic -Werror
  ${stage}/share/doc/reckon-dev/examples/reckon_board.h)
foreach(header pdu/entity/entity_state.hpp peer/federate.hpp haptics/devices/simulated_device.hpp)
  if(NOT reckon/${header} IN_LIST headers)
    message(FATAL_ERROR "${header} is not installed")
  endif()
endforeach()
foreach(header aoim/cells/over_delivery.hpp peer/network/udp_socket.hpp peer/scene/toml_reader.hpp)
  if(reckon/${header} IN_LIST headers)
    message(FATAL_ERROR "${header} is installed, and no public header includes it")
  endif()
endforeach()

# 1. find_package(reckon)
do(${configure} -B ${work}/build)
do(${CMAKE_COMMAND} --build ${work}/build)
foreach(program ${programs})
  do(${work}/build/${program})
endforeach()
do(${work}/build/truck lo 1)

# 2. One component where none of the others' libraries can be found.
file(MAKE_DIRECTORY ${work}/no_libraries)
set(without)
foreach(library Eigen3 fmt PkgConfig Threads)
  list(APPEND without -D CMAKE_DISABLE_FIND_PACKAGE_${library}=ON)
endforeach()
do(${CMAKE_COMMAND} -E env PKG_CONFIG_LIBDIR=${work}/no_libraries ${configure} -B ${work}/pdu_alone -D RECKON_PARTS=pdu
  ${without})
do(${CMAKE_COMMAND} --build ${work}/pdu_alone)
do(${work}/pdu_alone/decoder)
# And what is asked for in vain is named.
execute_process(COMMAND ${configure} -B ${work}/no_such -D RECKON_PARTS=touch RESULT_VARIABLE failed ERROR_VARIABLE words
  OUTPUT_QUIET)
if(NOT failed OR NOT words MATCHES "no component 'touch'; it has pdu, deadreckon")
  message(FATAL_ERROR "a component that does not exist is not named: ${words}")
endif()

# 3. pkg-config: all of it, and one component.
file(GLOB_RECURSE pc ${stage}/reckon.pc)
get_filename_component(pc_folder ${pc} DIRECTORY)
set(ENV{PKG_CONFIG_PATH} ${pc_folder})
function(compile program source package)
  execute_process(COMMAND ${PKG_CONFIG} --cflags --libs ${package} OUTPUT_VARIABLE flags
    COMMAND_ERROR_IS_FATAL ANY OUTPUT_STRIP_TRAILING_WHITESPACE)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  do(${CXX} -O1 ${ARGN} ${SOURCE}/${source} -o ${work}/${program} ${flags})
  do(${work}/${program})
endfunction()
compile(decoder decoder.cpp reckon)
compile(peer peer.cpp reckon)
compile(own_names own_names/main.cpp reckon -I${SOURCE}/own_names)
set(ENV{PKG_CONFIG_LIBDIR} ${work}/no_libraries)
compile(decoder_alone decoder.cpp reckon-pdu)
