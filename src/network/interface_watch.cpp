// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/interface_watch.hpp"

#include <linux/netlink.h>
#include <linux/rtnetlink.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>

namespace reckon::peer {
namespace {

int open_rtnetlink() noexcept {
  const int descriptor = socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, NETLINK_ROUTE);
  if (descriptor < 0) return -1;
  sockaddr_nl address{};
  address.nl_family = AF_NETLINK;
  address.nl_groups = RTMGRP_LINK | RTMGRP_IPV4_IFADDR | RTMGRP_IPV6_IFADDR;
  if (bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
    return descriptor;
  }
  close(descriptor);
  return -1;
}

}  // namespace

InterfaceWatch::InterfaceWatch() noexcept : descriptor_(open_rtnetlink()) {}

InterfaceWatch::~InterfaceWatch() {
  if (descriptor_ >= 0) close(descriptor_);
}

// The content of the messages is not used. The caller examines the host again, so a lost or
// truncated message has no effect.
bool InterfaceWatch::take_changes() noexcept {
  if (descriptor_ < 0) return false;
  std::array<std::byte, 8192> message;
  bool any = false;
  for (;;) {
    const ssize_t got = recv(descriptor_, message.data(), message.size(), MSG_DONTWAIT);
    const bool lost = got < 0 && errno == ENOBUFS;
    if (got <= 0 && !lost) return any;
    any = true;
  }
}

}  // namespace reckon::peer
