// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the entities of a crowd say of themselves: their Entity States, plain and compressed.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/bench/studies/scale/crowd.hpp"
#include "reckon/bench/studies/scale/light_peer.hpp"
#include "reckon/bench/studies/scale/light_rows.hpp"
#include "reckon/bench/studies/scale/setting.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/pdu/entity/entity_state.hpp"

namespace reckon::bench {

/// Where something is said.
struct LightAddress {
  aoim::GroupIndex cell;
  std::size_t row;  ///< of the channels; behind the near ones: the cell's own group
};

/// Of all peers of an exercise. One thread.
class LightStates {
 public:
  /// @param crowd outlives it  @param ranges what each peer owns
  LightStates(Crowd& crowd, std::span<const OwnedRange> ranges);

  [[nodiscard]] const deadreckon::LocalFrame& frame() const noexcept { return frame_; }
  [[nodiscard]] pdu::EntityId id_of(std::uint32_t entity) const { return ids_[entity]; }
  /// As it moves now, with the model that it is said by.
  [[nodiscard]] deadreckon::KinematicState state_of(std::uint32_t entity) const;
  /// False where it cannot be said.
  bool encode(std::uint32_t entity, pdu::EntityState& pdu) const;
  /// What a receiver makes of it; false where it can make nothing of it.
  bool decode(const pdu::EntityState& pdu, deadreckon::KinematicState& state) const;

  /// An Entity State in the compressed form.
  struct Compressed {
    LightAddress to;                    ///< where it goes: what has no key there, to the cell
    std::span<const std::byte> octets;  ///< none: it is to go plain; good until the next call
    bool is_key = false;                ///< so that it does not wait
    bool needs_key = false;             ///< on a key
  };
  /// What leans on no key in a near group is a key for all. @param near_rows that have groups
  [[nodiscard]] Compressed compress(std::uint32_t entity, const LightEntity& owned,
                                    const pdu::EntityState& pdu, const LightAddress& to,
                                    deadreckon::SendReason reason, std::size_t near_rows,
                                    std::chrono::nanoseconds now);
  /// As it is restored from what was compressed of it last.
  [[nodiscard]] std::span<const std::byte> told(std::uint32_t entity) const {
    return told_[entity];
  }

 private:
  Crowd& crowd_;
  deadreckon::LocalFrame frame_{kScaleOrigin[0], kScaleOrigin[1], kScaleOrigin[2]};
  std::vector<pdu::EntityId> ids_;
  std::vector<std::array<std::byte, pdu::kFixedSize<pdu::EntityState>>> told_;  // once compressed
  std::array<std::byte, peer::StateCompressor::kRoom> octets_{};
};

}  // namespace reckon::bench
