// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The bodies of a scene as entities: their owner sends them, and the other peers see and feel them
// at the received places.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "reckon/aoim/groups/body_owners.hpp"
#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/bodies/object_mover.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/peer/scene_graph/scene_nodes.hpp"
#include "reckon/peer/world/arrival.hpp"
#include "reckon/peer/world/datagram_decoder.hpp"
#include "reckon/peer/world/entity_description.hpp"
#include "reckon/peer/world/remote_entities.hpp"
#include "reckon/peer/world/state_table.hpp"

namespace reckon::peer {

/// Bodies that peers share, at most: their numbers have one octet.
inline constexpr std::size_t kMostSharedBodies = aoim::BodyOwners::kMost;

/// Kind other, category 66 (0x42); `extra` is the number of the body among the movable objects of
/// the scene.
[[nodiscard]] pdu::EntityType body_type(std::size_t body) noexcept;
/// None for any other entity.
[[nodiscard]] std::optional<std::size_t> body_of(const pdu::EntityType& type) noexcept;
/// Its entity ID, which names no owner: site and application of the scene, entity `body` + 1. In an
/// `interop` exercise, where states carry no epoch, a body has an ID of its owner.
[[nodiscard]] pdu::EntityId body_id(std::size_t body) noexcept;
/// The object's x, y, z axes are forward, left and up.
[[nodiscard]] EntityTruth truth_of(const haptics::BodyState& body,
                                   std::chrono::nanoseconds time) noexcept;

/// The inverse: motion of a body as shown.
[[nodiscard]] haptics::ObjectMotion motion_of(const deadreckon::Pose& shown) noexcept;

/// The bodies of another peer, from the model loop to the servos.
struct ShownBodies {
  enum class Known : std::uint8_t {
    not_yet,  ///< it is at its place in the scene
    here,
    gone,  ///< it stays at the last shown place
  };
  std::array<RemoteCopy, kMostSharedBodies> rows{};
  std::array<Known, kMostSharedBodies> known{};
};

/// Used by the servos. Bodies are placed as the table of remote entities shows them. Objects below
/// a time function of the scene are placed by that function, at the same time for all peers.
class BodyMover final : public haptics::ObjectMover {
 public:
  /// @param plan whose objects are carried; only read here  @param nodes of the same scene, copied
  BodyMover(const haptics::EffectPlan& plan, const SceneNodes& nodes);

  [[nodiscard]] haptics::ObjectMotion motion_of(std::uint32_t object,
                                                std::chrono::nanoseconds now) noexcept override;
  /// The body stands until an update of another peer comes after this call.
  void leave_at(std::uint32_t object, const haptics::ObjectMotion& motion) noexcept override;
  /// Written by the model loop.
  [[nodiscard]] haptics::TripleBuffer<ShownBodies>& shown() noexcept { return shown_; }
  /// Universal time minus the time of the servos; from the model loop.
  void set_offset(std::chrono::nanoseconds offset) noexcept {
    offset_.store(offset, std::memory_order_relaxed);
  }

 private:
  struct Body {
    std::uint32_t object = 0;
    NodeIndex node = kNoNode;  // below a time function
    haptics::ObjectMotion last;
    std::optional<std::uint32_t> left;  // version of the row that leave_at() found, until the next
  };
  [[nodiscard]] haptics::ObjectMotion by_time(NodeIndex node,
                                              std::chrono::nanoseconds now) noexcept;

  SceneGraph graph_;
  std::atomic<std::chrono::nanoseconds> offset_{std::chrono::nanoseconds(0)};
  std::chrono::nanoseconds evaluated_{-1};
  haptics::TripleBuffer<ShownBodies> shown_;
  std::vector<Body> bodies_;
};

/// Used by the model loop. Shows the bodies whose owner the scene's `touch` admits. The table of
/// remote entities has states of a body from only its owner. In an `interop` exercise no peer
/// announces itself: bodies are known by their type, and a sender that `touch` names owns them.
/// Allocates nothing.
class RemoteBodies {
 public:
  /// References outlive this.  @param interop whether the exercise is
  RemoteBodies(haptics::TripleBuffer<ShownBodies>& shown, bool interop)
      : shown_(shown), interop_(interop) {}

  /// An update with a state that the table has taken.
  void note(const Inbound& update, const Arrival& arrival, RemoteEntities& rows) noexcept;
  /// The table has a state of this peer, for a body that it has given away.
  void note_own(const pdu::EntityId& body, const RemoteEntities& rows) noexcept;
  /// Publishes the rows that have changed.
  void publish(const RemoteEntities& rows) noexcept;

 private:
  struct Place {
    std::optional<pdu::EntityId> id;
    std::uint32_t version = 0;
    std::chrono::nanoseconds doubted_at{0};
  };
  [[nodiscard]] std::optional<std::size_t> number_of(const RemoteEntity& row,
                                                     const RemoteEntities& rows) const noexcept;
  [[nodiscard]] bool takes(const RemoteEntity& row, const Arrival& arrival,
                           RemoteEntities& rows) const noexcept;
  void lose(std::size_t body) noexcept;

  haptics::TripleBuffer<ShownBodies>& shown_;
  bool interop_;
  bool changed_ = false;  // newest_, since it was published
  ShownBodies newest_;
  std::array<Place, kMostSharedBodies> places_{};
};

}  // namespace reckon::peer
