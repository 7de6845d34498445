# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
# Libraries, public headers and what they include (under include/reckon), the CMake package and the pkg-config files, each component by itself; tools/
# installs the program.
include(CMakePackageConfigHelpers)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/reckon)
set(public_headers)
foreach(component ${RECKON_COMPONENTS})
  get_target_property(doors reckon_${component} RECKON_PUBLIC_HEADERS)
  list(APPEND public_headers ${doors})
  install(TARGETS reckon_${component} EXPORT reckon-${component}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
  install(EXPORT reckon-${component} NAMESPACE reckon:: DESTINATION ${package} COMPONENT dev)
endforeach()

install(CODE "set(headers \"${public_headers}\")
set(from \"${reckon_include}\")
set(to \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}\")" COMPONENT dev)
install(SCRIPT cmake/install_headers.cmake COMPONENT dev)

configure_package_config_file(cmake/reckonConfig.cmake.in ${PROJECT_BINARY_DIR}/reckonConfig.cmake
  INSTALL_DESTINATION ${package} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/reckonConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES cmake/dependencies.cmake ${PROJECT_BINARY_DIR}/reckonConfig.cmake
  ${PROJECT_BINARY_DIR}/reckonConfigVersion.cmake DESTINATION ${package} COMPONENT dev)

# The .pc files find their prefix from where they lie, so that a staged tree can be used or moved.
file(RELATIVE_PATH pc_up /p/${CMAKE_INSTALL_LIBDIR}/pkgconfig /p)
# reckon_pkg_config(NAME PART REQUIRES LIBS CFLAGS)
function(reckon_pkg_config pc_name pc_part pc_requires pc_libs pc_cflags)
  configure_file(cmake/component.pc.in ${PROJECT_BINARY_DIR}/${pc_name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${pc_name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
endfunction()
set(deadreckon_requires eigen3)
set(haptics_requires openmesh libpng zlib ode libusb-1.0)
set(peer_requires fmt tomlplusplus libpcap libzstd libsodium)
foreach(component ${RECKON_COMPONENTS})
  list(TRANSFORM RECKON_${component}_UPON PREPEND reckon- OUTPUT_VARIABLE upon)
  list(JOIN upon " " upon)
  list(JOIN ${component}_requires " " others)
  set(libs "-L\${libdir} -lreckon_${component}")
  if(component STREQUAL peer)
    string(APPEND libs " -pthread")
  endif()
  reckon_pkg_config(reckon-${component} ": ${component}" "${upon} ${others}" "${libs}" "-std=c++20 -I\${includedir}")
endforeach()
reckon_pkg_config(reckon "" reckon-peer "" "")

install(DIRECTORY scenes/ DESTINATION ${CMAKE_INSTALL_DATADIR}/reckon/scenes COMPONENT program)
install(DIRECTORY devices/ DESTINATION ${CMAKE_INSTALL_DATADIR}/reckon/devices COMPONENT program FILES_MATCHING PATTERN "*.toml")
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT license)  # Debian has it
install(FILES README.md CHANGELOG.md SECURITY.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT doc OPTIONAL)
install(FILES NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT doc)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs COMPONENT doc
  FILES_MATCHING PATTERN "*.md" PATTERN "*.svg" PATTERN "*.png" PATTERN "*.xml" PATTERN site EXCLUDE)
# The site of ./run docs, where it was made.
install(DIRECTORY build/docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/html COMPONENT doc OPTIONAL PATTERN ".buildinfo" EXCLUDE)
install(FILES tools/wireshark/reckon.lua DESTINATION ${CMAKE_INSTALL_DATADIR}/reckon/wireshark COMPONENT program)
# reckon_install_page(PART WORDS FILE): what `reckon WORDS` prints.
function(reckon_install_page part words file)
  install(CODE "set(page_command \"$<TARGET_FILE:reckon>\")
set(page_words \"${words}\")
set(page_file \"\${CMAKE_INSTALL_PREFIX}/${file}\")" COMPONENT ${part})
  install(SCRIPT cmake/install_page.cmake COMPONENT ${part})
endfunction()
if(RECKON_BUILD_TOOLS AND NOT CMAKE_CROSSCOMPILING)
  reckon_install_page(man "help;--man" ${CMAKE_INSTALL_MANDIR}/man1/reckon.1)  # compressed for Debian
  reckon_install_page(program "completion;bash" ${CMAKE_INSTALL_DATADIR}/bash-completion/completions/reckon)
  reckon_install_page(program "completion;zsh" ${CMAKE_INSTALL_DATADIR}/zsh/site-functions/_reckon)
  reckon_install_page(program "completion;fish" ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d/reckon.fish)
endif()
# What the docs tell programmers to copy.
set(examples CMakeLists.txt decoder.cpp honey.cpp honey.hpp honey_module.cpp peer.cpp truck.cpp truck.hpp)
list(TRANSFORM examples PREPEND tests/consumer/)
install(FILES ${examples} haptics/plugin/dummy_device.c haptics/serial/paddle.ino haptics/serial/reckon_board.h DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/reckon-dev/examples COMPONENT dev)
