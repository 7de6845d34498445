// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/pressing_publisher.hpp"

#include <algorithm>
#include <limits>

#include "reckon/peer/loops/contact_publisher.hpp"

namespace reckon::peer {

namespace {

using std::chrono::nanoseconds;

// A hand at a body states its place at least every 300 ms. After this time of silence it has
// failed.
constexpr nanoseconds kHandFails = std::chrono::milliseconds(500);

}  // namespace

void PressingPublisher::search(std::span<const haptics::BodyState> bodies,
                               const RemoteEntities& remote, nanoseconds now) noexcept {
  count_ = left_out_ = 0;
  remote.visit_felt([&](const RemoteEntity& row) {
    if (row.epoch == 0 || row.type.kind != pdu::EntityKind::life_form) return;
    const Eigen::Vector3d place = row.motion(now).position;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (bodies[i].carried) continue;
      const Eigen::Vector3d local =
          bodies[i].orientation.conjugate() * (place - bodies[i].position);
      least = std::min(least, world_->box(i).exteriorDistance(local));
    }
    if (!(least <= kReach)) return;
    const auto end = found_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto at = std::find_if(found_.begin(), end,
                                 [&](const Found& found) { return found.distance > least; });
    if (count_ < found_.size()) {
      ++count_;
    } else {
      ++left_out_;
    }
    if (at == found_.end()) return;
    std::copy_backward(at, found_.begin() + static_cast<std::ptrdiff_t>(count_) - 1,
                       found_.begin() + static_cast<std::ptrdiff_t>(count_));
    *at = {row.id, least};
  });
}

void PressingPublisher::publish(std::span<const haptics::BodyState> bodies,
                                const RemoteEntities& remote, nanoseconds now) noexcept {
  if (out_ == nullptr) return;
  if (now - searched_ >= kSearch) {
    searched_ = now;
    search(bodies, remote, now);
  }
  haptics::HandList& slot = out_->write_slot();
  slot.count = 0;
  for (const Found& found : std::span(found_).first(count_)) {
    const RemoteEntity* row = remote.find(found.id);
    if (row == nullptr || !row->haptic || now - row->last_heard > kHandFails) continue;
    slot.hands[slot.count] = predictors_of(*row);
    slot.hands[slot.count++].given_to_us = touch_.body_energy_of(row->id);
  }
  const auto is_same = [](const haptics::RemoteHand& a, const haptics::RemoteHand& b) {
    return a.id == b.id && a.version == b.version && a.valid_until == b.valid_until;
  };
  const auto now_end = slot.hands.begin() + static_cast<std::ptrdiff_t>(slot.count);
  const auto sent_end = sent_.hands.begin() + static_cast<std::ptrdiff_t>(sent_.count);
  if (std::equal(slot.hands.begin(), now_end, sent_.hands.begin(), sent_end, is_same)) return;
  sent_ = slot;
  out_->publish();
}

}  // namespace reckon::peer
