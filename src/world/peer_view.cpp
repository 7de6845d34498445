// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/peer_view.hpp"

#include <algorithm>
#include <limits>

#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {
namespace {

// Number of periods, and time [s], without an update after which the rate counts as 0.
constexpr double kPeriods = 5.0, kLeastSilence = 1.0;

double rate_of(const RemoteEntity& row, double age) noexcept {
  const double span = pdu::to_seconds(row.last_heard - row.first_heard);
  const double rate = span > 0.0 ? static_cast<double>(row.updates - 1) / span : 0.0;
  return age > kLeastSilence && age * rate > kPeriods ? 0.0 : rate;
}

}  // namespace

EntityView view_of(const RemoteEntity& row, std::span<const HandView> hands,
                   std::chrono::nanoseconds now) noexcept {
  EntityView view;
  view.id = row.id;
  view.marking = row.marking;
  view.kind = row.type.kind;
  view.algorithm = row.state->algorithm;
  view.position = row.shown(now).position;
  view.age = pdu::to_seconds(now - row.last_heard);
  view.rate_hz = rate_of(row, view.age);
  view.jump_m = row.jump_m;
  view.haptic = row.haptic;
  view.frozen = row.frozen;
  view.refused = row.model_refused;
  view.k1 = view.k1_felt = row.model.k1;
  view.updates = row.updates;
  view.parts = row.parts;
  for (const HandView& hand : hands) {
    for (std::size_t i = 0; i < hand.servo.count; ++i) {
      const haptics::ContactAccount& contact = hand.servo.contacts[i];
      if (contact.id != row.id) continue;
      view.force_n = std::max(view.force_n, contact.force.norm());
      view.ledger_j += contact.ledger;
      view.refused |= contact.refused;
      view.k1_felt = std::min(view.k1_felt, contact.stiffness_limit);
    }
  }
  return view;
}

namespace {

// Squared [m^2].
double distance_of(const RemoteEntity& row, const Eigen::Vector3d& from) noexcept {
  const double distance = (row.state.motion().position - from).squaredNorm();
  const bool is_number = distance < std::numeric_limits<double>::max();
  return is_number ? distance : std::numeric_limits<double>::max();
}

}  // namespace

bool ViewChoice::was_chosen(const pdu::EntityId& id) const noexcept {
  const auto begin = chosen_.begin();
  return std::binary_search(begin, begin + static_cast<std::ptrdiff_t>(chosen_count_), id);
}

void ViewChoice::offer(const Candidate& candidate) noexcept {
  const bool is_full = count_ == nearest_.size();
  if (is_full && !(candidate < nearest_.front())) return;
  const auto begin = nearest_.begin();
  if (is_full) std::pop_heap(begin, nearest_.end());
  if (!is_full) ++count_;
  nearest_[count_ - 1] = candidate;
  std::push_heap(begin, begin + static_cast<std::ptrdiff_t>(count_));
}

// If the row of an entity has moved, the entity is found when its new place is examined.
void ViewChoice::offer_again(std::span<const RemoteEntity> rows,
                             const Eigen::Vector3d& from) noexcept {
  constexpr double kStays = 0.9 * 0.9;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < chosen_count_; ++i) {
    const std::uint32_t place = places_[i];
    if (place >= rows.size() || rows[place].id != chosen_[i]) continue;
    chosen_[kept++] = chosen_[i];
    offer({kStays * distance_of(rows[place], from), place});
  }
  chosen_count_ = kept;
}

std::span<const std::uint32_t> ViewChoice::choose(std::span<const RemoteEntity> rows,
                                                  const Eigen::Vector3d& from) noexcept {
  count_ = 0;
  offer_again(rows, from);
  for (std::size_t looks = std::min(kLooks, rows.size()); looks > 0; --looks) {
    if (next_ >= rows.size()) next_ = 0;
    const auto place = static_cast<std::uint32_t>(next_++);
    const double distance = distance_of(rows[place], from);
    if (count_ == nearest_.size() && !(distance < nearest_.front().distance)) continue;
    if (!was_chosen(rows[place].id)) offer({distance, place});
  }
  const auto end = places_.begin() + static_cast<std::ptrdiff_t>(count_);
  std::transform(nearest_.begin(), nearest_.begin() + static_cast<std::ptrdiff_t>(count_),
                 places_.begin(), [](const Candidate& candidate) { return candidate.place; });
  std::sort(places_.begin(), end,
            [&](std::uint32_t a, std::uint32_t b) { return rows[a].id < rows[b].id; });
  std::transform(places_.begin(), end, chosen_.begin(),
                 [&](std::uint32_t place) { return rows[place].id; });
  chosen_count_ = count_;
  return {places_.data(), count_};
}

}  // namespace reckon::peer
