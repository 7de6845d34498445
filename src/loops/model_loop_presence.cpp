// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The half of the model loop that deals with other peers: who comes and goes, who is silent, and
// what of theirs is heard.
#include <algorithm>
#include <array>

#include "reckon/peer/loops/model_loop.hpp"
#include "reckon/peer/loops/notice_text.hpp"
#include "reckon/peer/world/addressed.hpp"
#include "reckon/peer/world/scene_position.hpp"

namespace reckon::peer {

void ModelLoop::take_presence_events() noexcept {
  for (const aoim::PresenceEvent& event : aoim_.take_events()) {
    using Kind = aoim::PresenceEventKind;
    if (const auto dropped = event.dropped()) {
      remote_.drop_peer(dropped->name, event.kind == Kind::timed_out ? Gone::silent : Gone::left);
      decoder_.forget_keys(dropped->epoch);
    }
    if (event.kind == Kind::newcomer || event.kind == Kind::renamed)
      remote_.claim(event.peer(), event.announced.epoch);
    if (event.kind == Kind::identity_changed) owned_.rename(event.peer());
    if (event.kind == Kind::heard_again) heard_again_ = pass_.now;
    // One that calls the roll is no peer yet.
    if (event.announced.scene_peer == pdu::kScenePeerWanted) continue;
    notice_gate_.tell(event, pass_.now, notices_);
  }
}

// What leaders tell of cells that we have come late to, as if we had heard its owners then.
void ModelLoop::take_relayed() noexcept {
  aoim::Leading* leading = aoim_.leading();
  if (leading == nullptr || !leading->has_relayed()) return;
  for (const aoim::RelayedState& told : leading->take_relayed(pass_.now)) {
    const auto from = aoim_.presence().source_of(told.epoch);
    Inbound update;
    update.has_state = true;
    if (!from || pdu::decode(told.octets, update.state) != pdu::DecodeError::none) continue;
    update.entity = update.state.entity_id;
    update.has_model = told.model.has_value();
    if (told.model) update.model = *told.model;
    const Arrival arrival{pass_.now,
                          pass_.utc,
                          std::min(told.heard, pass_.now),
                          told.epoch,
                          time_.evidence(told.epoch),
                          *from};
    leader_watch_.note_told();
    take_update(update, arrival);
  }
}

void ModelLoop::doubt_the_silent() noexcept {
  std::array<Touched, kMaxDevices * haptics::kMaxRemoteHands> touched;
  auto end = touched.begin();
  for (const Touch& touch : touches_)
    end = std::copy_n(touch.touched.begin(), touch.touched_count, end);
  const bool again =
      silence_watch_.look(aoim_.presence(), {touched.begin(), end}, remote_, pass_.now, notices_);
  if (again) heard_again_ = pass_.now;
}

// Who was cut off from us feels nothing of ours until it hears where that is. However many come
// back, nothing is said more often than hands in contact say it.
void ModelLoop::tell_what_is_felt() noexcept {
  if (pass_.now - heard_again_ > HandPort::kContactPeriod) return;
  for (const EntityNumber number : owned_.touchable()) {
    OwnedEntity& entity = *owned_.find(number);
    const bool is_told = entity.last_sent >= heard_again_;
    if (is_told || pass_.now - entity.last_sent < HandPort::kContactPeriod) continue;
    entity.event();
    owned_.look_at(number);
  }
}

void ModelLoop::tell_muted() noexcept {
  if (muted_ == nullptr) return;
  for (; const MutedSender* sender = muted_->front(); muted_->pop())
    notice_gate_.tell(*sender, pass_.now, notices_);
}

// A peer gives orders in its own name alone, and nobody else does in the name of a peer.
bool ModelLoop::obeys(const Inbound& update, const Arrival& arrival) noexcept {
  if (!is_addressed(update.entity, owned_.simulation().simulation())) return true;
  const aoim::PeerId originator = update.originator.simulation();
  const auto epoch = aoim_.presence().epoch_of(originator);
  const bool unnamed = originator == aoim::PeerId() && arrival.epoch != 0;  // known by its epoch
  const bool member = unnamed || (epoch && *epoch == arrival.epoch);
  const bool genuine = member || (!epoch && arrival.epoch == 0 && !aoim_.is_own(update.originator));
  if (genuine && scene_.network.management.allows(originator, member)) return true;
  counted_.orders_refused.add();
  refusal_watch_.note_order(update.originator,
                            update.kind == Inbound::Kind::stop_freeze ? "freeze" : "resume",
                            arrival.from, pass_.now);
  return false;
}

void ModelLoop::cover_our_entities() noexcept {
  balls_.clear();
  owned_.for_each([&](const OwnedEntity& entity, EntityNumber) {
    const EntityTruth& truth = entity.truth();
    balls_.push_back({to_position(truth.position), truth.velocity.norm(), scene_.aoim.radius});
  });
  // Who owns nothing looks at the scene's origin.
  if (balls_.empty()) balls_.push_back({{}, 0.0, scene_.aoim.radius});
  foci_ = cover_.cover(balls_);
  moved_ = false;
}

// Who follows one of our beacons is to find its cell.
void ModelLoop::place_beacons() noexcept {
  beacons_.clear();
  beacon_watch_.for_each_carried([this](EntityNumber number, std::uint32_t tag) {
    const OwnedEntity* entity = owned_.find(number);
    if (entity != nullptr) beacons_.push_back({tag, to_position(entity->truth().position)});
  });
  if (aoim::Leading* leading = aoim_.leading()) leading->set_beacons(beacons_, pass_.now);
}

void ModelLoop::subscribe() noexcept {
  if (moved_ && scene_.aoim.hand_out) place_beacons();
  if (moved_) cover_our_entities();
  const aoim::TierTable& tiers = aoim_.tiers();
  const aoim::SubscriptionChange change = aoim_.listen(aoim::kCellTier, foci_, pass_.now);
  command(change);
  for (std::size_t row = 0; row < tiers.near_rows(); ++row) {
    const aoim::SubscriptionChange near = aoim_.listen(tiers.of_row(row), foci_, pass_.now);
    command(near);
    remote_.leave_groups(near.leave, pass_.now);
  }
  if (tiers.has_felt()) listen_near();
  aoim_watch_.look(aoim_, change, pass_.now, notices_);
  leader_watch_.look(aoim_, pass_.now, notices_);
  beacon_watch_.look(aoim_, pass_.now, notices_, leader_watch_.view());
}

// The contact groups of where we can touch and be touched. What is large, and near though its place
// is not, is found by the search for what our hands could touch.
void ModelLoop::listen_near() noexcept {
  contact_foci_.clear();
  for (const EntityNumber number : owned_.touchable()) contact_foci_.add(*owned_.find(number));
  for (const NearBodies& near : std::span(near_.data(), hands_.size())) {
    for (const NearBody& body : near.bodies()) {
      if (body.row != nullptr) contact_foci_.add_near(body.row->predicted(pass_.now).position);
    }
  }
  command(aoim_.listen(aoim_.tiers().felt(), contact_foci_.foci(), pass_.now));
}

void ModelLoop::command(const aoim::SubscriptionChange& change) noexcept {
  const auto each = [&](std::span<const aoim::GroupIndex> groups, bool join) {
    for (const aoim::GroupIndex group : groups) {
      if (group == aoim::kBaseGroup) continue;
      static_cast<void>(commands_.push({pool_.address(group.value - 1u), join}));
    }
  };
  each(change.join, true);
  each(change.leave, false);
}

}  // namespace reckon::peer
