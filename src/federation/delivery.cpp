// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/federation/delivery.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/reckon/assured_record.hpp"

namespace reckon::peer {
namespace {

constexpr unsigned kTypeBits = 8;

}  // namespace

std::uint64_t message_tag(MessageHandle message, pdu::PduType type) noexcept {
  return message.number << kTypeBits | static_cast<std::uint8_t>(type);
}

void check_assured(pdu::PduType type, std::size_t octets, bool interop) {
  if (interop)
    throw std::logic_error(
        "plain DIS programs acknowledge nothing, so nothing can be assured to them: use a scene "
        "without interop = true, or send with Delivery::best_effort");
  if (pdu::bundle_rank(type) != pdu::bundle_rank(pdu::PduType::fire))
    throw std::logic_error("PDU type " + std::to_string(static_cast<int>(type)) +
                           " cannot be assured: send an interaction, such as Fire or Comment");
  if (octets > pdu::kMostAssured)
    throw std::length_error("a PDU of " + std::to_string(octets) + " octets: an assured one has " +
                            std::to_string(pdu::kMostAssured) + " at most, so send several");
}

void check_order(Delivery delivery, Order order) {
  if (delivery == Delivery::assured || order == Order::none) return;
  throw std::logic_error(
      "only assured interactions have an order: send with Delivery::assured, or without an order");
}

void report_undelivered(std::span<const Undelivered> undelivered,
                        const std::function<void(const UndeliveredMessage&)>& callback) {
  while (callback && !undelivered.empty()) {
    const std::uint64_t tag = undelivered.front().tag;
    UndeliveredMessage report{{tag >> kTypeBits}, pdu::PduType{static_cast<std::uint8_t>(tag)}, {}};
    const auto other =
        std::ranges::find_if(undelivered, [tag](const Undelivered& one) { return one.tag != tag; });
    const auto count = static_cast<std::size_t>(other - undelivered.begin());
    for (const Undelivered& one : undelivered.first(count))
      report.peers.push_back({one.peer, one.cause});
    callback(report);
    undelivered = undelivered.subspan(count);
  }
}

}  // namespace reckon::peer
