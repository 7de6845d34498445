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

/// Compression of one connection. Holds 80 kB.
class MessageCompression {
 public:
  static constexpr int kWindowBits = 12;  ///< 4 kB: memory against size, 9 .. 15

  /// @throws std::bad_alloc
  explicit MessageCompression(const DeflateTerms& terms);
  ~MessageCompression();
  /// The payload of a message whose frame has the compressed bit, in the order in which they are
  /// sent. Cost: 2 ns an octet of JSON.
  [[nodiscard]] std::string deflate(std::string_view message);
  /// Inflates the payload of a client's frame in place. @return false if it is no valid message or
  /// has more than kLongestClientFrame octets. Does not allocate after its first call.
  [[nodiscard]] bool inflate(ClientFrame& frame) noexcept;

 private:
  struct Streams;
  std::unique_ptr<Streams> streams_;
  bool keeps_context_;
};

/// A message as it is sent.
struct PackedMessage {
  FrameHead head;
  std::shared_ptr<const std::string> payload;
};
/// Compresses texts. Pictures hold packed numbers: deflate saves a quarter of their octets, and
/// costs three times what making and sending them costs. @param compression null: not agreed
[[nodiscard]] PackedMessage pack_message(WebSocketOpcode opcode,
                                         std::shared_ptr<const std::string> payload,
                                         MessageCompression* compression);

}  // namespace reckon::tools
