// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The protocol between sealed links, in the stream `control`: the own nonce, and the nonces of
// others in return. A sender that returns the present nonce is live, and no recording.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace reckon::peer {

/// One returned nonce.
struct NonceEcho {
  std::uint64_t boot{0};   ///< its owner
  std::uint64_t nonce{0};  ///< last one received
};

/// Writes one hello: own nonce u64, number of echoes u16, of wanted u16, 4 octets of zero, the
/// echoes (boot, nonce) and the wanted boots, u64 each, network byte order. No allocation.
class HelloWriter {
 public:
  static constexpr std::size_t kHead = 16, kEcho = 16, kWanted = 8;  ///< [octets]

  /// @param room at least kHead octets (assert)
  HelloWriter(std::uint64_t nonce, std::span<std::byte> room) noexcept;

  /// Adds one; false if the room is full. All echoes come before the first wanted boot.
  [[nodiscard]] bool echo(const NonceEcho& echo) noexcept;
  /// Requests an answer of this boot.
  [[nodiscard]] bool want(std::uint64_t boot) noexcept;

  [[nodiscard]] std::span<const std::byte> finish() noexcept;
  [[nodiscard]] bool is_asking() const noexcept { return wanted_ > 0; }

 private:
  [[nodiscard]] std::byte* grow(std::size_t octets) noexcept;

  std::span<std::byte> room_;
  std::size_t size_ = kHead;
  std::uint16_t echoes_ = 0, wanted_ = 0;
};

/// One received hello. A view: valid while the octets are.
class Hello {
 public:
  /// False if the octets are no hello.
  [[nodiscard]] bool read(std::span<const std::byte> octets) noexcept;

  [[nodiscard]] std::uint64_t nonce() const noexcept;
  /// Whether this nonce of this boot is among the echoes.
  [[nodiscard]] bool has_echo(const NonceEcho& echo) const noexcept;
  /// Whether this boot is requested to answer.
  [[nodiscard]] bool wants(std::uint64_t boot) const noexcept;

 private:
  std::span<const std::byte> octets_;
  std::size_t echoes_ = 0, wanted_ = 0;
};

}  // namespace reckon::peer
