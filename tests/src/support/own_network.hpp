// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A network namespace that lasts for one function: it needs no cleanup, and no datagram leaves it.
#pragma once

#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

#include "reckon/peer/network/interface_choice.hpp"

namespace reckon::test {

/// Calls body() in a thread with a network namespace of its own (empty, lo down). Returns false
/// without a call if that is not permitted.
template <typename Body>
[[nodiscard]] bool in_own_network(Body&& body) {
  bool permitted = false;
  std::thread thread([&] {
    permitted =
        unshare(CLONE_NEWNET) == 0 && access("/proc/sys/net/ipv4/igmp_max_memberships", W_OK) == 0;
    if (permitted) body();
  });
  thread.join();
  return permitted;
}

/// Runs a command in this thread's namespace; true if it succeeded.
inline bool run(const char* command) { return std::system(command) == 0; }

/// Runs a command that brings interfaces up. Then waits, at most 30 s, until each has its carrier:
/// a kernel worker reports it later, on a busy host much later.
inline bool bring_up(const char* command) {
  if (!run(command)) return false;
  const auto has_carrier = [](const peer::NetworkInterface& one) { return !one.up || one.running; };
  for (int i = 0; i < 3000; ++i) {
    const auto all = peer::list_interfaces();
    if (std::all_of(all.begin(), all.end(), has_carrier)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// Two interfaces, a0 at 10.66.0.1 and b0 at 10.66.0.2, on both ends of a cable.
inline void make_cable() {
  ASSERT_TRUE(
      bring_up("ip link set lo up && ip link add a0 type veth peer name b0 && "
               "ip addr add 10.66.0.1/24 dev a0 && ip addr add 10.66.0.2/24 dev b0 && "
               "ip link set a0 up && ip link set b0 up"));
}

/// Waits, at most 5 s, until the kernel has created the IPv6 routes of `interface`, which happens
/// shortly after it came up.
inline bool wait_for_ipv6(const std::string& interface) {
  const std::string command = "for i in $(seq 100); do ip -6 route get ff15::1 oif " + interface +
                              " >/dev/null 2>&1 && exit 0; sleep 0.05; done; exit 1";
  return run(command.c_str());
}

}  // namespace reckon::test

/// Runs the body in a namespace of its own, or skips the test with a message.
#define RECKON_IN_OWN_NETWORK(...)                                                   \
  do {                                                                               \
    if (!reckon::test::in_own_network(__VA_ARGS__))                                  \
      GTEST_SKIP() << "needs root and /proc to make a network namespace of its own"; \
  } while (false)
