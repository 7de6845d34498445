# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
# What each component takes from Debian 12. `./run packages` installs all of it. reckonConfig.cmake includes this file
# too, for Reckon's libraries are static and their users link the same things.

set(RECKON_COMPONENTS pdu deadreckon aoim haptics peer)
# What each is built upon.
set(RECKON_pdu_UPON)
set(RECKON_deadreckon_UPON pdu)
set(RECKON_aoim_UPON pdu)
set(RECKON_haptics_UPON deadreckon)
set(RECKON_peer_UPON aoim haptics)

# reckon_closure(OUT COMPONENT..): these components and all that they are built upon, the lowest first.
function(reckon_closure out)
  set(wanted ${ARGN})
  set(closure)
  while(wanted)
    list(POP_FRONT wanted component)
    list(REMOVE_ITEM closure ${component})
    list(PREPEND closure ${component})
    list(APPEND wanted ${RECKON_${component}_UPON})
  endwhile()
  set(${out} ${closure} PARENT_SCOPE)
endfunction()

# reckon_find_dependencies(COMPONENT..): the libraries of others that just these need.
macro(reckon_find_dependencies)
  foreach(component ${ARGN})
    if(component STREQUAL deadreckon)
      find_package(Eigen3 3.4 REQUIRED NO_MODULE)
    elseif(component STREQUAL haptics)
      find_package(PkgConfig REQUIRED)
      pkg_check_modules(OpenMesh REQUIRED IMPORTED_TARGET openmesh)
      pkg_check_modules(png REQUIRED IMPORTED_TARGET libpng)
      pkg_check_modules(zlib REQUIRED IMPORTED_TARGET zlib)
      pkg_check_modules(ode REQUIRED IMPORTED_TARGET ode)
      pkg_check_modules(usb REQUIRED IMPORTED_TARGET libusb-1.0)
    elseif(component STREQUAL peer)
      find_package(Threads REQUIRED)
      find_package(fmt 9 REQUIRED)
      find_package(PkgConfig REQUIRED)
      pkg_check_modules(tomlplusplus REQUIRED IMPORTED_TARGET tomlplusplus)
      pkg_check_modules(pcap REQUIRED IMPORTED_TARGET libpcap)
      pkg_check_modules(zstd REQUIRED IMPORTED_TARGET libzstd)
      pkg_check_modules(sodium REQUIRED IMPORTED_TARGET libsodium)
    endif()
  endforeach()
endmacro()
