// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/ownership/message_codec.hpp"

#include <algorithm>

#include "reckon/pdu/aggregate/transfer_ownership.hpp"
#include "reckon/pdu/management/acknowledge.hpp"
#include "reckon/pdu/reckon/assured_record.hpp"
#include "reckon/pdu/reckon/ownership_content.hpp"

namespace reckon::peer {
namespace {

using pdu::AssuredKind;

// Appends records to octets, as far as they have room.
class RecordWriter {
 public:
  explicit RecordWriter(std::span<std::byte> out) noexcept : rest_(out), all_(out.size()) {}
  void add(const auto& record) noexcept {
    const std::size_t size = pdu::store_record(record, rest_);
    rest_ = rest_.subspan(size);
  }
  void add_octet(std::uint8_t value) noexcept {
    if (rest_.empty()) return;
    rest_[0] = std::byte{value};
    rest_ = rest_.subspan(1);
  }
  [[nodiscard]] std::size_t size() const noexcept { return all_ - rest_.size(); }

 private:
  std::span<std::byte> rest_;
  std::size_t all_;
};

pdu::ObjectBits bits_of(const ObjectSet& objects) noexcept {
  pdu::ObjectBits bits{};
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i]) bits[i / 8] = static_cast<std::uint8_t>(bits[i / 8] | 1U << i % 8);
  }
  return bits;
}

pdu::OwnershipHolding wire(const Holding& holding) noexcept {
  return {holding.object, 0, holding.tenure.owner, holding.tenure.version};
}
EncodedMessage encode(const Round& round, std::uint32_t half, RecordWriter& out) noexcept {
  pdu::OwnershipRound head{round.world.founded,
                           round.world.founder,
                           round.act,
                           round.hash,
                           round.table,
                           round.round,
                           0,
                           0,
                           0};
  const bool leaves = round.yields_to == kAnyAct;
  head.flags = static_cast<std::uint8_t>(
      (round.is_decided ? pdu::kRoundDecided : 0) | (round.is_active ? pdu::kRoundActive : 0) |
      (round.has_lease ? pdu::kRoundLease : 0) | (round.follows ? pdu::kRoundFollows : 0) |
      (leaves ? pdu::kRoundLeaves : 0) | (round.yields_to != 0 && !leaves ? pdu::kRoundYields : 0));
  const auto last = std::find_if(round.heard.rbegin(), round.heard.rend(),
                                 [](std::uint8_t heard) { return heard != 0; });
  const auto voters = static_cast<std::size_t>(round.heard.rend() - last);
  std::size_t begin = 0, end = voters;
  if (voters > kMostNamed) {
    const std::size_t middle = (voters + 1) / 2;
    (half % 2 == 0 ? end : begin) = middle;
  }
  head.first = static_cast<std::uint8_t>(begin);
  head.count = static_cast<std::uint8_t>(end - begin);
  out.add(head);
  for (std::size_t i = begin; i < end; ++i) out.add_octet(round.heard[i]);
  return {AssuredKind::ownership_round, false, out.size()};
}

EncodedMessage encode(const Proposal& proposal, RecordWriter& out) noexcept {
  const Act& act = proposal.act;
  pdu::OwnershipProposal head;
  head.founded = proposal.world.founded;
  head.founder = proposal.world.founder;
  head.act = act.number;
  head.chair = act.chair;
  head.attempt = proposal.ballot.attempt;
  head.proposer = proposal.ballot.proposer;
  head.accepted_attempt = proposal.accepted.attempt;
  head.accepted_proposer = proposal.accepted.proposer;
  head.digest = proposal.digest;
  head.phase = static_cast<std::uint8_t>(proposal.phase);
  head.voters = static_cast<std::uint8_t>(act.roll.size());
  head.removed = static_cast<std::uint8_t>(act.removed_count);
  head.given = bits_of(act.given);
  out.add(head);
  for (const Voter& voter : act.roll.voters())
    out.add(pdu::OwnershipVoter{voter.epoch, voter.host});
  for (const std::uint32_t epoch : act.removed()) out.add(pdu::PeerEpoch{epoch});
  return {AssuredKind::ownership_proposal, false, out.size()};
}

EncodedMessage encode(const Vote& vote, RecordWriter& out) noexcept {
  out.add(pdu::OwnershipVote{vote.world.founded, vote.world.founder, vote.act, vote.ballot.attempt,
                             vote.ballot.proposer});
  return {AssuredKind::ownership_vote, false, out.size()};
}

EncodedMessage encode(const TableExtract& extract, RecordWriter& out) noexcept {
  out.add(pdu::OwnershipTable{extract.world.founded, extract.world.founder, extract.serial,
                              extract.act, extract.asks ? pdu::kTableAsks : std::uint16_t{0},
                              static_cast<std::uint16_t>(extract.holdings.count)});
  for (const Holding& holding : extract.holdings.list()) out.add(wire(holding));
  return {AssuredKind::ownership_table, false, out.size()};
}

EncodedMessage encode(const Agreement& agreement, RecordWriter& out) noexcept {
  out.add(pdu::OwnershipAgreement{agreement.world.founded, agreement.world.founder,
                                  agreement.serial, bits_of(agreement.objects)});
  return {AssuredKind::ownership_agreement, false, out.size()};
}

