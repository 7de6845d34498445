// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Replaces socket() of the C library in each test program: a suite with the label `fast` opens no
// network socket.
#include <dlfcn.h>
#include <sys/socket.h>

#include <cstdio>
#include <cstdlib>

extern "C" int socket(int domain, int type, int protocol) noexcept {
  using Call = int (*)(int, int, int);
  static const auto next = reinterpret_cast<Call>(dlsym(RTLD_NEXT, "socket"));
  const bool network = domain == AF_INET || domain == AF_INET6;
  if (network && std::getenv("RECKON_NO_SOCKETS") != nullptr) {
    std::fputs("a fast test opens a socket: list its suite behind LIVE in CMakeLists.txt\n", stderr);
    std::_Exit(1);
  }
  return next(domain, type, protocol);
}
