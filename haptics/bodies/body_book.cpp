// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/body_book.hpp"

#include <algorithm>
#include <utility>

namespace reckon::haptics {

BodyBook::BodyBook(BodySolver& solver, const CarriedObjects& carried)
    : solver_(solver),
      carried_(carried),
      woken_(solver.slots()),
      touched_(solver.slots().kinds().size()) {
  const std::vector<BodyKind>& kinds = solver_.slots().kinds();
  now_.resize(kinds.size());
  for (std::size_t i = 0; i < now_.size(); ++i) {
    now_[i].object = kinds[i].object;
    now_[i].carried = kinds[i].is_carried;
    now_[i].island = static_cast<std::uint32_t>(i);
    if (solver_.slots().slot_of(i) != BodySlots::kNone) continue;
    static_cast<ObjectMotion&>(now_[i]) = kinds[i].lying();
    now_[i].awake = false;
  }
  next_ = now_;
  read(BodySolver::all(), 0.0, BodySolver::all(), 0.0);
}

std::size_t BodyBook::take_in(std::size_t body, BodySet pinned) noexcept {
  const auto [slot, lost] = woken_.take_in(body, pinned);
  if (lost != WokenBodies::kNobody) {
    static_cast<ObjectMotion&>(now_[lost]) = solver_.slots().kinds()[lost].lying();
    next_[lost] = now_[lost];
  }
  return slot;
}

void BodyBook::read(BodySet some, double step, BodySet fine, double usual) noexcept {
  for (std::size_t slot = 0; slot < solver_.size(); ++slot) {
    if ((some >> slot & 1) == 0 && !solver_.is_carried(slot)) continue;
    read_state(slot, (fine >> slot & 1) != 0 ? step : usual, next_[solver_.body(slot)]);
  }
  std::swap(now_, next_);
  ++version_;
  const auto is_awake = [this](std::uint32_t body) { return now_[body].awake; };
  quiet_ = std::ranges::any_of(woken_.with_slot(), is_awake) ? 0 : quiet_ + 1;
}

void BodyBook::read_ahead(BodySet some, double step) noexcept {
  for (std::size_t slot = 0; slot < solver_.size(); ++slot) {
    const std::size_t body = solver_.body(slot);
    if ((some >> slot & 1) == 0 || solver_.is_carried(slot)) {
      next_[body] = now_[body];
    } else {
      read_state(slot, step, next_[body]);
    }
  }
}

void BodyBook::read_again(std::size_t body, std::size_t slot) noexcept {
  const double step = now_[body].step;
  static_cast<ObjectMotion&>(now_[body]) = solver_.motion(slot);
  now_[body].step = step;
}

void BodyBook::show(std::uint32_t body) noexcept {
  const std::size_t slot = solver_.slots().slot_of(body);
  BodyState& out = now_[body];
  out.carried = solver_.slots().kinds()[body].is_carried;
  if (slot != BodySlots::kNone) {
    read_state(slot, out.step, out);
  } else {
    static_cast<ObjectMotion&>(out) =
        out.carried ? carried_.now(body) : solver_.slots().kinds()[body].lying();
    out.awake = false;
    out.island = body;
    woken_.note_changed(body);
  }
  next_[body] = out;
  quiet_ = 0;
}

void BodyBook::read_state(std::size_t slot, double step, BodyState& out) const noexcept {
  const bool is_carried = solver_.is_carried(slot);
  static_cast<ObjectMotion&>(out) = solver_.motion(slot);
  out.awake = solver_.awake(slot);
  if (frozen_ && !is_carried) {
    out.velocity.setZero();
    out.turn_rate.setZero();
  }
  out.step = is_carried ? 0.0 : step;
  out.island = woken_.island_of(slot);
}

void BodyBook::mark_touched(std::uint32_t body, bool is_touched) noexcept {
  now_[body].touched = next_[body].touched = is_touched;
  ++version_;
  if (solver_.slots().slot_of(body) == BodySlots::kNone) woken_.note_changed(body);
}

}  // namespace reckon::haptics
