// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Preloaded into a program (LD_PRELOAD), delays one join of six as long as the kernel may while
// interfaces of other namespaces change.
#include <dlfcn.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <atomic>
#include <chrono>
#include <thread>

extern "C" int setsockopt(int socket, int level, int name, const void* value,
                          socklen_t size) noexcept {
  using Call = int (*)(int, int, int, const void*, socklen_t);
  static const auto real = reinterpret_cast<Call>(dlsym(RTLD_NEXT, "setsockopt"));
  static std::atomic<unsigned> joins{0};
  if (level == IPPROTO_IP && name == IP_ADD_MEMBERSHIP && joins++ % 6 == 5) {
    std::this_thread::sleep_for(std::chrono::milliseconds(140));
  }
  return real(socket, level, name, value, size);
}
