// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/peer_view.hpp"

#include <algorithm>
#include <limits>

#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {

EntityView view_of(const RemoteEntity& row, std::span<const HandView> hands,
                   std::chrono::nanoseconds now) noexcept {
  EntityView view;
  view.id = row.id;
  view.marking = row.marking;
  view.kind = row.type.kind;
  view.algorithm = row.state.algorithm;
  view.position = row.shown(now).position;
  const double span = pdu::to_seconds(row.last_heard - row.first_heard);
  view.rate_hz = span > 0.0 ? static_cast<double>(row.updates - 1) / span : 0.0;
  view.jump_m = row.jump_m;
  view.age = pdu::to_seconds(now - row.last_heard);
  view.haptic = row.haptic;
  view.frozen = row.frozen;
  view.k1 = row.model.k1;
  view.updates = row.updates;
  view.parts = row.parts;
  for (const HandView& hand : hands) {
    for (std::size_t i = 0; i < hand.servo.count; ++i) {
      const haptics::ContactAccount& contact = hand.servo.contacts[i];
      if (contact.id != row.id) continue;
      view.force_n = std::max(view.force_n, contact.force.norm());
      view.ledger_j += contact.ledger;
    }
  }
  return view;
}

bool ViewChoice::was_chosen(const pdu::EntityId& id) const noexcept {
  const auto begin = chosen_.begin();
  return std::binary_search(begin, begin + static_cast<std::ptrdiff_t>(chosen_count_), id);
}

void ViewChoice::offer(const RemoteEntity& row, const Candidate& candidate) noexcept {
  constexpr double kStays = 0.9 * 0.9;
  const bool is_full = count_ == nearest_.size();
  const double farthest =
      is_full ? nearest_.front().distance : std::numeric_limits<double>::infinity();
  if (!(kStays * candidate.distance < farthest)) return;
  const double distance = candidate.distance * (was_chosen(row.id) ? kStays : 1.0);
  if (!(distance < farthest)) return;
  const auto begin = nearest_.begin();
  if (is_full) std::pop_heap(begin, nearest_.end());
  if (!is_full) ++count_;
  nearest_[count_ - 1] = {distance, candidate.place};
  std::push_heap(begin, begin + static_cast<std::ptrdiff_t>(count_));
}

std::span<const std::uint32_t> ViewChoice::choose(std::span<const RemoteEntity> rows,
                                                  const Eigen::Vector3d& from) noexcept {
  count_ = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double distance = (rows[i].state.position - from).squaredNorm();
    const bool is_number = distance < std::numeric_limits<double>::max();
    offer(rows[i], {is_number ? distance : std::numeric_limits<double>::max(),
                    static_cast<std::uint32_t>(i)});
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
