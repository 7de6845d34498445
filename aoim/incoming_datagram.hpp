// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the AOIM layer says of a datagram that has come.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "reckon/aoim/groups/sequence_tracker.hpp"
#include "reckon/pdu/reckon/datagram_trailer.hpp"

namespace reckon::aoim {

/// What to do with an incoming datagram.
enum class IncomingVerdict : std::uint8_t {
  use,             ///< from a member: same scene, present life
  plain,           ///< without trailer: plain DIS from a guest, use it
  own,             ///< our own, looped back
  not_joined,      ///< a group that is left already or was never joined
  other_scene,     ///< the sender was reported and not joined
  former_life,     ///< of a life of the sender that is over
  duplicate,       ///< received before
  too_old,         ///< so late that it may be a duplicate
  other_exercise,  ///< its trailer or a Presence in it is of another DIS exercise
  impostor,        ///< its trailer names a peer that speaks from another address
  /// Of a sender that has not announced itself: it may run another scene. Once it has, its entities
  /// are introduced to us.
  stranger,
};
inline constexpr std::size_t kIncomingVerdicts = 11;

/// True where the datagram's PDUs are to be used.
[[nodiscard]] constexpr bool is_usable(IncomingVerdict verdict) noexcept {
  return verdict == IncomingVerdict::use || verdict == IncomingVerdict::plain;
}

/// Answer to one incoming datagram.
struct Incoming {
  IncomingVerdict verdict = IncomingVerdict::plain;
  /// Valid unless the verdict is `plain`: sequence, epoch and send time of the sender.
  pdu::DatagramTrailer trailer;
  /// Of a known peer's in a group that we hear: what its number says.
  std::optional<SequenceVerdict> sequence;
};

/// The last octets of a datagram, where they are a trailer. Any octets may come.
[[nodiscard]] std::optional<pdu::DatagramTrailer> trailer_of(
    std::span<const std::byte> datagram) noexcept;

/// Whether a Presence in it is of another DIS exercise than this one. Any octets may come.
[[nodiscard]] bool announces_another_exercise(std::span<const std::byte> datagram,
                                              std::uint8_t exercise) noexcept;

}  // namespace reckon::aoim
