# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
# Debian packages of what install() installs, by its components: reckon (programs), reckon-dev, reckon-doc, and
# python3-reckon where the module is built. ./run package makes them. What install() alone does not need, for Debian's rules, is in cmake/debian.
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
set(parts program dev doc)
if(TARGET reckon_python)
  list(APPEND parts python)
endif()
set(CPACK_COMPONENTS_ALL ${parts})
foreach(part IN LISTS parts)
  list(APPEND CPACK_COMPONENTS_ALL debian_${part})
endforeach()
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)

# Libraries that are loaded when they are needed, which dpkg-shlibdeps does not see: cmake/container.sh and cmake/sbom.py have them too.
set(RECKON_LOADED_PACKAGES "libarchive13")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME reckon)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "${RECKON_LOADED_PACKAGES}")
# The unit of a recorder that was enabled goes with the package.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONTROL_EXTRA
  ${PROJECT_SOURCE_DIR}/cmake/debian/program/prerm ${PROJECT_SOURCE_DIR}/cmake/debian/program/postrm)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONTROL_STRICT_PERMISSION ON)
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
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libeigen3-dev, libopenmesh-dev, libpng-dev, zlib1g-dev, libode-dev, libusb-1.0-0-dev, libfmt-dev, libtomlplusplus-dev, libpcap-dev, libzstd-dev, libsodium-dev, ${RECKON_LOADED_PACKAGES}")
set(CPACK_DEBIAN_DEV_DESCRIPTION "Static libraries, headers, CMake package and pkg-config files: PDU codec, dead
reckoning, area of interest, haptics and the peer, each by itself.")
set(CPACK_DEBIAN_DOC_PACKAGE_NAME reckon-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOC_DESCRIPTION "Guides for scene files, areas of interest, the wire format, the inspector and
the library, with what is measured of each.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-reckon)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
  ${PROJECT_SOURCE_DIR}/cmake/debian/python/postinst ${PROJECT_SOURCE_DIR}/cmake/debian/python/prerm)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "reckon, reckon-doc")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "DIS traffic, dead reckoning and scenes for Python
The module reckon decodes and encodes every PDU of IEEE 1278.1 as an object,
reads captures as numpy arrays, predicts poses, runs scenes in simulated time,
and joins exercises as a federate.")
if(TARGET reckon_python)
  get_target_property(minor reckon_python MINOR_VERSION)
  math(EXPR next "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${minor}~), python3 (<< 3.${next}), python3-numpy, ${RECKON_LOADED_PACKAGES}")
endif()

# Debian wants a change log and a copyright file of each package.
set(debian ${PROJECT_BINARY_DIR}/debian)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(CONFIGURE OUTPUT ${debian}/changelog CONTENT "reckon (@PROJECT_VERSION@) unstable; urgency=medium

  * See CHANGELOG.md in this folder.

 -- @CPACK_PACKAGE_CONTACT@  @date@
" @ONLY)
execute_process(COMMAND ${GZIP} -9nc ${debian}/changelog OUTPUT_FILE ${debian}/changelog.gz COMMAND_ERROR_IS_FATAL ANY)
foreach(part IN LISTS parts)
  string(TOUPPER ${part} upper)
  set(name ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  install(FILES cmake/debian/copyright ${debian}/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name}
    COMPONENT debian_${part} EXCLUDE_FROM_ALL)
endforeach()
set(programs reckon reckon-peer reckon-inspect)
if(TARGET reckon-bench)
  list(APPEND programs reckon-bench)
endif()
add_custom_command(OUTPUT ${debian}/reckon.1.gz DEPENDS ${programs} VERBATIM
  COMMAND $<TARGET_FILE:reckon> help --man > ${debian}/reckon.1
  COMMAND ${GZIP} -9nc ${debian}/reckon.1 > ${debian}/reckon.1.gz)
add_custom_target(reckon_debian_pages ALL DEPENDS ${debian}/reckon.1.gz)
install(FILES ${debian}/reckon.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT debian_program EXCLUDE_FROM_ALL)
list(REMOVE_ITEM programs reckon)
foreach(program IN LISTS programs)
  install(FILES ${debian}/reckon.1.gz RENAME ${program}.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
    COMPONENT debian_program EXCLUDE_FROM_ALL)
endforeach()
install(FILES cmake/debian/reckon-record.service DESTINATION lib/systemd/system COMPONENT debian_program EXCLUDE_FROM_ALL)

include(CPack)
foreach(part IN LISTS parts)
  cpack_add_component(${part} GROUP ${part})
  cpack_add_component(debian_${part} GROUP ${part})
endforeach()
