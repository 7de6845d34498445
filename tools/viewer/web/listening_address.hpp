// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Listening address of a server of pages or metrics, and the host names for browsers.
#pragma once

#include <asio/io_context.hpp>
#include <asio/ip/address.hpp>
#include <asio/ip/tcp.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::tools {

/// Host names and addresses of a server.
struct ServerNames {
  std::vector<std::string> all;
  std::string own;  ///< for this host
};
/// @param bound listening address  @param certified names of its certificate, which come first
[[nodiscard]] ServerNames server_names(const asio::ip::address& bound,
                                       const std::vector<std::string>& certified);

/// What a server serves, and the flags that change its address; for error messages.
struct ServerPurpose {
  std::string_view what, flags;
};

/// Listens at this port; without one at `first` or one of the 31 ports after it.
/// @throws std::runtime_error with the value and the remedy
[[nodiscard]] asio::ip::tcp::acceptor open_acceptor(asio::io_context& io,
                                                    const std::string& address,
                                                    std::optional<std::uint16_t> port,
                                                    std::uint16_t first,
                                                    const ServerPurpose& purpose);

}  // namespace reckon::tools
