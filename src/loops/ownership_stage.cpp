// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/ownership_stage.hpp"

#include <algorithm>

#include "reckon/pdu/random/split_mix.hpp"
#include "reckon/pdu/reckon/assured_record.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

// Between two steps of the protocol while nothing arrives.
constexpr nanoseconds kStep = milliseconds(20);

std::size_t moving_in(const SceneFile& scene) {
  const auto moving = std::ranges::count_if(scene.scene.objects, [](const auto& object) {
    return object.carried || object.matter.mass > 0;
  });
  return std::min<std::size_t>(static_cast<std::size_t>(moving), kMostOwnable);
}

bool has_bodies(const SceneFile& scene) {
  return std::ranges::any_of(scene.scene.objects, [](const auto& object) {
    return !object.carried && object.matter.mass > 0;
  });
}

OwnershipConfig config_of(const ModelWiring& wiring, const ModelIdentity& identity) {
  OwnershipConfig config;
  config.epoch = identity.epoch;
  config.started = identity.started;
  config.objects = moving_in(wiring.scene);
  config.votes = identity.may_own;
  config.founds_at_once = identity.founds;
  return config;
}

}  // namespace

OwnershipStage::OwnershipStage(const ModelWiring& wiring, const ModelIdentity& identity,
                               const Parts& parts)
    : scene_(wiring.scene),
      link_(wiring.link),
      world_(wiring.bodies),
      epoch_(identity.epoch),
      parts_(parts),
      is_on_(wiring.bodies != nullptr && !wiring.scene.network.interop && has_bodies(wiring.scene)),
      requests_at_touch_(identity.requests_at_touch),
      protocol_(config_of(wiring, identity), *this),
      hand_overs_(wiring.bodies, protocol_, {parts.bodies, parts.owned, parts.remote},
                  identity.epoch),
      counted_(wiring.counters),
      watch_(parts.notices),
      approach_(wiring.bodies, parts.touch),
      meetings_(wiring.bodies),
      pressing_(wiring.bodies, wiring.pressing, parts.touch) {
  if (is_on_) parts_.assured.set_user(this);
}

std::span<const haptics::BodyState> OwnershipStage::states() const noexcept {
  const haptics::BodyStates* states = parts_.bodies.states();
  return states == nullptr ? std::span<const haptics::BodyState>() : states->bodies;
}

// In

bool OwnershipStage::take_record(const UserRecord& record) noexcept {
  const auto message = decode_message(record.kind, record.octets);
  if (!message) return false;
  protocol_.receive(record.epoch, *message, pass_.now);
  next_ = pass_.now;
  return true;
}

bool OwnershipStage::takes(const Inbound& update, const Arrival& arrival) noexcept {
  const pdu::PduType type = update.pdu.header.pdu_type;
  const bool is_ours =
      type == pdu::PduType::transfer_ownership || type == pdu::PduType::acknowledge;
  if (!is_on_ || !is_ours || update.record.empty() || arrival.epoch == 0) return false;
  const auto message = decode_message(pdu::AssuredKind::record, update.pdu.bytes);
  if (!message) return false;
  protocol_.receive(arrival.epoch, *message, arrival.now);
  next_ = arrival.now;
  return true;
}

// A state shows that a hand-over has ended, perhaps before the table of a voter does.
void OwnershipStage::note_state(const Inbound& update, const Arrival& arrival) noexcept {
  const bool is_body = is_on_ && update.ownership && aoim::BodyOwners::are_for(update.entity);
  if (!is_body || arrival.epoch == 0 || update.ownership->owner != arrival.epoch) return;
  const std::size_t body = update.entity.entity - 1u;
  if (update.entity.entity == 0 || body >= protocol_.table().size()) return;
  const Tenure stated{update.ownership->version, arrival.epoch};
  if (stated != protocol_.tenure(body)) note_claim(body, stated, *update.ownership, arrival);
  if (owner_of(body) == stated && update.has_state) parts_.bodies.note_place(body, update.state);
}

