// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One open socket of a UdpMulticast. Private to the network.
#pragma once

#include <asio/ip/udp.hpp>
#include <chrono>
#include <cstdint>

#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// A socket with the state of its reader. For the reading thread, except for the descriptor of the
/// unicast socket, with which the writing thread sends.
struct UdpSlot {
  asio::ip::udp::socket socket;
  GroupAddress group;                 ///< of the unicast socket: the own endpoint
  std::uint32_t drops_seen{0};        ///< as counted by the kernel since it was opened
  std::chrono::nanoseconds empty{0};  ///< last time at which it was empty
  bool brings_runs{false};            ///< its last message was several datagrams in one
  bool first{false};                  ///< prioritised
};

}  // namespace reckon::peer
