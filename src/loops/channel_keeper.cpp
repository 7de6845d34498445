// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/channel_keeper.hpp"

#include "reckon/peer/loops/notice_text.hpp"
#include "reckon/peer/world/scene_position.hpp"

namespace reckon::peer {

void ChannelKeeper::look(const RemoteEntities& remote, aoim::AreaOfInterestManager& aoim,
                         Nanoseconds now, haptics::SpscRing<Notice>& out) noexcept {
  if (aoim.receivers() == nullptr) return;
  if (now >= next_places_) {
    next_places_ = now + kPlaces;
    note_places(remote, aoim, now);
  }
  if (config_.budget > 0.0 && now >= next_budget_) {
    next_budget_ = now + kBudget;
    keep_to_budget(remote, aoim, now, out);
  }
}

void ChannelKeeper::note_places(const RemoteEntities& remote, aoim::AreaOfInterestManager& aoim,
                                Nanoseconds now) const {
  aoim::ReceiverChannels& receivers = *aoim.receivers();
  receivers.clear();
  remote.for_each_place(
      now, [&](std::uint32_t epoch, const Eigen::Vector3d& position, double speed) {
        receivers.add(to_position(position), aoim.presence().stretch_of(epoch), speed);
      });
}

// Others send as much as their nearest receiver asks for. If that is not us, we may get more than
// we ask for.
void ChannelKeeper::keep_to_budget(const RemoteEntities& remote, aoim::AreaOfInterestManager& aoim,
                                   Nanoseconds now, haptics::SpscRing<Notice>& out) {
  clients_.clear();
  for (const RemoteEntity& row : remote.rows()) {
    const deadreckon::Pose pose = row.predicted(now);
    clients_.push_back({aoim.sight().interest().distance_to_focus(to_position(pose.position)),
                        !pose.velocity.isZero(0)});
  }
  const aoim::ChannelBudget budget = aoim.receivers()->fit(clients_, config_.budget);
  aoim.set_stretch(budget.stretch);
  const NoticeCondition::Turn turn = stretched_.turn(budget.stretch > 1.0, now);
  if (turn == NoticeCondition::Turn::begins) {
    static_cast<void>(out.push(make_notice(
        "entities in range would send more than {:.4g} B/s: distances count {:.3g} times as long "
        "([aoim] budget)",
        config_.budget, budget.stretch)));
  } else if (turn == NoticeCondition::Turn::ends) {
    static_cast<void>(out.push(make_notice("all entities in range fit the budget again")));
  }
}

}  // namespace reckon::peer
