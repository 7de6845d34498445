// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/body_engine.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "reckon/pdu/seconds.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr double kLongestStep = 1e-3;  // [s]
constexpr double kLongestGap = 0.1;    // [s]
constexpr double kJitter = 5e-5;       // [s], lateness of a punctual servo
constexpr double kBefore = 0.17;       // greatest counted work before the forces, over the period
constexpr double kAfter = 0.4;         // the same after them
constexpr double kLate = 0.2;          // the same of a short step, which a late servo needs
constexpr double kMetAhead = 2.0;      // periods in which a moving body may reach a sleeping one
constexpr int kCoarsePeriods = 16;     // after a prediction that needed too much work
constexpr double kOver = 1.5;          // greatest work of a prediction, over its share

}  // namespace

BodyEngine::BodyEngine(const EffectPlan& plan, const Vector3d& gravity,
                       std::shared_ptr<ObjectMover> mover, const WorkSpace& work_space)
    : solver_(plan, gravity, work_space),
      carried_(plan, solver_.slots(), std::move(mover)),
      copied_(solver_.slots(), carried_),
      ordered_(solver_.slots(), carried_, copied_),
      book_(solver_, carried_),
      near_(radii_of_moving(plan)),
      pushes_(solver_) {}

bool BodyEngine::advance_to(nanoseconds now, bool frozen) noexcept {
  const bool is_first = !std::exchange(started_, true);
  if (is_first) time_ = now;
  const double gap = pdu::to_seconds(now - time_);
  if (!is_first && !(gap > 0)) return false;
  time_ = now;
  book_.expire(now);
  if (is_quiet() && !is_first && !frozen && !book_.is_frozen()) {
    begin_period();
    lead_ = 0.0;
    return true;
  }
  if (!carried_.empty()) follow_carried(now, gap);
  book_.freeze(frozen);
  if (is_first || frozen) {
    go_back();
    pushes_.clear();
    begin_period();
    lead_ = 0.0;
    carried_.put(solver_.slots());
    read_states(BodySolver::all(), 0.0);
    return true;
  }
  const bool is_ahead = ahead_ > 0;
  if (!is_ahead) {
    take_in_met();
    pushes_.begin_works();
  }
  const double whole = std::min(gap, kLongestGap);
  BodySet foreseen = is_ahead ? rest_ : 0;
  const BodySet rest = is_ahead ? rest_ : apart();
  double length = kLongestStep;
  if (rest != BodySolver::all()) {
    // Islands that hands push move in small steps, all other bodies in usual ones.
    const double dt = std::min(kLongestStep, period_ / static_cast<double>(pushes_.steps()));
    const double steps = std::ceil(whole / dt - 1e-9);
    length = whole / steps;
    carried_.drive(solver_.slots(), gap);
    solver_.allow({});
    pushes_.move(~rest, 0.0, whole, steps);
  }
  lead_ = ahead_ - whole;
  if (lead_ < -kJitter) {
    carried_.drive(solver_.slots(), gap);
    move_rest(rest, ahead_, whole);
    lead_ = 0.0;
    foreseen = 0;
  }
  carried_.put(solver_.slots());
  copied_.draw(now, whole);
  read_states(copied_.empty() ? ~foreseen : BodySolver::all(), length, ~rest);
  copied_.each_drawn([this](std::uint32_t body, const Vector3d& way, const Vector3d& turn) {
    book_.note_drawn(body, way, turn);
  });
  pushes_.end_period();
  begin_period();
  return true;
}

std::span<const std::uint32_t> BodyEngine::near(std::size_t hand, const HandReach& reach,
                                                double period) noexcept {
  return near_.of(
      hand, reach, [this] { return about(book_.now()); }, period);
}

bool BodyEngine::written(std::size_t hand, const HandReach& reach) noexcept {
  near_.watch(hand, reach);
  written_ |= std::uint64_t{1} << hand % 64;
  const std::uint64_t all = ~std::uint64_t{0} >> (64 - std::min<std::size_t>(near_.hands(), 64));
  return (written_ & all) == all;
}

