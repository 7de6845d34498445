// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Active bodies of a plan, in slots, and the poses of the inactive ones.
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

/// A set of bodies: bit i is the body in slot i.
using BodySet = std::uint64_t;

/// Slot of an active body.
[[nodiscard]] inline std::size_t slot_of(dBodyID body) noexcept {
  return reinterpret_cast<std::size_t>(dBodyGetData(body));
}

/// Each active body has a slot. If a plan has no more bodies than slots, all have one, in the
/// plan's order. Otherwise all but carried objects without a mass start asleep, without a slot, in
/// a separate grid outside ODE's space. It allocates nothing after some steps. One thread.
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

  /// Adds the next body. @param geom in the space, or null
  void add(const PlannedObject& object, std::uint32_t number, dGeomID geom);
  /// Call after the last add(). @throws std::invalid_argument: more carried objects than slots
  void fill();

  [[nodiscard]] const std::vector<BodyKind>& kinds() const noexcept { return kinds_; }
  [[nodiscard]] std::size_t slot_of(std::size_t body) const noexcept { return slot_of_[body]; }
  /// Boxes of bodies without a slot [m], S, by body number.
  [[nodiscard]] const CellGrid& asleep() const noexcept { return asleep_; }
  /// Calls visit(number) for each body without a slot whose box overlaps or touches `box` of a slot
  /// [m, S]. If none is near, the slot's next calls with boxes nearby take some ns.
  void visit_asleep(std::size_t slot, const Eigen::AlignedBox3d& box, auto&& visit) {
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
  /// Potential energy of bodies without a slot [J].
  [[nodiscard]] double asleep_energy() const noexcept { return asleep_energy_; }
  /// Gives a body a slot: a new one, or the slot of a sleeping body outside `pinned`, which loses
  /// it. @return kNone: none free
  std::size_t take_in(std::size_t body, BodySet pinned) noexcept;

  /// Changes the mode of a body that can be owned: carried, or moved by forces.
  void set_carried(std::size_t body, bool is_carried) noexcept;
  [[nodiscard]] bool can_be_owned(std::size_t body) const noexcept {
    return kinds_[body].can_be_owned;
  }
  /// It stays carried.
  void keep_carried(std::size_t body) noexcept { kinds_[body].can_be_owned = false; }
  /// Moves a body without a slot.
  void lie(std::size_t body, const ObjectMotion& at) noexcept;
  /// Motion of a body, with or without a slot.
  [[nodiscard]] ObjectMotion motion_of(std::size_t body) const noexcept {
    const std::size_t slot = slot_of_[body];
    return slot != kNone ? bodies_[slot].motion() : kinds_[body].lying();
  }

  /// Slots in use.
  [[nodiscard]] std::size_t size() const noexcept { return bodies_.size(); }
  [[nodiscard]] RigidBody& operator[](std::size_t slot) noexcept { return bodies_[slot]; }
  [[nodiscard]] const RigidBody& operator[](std::size_t slot) const noexcept {
    return bodies_[slot];
  }
  [[nodiscard]] BodySet carried() const noexcept { return carried_; }
  /// `some` without carried objects, and all bodies whose boxes are within a distance [m] of
  /// theirs, directly or through others.
  [[nodiscard]] BodySet near(BodySet some, double distance) const noexcept;
  /// Calls visit(slot) for each slot in use of the set, ascending.
  void each(BodySet some, auto&& visit) const {
    const BodySet used = size() < kMost ? (BodySet{1} << size()) - 1 : ~BodySet{0};
    for (BodySet left = some & used; left != 0; left &= left - 1)
      visit(static_cast<std::size_t>(std::countr_zero(left)));
  }

 private:
  static constexpr double kClear = 0.005;  // [m], margin around a box without a body near

  void set_mode(std::size_t slot) noexcept;
  void sit(std::size_t slot, const BodyKind& kind) noexcept;
  void leave(std::size_t slot) noexcept;
  void lie_down(const BodyKind& kind) noexcept;

  dWorldID world_;
  dSpaceID space_;
  Eigen::Vector3d gravity_;
  std::vector<BodyKind> kinds_;
  std::vector<std::size_t> slot_of_;  // by body
  std::vector<RigidBody> bodies_;     // by slot
  BodySet carried_ = 0;
  CellGrid asleep_;
  std::uint64_t lain_down_ = 1;  // number of additions to asleep_
  double asleep_energy_ = 0.0;
  std::size_t next_out_ = 0;  // next slot to take from a sleeping body
};

}  // namespace reckon::haptics
