// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "reckon/pdu/aggregate/transfer_ownership.hpp"
#include "reckon/pdu/management/acknowledge.hpp"
#include "reckon/pdu/reckon/ownership_content.hpp"
#include "reckon/pdu/reckon/peers_heard.hpp"
#include "reckon/peer/ownership/message_codec.hpp"

namespace reckon::peer {
namespace {

using pdu::AssuredKind;

class RecordReader {
 public:
  explicit RecordReader(std::span<const std::byte> octets) noexcept : rest_(octets) {}
  template <typename Record>
  [[nodiscard]] bool read(Record& record) noexcept {
    if (!pdu::load_record(rest_, record)) return false;
    rest_ = rest_.subspan(pdu::kFixedSize<Record>);
    return true;
  }
  [[nodiscard]] std::span<const std::byte> rest() const noexcept { return rest_; }

 private:
  std::span<const std::byte> rest_;
};

ObjectSet objects_of(const pdu::ObjectBits& bits) noexcept {
  ObjectSet objects;
  for (std::size_t i = 0; i < objects.size(); ++i) objects[i] = (bits[i / 8] >> i % 8 & 1) != 0;
  return objects;
}

Holding plain(const pdu::OwnershipHolding& holding) noexcept {
  return {holding.object, {holding.version, holding.owner}};
}

std::optional<OwnershipMessage> decode_round(RecordReader in) noexcept {
  pdu::OwnershipRound head;
  if (!in.read(head) || in.rest().size() != head.count) return {};
  if (std::size_t{head.first} + head.count > Roll::kMost) return {};
  Round round;
  round.world = {head.founded, head.founder};
  round.act = head.act;
  round.hash = head.hash;
  round.table = head.table;
  round.round = head.round;
  round.is_decided = (head.flags & pdu::kRoundDecided) != 0;
  round.is_active = (head.flags & pdu::kRoundActive) != 0;
  round.has_lease = (head.flags & pdu::kRoundLease) != 0;
  round.follows = (head.flags & pdu::kRoundFollows) != 0;
  if ((head.flags & pdu::kRoundYields) != 0)
    round.yields_to = head.act + (round.is_decided ? 1U : 0U);
  if ((head.flags & pdu::kRoundLeaves) != 0) round.yields_to = kAnyAct;
  for (std::size_t i = 0; i < head.count; ++i)
    round.heard[head.first + i] = static_cast<std::uint8_t>(in.rest()[i]);
  return round;
}

std::optional<OwnershipMessage> decode_proposal(RecordReader in) noexcept {
  pdu::OwnershipProposal head;
  if (!in.read(head) || head.act == 0) return {};
  if (head.voters > Roll::kMost || head.removed > Roll::kMost) return {};
  if (head.phase > static_cast<std::uint8_t>(DecisionPhase::decided)) return {};
  Proposal proposal;
  proposal.world = {head.founded, head.founder};
  proposal.act.number = head.act;
  proposal.act.chair = head.chair;
  proposal.ballot = {head.attempt, head.proposer};
  proposal.accepted = {head.accepted_attempt, head.accepted_proposer};
  proposal.digest = head.digest;
  proposal.phase = static_cast<DecisionPhase>(head.phase);
  proposal.act.given = objects_of(head.given);
  for (std::size_t i = 0; i < head.voters; ++i) {
    pdu::OwnershipVoter voter;
    if (!in.read(voter) || voter.host >= Roll::kMost) return {};
    if (!proposal.act.roll.add({voter.epoch, static_cast<std::uint8_t>(voter.host)})) return {};
  }
  for (std::size_t i = 0; i < head.removed; ++i) {
    pdu::PeerEpoch removed;
    if (!in.read(removed) || proposal.act.roll.contains(removed.epoch)) return {};
    if (!proposal.act.remove(removed.epoch)) return {};
  }
  if (!in.rest().empty()) return {};
  return proposal;
}

std::optional<OwnershipMessage> decode_vote(RecordReader in) noexcept {
  pdu::OwnershipVote head;
  if (!in.read(head) || !in.rest().empty()) return {};
  return Vote{{head.founded, head.founder}, head.act, {head.attempt, head.proposer}};
}

std::optional<OwnershipMessage> decode_table(RecordReader in) noexcept {
  pdu::OwnershipTable head;
  if (!in.read(head) || head.count > kMostHoldings) return {};
  TableExtract extract;
  extract.world = {head.founded, head.founder};
  extract.serial = head.serial;
  extract.act = head.act;
  extract.asks = (head.flags & pdu::kTableAsks) != 0;
  for (std::size_t i = 0; i < head.count; ++i) {
    pdu::OwnershipHolding holding;
    if (!in.read(holding) || holding.object >= kMostOwnable) return {};
    extract.holdings.add(holding.object, plain(holding).tenure);
  }
  if (!in.rest().empty()) return {};
  return extract;
}

std::optional<OwnershipMessage> decode_agreement(RecordReader in) noexcept {
  pdu::OwnershipAgreement head;
  if (!in.read(head) || !in.rest().empty()) return {};
  return Agreement{{head.founded, head.founder}, head.serial, objects_of(head.objects)};
}

bool is_sane(const pdu::TransferState& state) noexcept {
  const auto finite = [](const pdu::WorldCoordinates& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  const double norm = state.w * state.w + state.x * state.x + state.y * state.y + state.z * state.z;
  // Later times overflow a difference.
  if (state.utc >> 62 != 0) return false;
  return finite(state.position) && finite(state.velocity) && finite(state.turn_rate) &&
         finite(state.acceleration) && std::abs(norm - 1.0) < 1e-6 &&
         state.holding.object < kMostOwnable;
}

ObjectState plain(const pdu::TransferState& state) noexcept {
  ObjectState plain;
  plain.utc = std::chrono::nanoseconds(static_cast<std::int64_t>(state.utc));
  plain.position = {state.position.x, state.position.y, state.position.z};
  plain.orientation = {state.w, state.x, state.y, state.z};
  plain.velocity = {state.velocity.x, state.velocity.y, state.velocity.z};
  plain.turn_rate = {state.turn_rate.x, state.turn_rate.y, state.turn_rate.z};
  plain.acceleration = {state.acceleration.x, state.acceleration.y, state.acceleration.z};
  return plain;
}

std::optional<OwnershipMessage> decode_grant(RecordReader in, std::uint32_t request) noexcept {
  pdu::TransferGrant head;
  if (!in.read(head) || head.count == 0 || head.count > kMostGranted) return {};
  Grant grant;
  grant.world = {head.founded, head.founder};
  grant.transaction = request;
  grant.to = head.to;
  grant.lease_ms = std::min<std::uint32_t>(head.lease_ms, 10'000);
  grant.is_pushed = (head.flags & pdu::kGrantPushed) != 0;
  grant.round = head.round;
  grant.objects = objects_of(head.objects);
  for (std::size_t i = 0; i < head.count; ++i) {
    pdu::TransferState state;
    if (!in.read(state) || !is_sane(state)) return {};
    grant.part[grant.count] = plain(state.holding);
    grant.states[grant.count++] = plain(state);
  }
  return grant;
}

std::optional<OwnershipMessage> decode_transfer(std::span<const std::byte> octets) noexcept {
  pdu::TransferOwnership pdu;
  if (pdu::decode(octets, pdu) != pdu::DecodeError::none) return {};
  for (const auto& [head, body] : pdu.record_sets.records()) {
    if (head.record_id != pdu::kTransferRecordType) continue;
    RecordReader in(body);
    if (pdu.transfer_type == pdu::kTransferPush) return decode_grant(in, pdu.request_id);
    pdu::TransferRequest request;
    const bool withdraws = pdu.transfer_type == pdu::kTransferCancel;
    if ((!withdraws && pdu.transfer_type != pdu::kTransferPull) || !in.read(request)) return {};
    return Request{{request.founded, request.founder}, objects_of(request.objects), withdraws};
  }
  return {};
}

std::optional<OwnershipMessage> decode_refusal(std::span<const std::byte> octets) noexcept {
  pdu::Acknowledge pdu;
  if (pdu::decode(octets, pdu) != pdu::DecodeError::none) return {};
  const bool is_refusal = pdu.acknowledge_flag == pdu::AcknowledgeFlag::transfer_ownership &&
                          pdu.response_flag == pdu::ResponseFlag::unable_to_comply;
  if (!is_refusal) return {};
  return GrantRefusal{{}, pdu.request_id};
}

}  // namespace

std::optional<OwnershipMessage> decode_message(AssuredKind kind,
                                               std::span<const std::byte> octets) noexcept {
  switch (kind) {
    case AssuredKind::ownership_round:
      return decode_round(RecordReader(octets));
    case AssuredKind::ownership_proposal:
      return decode_proposal(RecordReader(octets));
    case AssuredKind::ownership_vote:
      return decode_vote(RecordReader(octets));
    case AssuredKind::ownership_table:
      return decode_table(RecordReader(octets));
    case AssuredKind::ownership_agreement:
      return decode_agreement(RecordReader(octets));
    case AssuredKind::record:
      break;
    default:
      return {};
  }
  if (auto transfer = decode_transfer(octets)) return transfer;
  return decode_refusal(octets);
}

}  // namespace reckon::peer
