// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The 52 octets that a sealed datagram has beyond what it carries: a header in front, a tag behind.
// And what the tag covers without being sent: where the datagram went.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>

#include "reckon/pdu/codec/byte_order.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// First octet of what is sealed: never a DIS protocol version (0 to 7).
inline constexpr std::uint8_t kSealedOctet = 0xE7;
inline constexpr std::size_t kEnvelopeHeader = 36;  ///< [octets] in front, read by anybody
inline constexpr std::size_t kEnvelopeTag = 16;     ///< [octets] behind
inline constexpr std::size_t kEnvelope = kEnvelopeHeader + kEnvelopeTag;
inline constexpr int kEnvelopeCountBits = 48;  ///< of the sequence; the stream is above them
inline constexpr std::uint64_t kEnvelopeCountMask = (std::uint64_t{1} << kEnvelopeCountBits) - 1;

/// The primitives of an exercise; the key file says which, nobody negotiates.
enum class SealingSuite : std::uint8_t {
  aes_256_gcm = 0x11,         ///< needs AES instructions in the CPU
  xchacha20_poly1305 = 0x12,  ///< for CPUs without
};

/// One opening of a sealed link. `boot` is drawn at random at each, so it alone tells one from
/// another; site and application are what the program was called then, for people.
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
  std::uint16_t epoch{0};  ///< which of the group's keys
  Sealer sealer;
  std::uint16_t stream{0};  ///< one for each sending thread of the sealer
  std::uint64_t count{0};   ///< of the stream, below 2^48
  /// [us] When it was sealed, by the sealer's steady clock from an origin of its own, modulo 2^32.
  std::uint32_t stamp{0};
  /// Drawn at random, so that a copy of the sealer shares no key with it (AES) or no nonce.
  std::uint64_t salt{0};

  bool operator==(const EnvelopeHeader&) const = default;
};

/// Where a datagram was sent, as its tag covers it: 0 kind (0: to one host, 1: to a group by a list
/// of addresses, 4 and 6: to a group), 1 exercise, 2 port, 4 address, or number of the group where
/// there is a list; what one host is sent has neither port nor address, for it knows itself by
/// others than the sender may.
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

/// A group by a list: its number, 0 for the base group, as what is in front says it.
[[nodiscard]] inline Destination listed_destination(std::uint16_t number,
                                                    std::uint8_t exercise) noexcept {
  Destination out{std::byte{1}, std::byte{exercise}};
  pdu::store_big_endian(out.data() + 4, number);
  return out;
}

/// Where the datagrams of one exercise go.
struct ExercisePlaces {
  std::uint8_t exercise{1};
  std::optional<GroupPool> listed;  ///< its groups, where all goes to a list of addresses

  [[nodiscard]] Destination of(const GroupAddress& to) const noexcept {
    if (!listed) return destination_of(to, exercise);
    if (to == listed->base()) return listed_destination(0, exercise);
    const auto index = listed->index(to);
    return index ? listed_destination(static_cast<std::uint16_t>(*index + 1), exercise)
                 : destination_of(to, exercise);
  }
};

/// Whether the octets claim to be sealed. 1 ns.
[[nodiscard]] inline bool is_sealed(std::span<const std::byte> datagram) noexcept {
  return datagram.size() >= kEnvelope && datagram[0] == std::byte{kSealedOctet};
}

/// The header as it claims to be, nothing proved. False where the datagram is not sealed, is too
/// short or of no known suite. 3 ns, any thread.
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

/// The same; nothing for false.
[[nodiscard]] inline std::optional<EnvelopeHeader> read_envelope(
    std::span<const std::byte> datagram) noexcept {
  EnvelopeHeader header;
  if (!read_envelope(datagram, header)) return std::nullopt;
  return header;
}

/// Writes the header; count below 2^48 (assert).
void write_envelope(const EnvelopeHeader& header,
                    std::span<std::byte, kEnvelopeHeader> out) noexcept;

}  // namespace reckon::peer
