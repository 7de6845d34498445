// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Octets as messages about owners, from three voters and a stranger. What is decoded is encoded to
// the same message, and no message makes this peer own what the table gives to another.
#include <algorithm>
#include <array>
#include <chrono>
#include <span>
#include <vector>

#include "reckon/pdu/reckon/assured_record.hpp"
#include "reckon/peer/ownership/message_codec.hpp"
#include "reckon/peer/ownership/ownership.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"

namespace reckon::fuzz {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kObjects = 8;
constexpr std::size_t kHead = 4;  // octets before a message: kind, sender, time, length

constexpr std::array kKinds{pdu::AssuredKind::record,
                            pdu::AssuredKind::ownership_round,
                            pdu::AssuredKind::ownership_proposal,
                            pdu::AssuredKind::ownership_vote,
                            pdu::AssuredKind::ownership_table,
                            pdu::AssuredKind::ownership_agreement};

class Willing final : public peer::OwnershipUser {
 public:
  bool may_take(std::size_t, std::uint32_t) override { return true; }
  bool is_busy(std::size_t) override { return false; }
  peer::ObjectSet company_of(std::size_t) override { return {}; }
  bool is_any_awake() override { return true; }
  std::uint64_t host_of(std::uint32_t epoch) override { return epoch; }
};

peer::EncodedMessage encode(const peer::OwnershipMessage& message, std::span<std::byte> out) {
  return peer::encode_message(message, {1, {1, 1}, {1, 2}, {65534, 1}}, 0, out);
}

// The first encoding may say less: half of a round's voters, without a number out of range.
void check_round_trip(const peer::OwnershipMessage& message) {
  std::array<std::byte, pdu::kMostAssured> first{}, second{};
  const peer::EncodedMessage plain = encode(message, first);
  const auto sent = peer::decode_message(plain.kind, std::span(first).first(plain.size));
  if (!sent) return;
  first = {};
  const peer::EncodedMessage once = encode(*sent, first);
  const auto again = peer::decode_message(once.kind, std::span(first).first(once.size));
  require(again.has_value(), "a message that was sent is not received");
  const peer::EncodedMessage twice = encode(*again, second);
  require(once.size == twice.size && std::ranges::equal(first, second),
          "a message changes when it is encoded");
}

void check_table(const peer::Ownership& protocol, std::chrono::nanoseconds now) {
  for (std::size_t i = 0; i < kObjects; ++i)
    require(!protocol.owns(i, now) || protocol.tenure(i).owner == 1, "it owns a body of another");
}

}  // namespace

void check(std::span<const std::byte> input) {
  Willing user;
  peer::OwnershipConfig config;
  config.epoch = config.started = 1;
  config.objects = kObjects;
  config.founds_at_once = true;
  peer::Ownership protocol(config, user);
  std::chrono::nanoseconds now = std::chrono::seconds(1);
  protocol.step(now);
  for (std::size_t i = 0; i < kObjects; ++i) protocol.ask(i);
  while (input.size() > kHead) {
    const auto at = [&](std::size_t i) { return std::to_integer<std::size_t>(input[i]); };
    const std::size_t size = std::min(input.size() - kHead, 4 * at(3));
    const pdu::AssuredKind kind = kKinds[at(0) % kKinds.size()];
    const auto message = peer::decode_message(kind, input.subspan(kHead, size));
    now += milliseconds(at(2));
    if (message) {
      check_round_trip(*message);
      protocol.receive(static_cast<std::uint32_t>(2 + at(1) % 4), *message, now);
    }
    protocol.step(now);
    for (const peer::OwnershipEvent& event :
         std::vector(protocol.events().begin(), protocol.events().end()))
      if (event.kind == peer::OwnershipEvent::Kind::yield) protocol.yielded(event.transaction, now);
    protocol.clear_events();
    protocol.clear_outgoing();
    check_table(protocol, now);
    input = input.subspan(kHead + size);
  }
}

}  // namespace reckon::fuzz
