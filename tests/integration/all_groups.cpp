// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Preloaded into a program (LD_PRELOAD), suppresses IP_MULTICAST_ALL = 0: its sockets then behave
// as in programs without this option.
#include <dlfcn.h>
#include <netinet/in.h>
#include <sys/socket.h>

extern "C" int setsockopt(int socket, int level, int name, const void* value,
                          socklen_t size) noexcept {
  using Call = int (*)(int, int, int, const void*, socklen_t);
  static const auto real = reinterpret_cast<Call>(dlsym(RTLD_NEXT, "setsockopt"));
  if (level == IPPROTO_IP && name == IP_MULTICAST_ALL) return 0;
  return real(socket, level, name, value, size);
}
