# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
# reckon_component(name HEADERS .. SOURCES .. ALONE .. | EACH_ALONE DEPENDS .. PRIVATE ..): one folder = one library = one namespace. HEADERS
# and SOURCES may stand once for each room of the folder.

# Includes carry the project's name, here as where it is installed: "reckon/pdu/..", and "reckon/peer/.." for src. In the
# build folder these are links to the folders.
set(reckon_include ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${reckon_include}/reckon)
foreach(folder pdu deadreckon aoim haptics tools tests bench)
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

add_library(reckon_options INTERFACE)
if(RECKON_SANITIZE)
  target_compile_options(reckon_options INTERFACE -fsanitize=${RECKON_SANITIZE}
    -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(reckon_options INTERFACE -fsanitize=${RECKON_SANITIZE})
endif()

option(RECKON_UNITE "Compile files of a room together: from scratch in half the time" ON)

# reckon_unite(target SOURCES .. ALONE ..): five files of a folder at a time become one translation unit. ALONE: those
# with a name of their own (in an unnamed namespace) that a neighbour has too, or with definitions from CMake; add a file
# here where the compiler says so.
# Without RECKON_UNITE each compiles by itself, which shows includes that are missing.
function(reckon_unite target)
  cmake_parse_arguments(ARG "" "" "SOURCES;ALONE" ${ARGN})
  if(NOT RECKON_UNITE)
    return()
  endif()
  foreach(file ${ARG_SOURCES})
    if(NOT file MATCHES "\\.cpp$" OR file IN_LIST ARG_ALONE)
      continue()
    endif()
    cmake_path(ABSOLUTE_PATH file NORMALIZE OUTPUT_VARIABLE path)
    # The name of the link above, not the path, so that a compiler's cache serves every clone.
    cmake_path(RELATIVE_PATH path BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE name)
    string(REGEX REPLACE "^src/" "peer/" name "${name}")
    cmake_path(GET name PARENT_PATH folder)
    string(MAKE_C_IDENTIFIER "${folder}" room)
    list(LENGTH files_${room} count)
    math(EXPR group "${count} / 5")
    list(APPEND files_${room} ${file})
    list(APPEND united_${room}_${group} "#include \"reckon/${name}\"")
    list(APPEND groups ${room}_${group})
    set_source_files_properties(${file} PROPERTIES HEADER_FILE_ONLY ON)
  endforeach()
  list(REMOVE_DUPLICATES groups)
  foreach(group ${groups})
    set(united ${CMAKE_CURRENT_BINARY_DIR}/united/${target}/${group}.cpp)
    list(JOIN united_${group} "\n" lines)
    file(CONFIGURE OUTPUT ${united} CONTENT "${lines}\n" @ONLY)
    target_sources(${target} PRIVATE ${united})
  endforeach()
  # GCC takes what a source file keeps to itself for a header's, where the file is included in another.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()

function(reckon_component name)
  cmake_parse_arguments(ARG "EACH_ALONE" "" "HEADERS;SOURCES;ALONE;DEPENDS;PRIVATE" ${ARGN})
  set(target reckon_${name})
  if(NOT ARG_SOURCES)
    list(APPEND ARG_SOURCES ${PROJECT_SOURCE_DIR}/cmake/empty.cpp)
  endif()
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(reckon::${name} ALIAS ${target})
  if(NOT ARG_EACH_ALONE)
    reckon_unite(${target} SOURCES ${ARG_SOURCES} ALONE ${ARG_ALONE})
  endif()
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON LINKER_LANGUAGE CXX)
  target_compile_features(${target} PUBLIC cxx_std_20)
  list(TRANSFORM ARG_HEADERS PREPEND ${reckon_include}/reckon/${name}/)
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${reckon_include} FILES ${ARG_HEADERS})
  target_include_directories(${target} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} PUBLIC ${ARG_DEPENDS}
    PRIVATE ${ARG_PRIVATE} $<BUILD_INTERFACE:reckon_warnings> $<BUILD_INTERFACE:reckon_options>)
  set_property(GLOBAL APPEND PROPERTY RECKON_COMPONENTS ${target})
endfunction()
