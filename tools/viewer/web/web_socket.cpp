// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/web/web_socket.hpp"

#include <bit>
#include <vector>

#include "reckon/tools/viewer/web/base64.hpp"

namespace reckon::tools {
namespace {

using Digest = std::array<std::uint8_t, 20>;
using Sha1State = std::array<std::uint32_t, 5>;

// RFC 6455 1.3.
constexpr std::string_view kAcceptGuid = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";

// FIPS 180-4 6.1.2: one block of 64 octets.
void add_block(Sha1State& state, std::span<const std::uint8_t> block) {
  std::array<std::uint32_t, 80> w{};
  for (std::size_t i = 0; i < 64; ++i) w[i / 4] = w[i / 4] << 8 | block[i];
  for (std::size_t i = 16; i < 80; ++i)
    w[i] = std::rotl(w[i - 3] ^ w[i - 8] ^ w[i - 14] ^ w[i - 16], 1);
  auto [a, b, c, d, e] = state;
  for (std::size_t i = 0; i < 80; ++i) {
    std::uint32_t mixed = b ^ c ^ d;
    std::uint32_t constant = i < 40 ? 0x6ED9EBA1U : 0xCA62C1D6U;
    if (i < 20) {
      mixed = (b & c) | (~b & d);
      constant = 0x5A827999U;
    } else if (i >= 40 && i < 60) {
      mixed = (b & c) | (b & d) | (c & d);
      constant = 0x8F1BBCDCU;
    }
    const std::uint32_t next = std::rotl(a, 5) + mixed + e + constant + w[i];
    e = d;
    d = c;
    c = std::rotl(b, 30);
    b = a;
    a = next;
  }
  state = {state[0] + a, state[1] + b, state[2] + c, state[3] + d, state[4] + e};
}

// Required by the handshake; it protects no secret.
Digest sha1(std::string_view text) {
  std::vector<std::uint8_t> padded(text.begin(), text.end());
  padded.push_back(0x80);
  while (padded.size() % 64 != 56) padded.push_back(0);
  const std::uint64_t bits = text.size() * 8;
  for (int shift = 56; shift >= 0; shift -= 8)
    padded.push_back(static_cast<std::uint8_t>(bits >> shift));
  Sha1State state{0x67452301U, 0xEFCDAB89U, 0x98BADCFEU, 0x10325476U, 0xC3D2E1F0U};
  for (std::size_t at = 0; at < padded.size(); at += 64)
    add_block(state, std::span(padded).subspan(at, 64));
  Digest digest{};
  for (std::size_t i = 0; i < digest.size(); ++i)
    digest[i] = static_cast<std::uint8_t>(state[i / 4] >> (24 - 8 * (i % 4)));
  return digest;
}

}  // namespace

bool is_web_socket_key(std::string_view key) noexcept {
  if (key.size() != 24 || !key.ends_with("==")) return false;
  return key.substr(0, 22).find_first_not_of(kBase64Letters) == std::string_view::npos;
}

std::string web_socket_accept(std::string_view key) {
  const Digest digest = sha1(std::string(key).append(kAcceptGuid));
  return base64(std::as_bytes(std::span(digest)));
}

FrameHead frame_head(WebSocketOpcode opcode, std::size_t payload, bool compressed) noexcept {
  FrameHead head;
  const auto put = [&head](std::uint64_t octet) {
    head.octets[head.size++] = static_cast<std::byte>(octet & 0xFFU);
  };
  put(0x80U | (compressed ? 0x40U : 0U) | static_cast<std::uint8_t>(opcode));
  int length_octets = 0;
  if (payload >= 126) length_octets = payload < 65536 ? 2 : 8;
  put(length_octets == 0 ? payload : length_octets == 2 ? 126U : 127U);
  for (int i = length_octets - 1; i >= 0; --i) put(static_cast<std::uint64_t>(payload) >> (8 * i));
  return head;
}

std::string last_frames(std::string_view text) {
  std::string frames;
  const auto append = [&frames](WebSocketOpcode opcode, std::string_view payload) {
    const FrameHead head = frame_head(opcode, payload.size());
    frames.append(reinterpret_cast<const char*>(head.octets.data()), head.size).append(payload);
  };
  append(WebSocketOpcode::text, text);
  append(WebSocketOpcode::close, {});
  return frames;
}

FrameVerdict read_client_frame(std::span<const std::byte> octets, bool may_be_compressed,
                               ClientFrame& out) noexcept {
  constexpr std::size_t kHead = 6;  // with the mask
  constexpr auto kWhole = std::byte{0x80}, kCompressed = std::byte{0x40};
  if (octets.size() < 2) return FrameVerdict::incomplete;
  const std::byte opcode = octets[0] & std::byte{0x0F};
  const auto size = std::to_integer<std::size_t>(octets[1] & std::byte{0x7F});
  const bool is_masked = (octets[1] & std::byte{0x80}) != std::byte{0};
  out.is_compressed = may_be_compressed && (octets[0] & kCompressed) != std::byte{0};
  // The other reserved bits must be zero: no other extension is agreed.
  const std::byte first = out.is_compressed ? octets[0] & ~kCompressed : octets[0];
  const bool is_whole = (first & std::byte{0xF0}) == kWhole;
  if (!is_masked || !is_whole || size > kLongestClientFrame) return FrameVerdict::bad;
  if (opcode == std::byte{static_cast<std::uint8_t>(WebSocketOpcode::close)})
    return FrameVerdict::closing;
  if (opcode != std::byte{static_cast<std::uint8_t>(WebSocketOpcode::binary)})
    return FrameVerdict::bad;
  if (octets.size() < kHead + size) return FrameVerdict::incomplete;
  for (std::size_t i = 0; i < size; ++i) out.octets[i] = octets[kHead + i] ^ octets[2 + i % 4];
  out.size = size;
  out.length = kHead + size;
  return FrameVerdict::good;
}

}  // namespace reckon::tools
