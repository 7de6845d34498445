// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/assured_stage.hpp"

#include <string_view>

#include "reckon/pdu/codec/byte_order.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/loops/notice_text.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kMostPeers = aoim::PresenceConfig{}.capacity;
constexpr nanoseconds kNoticeGap = std::chrono::seconds(1);

bool is_of_users(pdu::AssuredKind kind) noexcept {
  return kind == pdu::AssuredKind::record || kind >= pdu::AssuredKind::ownership_round;
}

bool holds_pdu(const pdu::AssuredRecord& record) noexcept {
  return record.kind == pdu::AssuredKind::record && (record.flags & pdu::kAssuredPdu) != 0;
}

UndeliveredCause cause_of(AssuredOutcome outcome) noexcept {
  if (outcome == AssuredOutcome::left) return UndeliveredCause::left;
  return outcome == AssuredOutcome::refused ? UndeliveredCause::refused : UndeliveredCause::gave_up;
}

std::string_view words_of(UndeliveredCause cause) noexcept {
  switch (cause) {
    case UndeliveredCause::left:
      return "it left";
    case UndeliveredCause::refused:
      return "it refused the message";
    case UndeliveredCause::in_flight:
      return "too many are in flight";
    case UndeliveredCause::gave_up:
      break;
  }
  return "no acknowledgement for 5 s";
}

}  // namespace

AssuredStage::AssuredStage(const ModelWiring& wiring, std::uint32_t epoch,
                           aoim::AreaOfInterestManager& aoim, const TimeKeeper& time,
                           const HookList& hooks, DatagramOutlet& outlet,
                           haptics::SpscRing<Notice>& notices)
    : epoch_(epoch),
      exercise_(wiring.scene.network.exercise),
      aoim_(aoim),
      time_(time),
      hooks_(hooks),
      outlet_(outlet),
      notices_(notices),
      counted_(wiring.counters),
      sent_(kMostPeers),
      received_(kMostPeers),
      held_arrivals_(HeldRecords::kMost) {
  joined_.reserve(kMostPeers);
  addressees_.reserve(sizeof(std::uint32_t) * kMostPeers);
}

// Out

void AssuredStage::find_joined() noexcept {
  joined_.clear();
  for (const aoim::Peer& peer : aoim_.presence().peers()) {
    if (peer.joined && joined_.size() < joined_.capacity()) joined_.push_back(peer.announced.epoch);
  }
}

std::optional<std::uint32_t> AssuredStage::send_to_joined(const AssuredContent& content,
                                                          const Pass& pass) noexcept {
  find_joined();
  return joined_.empty() ? std::nullopt : sent_.add(content, joined_, pass.now);
}

void AssuredStage::send(std::span<const std::byte> pdu, std::uint64_t tag, std::uint8_t flags,
                        const Pass& pass) noexcept {
  find_joined();
  if (joined_.empty()) {
    static_cast<void>(aoim_.send(aoim::kEverybody, aoim::PduPayload{pdu}, {}, pass.now));
    return;
  }
  const auto record_flags = static_cast<std::uint8_t>(pdu::kAssuredPdu | flags);
  const AssuredContent content{pdu::AssuredKind::record, record_flags, pdu, tag};
  if (sent_.add(content, joined_, pass.now)) return;
  for (const std::uint32_t epoch : joined_)
    note_undelivered({tag, epoch, aoim_.presence().id_of(epoch).value_or(aoim::PeerId{}),
                      UndeliveredCause::in_flight});
}

void AssuredStage::step(const Pass& pass) noexcept {
  pass_ = pass;
  if (sent_.in_flight() > 0) {
    sent_.give_up(pass.now, *this);
    for (DueRecord due; sent_.take_due(pass.now, due);) transmit(due);
  }
  if (!held_.empty()) held_.expire(pass.now);
  for (DueReceipt due; received_.owes() && received_.take_receipt(due);) acknowledge(due);
}

