# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
# Libraries, headers (under include/reckon), the CMake package and reckon.pc; tools/ installs the program.
include(CMakePackageConfigHelpers)

set(components pdu deadreckon aoim haptics peer)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/reckon)
list(TRANSFORM components PREPEND reckon_ OUTPUT_VARIABLE targets)

install(TARGETS ${targets} EXPORT reckonTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT reckonTargets NAMESPACE reckon:: DESTINATION ${package})

configure_package_config_file(cmake/reckonConfig.cmake.in ${PROJECT_BINARY_DIR}/reckonConfig.cmake
  INSTALL_DESTINATION ${package} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/reckonConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES cmake/dependencies.cmake ${PROJECT_BINARY_DIR}/reckonConfig.cmake
  ${PROJECT_BINARY_DIR}/reckonConfigVersion.cmake DESTINATION ${package})

# reckon.pc finds its prefix from where it lies, so that a staged tree can be used or moved.
file(RELATIVE_PATH pc_up /p/${CMAKE_INSTALL_LIBDIR}/pkgconfig /p)
configure_file(cmake/reckon.pc.in ${PROJECT_BINARY_DIR}/reckon.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/reckon.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

install(DIRECTORY scenes/ DESTINATION ${CMAKE_INSTALL_DATADIR}/reckon/scenes)
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} OPTIONAL)
install(FILES tools/wireshark/reckon.lua DESTINATION ${CMAKE_INSTALL_DATADIR}/reckon/wireshark)
if(RECKON_BUILD_TOOLS AND NOT CMAKE_CROSSCOMPILING)
  install(FILES ${PROJECT_BINARY_DIR}/reckon.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${PROJECT_BINARY_DIR}/reckon.bash RENAME reckon
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(FILES ${PROJECT_BINARY_DIR}/reckon.zsh RENAME _reckon
    DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
  install(FILES ${PROJECT_BINARY_DIR}/reckon.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
endif()
install(FILES NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR})
