// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where a server of pages or metrics listens, and by which addresses a browser reaches it.
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

/// As a browser writes it.
[[nodiscard]] std::string address_text(const asio::ip::address& address);

/// By which a server that listens at `bound` is reached.
[[nodiscard]] std::vector<std::string> own_addresses(const asio::ip::address& bound);

/// What a server hands out, and by which flags it goes elsewhere.
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