void BodyEngine::go_ahead() noexcept {
  if (book_.is_frozen() || !started_ || ahead_ > 0 || !(period_ > lead_)) return;
  if (is_quiet()) {
    near_.foresee_moved([this] { return about(book_.now()); }, period_);
    return;
  }
  take_in_met();
  rest_ = apart();
  if (rest_ == 0) return;
  ahead_ = period_;
  // Carried objects keep their present velocity.
  carried_.put(solver_.slots());
  solver_.only(rest_);
  solver_.keep();
  pushes_.keep();
  pushes_.begin_works();
  move_rest(rest_, lead_, period_);
  book_.read_ahead(rest_, kLongestStep);
  near_.foresee(about(book_.next()), period_);
}

std::size_t BodyEngine::push(std::size_t body, const Vector3d& point,
                             const Vector3d& force) noexcept {
  if (body >= book_.now().size() || pushes_.size() >= BodyWorld::kMostPushes || !force.allFinite())
    return BodyWorld::kNoPush;
  go_back();
  const std::size_t slot = slot_for(body);
  if (slot == BodySlots::kNone) return BodyWorld::kNoPush;
  const ObjectMotion at = solver_.motion(slot);
  return pushes_.add({body, at.orientation.conjugate() * (point - at.position), force});
}

std::size_t BodyEngine::press(std::size_t hand, const BodySpring& spring) noexcept {
  if (spring.body >= book_.now().size() || pushes_.size() >= BodyWorld::kMostPushes ||
      !spring.force.allFinite() || !spring.velocity.allFinite())
    return BodyWorld::kNoPush;
  const std::size_t slot = slot_for(spring.body);
  if (slot == BodySlots::kNone) return BodyWorld::kNoPush;
  const ObjectMotion at = solver_.motion(slot);
  return pushes_.add({hand, spring, at.position, at.orientation});
}

void BodyEngine::foresee(std::size_t hand, double period) noexcept {
  period_ = period;
  pushes_.note_step(hand);
  // Frozen bodies do not give way.
  if (book_.is_frozen() || !pushes_.has_any_of(hand)) return;
  const BodySet pushed = pushes_.present();
  const std::size_t steps = pushes_.steps_for(period);
  if (!is_coarse_) {
    const BodySet island = solver_.island(pushed);
    is_coarse_ = !is_small(island, steps);
    if (!is_coarse_ && pushes_.foresee(hand, period, {island, steps, kOver * time_before()}))
      return;
    if (!is_coarse_) coarse_left_ = kCoarsePeriods;
    is_coarse_ = true;
  }
  ++coarse_;
  static_cast<void>(
      pushes_.foresee(hand, period, {.bodies = pushed, .steps = steps, .has_impacts = false}));
}

bool BodyEngine::obey(const BodyOrder& order, ObjectMotion& was) noexcept {
  BodySlots& slots = solver_.slots();
  book_.note_order();
  go_back();
  if (order.body < book_.now().size()) was = slots.motion_of(order.body);
  if (!ordered_.admits(order)) return false;
  const bool goes_on = copied_.contains(order.body) && order.act != BodyAct::follow;
  const bool begins = order.act == BodyAct::own || order.act == BodyAct::adopt ||
                      order.act == BodyAct::place || order.act == BodyAct::copy;
  const bool is_put = begins && !goes_on;
  if (is_put) wake_near(order.body);
  const bool is_left = order.act == BodyAct::disown || order.act == BodyAct::follow;
  ordered_.carry_out(order, is_left ? slots.slot_of(order.body) : slot_for(order.body));
  // The springs of hands end where the body was.
  if (is_put || is_left) pushes_.end(order.body);
  book_.set_copied(order.body, copied_.contains(order.body));
  book_.show(order.body);
  near_.forget();
  return true;
}

// Wakes what a body leaves behind.
void BodyEngine::wake_near(std::uint32_t body) noexcept {
  BodySlots& slots = solver_.slots();
  Eigen::AlignedBox3d box = box_of(slots.kinds()[body].geom);
  const Vector3d near = Vector3d::Constant(BodySolver::kNear);
  box = {box.min() - near, box.max() + near};
  book_.woken().wake(box);
  for (const std::uint32_t other : book_.woken().touching(box)) {
    if (other == body || slots.kinds()[other].is_carried) continue;
    const std::size_t slot = slot_for(other);
    if (slot != BodySlots::kNone) slots[slot].wake();
  }
}

