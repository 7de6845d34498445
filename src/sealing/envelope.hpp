// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The 52 octets that sealing adds to a datagram: a header in front and a tag behind. Also the
// destination, which the tag covers although it is not sent.
#pragma once

#include <array>
#include <cassert>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>

#include "reckon/pdu/codec/byte_order.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// First octet of a sealed datagram: never a DIS protocol version (0 to 7).
inline constexpr std::uint8_t kSealedOctet = 0xE7;
inline constexpr std::size_t kEnvelopeHeader = 36;  ///< [octets] in front, not encrypted
inline constexpr std::size_t kEnvelopeTag = 16;     ///< [octets] behind
inline constexpr std::size_t kEnvelope = kEnvelopeHeader + kEnvelopeTag;
inline constexpr int kEnvelopeCountBits = 48;  ///< of the sequence; the stream is in the bits above
inline constexpr std::uint64_t kEnvelopeCountMask = (std::uint64_t{1} << kEnvelopeCountBits) - 1;

/// The primitives of an exercise; the key file selects them, and there is no negotiation.
enum class SealingSuite : std::uint8_t {
  aes_256_gcm = 0x11,         ///< needs AES instructions in the CPU
  xchacha20_poly1305 = 0x12,  ///< for CPUs without them
};

/// One opening of a sealed link. `boot` is drawn at random each time and alone identifies the
/// opening. Site and application are the program's numbers at that time, for people.
struct Sealer {
  std::uint64_t boot{0};
  std::uint16_t site{0}, application{0};

  auto operator<=>(const Sealer&) const = default;
};

/// Header of a sealed datagram, offsets in octets, numbers in network byte order: 0 kSealedOctet,
/// 1 suite, 2 epoch, 4 site, 6 application, 8 boot, 16 stream, 18 count (48 bits, from 1), 24
/// stamp, 28 salt.
struct EnvelopeHeader {
  SealingSuite suite{SealingSuite::aes_256_gcm};
  std::uint16_t epoch{0};  ///< number of the group's key
  Sealer sealer;
  std::uint16_t stream{0};  ///< one for each sending thread of the sealer
  std::uint64_t count{0};   ///< in the stream, below 2^48
  /// [us] Time of sealing by the sealer's steady clock from an origin of its own, modulo 2^32.
  std::uint32_t stamp{0};
  /// Drawn at random, so that a copy of the sealer uses another key (AES) or another nonce.
  std::uint64_t salt{0};

  bool operator==(const EnvelopeHeader&) const = default;
};

/// Destination of a datagram, covered by its tag: 0 kind (0: one host, 1: a group by a list of
/// addresses, 4 and 6: a group), 1 exercise, 2 port, 4 address, or number of the group with a list.
/// For one host, port and address are 0, because the sender may know the host by other values than
/// the host itself does.
using Destination = std::array<std::byte, 20>;

/// A group, or one host. 3 ns, any thread.
[[nodiscard]] inline Destination destination_of(const GroupAddress& to,
                                                std::uint8_t exercise) noexcept {
  Destination out{};
  const bool is_group = to.is_multicast() || to.is_broadcast();
  const std::uint32_t kind = !is_group ? 0 : to.is_v6 ? 6 : 4;
  const std::uint32_t port = is_group ? to.port : 0;
  pdu::store_big_endian(out.data(), kind << 24 | std::uint32_t{exercise} << 16 | port);
  if (is_group) std::memcpy(out.data() + 4, to.octets.data(), to.is_v6 ? to.octets.size() : 4);
  return out;
}

/// A group by a list: its number as in the frame, 0 for the base group.
[[nodiscard]] inline Destination listed_destination(std::uint16_t number,
                                                    std::uint8_t exercise) noexcept {
  Destination out{std::byte{1}, std::byte{exercise}};
  pdu::store_big_endian(out.data() + 4, number);
  return out;
}

/// Destinations of the datagrams of one exercise.
struct ExercisePlaces {
  std::uint8_t exercise{1};
  std::optional<GroupPool> listed;  ///< its groups, if all datagrams go to a list of addresses

  [[nodiscard]] Destination of(const GroupAddress& to) const noexcept {
    if (!listed) return destination_of(to, exercise);
    if (to == listed->base()) return listed_destination(0, exercise);
    const auto index = listed->index(to);
    return index ? listed_destination(static_cast<std::uint16_t>(*index + 1), exercise)
                 : destination_of(to, exercise);
  }
};

/// Whether the octets claim to be a sealed datagram. 1 ns.
[[nodiscard]] inline bool is_sealed(std::span<const std::byte> datagram) noexcept {
  return datagram.size() >= kEnvelope && datagram[0] == std::byte{kSealedOctet};
}

/// Reads the header, which is not verified. False if the datagram is not sealed, is too short or of
/// no known suite. 3 ns, any thread.
[[nodiscard]] inline bool read_envelope(std::span<const std::byte> datagram,
                                        EnvelopeHeader& out) noexcept {
  if (!is_sealed(datagram)) return false;
  const std::byte* at = datagram.data();
  out.suite = static_cast<SealingSuite>(at[1]);
  if (out.suite != SealingSuite::aes_256_gcm && out.suite != SealingSuite::xchacha20_poly1305)
    return false;
  out.epoch = pdu::load_big_endian<std::uint16_t>(at + 2);
  out.sealer.site = pdu::load_big_endian<std::uint16_t>(at + 4);
  out.sealer.application = pdu::load_big_endian<std::uint16_t>(at + 6);
  out.sealer.boot = pdu::load_big_endian<std::uint64_t>(at + 8);
  const auto sequence = pdu::load_big_endian<std::uint64_t>(at + 16);
  out.stream = static_cast<std::uint16_t>(sequence >> kEnvelopeCountBits);
  out.count = sequence & kEnvelopeCountMask;
  out.stamp = pdu::load_big_endian<std::uint32_t>(at + 24);
  out.salt = pdu::load_big_endian<std::uint64_t>(at + 28);
  return true;
}

/// The same; nothing instead of false.
[[nodiscard]] inline std::optional<EnvelopeHeader> read_envelope(
    std::span<const std::byte> datagram) noexcept {
  EnvelopeHeader header;
  if (!read_envelope(datagram, header)) return std::nullopt;
  return header;
}

/// Writes the header; count below 2^48 (assert).
inline void write_envelope(const EnvelopeHeader& header,
                           std::span<std::byte, kEnvelopeHeader> out) noexcept {
  assert(header.count <= kEnvelopeCountMask);
  std::byte* at = out.data();
  const std::uint64_t front = std::uint64_t{kSealedOctet} << 56 |
                              std::uint64_t{static_cast<std::uint8_t>(header.suite)} << 48 |
                              std::uint64_t{header.epoch} << 32 |
                              std::uint64_t{header.sealer.site} << 16 | header.sealer.application;
  pdu::store_big_endian(at, front);
  pdu::store_big_endian(at + 8, header.sealer.boot);
  pdu::store_big_endian(at + 16, std::uint64_t{header.stream} << kEnvelopeCountBits | header.count);
  pdu::store_big_endian(at + 24, header.stamp);
  pdu::store_big_endian(at + 28, header.salt);
}

}  // namespace reckon::peer
