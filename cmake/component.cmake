# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
# reckon_component(name PUBLIC .. HEADERS .. SOURCES .. ALONE .. APART .. COLD .. DEPENDS .. PRIVATE ..): one folder = one library = one
# namespace. HEADERS and SOURCES may stand once for each room of the folder. Installed are the headers directly in the folder, the
# PUBLIC ones of its rooms, and what these include.

# Includes carry the project's name, here as where it is installed: "reckon/pdu/..", and "reckon/peer/.." for src. In the
# build folder these are links to the folders.
set(reckon_include ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${reckon_include}/reckon)
foreach(folder pdu deadreckon aoim haptics tools tests bench python)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${folder} ${reckon_include}/reckon/${folder} SYMBOLIC)
endforeach()
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/src ${reckon_include}/reckon/peer SYMBOLIC)

# Warnings are errors for our own code only; dependencies come in as system headers.
add_library(reckon_warnings INTERFACE)
target_compile_options(reckon_warnings INTERFACE
  -Wall -Wextra -Wconversion -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Werror
  # The same inputs give the same bits whatever the compiler fuses.
  -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 reports it falsely for std::string operator+ (GCC bug 105329).
  target_compile_options(reckon_warnings INTERFACE -Wno-restrict)
  if(RECKON_SANITIZE)
    # And these once the sanitizers have instrumented Eigen and std::optional.
    target_compile_options(reckon_warnings INTERFACE -Wno-maybe-uninitialized -Wno-array-bounds
      -Wno-stringop-overflow)
    # Asio uses fences, which ThreadSanitizer does not see.
    target_compile_options(reckon_warnings INTERFACE -Wno-tsan)
  endif()
elseif(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  # Clang 14 does not see that a generic lambda calls members of `this`.
  target_compile_options(reckon_warnings INTERFACE -Wno-unused-lambda-capture)
endif()

option(RECKON_HARDENED "Harden our own targets: stack protector, checked calls of the C library, no late binding" ON)

add_library(reckon_options INTERFACE)
if(RECKON_SANITIZE)
  target_compile_options(reckon_options INTERFACE -fsanitize=${RECKON_SANITIZE}
    -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(reckon_options INTERFACE -fsanitize=${RECKON_SANITIZE})
elseif(RECKON_HARDENED)
  # The C library checks calls only in optimised code. Level 3, which checks sizes that are known at run time, makes
  # encoding 2.7 times as slow.
  target_compile_options(reckon_options INTERFACE -fstack-protector-strong
    "$<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2>")
  target_link_options(reckon_options INTERFACE -Wl,-z,relro,-z,now)
endif()

option(RECKON_UNITE "Compile files of a room together: from scratch in half the time" ON)
option(RECKON_PRECOMPILE "Precompile what most files include: an edit of one file compiles sooner" OFF)

# reckon_precompile(target): the standard headers, and Eigen and fmt where the target is linked with them.
function(reckon_precompile target)
  if(NOT RECKON_PRECOMPILE)
    return()
  endif()
  set(headers <algorithm> <array> <chrono> <cmath> <cstddef> <cstdint> <functional> <limits> <map> <memory> <optional>
    <span> <string> <string_view> <tuple> <utility> <variant> <vector>)
  get_target_property(libraries ${target} LINK_LIBRARIES)
  if(libraries MATCHES "deadreckon|haptics|peer|tools|bench")
    list(APPEND headers <Eigen/Core> <Eigen/Geometry>)
  endif()
  if(libraries MATCHES "fmt|peer|tools|bench")
    list(APPEND headers <fmt/format.h>)
  endif()
  if(libraries MATCHES "GTest")
    list(APPEND headers <gtest/gtest.h> <gmock/gmock.h>)
  endif()
  target_precompile_headers(${target} PRIVATE ${headers})
endfunction()

# reckon_unite(target SOURCES .. ALONE .. APART .. COLD ..): sixteen files of a folder at a time become one translation unit. What
# is left over of folders is compiled with what is left over of the next, up to twenty files.
# APART: "FILE FILE .." "FILE FILE .." ..: files with a name of their own (in an unnamed namespace) that a neighbour has
# too, each list one unit. ALONE: those with definitions from CMake, or too long for company. Where the compiler says that
# two names collide, rename one, or name its file here; a file of tests gets a namespace that has its name.
# COLD: rooms and files that run at a start, for a person or for a page. They need no more than -O1, which takes half the
# time to compile, and twice as many share what they include. A list of APART is as cold as its first file.
# Without RECKON_UNITE each compiles by itself, which shows includes that are missing.
function(reckon_unite target)
  cmake_parse_arguments(ARG "" "" "SOURCES;ALONE;APART;COLD" ${ARGN})
  set(sources ${ARG_SOURCES})
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  set(cold_sources)
  foreach(cold ${ARG_COLD})
    string(REPLACE "." "\\." pattern ${cold})
    set(files ${sources})
    list(FILTER files INCLUDE REGEX "^${pattern}(/|$)")
    if(NOT files)
      message(FATAL_ERROR "${target}: COLD names what SOURCES does not, or twice: ${cold}")
    endif()
    reckon_cold(${files})
    list(REMOVE_ITEM sources ${files})
    list(APPEND cold_sources ${files})
  endforeach()
  if(NOT RECKON_UNITE)
    return()
  endif()
  foreach(unit IN LISTS ARG_APART)
    separate_arguments(files UNIX_COMMAND "${unit}")
    list(GET files 0 first)
    string(MAKE_C_IDENTIFIER "${first}" name)
    reckon_united_unit(${target} apart_${name} ${files})
    if(first IN_LIST cold_sources)
      reckon_cold(${united})
    endif()
    foreach(file ${files})
      if(NOT file IN_LIST ARG_SOURCES)
        message(FATAL_ERROR "${target}: APART names what SOURCES does not: ${file}")
      endif()
    endforeach()
    list(REMOVE_ITEM sources ${files})
    list(REMOVE_ITEM cold_sources ${files})
  endforeach()
  list(REMOVE_ITEM sources ${ARG_ALONE})
  list(REMOVE_ITEM cold_sources ${ARG_ALONE})
  reckon_united_rooms(${target} "" 16 20 ${sources})
  # After the others: of a function that both kinds have, a linker takes the first.
  reckon_united_rooms(${target} cold_ 32 40 ${cold_sources})
  # GCC takes what a source file keeps to itself for a header's, where the file is included in another.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()

# reckon_cold(FILE..): compiled for a short build. GCC 12 then says falsely of some copies that they take what was never set.
function(reckon_cold)
  set_property(SOURCE ${ARGN} APPEND PROPERTY COMPILE_OPTIONS
    $<$<CONFIG:Release>:-O1> $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:-Wno-maybe-uninitialized>)
endfunction()

# reckon_united_rooms(target prefix number most FILE..): units of so many files of a room, and of at most so many of what is
# left over of rooms. Those with a prefix are cold.
function(reckon_united_rooms target prefix number most)
  set(rooms)
  set(left)
  foreach(file ${ARGN})
    reckon_include_name(name ${file})
    cmake_path(GET name PARENT_PATH folder)
    string(MAKE_C_IDENTIFIER "${prefix}${folder}" room)
    if(NOT room IN_LIST rooms)
      list(APPEND rooms ${room})
      set(files_${room})
    endif()
    list(APPEND files_${room} ${file})
  endforeach()
  foreach(room ${rooms})
    set(group 0)
    list(LENGTH files_${room} count)
    while(count GREATER_EQUAL number)
      list(SUBLIST files_${room} 0 ${number} files)
      list(REMOVE_ITEM files_${room} ${files})
      reckon_united_unit(${target} ${room}_${group} ${files})
      list(APPEND units ${united})
      math(EXPR group "${group} + 1")
      math(EXPR count "${count} - ${number}")
    endwhile()
    list(LENGTH left together)
    math(EXPR together "${together} + ${count}")
    if(together GREATER most)
      reckon_united_unit(${target} ${left_room}_rest ${left})
      list(APPEND units ${united})
      set(left)
    endif()
    if(count AND NOT left)
      set(left_room ${room})
    endif()
    list(APPEND left ${files_${room}})
  endforeach()
  if(left)
    reckon_united_unit(${target} ${left_room}_rest ${left})
    list(APPEND units ${united})
  endif()
  if(prefix AND units)
    reckon_cold(${units})
  endif()
endfunction()

# reckon_include_name(OUT FILE): as in an include line, after "reckon/": the name of the link above, not the path, so that a
# compiler's cache serves every clone.
function(reckon_include_name out file)
  cmake_path(ABSOLUTE_PATH file NORMALIZE OUTPUT_VARIABLE path)
  cmake_path(RELATIVE_PATH path BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE name)
  string(REGEX REPLACE "^src/" "peer/" name "${name}")
  set(${out} ${name} PARENT_SCOPE)
endfunction()

# reckon_united_unit(target unit FILE..): one translation unit of these files, which are no units of their own any more. Its path is in `united`.
function(reckon_united_unit target unit)
  set_source_files_properties(${ARGN} PROPERTIES HEADER_FILE_ONLY ON)
  set(lines)
  foreach(file ${ARGN})
    reckon_include_name(name ${file})
    string(APPEND lines "#include \"reckon/${name}\"\n")
  endforeach()
  set(united ${CMAKE_CURRENT_BINARY_DIR}/united/${target}/${unit}.cpp)
  file(CONFIGURE OUTPUT ${united} CONTENT "${lines}" @ONLY)
  target_sources(${target} PRIVATE ${united})
  set(united ${united} PARENT_SCOPE)
endfunction()

function(reckon_component name)
  cmake_parse_arguments(ARG "" "" "PUBLIC;HEADERS;SOURCES;ALONE;APART;COLD;DEPENDS;PRIVATE" ${ARGN})
  set(target reckon_${name})
  if(NOT ARG_SOURCES)
    list(APPEND ARG_SOURCES ${PROJECT_SOURCE_DIR}/cmake/empty.cpp)
  endif()
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(reckon::${name} ALIAS ${target})
  reckon_unite(${target} SOURCES ${ARG_SOURCES} ALONE ${ARG_ALONE} APART ${ARG_APART} COLD ${ARG_COLD})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON LINKER_LANGUAGE CXX)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_sources(${target} PRIVATE ${ARG_HEADERS})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${reckon_include}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  set(doors ${ARG_HEADERS})
  list(FILTER doors EXCLUDE REGEX /)
  list(APPEND doors ${ARG_PUBLIC})
  list(TRANSFORM doors PREPEND reckon/${name}/)
  set_property(TARGET ${target} PROPERTY RECKON_PUBLIC_HEADERS ${doors})
  target_link_libraries(${target} PUBLIC ${ARG_DEPENDS}
    PRIVATE ${ARG_PRIVATE} $<BUILD_INTERFACE:reckon_warnings> $<BUILD_INTERFACE:reckon_options>)
  reckon_precompile(${target})
  set_property(GLOBAL APPEND PROPERTY RECKON_COMPONENTS ${target})
endfunction()

# reckon_components_first(program): of a function that a header gives to several files a linker takes the first, which is
# then not that of cold code: cold units come from the libraries, after all others.
function(reckon_components_first program)
  foreach(component ${RECKON_COMPONENTS})
    target_sources(${program} PRIVATE $<FILTER:$<TARGET_OBJECTS:reckon_${component}>,EXCLUDE,/cold_>)
  endforeach()
endfunction()
