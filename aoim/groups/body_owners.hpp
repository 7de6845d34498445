// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Owner of each body of the scene, as far as this peer knows. The rule or protocol that decides
// about owners fills the table; each received state of a body is checked by it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::aoim {

/// Counterpart of the energy account of a hand with all bodies of the scene.
inline constexpr pdu::EntityId kAllBodies{kSceneId.site, kSceneId.application, 0};

/// The peer that may send a body.
struct BodyOwnership {
  std::uint32_t epoch = 0;    ///< of the owner; 0: not known, so nobody may send the body
  std::uint64_t version = 0;  ///< least version that its states must have

  friend bool operator==(const BodyOwnership&, const BodyOwnership&) = default;
};

/// The table. One thread; fixed memory; some ns.
///
///   owners.set(0, {epoch, 1});
///   if (BodyOwners::are_for(id) && owners.of(id).epoch == sender) take(state);
class BodyOwners {
 public:
  /// Bodies of a scene, at most: body `k` has entity number k + 1 of kSceneId.
  static constexpr std::size_t kMost = 256;

  /// Whether this is an ID of the scene, which has no entities but bodies.
  [[nodiscard]] static constexpr bool are_for(const pdu::EntityId& id) noexcept {
    return id.simulation() == kSceneId;
  }
  /// Owner of an ID of the scene; epoch 0 if it is not known, or the scene has no such body.
  [[nodiscard]] BodyOwnership of(const pdu::EntityId& id) const noexcept {
    const bool is_body = id.entity > 0 && id.entity <= kMost;
    return is_body ? owners_[id.entity - 1u] : BodyOwnership{};
  }
  /// @param body 0 .. kMost - 1
  void set(std::size_t body, const BodyOwnership& owner) noexcept { owners_[body] = owner; }

 private:
  std::array<BodyOwnership, kMost> owners_{};
};

}  // namespace reckon::aoim
