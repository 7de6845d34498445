// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A sealed group, its members and forgers.
#pragma once

#include <array>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/peer/sealing/envelope_opener.hpp"

namespace reckon::peer::samples {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;
using Octets = std::vector<std::byte>;

inline Octets from_hex(std::string_view digits) {
  Octets out;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
    std::uint8_t octet = 0;
    std::from_chars(digits.data() + i, digits.data() + i + 2, octet, 16);
    out.push_back(static_cast<std::byte>(octet));
  }
  return out;
}

/// Epoch 1 from the beginning; each further epoch begins an hour later, the second at UTC hour 1.
inline GroupKey group_key(std::size_t epochs = 1,
                          SealingSuite suite = SealingSuite::xchacha20_poly1305,
                          std::uint8_t seed = 1) {
  GroupKey key;
  key.group = "test";
  key.suite = suite;
  for (std::size_t i = 0; i < epochs; ++i) {
    GroupEpoch epoch;
    epoch.number = static_cast<std::uint16_t>(i + 1);
    if (i > 0) epoch.from = std::chrono::hours(i);
    epoch.secret.fill(static_cast<std::byte>(seed + i));
    key.epochs.push_back(epoch);
  }
  return key;
}

/// The default suite of users whose CPU supports it.
inline SealingSuite fast_suite() {
  return can_seal(SealingSuite::aes_256_gcm) ? SealingSuite::aes_256_gcm
                                             : SealingSuite::xchacha20_poly1305;
}

inline IpEndpoint address(std::uint32_t host) { return IpEndpoint::v4(0x0a000000 + host, 4000); }

/// A group of a sealed exercise: 0 is the base group, others follow it.
inline GroupAddress group_of(std::uint32_t number = 0) {
  return GroupAddress::v4(0xEFC00100 + number, 3001);
}

inline Octets sealed(EnvelopeSealer& sealer, std::span<const std::byte> plain,
                     SealingStream stream = SealingStream::datagrams, std::size_t epoch = 0,
                     const GroupAddress& to = group_of(), nanoseconds now = 1s) {
  Octets room(plain.size() + kEnvelope);
  const auto out = sealer.seal(stream, epoch, to, now, plain, room);
  return {out.begin(), out.end()};
}

/// A datagram as it arrives.
inline Datagram arrived(std::span<const std::byte> octets, const IpEndpoint& from, nanoseconds at,
                        const GroupAddress& group = group_of()) {
  return {group, from, octets, at};
}

/// Genuine datagrams that have been taken, and all forgeries an outsider can make from them. The
/// opener must refuse every one.
class Forger {
 public:
  Forger(const GroupKey& key, std::size_t size, std::uint32_t seed) : random_(seed) {
    Octets plain(size - kEnvelope);
    for (std::byte& octet : plain) octet = static_cast<std::byte>(random_());
    for (std::uint16_t i = 0; i < kMembers; ++i) {
      EnvelopeSealer sealer(key, 1, i);
      for (int k = 0; k < 16; ++k) genuine_.push_back(sealed(sealer, plain));
    }
  }

  [[nodiscard]] const std::vector<Octets>& genuine() const { return genuine_; }

  /// The next forgery; equal to a genuine datagram only as a replay.
  [[nodiscard]] const Octets& next() {
    const Octets& one = genuine_[random_() % genuine_.size()];
    forged_ = one;
    switch (random_() % 8) {
      case 0:
        break;  // a replay
      case 1:
        flip(random_() % (8 * forged_.size()));
        break;
      case 2:
        for (int i = 0; i < 8; ++i) forged_[random_() % forged_.size()] ^= any_octet();
        break;
      case 3:
        forged_.resize(random_() % forged_.size());
        break;
      case 4:
        forged_.push_back(any_octet());
        break;
      case 5:
        forged_[2 + random_() % 2] ^= any_octet();  // another epoch
        break;
      case 6:
        splice(genuine_[random_() % genuine_.size()]);
        break;
      default:
        forged_[16 + random_() % 8] ^= any_octet();  // another stream or count
    }
    return forged_;
  }

 private:
  static constexpr std::uint16_t kMembers = 8;

  std::byte any_octet() { return static_cast<std::byte>(1 + random_() % 255); }
  void flip(std::size_t bit) { forged_[bit / 8] ^= static_cast<std::byte>(1 << bit % 8); }
  /// Puts the header of one datagram before the body of another: another member's boot.
  void splice(const Octets& other) { std::copy_n(other.begin(), 16, forged_.begin()); }

  std::mt19937 random_;
  std::vector<Octets> genuine_;
  Octets forged_;
};

/// Opens the genuine datagrams, then counts how many of the `forgeries` are taken.
inline std::uint64_t taken_of(Forger& forger, EnvelopeOpener& opener, std::uint64_t forgeries) {
  std::vector<std::byte> room(kMaxDatagram);
  std::uint64_t taken = 0;
  for (const Octets& one : forger.genuine()) {
    const auto opened =
        opener.open(arrived(one, address(1 + read_envelope(one)->sealer.application), 1s),
                    nanoseconds::min(), 1s, room);
    if (opened.verdict != SealedVerdict::opened) return forgeries;
  }
  for (std::uint64_t i = 0; i < forgeries; ++i)
    if (opener.open(arrived(forger.next(), address(99), 2s), nanoseconds::min(), 2s, room)
            .verdict == SealedVerdict::opened)
      ++taken;
  return taken;
}

}  // namespace reckon::peer::samples
