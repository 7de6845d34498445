# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
# Debian packages of what install() installs, by its components: reckon (programs), reckon-dev, reckon-doc. ./run package
# makes them. What install() alone does not need, for Debian's rules, is in cmake/debian.
find_program(GZIP gzip)
if(NOT GZIP OR RECKON_SANITIZE OR CMAKE_CROSSCOMPILING OR NOT RECKON_BUILD_TOOLS)
  return()
endif()
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # ./run package builds what is packed, no tests
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME reckon)
set(CPACK_PACKAGE_VENDOR "The Reckon authors")
set(CPACK_PACKAGE_CONTACT "The Reckon authors <reckon@localhost.localdomain>")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL program dev doc debian_program debian_dev debian_doc)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME reckon)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "reckon-doc, wireshark")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "Peers on a LAN exchange IEEE 1278.1 (DIS) Entity State PDUs over UDP
multicast. An area of interest gives each peer what its entities can sense.
Each peer predicts pose and contact force of remote entities, so that a force
loop of 1 kHz stays stable whatever the network does.
.
The program runs peers and demonstrations, inspects, records and replays DIS
traffic, shows an exercise in a browser, and measures accuracy and cost.")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME reckon-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libeigen3-dev, libopenmesh-dev, libpng-dev, libfmt-dev, libtomlplusplus-dev, libpcap-dev, libzstd-dev, libarchive-dev, libsodium-dev")
set(CPACK_DEBIAN_DEV_DESCRIPTION "Static libraries, headers, CMake package and pkg-config files: PDU codec, dead
reckoning, area of interest, haptics and the peer, each by itself.")
set(CPACK_DEBIAN_DOC_PACKAGE_NAME reckon-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOC_DESCRIPTION "Guides for scene files, areas of interest, the wire format, the inspector and
the library, with what is measured of each.")

# Debian wants a change log and a copyright file of each package.
set(debian ${PROJECT_BINARY_DIR}/debian)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(CONFIGURE OUTPUT ${debian}/changelog CONTENT "reckon (@PROJECT_VERSION@) unstable; urgency=medium

  * See CHANGELOG.md in this folder.

 -- @CPACK_PACKAGE_CONTACT@  @date@
" @ONLY)
execute_process(COMMAND ${GZIP} -9nc ${debian}/changelog OUTPUT_FILE ${debian}/changelog.gz COMMAND_ERROR_IS_FATAL ANY)
foreach(part program dev doc)
  string(TOUPPER ${part} upper)
  set(name ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  install(FILES cmake/debian/copyright ${debian}/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name}
    COMPONENT debian_${part} EXCLUDE_FROM_ALL)
endforeach()
add_custom_command(OUTPUT ${debian}/reckon.1.gz DEPENDS ${PROJECT_BINARY_DIR}/reckon.1 VERBATIM
  COMMAND ${GZIP} -9nc ${PROJECT_BINARY_DIR}/reckon.1 > ${debian}/reckon.1.gz)
add_custom_target(reckon_debian_pages ALL DEPENDS ${debian}/reckon.1.gz)
install(FILES ${debian}/reckon.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT debian_program EXCLUDE_FROM_ALL)
if(TARGET reckon-bench)
  install(FILES ${debian}/reckon.1.gz RENAME reckon-bench.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
    COMPONENT debian_program EXCLUDE_FROM_ALL)
endif()
install(FILES cmake/debian/reckon-record.service DESTINATION lib/systemd/system COMPONENT debian_program EXCLUDE_FROM_ALL)

include(CPack)
foreach(part program dev doc)
  cpack_add_component(${part} GROUP ${part})
  cpack_add_component(debian_${part} GROUP ${part})
endforeach()
