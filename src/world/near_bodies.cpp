// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/near_bodies.hpp"

#include <algorithm>
#include <tuple>

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

// Ours are not a host's: no row owner has this number.
constexpr std::uint16_t kOwnHost = 0xFFFF;

// Whether a hand would feel it, a decimetre deep or at 1 m/s.
bool is_weak(const deadreckon::ForceModel& model) noexcept {
  return model.kind == pdu::ForceModelKind::none ||
         deadreckon::normal_force(model.k1, model.k3, 0.1) + model.damping <
             NearBodies::kLeastForce;
}

// Gives each of the sorted ranks its place in its group: those for which `same` holds.
template <typename Rank, typename Same>
void number_each(std::span<Rank> ranks, std::uint8_t Rank::* place, Same&& same) noexcept {
  std::uint8_t next = 0;
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    next = i > 0 && same(ranks[i - 1], ranks[i]) ? static_cast<std::uint8_t>(next + 1) : 0;
    ranks[i].*place = next;
  }
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
                     const Eigen::Vector3d& velocity) noexcept {
  NearBody body;
  body.row = &row;
  body.id = row.id;
  body.centre = touch.point;
  body.velocity = velocity;
  body.depth = touch.depth;
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
  bodies_[count_++] = body;
}

NearBodies::Rank NearBodies::rank_of(std::size_t at) const noexcept {
  const NearBody& body = bodies_[at];
  const auto end = touched_.begin() + static_cast<std::ptrdiff_t>(touched_count_);
  Rank rank;
  rank.party = body.row != nullptr ? body.row->party : Party{kOwnHost, 0, false};
  rank.weak = is_weak(body.model());
  rank.far = body.depth < -kSoonTouching;
  rank.fresh = std::find(touched_.begin(), end, body.id) == end;
  rank.depth = body.depth;
  rank.at = static_cast<std::uint8_t>(at);
  return rank;
}

void NearBodies::choose() noexcept {
  if (count_ <= 1) return;
  std::array<Rank, kRoom> room;
  for (std::size_t i = 0; i < count_; ++i) room[i] = rank_of(i);
  const std::span<Rank> ranks(room.data(), count_);
  const auto sort_by = [&](auto key) {
    std::sort(ranks.begin(), ranks.end(),
              [&](const Rank& a, const Rank& b) { return key(a) < key(b); });
  };
  sort_by([](const Rank& r) {
    return std::tuple(r.party.host, r.party.sender, r.weak, r.far, r.fresh, -r.depth, r.at);
  });
  number_each(ranks, &Rank::of_sender, [](const Rank& a, const Rank& b) {
    return a.party.host == b.party.host && a.party.sender == b.party.sender;
  });
  if (count_ > kMost) note_crowding(ranks);
  sort_by([](const Rank& r) {
    return std::tuple(r.party.host, r.weak, r.of_sender >= kSure, r.far, r.party.guest, r.fresh,
                      r.of_sender, -r.depth, r.at);
  });
  number_each(ranks, &Rank::of_host,
              [](const Rank& a, const Rank& b) { return a.party.host == b.party.host; });
  sort_by([](const Rank& r) {
    return std::tuple(r.weak, r.of_host >= kSure, r.far, r.party.guest, r.fresh, r.of_host,
                      -r.depth, r.at);
  });
  take_in_order(ranks);
}

// `ranks` in the order of their hosts.
void NearBodies::note_crowding(std::span<const Rank> ranks) noexcept {
  std::size_t most = 0;
  for (std::size_t begin = 0, end = 0; begin < ranks.size(); begin = end) {
    while (end < ranks.size() && ranks[end].party.host == ranks[begin].party.host) ++end;
    if (end - begin <= most) continue;
    most = end - begin;
    crowding_ = bodies_[ranks[begin].at].row;
  }
}

void NearBodies::take_in_order(std::span<const Rank> ranks) noexcept {
  const std::size_t kept = std::min(ranks.size(), kMost);
  std::array<NearBody, kMost> chosen;
  for (std::size_t i = 0; i < kept; ++i) chosen[i] = bodies_[ranks[i].at];
  std::copy_n(chosen.begin(), kept, bodies_.begin());
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
