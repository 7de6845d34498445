// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The connection of a browser, plain or in TLS, as the viewer's server reads and writes it.
#pragma once

#include <array>
#include <asio/buffer.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/ssl/context.hpp>
#include <asio/ssl/stream.hpp>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <system_error>

namespace reckon::tools {

/// One read and one write may be under way at a time. Whoever waits for one keeps the stream alive.
class ByteStream {
 public:
  using Done = std::function<void(std::error_code, std::size_t)>;
  using Parts = std::array<asio::const_buffer, 2>;

  /// @param tls outlives it; null: plain
  ByteStream(asio::ip::tcp::socket socket, asio::ssl::context* tls);

  /// The handshake of TLS; a plain stream is open at once.
  void open(std::function<void(std::error_code)> done);
  void read(asio::mutable_buffer room, Done done);
  /// All of it. The octets stay where they are until then.
  void write(const Parts& parts, Done done);
  /// What goes out without waiting.
  void write_now(const Parts& parts);
  /// Says that no more comes, then calls.
  void end(std::function<void()> done);
  void close();

  [[nodiscard]] bool is_open() const { return socket().is_open(); }
  /// Address of the other side; empty where it has gone.
  [[nodiscard]] const std::string& from() const noexcept { return from_; }

 private:
  using Secure = asio::ssl::stream<asio::ip::tcp::socket>;
  [[nodiscard]] const asio::ip::tcp::socket& socket() const;
  [[nodiscard]] asio::ip::tcp::socket& socket();

  asio::ip::tcp::socket plain_;
  std::unique_ptr<Secure> secure_;  // in its place
  std::string from_;
};

}  // namespace reckon::tools
