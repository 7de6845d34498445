// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/bound_endpoints.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

namespace reckon::peer {
namespace {

bool read_hex(std::string_view text, auto& out) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out, 16);
  return error == std::errc{} && end == text.data() + text.size();
}

// "0100A8C0:0BB8": words of the address as this machine holds them, then the port.
std::optional<IpEndpoint> parse_bound(std::string_view text, bool ipv6) {
  const std::size_t words = ipv6 ? 4 : 1;
  if (text.size() != words * 8 + 5 || text[words * 8] != ':') return std::nullopt;
  IpEndpoint out;
  out.is_v6 = ipv6;
  for (std::size_t i = 0; i < words; ++i) {
    std::uint32_t word = 0;
    if (!read_hex(text.substr(8 * i, 8), word)) return std::nullopt;
    std::memcpy(out.octets.data() + 4 * i, &word, sizeof word);
  }
  if (!read_hex(text.substr(words * 8 + 1), out.port)) return std::nullopt;
  return out;
}

}  // namespace

std::vector<IpEndpoint> read_bound_endpoints(std::istream& table, bool ipv6) {
  std::vector<IpEndpoint> out;
  for (std::string line; std::getline(table, line);) {
    std::istringstream words(line);
    std::string number, bound;
    words >> number >> bound;
    const auto endpoint = parse_bound(bound, ipv6);
    if (endpoint && std::find(out.begin(), out.end(), *endpoint) == out.end())
      out.push_back(*endpoint);
  }
  return out;
}

std::vector<IpEndpoint> bound_endpoints(bool ipv6) {
  std::ifstream table(ipv6 ? "/proc/net/udp6" : "/proc/net/udp");
  return read_bound_endpoints(table, ipv6);
}

}  // namespace reckon::peer
