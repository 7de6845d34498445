// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// WebSocket (RFC 6455) as far as the viewer's server speaks it: the answer to a handshake, frames
// of any length out, short binary ones in. Any octets will do: reading neither throws nor
// allocates.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace reckon::tools {

/// Whether this is a Sec-WebSocket-Key: 16 octets in base64.
[[nodiscard]] bool is_web_socket_key(std::string_view key) noexcept;
/// The Sec-WebSocket-Accept that answers a key.
[[nodiscard]] std::string web_socket_accept(std::string_view key);

/// Kinds of frames.
enum class WebSocketOpcode : std::uint8_t { text = 1, binary = 2, close = 8 };

/// What stands in front of a payload that the server sends.
struct FrameHead {
  std::array<std::byte, 10> octets{};
  std::size_t size = 0;
  [[nodiscard]] std::span<const std::byte> bytes() const { return {octets.data(), size}; }
};
[[nodiscard]] FrameHead frame_head(WebSocketOpcode opcode, std::size_t payload) noexcept;

/// A text and the end of the connection.
[[nodiscard]] std::string last_frames(std::string_view text);

/// Longest payload of a frame that is taken from a page.
inline constexpr std::size_t kLongestClientFrame = 125;

/// A binary frame of a page, unmasked.
struct ClientFrame {
  std::array<std::byte, kLongestClientFrame> octets{};
  std::size_t size = 0;    ///< of the payload
  std::size_t length = 0;  ///< of the frame with its head
  [[nodiscard]] std::span<const std::byte> payload() const { return {octets.data(), size}; }
};

enum class FrameVerdict : std::uint8_t {
  incomplete,  ///< more octets are needed, at most 131 in all
  good,
  closing,  ///< the page ends the connection
  bad       ///< not masked, longer, in parts, or of another kind: the connection is to be closed
};

/// Reads the frame that `octets` begin with.
[[nodiscard]] FrameVerdict read_client_frame(std::span<const std::byte> octets,
                                             ClientFrame& out) noexcept;

}  // namespace reckon::tools
