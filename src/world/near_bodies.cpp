// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/near_bodies.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

// Host number of our own bodies: no row owner has it.
constexpr std::uint16_t kOwnHost = 0xFFFF;

// Whether a hand would feel it, a decimetre deep or at 1 m/s.
bool is_weak(const deadreckon::ForceModel& model) noexcept {
  return model.kind == pdu::ForceModelKind::none ||
         deadreckon::normal_force(model.k1, model.k3, 0.1) + model.damping <
             NearBodies::kLeastForce;
}

// A number that grows with `value`.
std::uint64_t in_order(double value) noexcept {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  constexpr std::uint64_t kSign = std::uint64_t{1} << 63;
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

// The values, with the given number of bits each, as one number: the first is the most significant.
template <typename... Values>
std::uint64_t packed(const std::pair<Values, int>&... fields) noexcept {
  std::uint64_t sum = 0;
  ((sum = sum << fields.second | static_cast<std::uint64_t>(fields.first)), ...);
  return sum;
}

}  // namespace

void NearBodies::clear() noexcept {
  touched_count_ = 0;
  for (const NearBody& body : bodies()) {
    if (body.depth > 0 && touched_count_ < kMost) touched_[touched_count_++] = body.id;
  }
  count_ = left_out_ = 0;
  crowding_ = nullptr;
}

void NearBodies::add(const RemoteEntity& row, const deadreckon::Contact& touch,
                     const Eigen::Vector3d& velocity, bool may_press) noexcept {
  NearBody body;
  body.row = &row;
  body.id = row.id;
  body.centre = touch.point;
  body.velocity = velocity;
  body.depth = touch.depth;
  body.may_press = may_press;
  insert(body);
}

void NearBodies::add_own(const OwnedEntities& owned, EntityNumber except,
                         const deadreckon::ProbeState& probe, nanoseconds now) noexcept {
  for (const EntityNumber number : owned.touchable()) {
    const OwnedEntity* entity = owned.find(number);
    if (number == except || entity->truth().time <= nanoseconds(0)) continue;
    const EntityTruth truth = entity->truth_at(now);
    const deadreckon::Pose pose{truth.position, truth.orientation, truth.velocity,
                                truth.angular_velocity};
    NearBody body;
    body.own = entity;
    body.id = entity->id();
    body.number = number;
    body.centre = pose.position + pose.orientation * entity->touch()->model().point;
    body.velocity = pose.velocity;
    body.depth =
        deadreckon::contact(entity->touch()->model(), pose, probe.position, probe.radius).depth;
    if (body.depth >= -kContactReach) insert(body);
  }
  choose();
}

bool NearBodies::has_hand(double margin) const noexcept {
  return std::any_of(bodies().begin(), bodies().end(), [&](const NearBody& body) {
    return body.row != nullptr && body.depth > -margin && body.is_hand();
  });
}

void NearBodies::insert(const NearBody& body) noexcept {
  if (count_ == kRoom) choose();
  ranks_[count_] = rank_of(body);
  bodies_[count_++] = body;
}

NearBodies::Rank NearBodies::rank_of(const NearBody& body) const noexcept {
  const auto end = touched_.begin() + static_cast<std::ptrdiff_t>(touched_count_);
  Rank rank;
  rank.party = body.row != nullptr ? body.row->party : Party{kOwnHost, 0, false};
  rank.weak = !body.may_press || is_weak(body.model());
  rank.far = body.depth < -kSoonTouching;
  rank.fresh = std::find(touched_.begin(), end, body.id) == end;
  rank.shallow = in_order(-body.depth);
  return rank;
}

// The bodies in the order of `rank_key`, a number from their rank; of equal ones the deeper first.
std::span<const NearBodies::Key> NearBodies::sorted(const auto& rank_key) noexcept {
  for (std::size_t i = 0; i < count_; ++i)
    keys_[i] = {rank_key(ranks_[i]), ranks_[i].shallow, static_cast<std::uint8_t>(i)};
  const std::span<Key> keys(keys_.data(), count_);
  std::sort(keys.begin(), keys.end());
  return keys;
}

void NearBodies::choose() noexcept {
  if (count_ <= 1) return;
  // The number of bodies of its group before each; `same` defines a group.
  const auto number_each = [&](std::span<const Key> order, std::uint8_t Rank::*place, auto same) {
    ranks_[order[0].at].*place = 0;
    for (std::size_t i = 1; i < order.size(); ++i) {
      const Rank& before = ranks_[order[i - 1].at];
      Rank& rank = ranks_[order[i].at];
      const int next =
          before.party.host == rank.party.host && same(before, rank) ? before.*place + 1 : 0;
      rank.*place = static_cast<std::uint8_t>(next);
    }
  };
  const auto by_sender = sorted([](const Rank& r) {
    return packed(std::pair(r.party.host, 16), std::pair(r.party.sender, 16), std::pair(r.weak, 1),
                  std::pair(r.far, 1), std::pair(r.fresh, 1));
  });
  number_each(by_sender, &Rank::of_sender,
              [](const Rank& a, const Rank& b) { return a.party.sender == b.party.sender; });
  if (count_ > kMost) note_crowding(by_sender);
  const auto by_host = sorted([](const Rank& r) {
    return packed(std::pair(r.party.host, 16), std::pair(r.weak, 1),
                  std::pair(r.of_sender >= kSure, 1), std::pair(r.far, 1),
                  std::pair(r.party.guest, 1), std::pair(r.fresh, 1), std::pair(r.of_sender, 8));
  });
  number_each(by_host, &Rank::of_host, [](const Rank&, const Rank&) { return true; });
  take_in_order(sorted([](const Rank& r) {
    return packed(std::pair(r.weak, 1), std::pair(r.of_host >= kSure, 1), std::pair(r.far, 1),
                  std::pair(r.party.guest, 1), std::pair(r.fresh, 1), std::pair(r.of_host, 8));
  }));
}

void NearBodies::note_crowding(std::span<const Key> by_host) noexcept {
  const auto host = [&](std::size_t i) { return ranks_[by_host[i].at].party.host; };
  std::size_t most = 0;
  for (std::size_t begin = 0, end = 0; begin < by_host.size(); begin = end) {
    while (end < by_host.size() && host(end) == host(begin)) ++end;
    if (end - begin <= most) continue;
    most = end - begin;
    crowding_ = bodies_[by_host[begin].at].row;
  }
}

void NearBodies::take_in_order(std::span<const Key> order) noexcept {
  const std::size_t kept = std::min(order.size(), kMost);
  std::array<NearBody, kMost> chosen;
  std::array<Rank, kMost> ranks;
  for (std::size_t i = 0; i < kept; ++i) {
    chosen[i] = bodies_[order[i].at];
    ranks[i] = ranks_[order[i].at];
  }
  std::copy_n(chosen.begin(), kept, bodies_.begin());
  std::copy_n(ranks.begin(), kept, ranks_.begin());
  left_out_ += count_ - kept;
  count_ = kept;
}

std::size_t to_probes(std::span<const NearBody> bodies, double margin,
                      std::span<deadreckon::ProbeState, haptics::kMaxRemoteHands> out) noexcept {
  std::size_t count = 0;
  for (const NearBody& body : bodies) {
    if (!body.is_hand()) continue;
    const bool nearly = body.depth < 0 && body.depth > -margin;
    out[count++] = {body.centre, body.velocity, body.model().radius + (nearly ? margin : 0.0)};
  }
  return count;
}

}  // namespace reckon::peer
