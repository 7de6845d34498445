# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
# cmake -D BUILD=<Reckon's build folder> -D SOURCE=<this folder> -D CXX=<compiler> -D PKG_CONFIG=<program>
#   -P consumer.cmake: installs into a stage, then uses it as other projects do, both ways.
set(work ${BUILD}/consumer)
set(stage ${work}/stage)
file(REMOVE_RECURSE ${work})
set(programs decoder peer)

function(do)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE failed OUTPUT_VARIABLE words ERROR_VARIABLE words)
  if(failed)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "failed: ${command}\n${words}")
  endif()
endfunction()

do(${CMAKE_COMMAND} --install ${BUILD} --prefix ${stage})
do(${stage}/bin/reckon --version)
foreach(file man/man1/reckon.1 bash-completion/completions/reckon reckon/wireshark/reckon.lua)
  if(NOT EXISTS ${stage}/share/${file})
    message(FATAL_ERROR "share/${file} is not installed")
  endif()
endforeach()

# 1. find_package(reckon)
do(${CMAKE_COMMAND} -S ${SOURCE} -B ${work}/build -G Ninja -D CMAKE_PREFIX_PATH=${stage}
  -D CMAKE_CXX_COMPILER=${CXX} -D CMAKE_BUILD_TYPE=Release)
do(${CMAKE_COMMAND} --build ${work}/build)
foreach(program ${programs})
  do(${work}/build/${program})
endforeach()

# 2. pkg-config
file(GLOB_RECURSE pc ${stage}/reckon.pc)
get_filename_component(pc_folder ${pc} DIRECTORY)
set(ENV{PKG_CONFIG_PATH} ${pc_folder})
execute_process(COMMAND ${PKG_CONFIG} --cflags --libs reckon OUTPUT_VARIABLE flags
  COMMAND_ERROR_IS_FATAL ANY OUTPUT_STRIP_TRAILING_WHITESPACE)
separate_arguments(flags UNIX_COMMAND "${flags}")
foreach(program ${programs})
  do(${CXX} -O1 ${SOURCE}/${program}.cpp -o ${work}/${program} ${flags})
  do(${work}/${program})
endforeach()
