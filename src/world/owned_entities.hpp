// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// All entities that this peer owns, and the list of entities to check now: with a new truth or a
// due heartbeat. An entity at rest costs nothing between heartbeats.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/peer/world/entity_description.hpp"
#include "reckon/peer/world/owned_entity.hpp"

namespace reckon::peer {

/// Settings that all entities of an owner share.
struct OwnerSettings {
  pdu::SimulationAddress simulation;  ///< first two numbers of their IDs
  std::uint8_t exercise = 1;
  double teleport_distance = 10.0;  ///< [m] > 0
  /// Motion is rounded to the quanta of this compressed form; `none`: no rounding.
  pdu::CompressedForm compression = pdu::CompressedForm::none;
  std::size_t urgent_tiers = 0;  ///< see aoim::TierTable
  /// If the inner rows of channels have tiers: the rows that are not kept, the nearest first.
  std::vector<aoim::Channel> rows = {};
};

/// The numbers of a peer's entities. A released number is assigned last, so that no peer confuses a
/// new entity with the old one.
class EntityNumbers {
 public:
  /// @param taken numbers up to this one are in use
  explicit EntityNumbers(std::size_t taken = 0) : next_(taken) {}
  /// None if all are in use.
  std::optional<EntityNumber> take();
  void give_back(EntityNumber number) { free_.push_back(number); }

 private:
  std::size_t next_;
  std::deque<EntityNumber> free_;
};

/// The table. One thread. add() allocates; the rest allocates only when more entities are pending
/// than ever before.
class OwnedEntities {
 public:
  /// @param frame outlives the table.
  OwnedEntities(const deadreckon::LocalFrame& frame, const OwnerSettings& settings)
      : frame_(frame), settings_(settings) {}

  /// Adds an entity under a number of 1 .. kMostOwned, to be checked at once if `truth` has a time.
  /// False if the number is in use.
  bool add(EntityNumber number, const EntityDescription& description,
           const EntityTruth& truth = {});
  /// The same for a body of the scene: rename() does not change its ID.
  bool add_body(EntityNumber number, const EntityDescription& description, const pdu::EntityId& id,
                const pdu::OwnershipRecord& ownership);
  /// Removes an entity; does nothing if there is none.
  void remove(EntityNumber number) noexcept;

  [[nodiscard]] OwnedEntity* find(EntityNumber number) noexcept;
  [[nodiscard]] const OwnedEntity* find(EntityNumber number) const noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// The same without bodies of other owners; visits all.
  [[nodiscard]] std::size_t ours() const noexcept {
    return static_cast<std::size_t>(std::ranges::count_if(
        slots_, [](const Slot& slot) { return slot.entity && slot.entity->is_ours(); }));
  }
  /// Upper bound of the numbers in use.
  [[nodiscard]] std::size_t last_number() const noexcept { return slots_.size(); }
  /// The entities that hands can feel, in the order of add().
  [[nodiscard]] std::span<const EntityNumber> touchable() const noexcept { return touchable_; }
  /// Of the entity with the least number that is no body; simulation() if there is none.
  [[nodiscard]] pdu::EntityId first_id() const noexcept;
  /// First half of their IDs; entity 0 is the whole simulation.
  [[nodiscard]] pdu::EntityId simulation() const noexcept {
    return {settings_.simulation.site, settings_.simulation.application, 0};
  }
  /// Changes the first half after an identity conflict: an event for each entity but bodies.
  void rename(const pdu::SimulationAddress& simulation) noexcept;

  /// Has the entity checked in the next pass.
  void look_at(EntityNumber number) noexcept;
  /// Records a sent update, after which the next repetition is scheduled.
  void note_sent(EntityNumber number) noexcept;

  /// Calls visit(OwnedEntity&, EntityNumber) for each entity to check, oldest first. If visit
  /// returns false, this entity and the rest stay for the next pass.
  void for_each_waiting(std::chrono::nanoseconds now, auto&& visit) {
    wake_due(now);
    std::size_t done = 0;
    while (done < waiting_.size()) {
      const EntityNumber number = waiting_[done];
      Slot& slot = slots_[number - 1u];
      bool go_on = true;
      if (slot.entity) go_on = visit(*slot.entity, number);
      slot.waits = !go_on;
      if (!go_on) break;
      ++done;
      if (slots_[number - 1u].entity) schedule(slots_[number - 1u], number);
    }
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(done));
  }

  /// Calls visit(OwnedEntity&, EntityNumber) for all.
  void for_each(auto&& visit) { for_each_in(0, slots_.size(), visit); }
  /// The same for the next `count` places of the table, cyclically.
  void for_each_next(std::size_t count, auto&& visit) {
    count = std::min(count, slots_.size());
    if (cursor_ >= slots_.size()) cursor_ = 0;
    const std::size_t first = std::min(count, slots_.size() - cursor_);
    for_each_in(cursor_, cursor_ + first, visit);
    for_each_in(0, count - first, visit);
    cursor_ = slots_.empty() ? 0 : (cursor_ + count) % slots_.size();
  }

  /// Steady time at which the next one has to be checked; max if none.
  [[nodiscard]] std::chrono::nanoseconds next_due() const noexcept;

 private:
  struct Slot {
    std::unique_ptr<OwnedEntity> entity;
    std::chrono::nanoseconds scheduled = std::chrono::nanoseconds::max();
    bool waits = false;
  };
  struct Due {
    std::chrono::nanoseconds time;
    EntityNumber number;
    friend bool operator<(const Due& a, const Due& b) noexcept { return a.time > b.time; }
  };
  void for_each_in(std::size_t from, std::size_t to, auto&& visit) {
    for (std::size_t i = from; i < to; ++i) {
      if (slots_[i].entity) visit(*slots_[i].entity, static_cast<EntityNumber>(i + 1));
    }
  }
  OwnedEntity* place(EntityNumber number, const EntityDescription& description,
                     const pdu::EntityId& id);
  void wake_due(std::chrono::nanoseconds now) noexcept;
  void schedule(Slot& slot, EntityNumber number) noexcept;

  const deadreckon::LocalFrame& frame_;
  OwnerSettings settings_;
  std::vector<Slot> slots_;            // by number - 1
  std::vector<EntityNumber> waiting_;  // each at most once
  std::vector<Due> due_;               // a heap, earliest at the front; stale entries are skipped
  std::vector<EntityNumber> touchable_;
  std::size_t size_ = 0;
  std::size_t cursor_ = 0;
};

}  // namespace reckon::peer
