// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/near_search.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {
namespace {

using deadreckon::Contact;
using deadreckon::Pose;
using deadreckon::ProbeState;
using std::chrono::nanoseconds;

constexpr double kHorizonSeconds = std::chrono::duration<double>(NearSearch::kHorizon).count();

constexpr double kLeap = kHorizonSeconds * NearSearch::kHandSpeed;

// Motion by which the gap between an entity and a hand may close within kHorizon.
class Closing {
 public:
  Closing(const RemoteEntity& row, const Pose& pose) : turn_(pose.angular_velocity.norm()) {
    speed_ = NearSearch::kHandSpeed + pose.velocity.norm() + turn_ * row.model.point.norm();
    if (deadreckon::drm_terms(row.state.motion().algorithm).acceleration)
      acceleration_ = row.state.motion().acceleration.norm();
    const pdu::ForceModelKind kind = row.model.kind;
    if (kind == pdu::ForceModelKind::sphere || kind == pdu::ForceModelKind::field) turn_ = 0;
  }

  // For a remote entity as a hand that meets a body of ours: the turn of the body counts at the
  // hand's place.
  static Closing of_hand(const RemoteEntity& row, const Pose& pose) {
    Closing closing(row, pose);
    closing.turn_ = NearSearch::kBodyTurn;
    return closing;
  }

  // The least time [s] to cover a gap [m], by a probe at this distance from the model's point.
  [[nodiscard]] double time(double gap, double distance) const {
    if (!(gap > 0)) return 0;
    if (turn_ == 0)
      return 2 * gap / (speed_ + std::sqrt(speed_ * speed_ + 2 * acceleration_ * gap));
    // a rotating plane moves faster at distant points
    const double speed = speed_ + kHorizonSeconds * acceleration_;
    return gap / (speed + turn_ * (distance + kHorizonSeconds * speed));
  }

 private:
  double turn_;
  double speed_;
  double acceleration_ = 0;
};

}  // namespace

NearSearch::NearSearch(std::size_t capacity, double reach)
    : reach_(reach), entry_of_(capacity), row_of_(capacity), look_at_(capacity) {}

void NearSearch::note_model(std::size_t place) {
  if (entry_of_[place] != kNone) return note_update(place);
  entry_of_[place] = static_cast<std::uint32_t>(row_of_.size());
  row_of_.push(static_cast<std::uint32_t>(place));
  look_at_.push(hurry_);
}

void NearSearch::note_update(std::size_t place) noexcept {
  if (entry_of_[place] != kNone) look_at_.set(entry_of_[place], hurry_);
}

void NearSearch::erase_row(std::size_t place) noexcept {
  if (const std::uint32_t entry = entry_of_[place]; entry != kNone) {
    row_of_.erase(entry);
    look_at_.erase(entry);
    if (entry < row_of_.size()) entry_of_[row_of_[entry]] = entry;
  }
  entry_of_.erase(place);
  if (place < entry_of_.size() && entry_of_[place] != kNone)
    row_of_[entry_of_[place]] = static_cast<std::uint32_t>(place);
}

// If a body appears, disappears or jumps, it may be near anything: then all rows are checked.
void NearSearch::advance(const Search& search) noexcept {
  const double way = std::max(way_of_probes(search.probes), way_of_bodies(search.bodies));
  const nanoseconds by_way = pdu::from_seconds(way / kHandSpeed);
  hurry_ += std::max({nanoseconds(1), std::min(search.now - last_, kHorizon), by_way});
  last_ = search.now;
}

// The longest way of a probe [m], at most kLeap.
double NearSearch::way_of_probes(std::span<const ProbeState> probes) noexcept {
  double way = probes.size() == probe_count_ ? 0.0 : kLeap;
  for (std::size_t i = 0; i < std::min(probes.size(), probe_count_); ++i) {
    const double moved = (probes[i].position - probes_[i].position).norm() +
                         std::abs(probes[i].radius - probes_[i].radius);
    way = std::max(way, moved < kLeap ? moved : kLeap);  // not a number: a jump
  }
  probe_count_ = probes.size();
  std::copy(probes.begin(), probes.end(), probes_.begin());
  return way;
}

// The same for bodies. A turn counts as the distance that a hand moves in the body's nominal time
// for that turn. If the last body is removed, nothing comes nearer.
double NearSearch::way_of_bodies(std::span<const MovingBody> bodies) noexcept {
  double way = bodies.size() <= bodies_.size() ? 0.0 : kLeap;
  for (std::size_t i = 0; i < std::min(bodies.size(), bodies_.size()); ++i) {
    const Pose &pose = bodies[i].pose, &before = bodies_[i].pose;
    const double turned = deadreckon::angle_between(before.orientation, pose.orientation);
    const double moved =
        std::max((pose.position - before.position).norm(), turned / kBodyTurn * kHandSpeed);
    const bool same = bodies[i].model == bodies_[i].model;
    way = std::max(way, same && moved < kLeap ? moved : kLeap);
  }
  assert(bodies.size() <= bodies_.capacity());
  bodies_.assign(bodies.begin(), bodies.end());
  return way;
}

