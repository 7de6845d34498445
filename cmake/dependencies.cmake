# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
# What Reckon takes from Debian 12. `./run packages` installs all of it. reckonConfig.cmake includes
# this file too, for Reckon's libraries are static and their users link the same things.

find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt 9 REQUIRED)
pkg_check_modules(OpenMesh REQUIRED IMPORTED_TARGET openmesh)
pkg_check_modules(libusb REQUIRED IMPORTED_TARGET libusb-1.0)
pkg_check_modules(tomlplusplus REQUIRED IMPORTED_TARGET tomlplusplus)
pkg_check_modules(pcap REQUIRED IMPORTED_TARGET libpcap)
pkg_check_modules(zstd REQUIRED IMPORTED_TARGET libzstd)

# Debian's Asio ships neither a CMake package nor a .pc file.
find_path(ASIO_INCLUDE_DIR asio.hpp REQUIRED)
if(NOT TARGET reckon_asio)
  add_library(reckon_asio INTERFACE IMPORTED GLOBAL)
  target_include_directories(reckon_asio INTERFACE ${ASIO_INCLUDE_DIR})
  target_compile_definitions(reckon_asio INTERFACE ASIO_STANDALONE ASIO_NO_DEPRECATED)
  target_link_libraries(reckon_asio INTERFACE Threads::Threads)
endif()
