// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// State of one emitter system, IFF system or radio of an entity.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/emission/electromagnetic_emission.hpp"
#include "reckon/pdu/emission/iff.hpp"
#include "reckon/pdu/radio/transmitter.hpp"

namespace reckon::peer {

/// Default heartbeats of IEEE 1278.1-2012, table 25: HBT_PDU_EE, HBT_PDU_IFF, HBT_PDU_TRANSMITTER.
inline constexpr std::chrono::nanoseconds kEmitterHeartbeat = std::chrono::seconds(10);
inline constexpr std::chrono::nanoseconds kIffHeartbeat = std::chrono::seconds(10);
inline constexpr std::chrono::nanoseconds kRadioHeartbeat = std::chrono::seconds(2);

/// A beam of an emitter system.
struct EmittedBeam {
  /// Limit of stored targets. A sender names no more in one beam: beyond EE_HIGH_DENSITY_THRSH
  /// (IEEE 1278.1-2012, table 25) it sets high_density_track_jam and names none.
  static constexpr std::size_t kTargets = 10;

  /// As sent; a DIS 5 or 6 beam is set active, and its jamming mode is read from the same octets.
  pdu::EmitterBeam beam;
  std::array<pdu::TrackJamTarget, kTargets> targets{};
  std::chrono::nanoseconds since{0};  ///< last change between active and inactive

  [[nodiscard]] bool is_active() const noexcept { return (beam.jamming.beam_status & 1U) == 0; }
  [[nodiscard]] std::span<const pdu::TrackJamTarget> known_targets() const noexcept {
    return std::span(targets).first(std::min<std::size_t>(beam.number_of_targets, kTargets));
  }
};

/// An emitter system.
struct EmitterState {
  static constexpr std::size_t kBeams = 8;  ///< stored beams

  pdu::EmitterSystem system;  ///< as sent; number_of_beams from the last PDU
  std::array<EmittedBeam, kBeams> beams{};
  std::uint8_t count = 0;     ///< beams; 0: the system has no beam
  std::uint8_t left_out = 0;  ///< beams of the last PDU for which there was no room

  [[nodiscard]] std::span<const EmittedBeam> known_beams() const noexcept {
    return std::span(beams).first(count);
  }
};

/// Emissions of one system of an entity. A value.
struct Emission {
  /// In the order of the alternatives of `state`.
  enum class Kind : std::uint8_t { emitter, iff, radio };

  pdu::EntityId entity;
  std::uint16_t number = 0;  ///< number of the emitter or of the radio; for an IFF system its
                             ///< designator
  std::chrono::nanoseconds since{0};       ///< last start or end of emission
  std::chrono::nanoseconds last_heard{0};  ///< arrival of the last PDU about it
  std::uint64_t updates = 0;               ///< PDUs about it
  /// IFF and Transmitter PDUs as sent, without their variable parts.
  std::variant<EmitterState, pdu::Iff, pdu::Transmitter> state = {};

  [[nodiscard]] Kind kind() const noexcept { return static_cast<Kind>(state.index()); }
  /// Whether an emitter has an active beam, an IFF system is on, or a radio transmits.
  [[nodiscard]] bool emits() const noexcept;
  /// Whether two heartbeats and their tolerance (deadreckon::kTimeoutMultiplier) have passed
  /// without a PDU.
  [[nodiscard]] bool is_over(std::chrono::nanoseconds now) const noexcept {
    return now > last_heard + lifetime();
  }
  [[nodiscard]] std::chrono::nanoseconds lifetime() const noexcept;
};

}  // namespace reckon::peer
