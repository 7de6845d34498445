// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The key of one sealer in one epoch, ready for use. All primitives are libsodium's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/peer/sealing/envelope.hpp"

namespace reckon::peer {

/// Octets of a group's secret and of each key made from it.
inline constexpr std::size_t kKeyOctets = 32;
using KeyOctets = std::array<std::byte, kKeyOctets>;

/// Initialises libsodium; a second call costs nothing.  @throws std::runtime_error on failure.
void prepare_sealing();

/// Whether this CPU supports the suite.
[[nodiscard]] bool can_seal(SealingSuite suite);

/// Overwrites the octets; never optimised away.
void wipe(std::span<std::byte> octets) noexcept;

/// BLAKE2b-256, keyed with the group's secret, of octets 1 to 15 of the header: suite, epoch and
/// sealer. Therefore different sealers and different epochs have different keys. For AES-256-GCM
/// the hash also covers the salt in the header, because its nonce has no room for it. 0.2 us.
[[nodiscard]] KeyOctets derive_key(const KeyOctets& secret, const EnvelopeHeader& header) noexcept;

/// The salt as part of the key: 0 with XChaCha20, which has the salt in the nonce.
[[nodiscard]] inline std::uint64_t key_salt(const EnvelopeHeader& header) noexcept {
  return header.suite == SealingSuite::aes_256_gcm ? header.salt : 0;
}

/// Seals and opens with one key; call set_key() first. No allocation; const functions by any
/// threads.
class SealingKey {
 public:
  /// The CPU must support the suite (assert).
  void set_key(SealingSuite suite, const KeyOctets& key) noexcept;
  void wipe() noexcept { peer::wipe(state_); }

  /// Writes header, sealed `plain` and tag to `out`. The nonce is the header's stamp and sequence,
  /// with XChaCha20 also its salt. The same nonce twice with one key reveals both datagrams.
  /// @param to destination, covered by the tag.
  /// @param out plain.size() + kEnvelope octets, not overlapping `plain` (assert). 0.7 us at 1400
  /// octets.
  void seal(const EnvelopeHeader& header, const Destination& to, std::span<const std::byte> plain,
            std::span<std::byte> out) const noexcept;

  /// Opens a datagram that read_envelope() accepted. False if the tag is wrong for any reason;
  /// `out` is then zero.  @param to its destination.
  /// @param out datagram.size() - kEnvelope octets (assert)
  [[nodiscard]] bool open(std::span<const std::byte> datagram, const Destination& to,
                          std::span<std::byte> out) const noexcept;

 private:
  static constexpr std::size_t kState = 512;  ///< of AES: the expanded key; else the key itself

  SealingSuite suite_{SealingSuite::aes_256_gcm};
  alignas(16) std::array<std::byte, kState> state_{};
};

}  // namespace reckon::peer
