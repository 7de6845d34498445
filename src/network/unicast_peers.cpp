// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/unicast_peers.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace reckon::peer {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

[[noreturn]] void refuse_peer(std::string_view item, std::string_view why) {
  throw std::invalid_argument("'" + std::string(item) + "' " + std::string(why) +
                              "; write addresses or names separated by commas, each with its port "
                              "if it differs: \"10.0.0.7, host-b:3001, [2001:db8::7]:3001\"");
}

std::uint16_t port_of(std::string_view item, std::string_view text) {
  unsigned port = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), port);
  if (read.ec != std::errc() || read.ptr != text.data() + text.size() || port < 1 || port > 65535)
    refuse_peer(item, "has a port outside 1 to 65535");
  return static_cast<std::uint16_t>(port);
}

}  // namespace

NamedPeer parse_peer(std::string_view text) {
  const std::string_view item = trimmed(text);
  if (item.empty()) refuse_peer(item, "has no host");
  if (item.find(' ') != std::string_view::npos) refuse_peer(item, "contains a blank");
  if (item.front() == '[') {
    const auto end = item.find(']');
    const bool has_port = end != std::string_view::npos && item.substr(end + 1).starts_with(':');
    const std::string_view host = item.substr(1, std::min(end, item.size()) - 1);
    const bool is_ipv6 =
        host.find(':') != host.rfind(':') && host.find('[') == std::string_view::npos;
    if (end == std::string_view::npos || (!has_port && end + 1 != item.size()) || !is_ipv6)
      refuse_peer(item, "is not an address in brackets");
    return {std::string(host), has_port ? port_of(item, item.substr(end + 2)) : std::uint16_t{0}};
  }
  if (item.find_first_of("[]") != std::string_view::npos)
    refuse_peer(item, "has a bracket that does not enclose an address");
  const auto colon = item.find(':');
  const bool many = colon != item.rfind(':');  // IPv6 without brackets
  if (colon == std::string_view::npos || many) return {std::string(item), 0};
  if (colon == 0) refuse_peer(item, "has no host");
  return {std::string(item.substr(0, colon)), port_of(item, item.substr(colon + 1))};
}

std::string NamedPeer::text() const {
  const bool is_v6 = host.find(':') != std::string::npos;
  if (port == 0) return host;
  return (is_v6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

void check_number(const std::vector<NamedPeer>& peers) {
  if (peers.size() > kMostUnicastPeers)
    refuse_peer(peers.back().host, "is one of more than 256: use a relay or multicast for so many");
}

std::vector<NamedPeer> parse_peers(std::string_view list) {
  std::vector<NamedPeer> peers;
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t end = std::min(list.find(',', at), list.size());
    peers.push_back(parse_peer(list.substr(at, end - at)));
    at = end + 1;
  }
  check_number(peers);
  return peers;
}

}  // namespace reckon::peer
