// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Octets as a datagram with assured records, and as records of four senders near the wrap. The
// decoder passes on standard PDUs alone; no record is taken twice, and a receipt names taken ones.
#include <set>
#include <span>
#include <utility>

#include "reckon/pdu/bundle.hpp"
#include "reckon/peer/reliable/received_set.hpp"
#include "reckon/peer/world/datagram_decoder.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"

namespace reckon::fuzz {
namespace {

constexpr std::size_t kStep = 4;  // octets an operation

void decode(std::span<const std::byte> octets) {
  static peer::Counters counters;
  static peer::DatagramDecoder decoder(1, counters);
  for (const peer::Inbound& update : decoder.decode(octets, {1, 1})) {
    if (update.record.empty()) continue;
    pdu::AssuredRecord record;
    require(pdu::decode(update.record, record) == pdu::DecodeError::none, "no record is passed on");
    if (update.kind == peer::Inbound::Kind::assured) continue;
    require(pdu::bundle_rank(update.pdu.header.pdu_type) == 1, "a record holds no standard PDU");
    const bool is_marked = record.kind == pdu::AssuredKind::mark;
    require(is_marked || update.pdu.bytes.size() == record.content.bytes.size(),
            "a record holds more than its PDU");
  }
}

void check_receipt(peer::ReceivedSet& set,
                   const std::set<std::pair<std::uint32_t, std::uint32_t>>& taken) {
  for (peer::DueReceipt due; set.take_receipt(due);) {
    for (std::uint32_t back = 0; back < peer::ReceivedSet::kWindow; ++back) {
      const bool has = (due.receipt.received[back / 8] >> back % 8 & 1) != 0;
      require(!has || taken.contains({due.epoch, due.highest - back}), "a receipt names others");
    }
  }
}

}  // namespace

void check(std::span<const std::byte> input) {
  decode(input);
  peer::ReceivedSet set(3);
  std::set<std::pair<std::uint32_t, std::uint32_t>> taken;
  std::uint32_t sequence = 0xFFFFFF00U;
  for (; input.size() >= kStep; input = input.subspan(kStep)) {
    const auto at = [&](std::size_t i) { return std::to_integer<std::uint32_t>(input[i]); };
    const std::uint32_t epoch = 1 + at(0) % 4;
    sequence += at(1) % 2 == 0 ? at(2) : 0U - (at(2) << 8 | at(3)) % 600;
    if (at(0) >= 250) {
      set.drop(epoch);
      std::erase_if(taken, [epoch](const auto& one) { return one.first == epoch; });
    } else if (set.take(epoch, sequence, {}) == peer::AssuredNovelty::fresh) {
      require(taken.insert({epoch, sequence}).second, "a record is taken twice");
      set.owe(epoch, at(3) % 2 == 0);
    }
    check_receipt(set, taken);
  }
}

}  // namespace reckon::fuzz
