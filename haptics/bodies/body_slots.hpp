// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which bodies of a plan take part, and where the others lie.
#pragma once

#include <Eigen/Core>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reckon/haptics/bodies/ode_calls.hpp"
#include "reckon/haptics/bodies/rigid_body.hpp"
#include "reckon/haptics/queries/cell_grid.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// Bodies by their slots, a bit each.
using BodySet = std::uint64_t;

/// Slot of a body that takes part.
[[nodiscard]] inline std::size_t slot_of(dBodyID body) noexcept {
  return reinterpret_cast<std::size_t>(dBodyGetData(body));
}

/// Those that take part have a slot each. A plan of no more bodies than slots has all of them in,
/// in its order. Of others all but those that are carried begin asleep, as they stand, and without
/// a slot; they are in a grid of their own, and in no space of ODE's. After some steps it allocates
/// nothing. One thread.
class BodySlots {
 public:
  static constexpr std::size_t kMost = 8 * sizeof(BodySet);
  static constexpr std::size_t kNone = kMost;

  /// @param world, space outlive this  @param gravity [m/s^2], S
  BodySlots(dWorldID world, dSpaceID space, const Eigen::Vector3d& gravity)
      : world_(world), space_(space), gravity_(gravity) {}
  ~BodySlots();
  BodySlots(const BodySlots&) = delete;
  BodySlots& operator=(const BodySlots&) = delete;

  /// The next body. @param geom in the space, or null
  void add(const PlannedObject& object, std::uint32_t number, dGeomID geom);
  /// After the last one. @throws std::invalid_argument where more are carried than have room
  void fill();

  [[nodiscard]] const std::vector<BodyKind>& kinds() const noexcept { return kinds_; }
  [[nodiscard]] std::size_t slot_of(std::size_t body) const noexcept { return slot_of_[body]; }
  /// Boxes of those without a slot [m], S, by their numbers.
  [[nodiscard]] const CellGrid& asleep() const noexcept { return asleep_; }
  /// Calls visit(number) for each of those whose box overlaps or touches `box` of a slot [m, S].
  /// Where none is near, the slot's next boxes thereabouts cost some ns.
  template <class Visit>
  void visit_asleep(std::size_t slot, const Eigen::AlignedBox3d& box, Visit&& visit) {
    RigidBody& body = bodies_[slot];
    if (asleep_.size() == 0 || (body.clear_since == lain_down_ && body.clear.contains(box))) return;
    bool any = false;
    asleep_.visit(box, [&](std::uint32_t number) {
      any = true;
      visit(number);
    });
    if (any) return;
    body.clear = {box.min().array() - kClear, box.max().array() + kClear};
    asleep_.visit(body.clear, [&](std::uint32_t) { any = true; });
    body.clear_since = any ? 0 : lain_down_;
  }
  /// Of their weight [J].
  [[nodiscard]] double asleep_energy() const noexcept { return asleep_energy_; }
  /// Gives a body a slot: a new one, or that of one that sleeps and is not in `pinned`, which then
  /// has none. @return kNone if there is none to be had
  std::size_t take_in(std::size_t body, BodySet pinned) noexcept;

  /// Slots in use.
  [[nodiscard]] std::size_t size() const noexcept { return bodies_.size(); }
  [[nodiscard]] RigidBody& operator[](std::size_t slot) noexcept { return bodies_[slot]; }
  [[nodiscard]] const RigidBody& operator[](std::size_t slot) const noexcept {
    return bodies_[slot];
  }
  [[nodiscard]] BodySet carried() const noexcept { return carried_; }
  /// Calls visit(slot) for those in use that are in the set, in their order.
  template <class Visit>
  void each(BodySet some, Visit&& visit) const {
    const BodySet used = size() < kMost ? (BodySet{1} << size()) - 1 : ~BodySet{0};
    for (BodySet left = some & used; left != 0; left &= left - 1)
      visit(static_cast<std::size_t>(std::countr_zero(left)));
  }

 private:
  static constexpr double kClear = 0.005;  // [m], about a box that meets none

  void sit(std::size_t slot, const BodyKind& kind) noexcept;
  void leave(std::size_t slot) noexcept;
  void lie_down(const BodyKind& kind) noexcept;

  dWorldID world_;
  dSpaceID space_;
  Eigen::Vector3d gravity_;
  std::vector<BodyKind> kinds_;
  std::vector<std::size_t> slot_of_;  // of all bodies
  std::vector<RigidBody> bodies_;     // by their slots
  BodySet carried_ = 0;
  CellGrid asleep_;
  std::uint64_t lain_down_ = 1;  // how often one was added to them
  double asleep_energy_ = 0.0;
  std::size_t next_out_ = 0;  // slot
};

}  // namespace reckon::haptics