// Carried bodies without a slot take one when they move; without a free slot they jump.
void BodyEngine::follow_carried(nanoseconds now, double gap) noexcept {
  carried_.see(now, gap);
  BodySlots& slots = solver_.slots();
  for (const std::uint32_t body : carried_.bodies()) {
    const std::size_t slot = slots.slot_of(body);
    const bool keeps = slot != BodySlots::kNone && slots.kinds()[body].can_be_owned;
    if (keeps && carried_.is_moved(body)) slots[slot].wake();  // it cannot lose its slot
  }
  for (const std::uint32_t body : carried_.bodies()) {
    const bool jumps = carried_.has_jumped(body), is_moved = carried_.is_moved(body);
    if (jumps) wake_near(body);
    if (slots.slot_of(body) != BodySlots::kNone) continue;
    const ObjectMotion& to = carried_.now(body);
    if (!is_moved && to.velocity == book_.now()[body].velocity) continue;
    const std::size_t slot = is_moved && !jumps ? slot_for(body) : BodySlots::kNone;
    if (slot != BodySlots::kNone) {
      slots[slot].wake();
      continue;
    }
    slots.lie(body, to);
    book_.show(body);
    near_.forget();
  }
}

double BodyEngine::take_back(std::size_t body, double energy) noexcept {
  const std::size_t slot = solver_.slots().slot_of(body);
  if (slot == BodySlots::kNone || solver_.is_carried(slot) || !(energy > 0)) return 0.0;
  go_back();
  const double taken = solver_.take_back(slot, energy);
  book_.read_again(body, slot);
  near_.forget();
  return taken;
}

// The bodies to search, in these states.
BodiesAbout BodyEngine::about(std::span<const BodyState> states) const noexcept {
  return {states, with_slot(), solver_.slots().asleep()};
}

// A sleeping body gets a slot; another sleeping body may lose its slot.
std::size_t BodyEngine::slot_for(std::size_t body) noexcept {
  const std::size_t had = solver_.slots().slot_of(body);
  if (had != BodySlots::kNone) return had;
  go_back();
  const std::size_t slot = book_.take_in(body, pushes_.pinned());
  if (slot == BodySlots::kNone) return slot;
  near_.forget();
  return slot;
}

// Gives slots to sleeping bodies in the way of moving ones.
void BodyEngine::take_in_met() noexcept {
  for (const std::uint32_t body : book_.woken().met(kMetAhead * period_))
    static_cast<void>(slot_for(body));
}

// Moves the bodies that are ahead back to the start of the period, where all others are.
void BodyEngine::go_back() noexcept {
  if (!(std::exchange(ahead_, 0.0) > 0)) return;
  solver_.only(rest_);
  solver_.restore();
  solver_.only(BodySolver::all());
  pushes_.restore();
}

void BodyEngine::begin_period() noexcept {
  is_coarse_ = coarse_left_ > 0;
  coarse_left_ -= is_coarse_ ? 1 : 0;
  written_ = 0;
  pushes_.begin_period();
  book_.woken().begin_period();
  ahead_ = 0.0;
}

// The bodies outside the islands that take small steps.
BodySet BodyEngine::apart() const noexcept {
  const std::size_t steps = pushes_.steps();
  if (is_coarse_ || steps < 2) return BodySolver::all();
  const BodySet pushed = solver_.island(pushes_.pushed());
  return is_small(pushed, steps) ? ~pushed : BodySolver::all();
}

// Whether an island can be stepped in time: once for each hand and once more.
bool BodyEngine::is_small(BodySet island, std::size_t steps) const noexcept {
  return solver_.work_of(island) * static_cast<double>(steps) <= time_before();
}

// For the prediction of one hand, or for the steps of the islands [s].
double BodyEngine::time_before() const noexcept {
  const bool is_idle = guest_ < near_.hands() && !pushes_.has_any_of(guest_);
  const std::size_t hands = near_.hands() - (is_idle ? 1 : 0);
  return kBefore * period_ / (pace_ * static_cast<double>(hands + 1));
}

// Moves bodies in usual steps, within the time after the forces.
void BodyEngine::move_rest(BodySet rest, double from, double to) noexcept {
  const double steps = std::max(1.0, std::ceil((to - from - kJitter) / kLongestStep - 1e-9));
  const double share = std::max(kAfter * (to - from) / steps, kLate * period_);
  solver_.allow({share / pace_, pushes_.pushed()});
  pushes_.move(rest, from, to, steps);
}

void BodyEngine::read_states(BodySet some, double step, BodySet fine) noexcept {
  book_.read(some, step, fine, kLongestStep);
  if (some != 0) near_.forget();
}

}  // namespace reckon::haptics
