// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The half of the model loop that says no: orders that the scene does not allow, and what the user
// is told of those who speak for others.
#include "reckon/peer/loops/address_text.hpp"
#include "reckon/peer/loops/model_loop.hpp"
#include "reckon/peer/loops/notice_text.hpp"
#include "reckon/peer/world/addressed.hpp"

namespace reckon::peer {

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
  if (strange_orders_.turn(true, pass_.now) == Matter::Turn::begins) {
    tell_refused(
        make_notice("{}:{}:{} at {} orders to {}: refused, see allow_management in the scene",
                    originator.site, originator.application, update.originator.entity,
                    AddressText(arrival.from).view(),
                    update.kind == Inbound::Kind::stop_freeze ? "freeze" : "resume"),
        arrival.from);
  }
  return false;
}

void ModelLoop::tell_dispute(const Dispute& dispute) noexcept {
  const AddressText owner(dispute.owner), speaker(dispute.speaker);
  const auto [site, application] = dispute.name;
  const bool ours = dispute.name == owned_.simulation().simulation();
  tell_refused(ours ? make_notice("somebody at {} speaks in our name, {}:{} (refused)",
                                  speaker.view(), site, application)
                    : make_notice("{}:{} at {}: somebody at {} speaks in its name (refused)", site,
                                  application, owner.view(), speaker.view()),
               dispute.speaker);
}

void ModelLoop::tell_refused(const Notice& notice, const aoim::SourceAddress& cause) noexcept {
  notice_gate_.tell_refused(notice, cause, pass_.now, notices_);
}

void ModelLoop::tell_hostile() noexcept {
  static_cast<void>(strange_orders_.turn(false, pass_.now));
  if (const auto dispute = remote_.take_dispute(pass_.now)) tell_dispute(*dispute);
  tell_untouchable();
  const std::uint64_t evicted = remote_.evicted();
  const auto turn = crowding_.turn(evicted > evicted_before_, pass_.now);
  evicted_before_ = evicted;
  if (turn == Matter::Turn::begins) {
    const aoim::SourceAddress& by = remote_.last_evicted();
    tell_refused(
        make_notice("somebody at {} fills the table of entities: his rows make room for others'",
                    AddressText(by).view()),
        by);
  }
  const std::uint64_t strangers = remote_.strangers_refused();
  const auto full = strangers_full_.turn(strangers > strangers_before_, pass_.now);
  strangers_before_ = strangers;
  if (full == Matter::Turn::begins) {
    const aoim::SourceAddress& by = remote_.last_stranger();
    tell_refused(
        make_notice("somebody at {} fills what [network] strangers_memory gives plain DIS programs: "
                    "his further entities are not shown",
                    AddressText(by).view()),
        by);
  }
}

void ModelLoop::tell_untouchable() noexcept {
  const std::uint64_t refused = remote_.untouchable();
  const auto turn = untouchable_.turn(refused > untouchable_before_, pass_.now);
  untouchable_before_ = refused;
  if (turn != Matter::Turn::begins) return;
  const Untouchable& last = remote_.last_untouchable();
  tell_refused(make_notice("{}:{}:{} at {} is not felt: see touch in the scene", last.id.site,
                           last.id.application, last.id.entity, AddressText(last.from).view()),
               last.from);
}

}  // namespace reckon::peer
