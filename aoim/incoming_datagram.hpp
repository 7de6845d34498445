// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The verdict of the AOIM layer on a received datagram.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "reckon/aoim/groups/sequence_tracker.hpp"
#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/reckon/datagram_trailer.hpp"

namespace reckon::aoim {

/// What to do with an incoming datagram.
enum class IncomingVerdict : std::uint8_t {
  use,             ///< from a member: same scene, present epoch
  plain,           ///< without trailer: plain DIS from a guest, use it
  own,             ///< our own, looped back
  not_joined,      ///< in a group that was left or never joined
  other_scene,     ///< from a peer with another scene, which was reported and not joined
  former_life,     ///< from a former epoch of the sender
  duplicate,       ///< received before
  too_old,         ///< so stale that it may be a duplicate
  other_exercise,  ///< its trailer or a Presence in it is of another DIS exercise
  impostor,        ///< its trailer names a peer that has another address
  /// From a sender that has not announced itself and may have another scene. After its announcement
  /// it introduces its entities to us.
  stranger,
};
inline constexpr std::size_t kIncomingVerdicts = 11;

/// Whether the datagram's PDUs are to be used.
[[nodiscard]] constexpr bool is_usable(IncomingVerdict verdict) noexcept {
  return verdict == IncomingVerdict::use || verdict == IncomingVerdict::plain;
}

/// Result for one incoming datagram.
struct Incoming {
  IncomingVerdict verdict = IncomingVerdict::plain;
  /// Valid unless the verdict is `plain`: sequence, epoch and send time of the sender.
  pdu::DatagramTrailer trailer;
  /// Result of the sequence number, for a datagram of a known peer in a joined group.
  std::optional<SequenceVerdict> sequence;
};

/// The trailer at the end of a datagram, if there is one. Accepts any octets.
[[nodiscard]] inline std::optional<pdu::DatagramTrailer> trailer_of(
    std::span<const std::byte> datagram) noexcept {
  if (datagram.size() < pdu::kDatagramTrailerSize) return {};
  pdu::DatagramTrailer trailer;
  const auto error = pdu::decode(datagram.last(pdu::kDatagramTrailerSize), trailer);
  const bool whole = trailer.header.length == pdu::kDatagramTrailerSize;
  if (error != pdu::DecodeError::none || !whole) return {};
  return trailer;
}

/// Whether it has a Presence of another DIS exercise. Accepts any octets.
[[nodiscard]] inline bool announces_another_exercise(std::span<const std::byte> datagram,
                                                     std::uint8_t exercise) noexcept {
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
    const bool announces = bundled.error == pdu::DecodeError::none &&
                           bundled.header.pdu_type == pdu::PduType::presence;
    if (announces && bundled.header.exercise_id != exercise) return true;
  }
  return false;
}

}  // namespace reckon::aoim