void NearSearch::find(std::span<const RemoteEntity> rows, std::span<const ProbeState> probes,
                      nanoseconds now, std::span<NearBodies> found,
                      std::span<const MovingBody> bodies, HandsNear& hands) noexcept {
  assert(probes.size() <= kMostProbes && found.size() == probes.size());
  for (NearBodies& each : found) each.clear();
  hands.clear();
  const Search search{probes, found, bodies, hands, now};
  advance(search);
  look_at_due(rows, search);
  for (NearBodies& each : found) each.choose();
  hands.sort();
}

// Checks several rows at a time if there are many, so that memory fetches them together: none of
// them is in the cache.
void NearSearch::look_at_due(std::span<const RemoteEntity> rows, const Search& search) noexcept {
  constexpr std::size_t kMany = 16'384, kMostTogether = 16;
  const std::size_t together = look_at_.size() < kMany ? 1 : kMostTogether;
  std::array<std::size_t, kMostTogether> due;
  std::size_t next = look_at_.next_due(hurry_, 0);
  while (next < look_at_.size()) {
    std::size_t count = 0;
    while (next < look_at_.size()) {
      due[count++] = next;
      if (count == together) break;
      StateTable::prefetch_felt(rows[row_of_[next]]);
      next = look_at_.next_due(hurry_, next + 1);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t place = row_of_[due[i]];
      const double calm = look(rows[place], place, search);
      look_at_.set(due[i], hurry_ + std::max(nanoseconds(1), pdu::from_seconds(calm)));
    }
    next = look_at_.next_due(hurry_, due[0]);
  }
}

// Time for which the row is not within reach of any probe or body [s], 0 to kHorizon. A row within
// reach is added to the results.
double NearSearch::look(const RemoteEntity& row, std::size_t place, const Search& search) noexcept {
  ++looks_;
  const Pose pose = row.predicted(search.now);
  const Closing closing(row, pose);
  constexpr double kGolden = 0.6180339887498949;  // spreads any number of checks evenly
  phase_ += phase_ < 1 - kGolden ? kGolden : kGolden - 1;
  double calm = kHorizonSeconds * (0.5 + 0.5 * phase_);
  for (std::size_t i = 0; i < search.probes.size(); ++i) {
    const ProbeState& probe = search.probes[i];
    const Contact touch = deadreckon::contact(row.model, pose, probe.position, probe.radius);
    const double apart = -touch.depth - reach_;
    const bool may_press = beginnings_ == nullptr ||
                           beginnings_->may_press(place, row, i, touch.depth, *owners_, search.now);
    if (apart < 0) search.found[i].add(row, touch, pose.velocity, may_press);
    calm = std::min(calm, closing.time(apart, (probe.position - touch.point).norm()));
  }
  if (!search.bodies.empty()) calm = std::min(calm, look_from_bodies(row, pose, search));
  return 0.999 * calm;  // room for rounding
}

// The same for bodies, which remote hands touch with their centre.
double NearSearch::look_from_bodies(const RemoteEntity& row, const Pose& pose,
                                    const Search& search) const noexcept {
  const ProbeState hand{pose.position + pose.orientation * row.model.point, pose.velocity,
                        row.model.radius};
  const Closing closing = Closing::of_hand(row, pose);
  double calm = kHorizonSeconds;
  for (std::size_t i = 0; i < search.bodies.size(); ++i) {
    const MovingBody& body = search.bodies[i];
    const Contact touch = deadreckon::contact(*body.model, body.pose, hand.position, hand.radius);
    const double apart = -touch.depth - reach_;
    if (apart < 0) search.hands.add(i, hand, row.party, touch.depth);
    calm = std::min(calm, closing.time(apart, (hand.position - body.pose.position).norm()));
  }
  return calm;
}

void HandsNear::add(std::size_t body, const ProbeState& hand, const Party& party,
                    double depth) noexcept {
  if (found_.size() == kMost) leave_out();
  if (found_.size() < kMost) found_.push_back({body, hand, party, depth});
}

void HandsNear::sort() noexcept {
  const auto sort_by = [&](auto key) {
    std::sort(found_.begin(), found_.end(),
              [&](const Found& a, const Found& b) { return key(a) < key(b); });
  };
  sort_by([](const Found& f) { return std::tuple(f.body, f.party.host, -f.depth); });
  const Found* before = nullptr;
  for (Found& found : found_) {
    const bool same =
        before != nullptr && found.body == before->body && found.party.host == before->party.host;
    found.of_host = same ? before->of_host + 1 : 0;
    before = &found;
  }
  sort_by([](const Found& f) {
    return std::tuple(f.body, f.of_host >= NearBodies::kSure, f.party.guest, f.of_host, -f.depth);
  });
}

// Removes the hands for which no body has a place.
void HandsNear::leave_out() noexcept {
  sort();
  std::size_t kept = 0, of_body = 0;
  for (std::size_t i = 0; i < found_.size(); ++i) {
    of_body = i > 0 && found_[i].body == found_[i - 1].body ? of_body + 1 : 0;
    if (of_body < NearBodies::kMost) found_[kept++] = found_[i];
  }
  found_.resize(kept, Found{});
}

std::size_t HandsNear::of(std::size_t body, std::span<ProbeState> out) const noexcept {
  auto found = std::lower_bound(found_.begin(), found_.end(), body,
                                [](const Found& a, std::size_t wanted) { return a.body < wanted; });
  std::size_t count = 0;
  for (; found != found_.end() && found->body == body && count < out.size(); ++found) {
    out[count++] = found->hand;
  }
  return count;
}

}  // namespace reckon::peer