pdu::AssuredRecord AssuredStage::record_of(pdu::AssuredKind kind,
                                           std::uint32_t sequence) const noexcept {
  pdu::AssuredRecord record;
  record.header.exercise_id = exercise_;
  record.header.timestamp = time_.stamp(pass_.utc);
  record.simulation = aoim_.presence().id();
  record.kind = kind;
  record.epoch = epoch_;
  record.sequence = sequence;
  return record;
}

std::span<const std::byte> AssuredStage::store_addressees(
    std::span<const std::uint32_t> epochs) noexcept {
  addressees_.resize(sizeof(std::uint32_t) * epochs.size());
  for (std::size_t i = 0; i < epochs.size(); ++i)
    pdu::store_big_endian(addressees_.data() + sizeof(std::uint32_t) * i, epochs[i]);
  return addressees_;
}

void AssuredStage::transmit(const DueRecord& due) noexcept {
  (due.is_first ? counted_.sent : counted_.repeated).add();
  pdu::AssuredRecord record = record_of(due.content.kind, due.sequence);
  record.flags = due.content.flags;
  record.predecessor_distance = due.predecessor_distance;
  record.addressees = store_addressees(due.missing);
  if (due.is_first && holds_pdu(record)) return transmit_marked(due, record);
  record.content = pdu::OctetBlock<std::uint16_t>::of(due.content.octets);
  send_to_all(record);
  if (!due.is_for_hosts) return;
  for (const std::uint32_t epoch : due.missing) send_to_host(epoch, record);
}

// The PDU itself, with a mark in its datagram.
void AssuredStage::transmit_marked(const DueRecord& due,
                                   const pdu::AssuredRecord& record) noexcept {
  const std::span<const std::byte> octets = due.content.octets;
  const pdu::AssuredMark mark{pdu::assured_digest(octets),
                              static_cast<std::uint16_t>(octets.size()), 0};
  std::array<std::byte, pdu::kFixedSize<pdu::AssuredMark>> content;
  static_cast<void>(pdu::store_record(mark, content));
  pdu::AssuredRecord marking = record;
  marking.kind = pdu::AssuredKind::mark;
  marking.flags &= pdu::kAssuredOrdered;
  marking.content = pdu::OctetBlock<std::uint16_t>::of(content);
  const std::size_t room = aoim_.aggregator().room(aoim::kBaseGroup);
  if (pdu::wire_size(marking) + octets.size() > room) marking.addressees = {};
  const std::size_t size = pdu::encode(marking, octets_);
  const aoim::PduPayload payload{octets, std::span(octets_).first(size)};
  static_cast<void>(aoim_.send(aoim::kEverybody, payload, {}, pass_.now));
}

void AssuredStage::acknowledge(const DueReceipt& due) noexcept {
  pdu::AssuredRecord record = record_of(pdu::AssuredKind::acknowledgement, due.highest);
  std::array<std::byte, pdu::kFixedSize<pdu::AssuredReceipt>> content;
  static_cast<void>(pdu::store_record(due.receipt, content));
  record.content = pdu::OctetBlock<std::uint16_t>::of(content);
  record.addressees = store_addressees(std::span(&due.epoch, 1));
  send_to_all(record);
  if (due.is_for_host) send_to_host(due.epoch, record);
}

void AssuredStage::send_once(pdu::AssuredKind kind, std::span<const std::byte> octets,
                             std::uint32_t to, const Pass& pass) noexcept {
  pass_ = pass;
  pdu::AssuredRecord record = record_of(kind, 0);
  record.flags = pdu::kAssuredOnce;
  if (to != 0) record.addressees = store_addressees(std::span(&to, 1));
  record.content = pdu::OctetBlock<std::uint16_t>::of(octets);
  send_to_all(record);
}

// To all addressees, or to all peers if the addressees leave too little room.
void AssuredStage::send_to_all(const pdu::AssuredRecord& record) noexcept {
  pdu::AssuredRecord sent = record;
  if (pdu::wire_size(sent) > aoim_.aggregator().room(aoim::kBaseGroup)) sent.addressees = {};
  const std::size_t size = pdu::encode(sent, octets_);
  const aoim::PduPayload payload{std::span(octets_).first(size)};
  static_cast<void>(aoim_.send(aoim::kEverybody, payload, {}, pass_.now));
}

