// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/address_text.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>

#include <algorithm>

namespace reckon::peer {
namespace {

constexpr std::array<std::uint8_t, 12> kIpv4{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF};

}  // namespace

AddressText::AddressText(const aoim::SourceAddress& address) noexcept {
  const bool v4 = std::equal(kIpv4.begin(), kIpv4.end(), address.octets.begin());
  std::array<char, INET6_ADDRSTRLEN> host{};
  const void* octets = v4 ? address.octets.data() + kIpv4.size() : address.octets.data();
  ::inet_ntop(v4 ? AF_INET : AF_INET6, octets, host.data(), host.size());
  const char* format = v4 ? "{}:{}" : "[{}]:{}";
  if (address.port == 0) format = "{}";
  if (address == aoim::SourceAddress{}) format = "an unknown address";
  fmt::format_to_n(text_.data(), text_.size() - 1, fmt::runtime(format), host.data(), address.port);
}

}  // namespace reckon::peer
