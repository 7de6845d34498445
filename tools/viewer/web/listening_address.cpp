// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/web/listening_address.hpp"

#include <fmt/format.h>
#include <ifaddrs.h>
#include <netinet/in.h>

#include <cstring>
#include <stdexcept>

namespace reckon::tools {
namespace {

using asio::ip::tcp;

constexpr int kPortsTried = 32;

// In the notation of browsers.
std::string address_text(const asio::ip::address& address) {
  return address.is_v6() ? fmt::format("[{}]", address.to_string()) : address.to_string();
}

std::vector<std::string> own_addresses(const asio::ip::address& bound) {
  std::vector<std::string> own{"localhost"};
  if (!bound.is_unspecified()) {
    own.push_back(address_text(bound));
    return own;
  }
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) return own;
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr) continue;
    if (one->ifa_addr->sa_family == AF_INET) {
      sockaddr_in address{};
      std::memcpy(&address, one->ifa_addr, sizeof address);
      own.push_back(asio::ip::address_v4(ntohl(address.sin_addr.s_addr)).to_string());
    } else if (one->ifa_addr->sa_family == AF_INET6 && bound.is_v6()) {
      sockaddr_in6 address{};
      std::memcpy(&address, one->ifa_addr, sizeof address);
      asio::ip::address_v6::bytes_type octets{};
      std::memcpy(octets.data(), &address.sin6_addr, octets.size());
      own.push_back(address_text(asio::ip::address_v6(octets)));
    }
  }
  freeifaddrs(all);
  return own;
}

}  // namespace

ServerNames server_names(const asio::ip::address& bound,
                         const std::vector<std::string>& certified) {
  ServerNames names{certified, bound.is_unspecified() ? "127.0.0.1" : address_text(bound)};
  if (!certified.empty()) names.own = certified.front();
  for (std::string& address : own_addresses(bound)) names.all.push_back(std::move(address));
  return names;
}

tcp::acceptor open_acceptor(asio::io_context& io, const std::string& text,
                            std::optional<std::uint16_t> port, std::uint16_t first,
                            const ServerPurpose& purpose) {
  std::error_code error;
  const auto address = asio::ip::make_address(text, error);
  if (error)
    throw std::runtime_error(
        fmt::format("'{}' is not an address; write the address of an interface of this host, or "
                    "0.0.0.0 for all",
                    text));
  const int begin = port.value_or(first);
  const int tried = port ? 1 : kPortsTried;
  for (int i = 0; i < tried; ++i) {
    tcp::acceptor acceptor(io);
    const tcp::endpoint endpoint(address, static_cast<std::uint16_t>(begin + i));
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (!error) return acceptor;
    if (error != asio::error::address_in_use) break;
  }
  throw std::runtime_error(fmt::format("cannot serve {} at {}:{}: {}; choose another by {}",
                                       purpose.what, address_text(address), begin, error.message(),
                                       purpose.flags));
}

}  // namespace reckon::tools
