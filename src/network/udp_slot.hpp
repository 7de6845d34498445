// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One open socket of a UdpMulticast. Private to the network.
#pragma once

#include <asio/ip/udp.hpp>
#include <chrono>
#include <cstdint>

#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// A socket with what its reader knows of it. The reading thread's, but for the descriptor of the
/// unicast socket, by which the writing thread sends.
struct UdpSlot {
  asio::ip::udp::socket socket;
  GroupAddress group;                 ///< of the unicast socket: the own endpoint
  std::uint32_t drops_seen{0};        ///< as the kernel has counted them since it was opened
  std::chrono::nanoseconds empty{0};  ///< when nothing waited in it last
  bool brings_runs{false};            ///< its last message was several datagrams in one
  bool first{false};                  ///< it is read before the others
};

}  // namespace reckon::peer