void OwnershipStage::note_claim(std::size_t body, const Tenure& stated,
                                const pdu::OwnershipRecord& record,
                                const Arrival& arrival) noexcept {
  const bool is_of_ours =
      !protocol_.acts().exists() || record.world == number_of(protocol_.world());
  const aoim::Presence& presence = parts_.aoim.presence();
  if (!is_of_ours || presence.standing(arrival.epoch, &arrival.from) != aoim::Standing::member)
    return;
  if (is_newer(stated, claims_[body]) ||
      presence.standing(claims_[body].owner) != aoim::Standing::member)
    claims_[body] = stated;
  if (protocol_.acts().exists()) {
    TableExtract extract;
    extract.world = protocol_.world();
    extract.holdings.add(body, stated);
    protocol_.receive(arrival.epoch, extract, arrival.now);
  }
  const Tenure& owner = owner_of(body);
  parts_.bodies.name_owner(body, {owner.owner, owner.version});
}

// Questions of the protocol

// Bodies of other owners stay with them.
ObjectSet OwnershipStage::company_of(std::size_t object) {
  return meetings_.company_of(object, states());
}

bool OwnershipStage::is_any_awake() {
  return std::ranges::any_of(
      states(), [](const haptics::BodyState& body) { return body.awake && body.is_owned(); });
}

std::uint64_t OwnershipStage::host_of(std::uint32_t epoch) {
  const auto source = epoch == epoch_ ? std::optional(source_of(link_.local_endpoint()))
                                      : parts_.aoim.presence().source_of(epoch);
  std::uint64_t host = 0;
  if (!source) return host;
  for (const std::uint8_t octet : source->octets) host = pdu::split_mix(host ^ octet);
  return host;
}

// Events

void OwnershipStage::take_events() noexcept {
  for (const OwnershipEvent& event : protocol_.events()) {
    for (std::size_t i = 0; i < event.objects.size(); ++i)
      if (event.objects[i] && event.kind == OwnershipEvent::Kind::gained) gained_at_[i] = pass_.now;
    watch_.note(event);
    hand_overs_.note(event);
  }
  protocol_.clear_events();
}

// Out

const Tenure& OwnershipStage::owner_of(std::size_t body) const noexcept {
  const Tenure& known = protocol_.tenure(body);
  return known.version > 0 ? known : claims_[body];
}

aoim::PeerId OwnershipStage::owner_id_of(std::size_t body) const noexcept {
  const aoim::Presence& presence = parts_.aoim.presence();
  const std::uint32_t owner = owner_of(body).owner;
  return owner == epoch_ ? presence.id() : presence.id_of(owner).value_or(aoim::PeerId{});
}

void OwnershipStage::name_owners() noexcept {
  for (std::size_t i = 0; i < protocol_.table().size(); ++i) {
    const Tenure& owner = owner_of(i);
    parts_.bodies.name_owner(i, {owner.owner, owner.version});
    note_owner(i, owner);
    if (i >= states().size()) continue;
    const bool is_ours = protocol_.owns(i, pass_.now) && states()[i].is_owned();
    pdu::OwnershipRecord record = hand_overs_.own_record(i);
    if (!is_ours) record.owner = 0;
    if (!parts_.bodies.set_own(i, record, parts_.owned)) continue;
    parts_.remote.forget(body_id(i));
    hand_overs_.begin_own(i);
  }
}

// The cause follows from the version, so that all peers show the same.
void OwnershipStage::note_owner(std::size_t body, const Tenure& owner) noexcept {
  BodyOwnerView& shown = shown_[body];
  if (shown.epoch == owner.owner && shown.version == owner.version) return;
  if (shown.epoch != 0 && owner.owner != 0 && shown.epoch != owner.owner) ++shown.changes;
  const OwnerChange cause = cause_of(owner.version);
  if (shown.epoch != owner.owner || cause == OwnerChange::founded) shown.cause = cause;
  shown.epoch = owner.owner;
  shown.version = owner.version;
}

