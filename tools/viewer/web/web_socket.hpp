// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The part of WebSocket (RFC 6455) that the viewer's server needs: handshake answer, sending frames
// of any length, receiving short binary frames. Accepts any octets: reading neither throws nor
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
/// The Sec-WebSocket-Accept for a key.
[[nodiscard]] std::string web_socket_accept(std::string_view key);

/// Kinds of frames.
enum class WebSocketOpcode : std::uint8_t { text = 1, binary = 2, close = 8 };

/// Header of a frame that the server sends.
struct FrameHead {
  std::array<std::byte, 10> octets{};
  std::size_t size = 0;
  [[nodiscard]] std::span<const std::byte> bytes() const { return {octets.data(), size}; }
};
/// @param compressed the payload is (RFC 7692)
[[nodiscard]] FrameHead frame_head(WebSocketOpcode opcode, std::size_t payload,
                                   bool compressed = false) noexcept;

/// A text frame and a close frame.
[[nodiscard]] std::string last_frames(std::string_view text);

/// Longest payload of a received frame.
inline constexpr std::size_t kLongestClientFrame = 125;

/// A received binary frame, unmasked.
struct ClientFrame {
  std::array<std::byte, kLongestClientFrame> octets{};
  std::size_t size = 0;    ///< of the payload
  std::size_t length = 0;  ///< of the frame with its header
  bool is_compressed = false;
  [[nodiscard]] std::span<const std::byte> payload() const { return {octets.data(), size}; }
};

enum class FrameVerdict : std::uint8_t {
  incomplete,  ///< more octets are needed, at most 131 in total
  good,
  closing,  ///< the page closes the connection
  bad       ///< not masked, too long, fragmented, compressed without being agreed, or of another
            ///< kind: close the connection
};

/// Reads the frame at the begin of `octets`. @param may_be_compressed as agreed
[[nodiscard]] FrameVerdict read_client_frame(std::span<const std::byte> octets,
                                             bool may_be_compressed, ClientFrame& out) noexcept;

}  // namespace reckon::tools