// One record set of 8-octet values.
EncodedMessage encode_transfer(const TransferNames& names, std::uint8_t type, std::uint32_t request,
                               const ObjectSet& objects, std::span<const std::byte> content,
                               std::span<std::byte> out) noexcept {
  std::array<std::byte, pdu::kMostAssured> sets{};
  pdu::RecordSet set;
  set.record_id = pdu::kTransferRecordType;
  set.record_length = 64;
  set.record_count = static_cast<std::uint16_t>(content.size() / 8);
  const std::size_t head = pdu::store_record(set, sets);
  if (head + content.size() > sets.size()) return {};
  std::ranges::copy(content, sets.begin() + static_cast<std::ptrdiff_t>(head));
  std::size_t first = 0;
  while (first + 1 < objects.size() && !objects[first]) ++first;
  pdu::TransferOwnership pdu;
  pdu.header.exercise_id = names.exercise;
  pdu.originating_entity_id = {names.sender.site, names.sender.application, 0};
  pdu.receiving_entity_id = {names.receiver.site, names.receiver.application, 0};
  pdu.request_id = request;
  pdu.transfer_type = type;
  pdu.transfer_entity_id = {names.scene.site, names.scene.application,
                            static_cast<std::uint16_t>(first + 1)};
  pdu.record_sets.count = 1;
  pdu.record_sets.bytes = std::span(sets).first(head + content.size());
  return {AssuredKind::record, true, pdu::encode(pdu, out)};
}

EncodedMessage encode(const Request& request, const TransferNames& names,
                      std::span<std::byte> out) noexcept {
  std::array<std::byte, pdu::kFixedSize<pdu::TransferRequest>> content{};
  static_cast<void>(pdu::store_record(
      pdu::TransferRequest{request.world.founded, request.world.founder, bits_of(request.objects)},
      content));
  return encode_transfer(names, request.withdraws ? pdu::kTransferCancel : pdu::kTransferPull, 0,
                         request.objects, content, out);
}

pdu::TransferState wire(const Holding& holding, const ObjectState& state) noexcept {
  pdu::TransferState wired;
  wired.holding = wire(holding);
  wired.utc = static_cast<std::uint64_t>(state.utc.count());
  wired.position = {state.position[0], state.position[1], state.position[2]};
  wired.w = state.orientation[0];
  wired.x = state.orientation[1];
  wired.y = state.orientation[2];
  wired.z = state.orientation[3];
  wired.velocity = {state.velocity[0], state.velocity[1], state.velocity[2]};
  wired.turn_rate = {state.turn_rate[0], state.turn_rate[1], state.turn_rate[2]};
  wired.acceleration = {state.acceleration[0], state.acceleration[1], state.acceleration[2]};
  return wired;
}

EncodedMessage encode(const Grant& grant, const TransferNames& names,
                      std::span<std::byte> out) noexcept {
  std::array<std::byte, pdu::kMostAssured> content{};
  RecordWriter writer(content);
  pdu::TransferGrant head;
  head.founded = grant.world.founded;
  head.founder = grant.world.founder;
  head.to = grant.to;
  head.lease_ms = grant.lease_ms;
  head.round = grant.round;
  head.count = static_cast<std::uint8_t>(grant.count);
  head.flags = grant.is_pushed ? pdu::kGrantPushed : std::uint16_t{0};
  head.objects = bits_of(grant.objects);
  writer.add(head);
  for (std::size_t i = 0; i < grant.count; ++i) writer.add(wire(grant.part[i], grant.states[i]));
  return encode_transfer(names, pdu::kTransferPush, grant.transaction, grant.objects,
                         std::span(content).first(writer.size()), out);
}

// The world is not in an Acknowledge PDU; the transaction is unique for its grantor.
EncodedMessage encode(const GrantRefusal& refusal, const TransferNames& names,
                      std::span<std::byte> out) noexcept {
  pdu::Acknowledge pdu;
  pdu.header.exercise_id = names.exercise;
  pdu.originating_entity_id = {names.sender.site, names.sender.application, 0};
  pdu.receiving_entity_id = {names.receiver.site, names.receiver.application, 0};
  pdu.acknowledge_flag = pdu::AcknowledgeFlag::transfer_ownership;
  pdu.response_flag = pdu::ResponseFlag::unable_to_comply;
  pdu.request_id = refusal.transaction;
  return {AssuredKind::record, true, pdu::encode(pdu, out)};
}

}  // namespace

EncodedMessage encode_message(const OwnershipMessage& message, const TransferNames& names,
                              std::uint32_t half, std::span<std::byte> out) noexcept {
  out = out.first(std::min(out.size(), pdu::kMostAssured));
  return std::visit(
      [&](const auto& sent) -> EncodedMessage {
        using Message = std::decay_t<decltype(sent)>;
        RecordWriter writer(out);
        if constexpr (std::is_same_v<Message, Round>) {
          return encode(sent, half, writer);
        } else if constexpr (requires { encode(sent, names, out); }) {
          return encode(sent, names, out);
        } else {
          return encode(sent, writer);
        }
      },
      message);
}

}  // namespace reckon::peer
