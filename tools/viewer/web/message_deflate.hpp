// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Compression of WebSocket messages (RFC 7692, permessage-deflate), as far as the viewer's server
// needs it.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "reckon/tools/viewer/web/web_socket.hpp"

namespace reckon::tools {

/// What a server and a client agree on. The client compresses each message by itself.
struct DeflateTerms {
  int window_bits = 0;        ///< of the server's window, 9 .. 15
  bool keeps_context = true;  ///< the server refers to its earlier messages
  std::string answer;         ///< value of the answer's Sec-WebSocket-Extensions
};
/// Terms for the first offer that can be accepted. @param offers value of the request's
/// Sec-WebSocket-Extensions  @return none if there is no such offer
[[nodiscard]] std::optional<DeflateTerms> agree_on_deflate(std::string_view offers);

/// Compresses the messages of one connection, in the order in which they are sent. Holds 40 kB.
/// Cost: 25 ns an octet, of JSON 2 ns.
class MessageDeflater {
 public:
  static constexpr int kWindowBits = 12;  ///< 4 kB: memory against size, 9 .. 15

  /// @throws std::bad_alloc
  explicit MessageDeflater(const DeflateTerms& terms);
  ~MessageDeflater();
  /// The payload of a message whose frame has the compressed bit.
  [[nodiscard]] std::string deflate(std::string_view message);

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
  bool keeps_context_;
};

/// A message as it is sent.
struct PackedMessage {
  FrameHead head;
  std::shared_ptr<const std::string> payload;
};
/// Compresses texts, and pictures of at most kMostPacked octets. @param deflater null: not agreed
[[nodiscard]] PackedMessage pack_message(WebSocketOpcode opcode,
                                         std::shared_ptr<const std::string> payload,
                                         MessageDeflater* deflater);
/// Longer pictures hold packed numbers of entities: deflate saves 40 % of them, and costs four
/// times what making them costs.
inline constexpr std::size_t kMostPacked = 2048;

/// Inflates messages of clients, each by itself; one serves all connections. Holds 40 kB.
class MessageInflater {
 public:
  /// @throws std::bad_alloc
  MessageInflater();
  ~MessageInflater();
  /// Inflates the payload of `frame` in place. @return false if it is no valid message or has more
  /// than kLongestClientFrame octets. Does not allocate after its first call.
  [[nodiscard]] bool inflate(ClientFrame& frame) noexcept;

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace reckon::tools