void AssuredStage::send_to_host(std::uint32_t epoch, pdu::AssuredRecord record) noexcept {
  const auto source = aoim_.presence().source_of(epoch);
  if (!source || source->port == 0 || !outlet_.reaches_hosts()) return;
  std::array<std::byte, sizeof(epoch)> addressee;
  pdu::store_big_endian(addressee.data(), epoch);
  record.addressees = addressee;
  const std::span<const std::byte> octets = std::span(octets_).first(pdu::encode(record, octets_));
  if (!hooks_.leaving.pass({aoim::kBaseGroup, octets})) return;
  hooks_.sent(octets);
  outlet_.push(endpoint_of(*source), octets);
}

AssuredUser* AssuredStage::user_of(pdu::AssuredKind kind) const noexcept {
  const bool is_shared =
      kind >= pdu::AssuredKind::shared_record && kind <= pdu::AssuredKind::record_request;
  return is_shared ? records_ : user_;
}

void AssuredStage::settle(const AssuredReport& report) noexcept {
  const bool is_users = report.kind != pdu::AssuredKind::record || report.tag == 0;
  if (report.outcome != AssuredOutcome::accepted) counted_.undelivered.add();
  if (is_users) {
    if (AssuredUser* user = user_of(report.kind)) user->settle(report);
    return;
  }
  if (report.outcome == AssuredOutcome::accepted) return;
  const auto known = aoim_.presence().id_of(report.peer);
  const aoim::PeerId name =
      report.peer == gone_.epoch ? gone_.name : known.value_or(aoim::PeerId{});
  note_undelivered({report.tag, report.peer, name, cause_of(report.outcome)});
}

// At most one notice in kNoticeGap.
void AssuredStage::note_undelivered(const Undelivered& undelivered) noexcept {
  if (undelivered.cause == UndeliveredCause::in_flight) counted_.undelivered.add();
  if (watch_ != nullptr) watch_->note_undelivered(undelivered);
  if (pass_.now - noticed_ < kNoticeGap) return;
  noticed_ = pass_.now;
  static_cast<void>(notices_.push(make_notice(
      NoticeKind::undelivered, "an assured message did not reach peer {}:{}: {}; {} in all",
      undelivered.peer.site, undelivered.peer.application, words_of(undelivered.cause),
      counted_.undelivered.value())));
}

// In

bool AssuredStage::is_from_member(const pdu::AssuredRecord& record,
                                  const Arrival& arrival) const noexcept {
  return record.epoch != 0 && record.epoch == arrival.epoch &&
         aoim_.presence().standing(record.epoch, &arrival.from) == aoim::Standing::member;
}

bool AssuredStage::names_us(const pdu::AssuredRecord& record) const noexcept {
  for (const pdu::PeerEpoch& addressee : pdu::records_of<pdu::PeerEpoch>(record.addressees)) {
    if (addressee.epoch == epoch_) return true;
  }
  return false;
}

