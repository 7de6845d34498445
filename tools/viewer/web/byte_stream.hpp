// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The connection to a browser, plain or TLS.
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

/// At most one read and one write may be pending. The callbacks must keep the stream alive.
class ByteStream {
 public:
  using Done = std::function<void(std::error_code, std::size_t)>;
  using Parts = std::array<asio::const_buffer, 2>;

  /// @param tls outlives it; null: plain
  ByteStream(asio::ip::tcp::socket socket, asio::ssl::context* tls);

  /// TLS handshake; a plain stream is open at once.
  void open(std::function<void(std::error_code)> done);
  void read(asio::mutable_buffer room, Done done);
  /// Writes all octets. They must remain valid until then.
  void write(const Parts& parts, Done done);
  /// Writes as much as possible without waiting.
  void write_now(const Parts& parts);
  /// Shuts down the sending side, then calls `done`.
  void end(std::function<void()> done);
  void close();

  [[nodiscard]] bool is_open() const { return socket().is_open(); }
  /// Address of the client; empty if it has closed.
  [[nodiscard]] const std::string& from() const noexcept { return from_; }

 private:
  using Secure = asio::ssl::stream<asio::ip::tcp::socket>;
  [[nodiscard]] const asio::ip::tcp::socket& socket() const;
  [[nodiscard]] asio::ip::tcp::socket& socket();

  asio::ip::tcp::socket plain_;
  std::unique_ptr<Secure> secure_;  // with TLS, instead of plain_
  std::string from_;
};

}  // namespace reckon::tools
