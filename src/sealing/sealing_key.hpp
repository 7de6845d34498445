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

/// Makes libsodium ready; a second call costs nothing. @throws std::runtime_error where it cannot.
void prepare_sealing();

/// Whether this CPU has what the suite needs.
[[nodiscard]] bool can_seal(SealingSuite suite);

/// Overwrites the octets, and is not optimised away.
void wipe(std::span<std::byte> octets) noexcept;

/// BLAKE2b-256 under the group's secret of octets 1 to 15 of the header: suite, epoch and sealer,
/// so that no two sealers and no two epochs share a key; for AES-256-GCM, whose nonce has no room
/// for it, of the salt behind them. 0.2 us.
[[nodiscard]] KeyOctets derive_key(const KeyOctets& secret, const EnvelopeHeader& header) noexcept;

/// The salt as far as it is in the key: 0 with XChaCha20, which has it in the nonce.
[[nodiscard]] inline std::uint64_t key_salt(const EnvelopeHeader& header) noexcept {
  return header.suite == SealingSuite::aes_256_gcm ? header.salt : 0;
}

/// Seals and opens under one key; set_key() first. No allocation; const functions by any threads.
class SealingKey {
 public:
  /// Of a suite that this CPU can (assert).
  void set_key(SealingSuite suite, const KeyOctets& key) noexcept;
  void wipe() noexcept { peer::wipe(state_); }

  /// Writes header, sealed `plain` and tag to `out`. The header's stamp and sequence are the nonce,
  /// with XChaCha20 its salt too: the same twice under one key gives both datagrams away.
  /// @param to where it goes; covered by the tag. @param out plain.size() + kEnvelope octets, not
  /// over `plain` (assert). 0.7 us at 1400 octets.
  void seal(const EnvelopeHeader& header, const Destination& to, std::span<const std::byte> plain,
            std::span<std::byte> out) const noexcept;

  /// Opens what read_envelope() took for sealed; false where the tag is not right, for whatever
  /// reason, and `out` is then zero. @param to where it came. @param out datagram.size() -
  /// kEnvelope octets (assert)
  [[nodiscard]] bool open(std::span<const std::byte> datagram, const Destination& to,
                          std::span<std::byte> out) const noexcept;

 private:
  static constexpr std::size_t kState = 512;  ///< of AES: the expanded key; else the key itself

  SealingSuite suite_{SealingSuite::aes_256_gcm};
  alignas(16) std::array<std::byte, kState> state_{};
};

}  // namespace reckon::peer