bool AssuredStage::admits_record(const Inbound& update, const Arrival& arrival) noexcept {
  pdu::AssuredRecord record;
  const bool is_good = pdu::decode(update.record, record) == pdu::DecodeError::none &&
                       is_from_member(record, arrival);
  if (!is_good) return counted_.refused.add(), false;
  active_until_ = arrival.now + kActive;
  if (record.kind == pdu::AssuredKind::acknowledgement) return take_receipt(record), false;

  const bool is_pdu = update.kind != Inbound::Kind::assured;
  const bool is_unusable = !is_pdu && holds_pdu(record);
  const bool is_users = !is_pdu && !is_unusable;
  if (is_users && !is_of_users(record.kind)) return counted_.unknown.add(), false;
  const bool is_for_us = record.addressees.empty() || names_us(record);
  if (is_users && (record.flags & pdu::kAssuredOnce) != 0) {
    AssuredUser* user = user_of(record.kind);
    if (is_for_us && user != nullptr)
      static_cast<void>(user->take_record({record.epoch, record.kind, record.content.bytes}));
    return false;
  }
  AssuredUser* user = user_of(record.kind);
  if (is_users && user == nullptr) {
    received_.follow(record.epoch, record.sequence, arrival.now);
    return counted_.unknown.add(), false;
  }

  // A marked PDU is for everybody.
  if (!is_for_us && record.kind != pdu::AssuredKind::mark)
    return received_.follow(record.epoch, record.sequence, arrival.now), false;
  if (is_pdu && (is_for_us ? hold_if_early(record, update, arrival) : is_late(record)))
    return false;
  const AssuredNovelty novelty = received_.take(record.epoch, record.sequence, arrival.now);
  if (novelty == AssuredNovelty::refused) return counted_.refused.add(), false;
  if (is_for_us) received_.owe(record.epoch, arrival.is_unicast);
  if (novelty == AssuredNovelty::duplicate) return counted_.doubled.add(), false;
  counted_.taken.add();
  admitted_ = {record.epoch, record.sequence};
  if (is_pdu) return true;
  conclude(update,
           is_users && user->take_record({record.epoch, record.kind, record.content.bytes}));
  return false;
}

// An ordered PDU for others, which nobody repeats to us.
bool AssuredStage::is_late(const pdu::AssuredRecord& record) const noexcept {
  return (record.flags & pdu::kAssuredOrdered) != 0 &&
         received_.has_later(record.epoch, record.sequence);
}

// Holds an ordered PDU while its predecessor is missing. The sender repeats it. A repeat names no
// predecessor that every addressee has, or that the sender has given up.
bool AssuredStage::hold_if_early(const pdu::AssuredRecord& record, const Inbound& update,
                                 const Arrival& arrival) noexcept {
  const std::uint32_t predecessor = record.sequence - record.predecessor_distance;
  if (record.predecessor_distance == 0 || received_.needs_no_wait(record.epoch, predecessor)) {
    if (!held_.empty()) held_.drop(record.epoch, record.sequence);
    return false;
  }
  const std::size_t place =
      held_.hold({record.epoch, record.sequence, predecessor, update.pdu.bytes}, arrival.now);
  if (place == HeldRecords::kMost) return true;
  counted_.held.add();
  held_arrivals_[place] = arrival;
  return true;
}

bool AssuredStage::take_held(const Pass& pass, HeldPdu& held) noexcept {
  const auto is_due = [this](const HeldRecord& record) {
    return received_.needs_no_wait(record.epoch, record.predecessor);
  };
  HeldRecord record;
  is_held_ = false;
  while (!held_.empty()) {
    const std::size_t place = held_.take(is_due, record);
    if (place == HeldRecords::kMost) return false;
    if (received_.take(record.epoch, record.sequence, pass.now) != AssuredNovelty::fresh) continue;
    received_.owe(record.epoch, false);
    counted_.taken.add();
    admitted_ = {record.epoch, record.sequence};
    is_held_ = true;
    held = {record.octets, held_arrivals_[place]};
    held.arrival.now = pass.now;
    held.arrival.utc = pass.utc;
    return true;
  }
  return false;
}

void AssuredStage::take_receipt(const pdu::AssuredRecord& record) noexcept {
  pdu::AssuredReceipt receipt;
  if (!pdu::load_record(record.content.bytes, receipt)) return counted_.refused.add();
  if (names_us(record)) sent_.acknowledge(record.epoch, record.sequence, receipt, *this);
}

// A peer that only takes another name remains.
void AssuredStage::drop(const aoim::PresenceEvent::Dropped& life) noexcept {
  if (aoim_.presence().id_of(life.epoch)) return;
  gone_ = life;
  sent_.drop(life.epoch, *this);
  received_.drop(life.epoch);
  held_.drop(life.epoch);
  gone_ = {};
}

}  // namespace reckon::peer