void OwnershipStage::show(PeerView& view) const noexcept {
  view.bodies_rest = watch_.rests();
  view.body_owner_count = is_on_ ? protocol_.table().size() : 0;
  for (std::size_t i = 0; i < view.body_owner_count; ++i) {
    BodyOwnerView& row = view.body_owners[i] = shown_[i];
    row.is_ours = row.epoch == epoch_;
    row.owner = owner_id_of(i);
  }
}

TransferNames OwnershipStage::names_for(std::uint32_t to) const noexcept {
  const aoim::Presence& presence = parts_.aoim.presence();
  const aoim::PeerId receiver = presence.id_of(to).value_or(aoim::PeerId{0xFFFF, 0xFFFF});
  return {scene_.network.exercise, presence.id(), receiver, aoim::kSceneId};
}

// An assured message to all has every joined peer as an addressee, because all are witnesses.
void OwnershipStage::send(const OutgoingMessage& message) noexcept {
  std::array<std::byte, pdu::kMostAssured> octets;
  const EncodedMessage encoded =
      encode_message(message.message, names_for(message.to), half_++, octets);
  const std::span<const std::byte> content = std::span(octets).first(encoded.size);
  if (encoded.size == 0) return;
  if (!message.is_assured)
    return parts_.assured.send_once(encoded.kind, content, message.to, pass_);
  const std::uint8_t flags = encoded.is_pdu ? pdu::kAssuredPdu : std::uint8_t{0};
  const AssuredContent sent{encoded.kind, flags, content, 0};
  if (message.to != 0) {
    static_cast<void>(parts_.assured.send(sent, std::span(&message.to, 1), pass_));
  } else {
    static_cast<void>(parts_.assured.send_to_joined(sent, pass_));
  }
}

void OwnershipStage::send_messages() noexcept {
  for (const OutgoingMessage& message : protocol_.outgoing()) send(message);
  protocol_.clear_outgoing();
}

// For the program

void OwnershipStage::acquire(std::size_t body) noexcept {
  if (!is_on_ || body >= protocol_.table().size() || !may_take(body, epoch_)) return;
  kept_.set(body);
  protocol_.ask(body);
  next_ = pass_.now;
}

void OwnershipStage::divest(std::size_t body) {
  if (!is_on_ || body >= protocol_.table().size()) return;
  kept_.reset(body);
  reached_.reset(body);
  protocol_.withdraw(body);
  next_ = pass_.now;
}

aoim::PeerId OwnershipStage::asker_of(std::size_t body) const noexcept {
  return parts_.aoim.presence().id_of(protocol_.asker_of(body)).value_or(aoim::PeerId{});
}

bool OwnershipStage::order(std::span<const haptics::BodyOrder> orders) noexcept {
  return is_on_ && world_->exchange().send(orders) != 0;
}

void OwnershipStage::go_alone() noexcept {
  if (!is_on_) return;
  const auto utc = std::chrono::duration_cast<std::chrono::seconds>(pass_.utc).count();
  protocol_.go_alone(static_cast<std::uint32_t>(utc), pass_.now);
  next_ = pass_.now;
}

void OwnershipStage::step(const Pass& pass) noexcept {
  pass_ = pass;
  if (!is_on_) return;
  hand_overs_.take_answers(pass);
  ask_ahead();
  protocol_.step(pass.now);
  take_events();
  choose_copies();
  hand_overs_.send_orders(pass);
  name_owners();
  hand_overs_.doubt_left(pass.now);
  hand_overs_.doubt_silent(pass.now);
  pressing_.publish(states(), parts_.remote, pass.now);
  send_messages();
  watch_.look(protocol_, pass.now);
  counted_.publish(protocol_.counts());
  next_ = pass.now + kStep;
}

}  // namespace reckon::peer
