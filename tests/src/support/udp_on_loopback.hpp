// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Common parts of the tests of the real link: groups, options, and reading until nothing more
// arrives.
#pragma once

#include <unistd.h>

#include <array>
#include <chrono>
#include <string>
#include <vector>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/udp_multicast.hpp"

namespace reckon::test {

using namespace reckon::peer;

/// Each test program of a parallel ctest run uses groups of its own.
inline GroupAddress group(std::uint8_t number) {
  return IpEndpoint::v4(0xefc04e00u + number, static_cast<std::uint16_t>(20000 + getpid() % 20000));
}

inline const SteadyClock kClock;

inline UdpMulticastOptions on(const char* interface) {
  UdpMulticastOptions options;
  options.interface = interface;
  return options;
}

inline std::span<const std::byte> octets(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

inline std::string text_of(const Datagram& datagram) {
  return {reinterpret_cast<const char*>(datagram.bytes.data()), datagram.bytes.size()};
}

/// All datagrams that arrive until none has come for `quiet`.
inline std::vector<std::string> hear(
    Link& link, std::chrono::nanoseconds quiet = std::chrono::milliseconds(50)) {
  std::vector<std::string> out;
  std::array<Datagram, 16> batch;
  while (link.wait(quiet)) {
    const std::size_t count = link.receive(batch);
    for (std::size_t i = 0; i < count; ++i) out.push_back(text_of(batch[i]));
  }
  return out;
}

}  // namespace reckon::test
