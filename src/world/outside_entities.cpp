// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/outside_entities.hpp"

#include <algorithm>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {

OutsideEntity::OutsideEntity(const Inbound& update, const Arrival& arrival,
                             const deadreckon::KinematicState& state, double timeout) noexcept
    : pdu_(update.state),
      parts_size_(std::min(parts_.size(), update.state.variable_parameters.size())),
      model_(update.model),
      has_model_(update.has_model),
      arrival_(arrival),
      last_heard_(arrival.arrival),
      state_(state),
      timeout_(timeout) {
  std::copy_n(update.state.variable_parameters.begin(), parts_size_, parts_.begin());
  pdu_.variable_parameters = {};
}

Inbound OutsideEntity::update() const noexcept {
  Inbound update;
  update.entity = pdu_.entity_id;
  update.has_state = true;
  update.state = pdu_;
  update.state.variable_parameters = std::span(parts_).first(parts_size_);
  update.has_model = has_model_;
  update.model = model_;
  return update;
}

Eigen::Vector3d OutsideEntity::position(std::chrono::nanoseconds now) const noexcept {
  const bool frozen = (pdu_.appearance & pdu::kAppearanceFrozen) != 0;
  const double since = frozen ? 0.0 : pdu::to_seconds(now - arrival_.arrival);
  return deadreckon::extrapolate(state_, since).position;
}

bool OutsideEntity::is_silent(std::chrono::nanoseconds now) const noexcept {
  return pdu::to_seconds(now - last_heard_) > timeout_;
}

void OutsideEntity::set_model(const pdu::HapticRecord& model) noexcept {
  model_ = model;
  has_model_ = true;
}

void OutsideEntity::take_model_of(const OutsideEntity& former) noexcept {
  if (!has_model_ && former.has_model_ && former.arrival_.epoch == arrival_.epoch) {
    set_model(former.model_);
  }
}

void OutsideEntities::keep(const OutsideEntity& entity, bool guest_room) noexcept {
  const std::uint64_t key = entity.id().key();
  const std::uint32_t place = places_.find(key);
  const Arrival& arrival = entity.arrival();
  const bool guest = arrival.epoch == 0;
  if (place != KeyIndex::kNone) {
    OutsideEntity kept = entity;
    kept.take_model_of(rows_[place]);
    const bool was_guest = rows_[place].arrival().epoch == 0;
    const bool stays = guest == was_guest && (owners_.owner(place) == arrival.from ||
                                              owners_.hand_over(place, arrival.from, arrival.now));
    if (!stays) {
      erase(place);
      return keep(kept, guest_room || was_guest);
    }
    rows_[place] = kept;
    return look_at_.set(place, Nanoseconds(0));
  }
  if (guest && !guest_room) {
    const auto gone = owners_.guest_to_give_up(arrival.from);
    if (!gone) return;
    erase(*gone);
  }
  if (rows_.size() == rows_.capacity() || !owners_.push(arrival.from, guest, arrival.now)) return;
  places_.put(key, rows_.size());
  rows_.push(entity);
  look_at_.push(Nanoseconds(0));
}

bool OutsideEntities::give_up_guest() noexcept {
  const auto place = owners_.guest_to_give_up({});
  if (place) erase(*place);
  return place.has_value();
}

const aoim::SourceAddress* OutsideEntities::guest_of(const pdu::EntityId& id,
                                                     Nanoseconds now) const noexcept {
  const std::uint32_t place = places_.find(id.key());
  if (place == KeyIndex::kNone || rows_[place].arrival().epoch != 0) return nullptr;
  const Nanoseconds patience = RowOwners::patience_with_guest(rows_[place].timeout());
  return now - owners_.last_heard(place) > patience ? nullptr : &owners_.owner(place);
}

void OutsideEntities::set_model(const pdu::EntityId& id, std::uint32_t epoch,
                                const pdu::HapticRecord& model) noexcept {
  const std::uint32_t place = places_.find(id.key());
  if (place == KeyIndex::kNone || rows_[place].arrival().epoch != epoch) return;
  rows_[place].set_model(model);
}

void OutsideEntities::forget(const pdu::EntityId& id) noexcept {
  const std::uint32_t place = places_.find(id.key());
  if (place != KeyIndex::kNone) erase(place);
}

OutsideEntities::Nanoseconds OutsideEntities::patience(double away, double speed) noexcept {
  const double least = pdu::to_seconds(kSoonest), most = pdu::to_seconds(kLatest);
  return pdu::from_seconds(std::clamp(away / (speed + kSpareSpeed), least, most));
}

void OutsideEntities::erase(std::size_t place) noexcept {
  places_.erase(rows_[place].id().key());
  if (place + 1 < rows_.size()) places_.put(rows_.all().back().id().key(), place);
  rows_.erase(place);
  look_at_.erase(place);
  owners_.erase(place);
}

}  // namespace reckon::peer
