// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/view_controls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "reckon/pdu/seconds.hpp"

namespace reckon::tools {
namespace {

std::string network_text(const NetworkRequest& request) {
  if (request.outage) return "network: outage, nothing arrives";
  return fmt::format("network: {:.0f} ms delay, {:.0f} ms jitter, {:.0f} % loss", request.delay_ms,
                     request.jitter_ms, 100 * request.loss);
}

}  // namespace

ViewControls::ViewControls(peer::ImpairmentLaw law, ChangeNetwork change, GoAlone go_alone)
    : law_(std::move(law)), change_(std::move(change)), go_alone_(std::move(go_alone)) {
  network_.delay_ms = static_cast<float>(1e3 * pdu::to_seconds(law_.delay));
  network_.jitter_ms = static_cast<float>(1e3 * pdu::to_seconds(law_.jitter));
  network_.loss = static_cast<float>(law_.loss);
}

void ViewControls::add_hand(std::size_t index, const PointerHand& pointer) {
  hands_.emplace_back(index, pointer);
}

bool ViewControls::is_free(std::size_t index) const {
  return std::any_of(hands_.begin(), hands_.end(), [index](const Hand& hand) {
    return hand.index == index && hand.owner.load(std::memory_order_relaxed) == kNobody;
  });
}

ViewerControls::HandAnswer ViewControls::take_hand(Watcher watcher) {
  Hand* free = nullptr;
  for (Hand& hand : hands_) {
    if (hand.owner == watcher)
      return {static_cast<std::uint16_t>(hand.index),
              fmt::format("you already have hand {}", hand.index + 1)};
    if (free == nullptr && hand.owner == kNobody) free = &hand;
  }
  if (free == nullptr)
    return {std::nullopt, hands_.empty() ? "this scene has no hand for a pointer"
                                         : "all hands for pointers are taken; you can only watch"};
  free->owner = watcher;
  return {static_cast<std::uint16_t>(free->index),
          fmt::format("you have hand {}", free->index + 1)};
}

void ViewControls::give_hand(Watcher watcher) {
  for (Hand& hand : hands_) {
    if (hand.owner != watcher) continue;
    hand.pointer.release();
    hand.owner = kNobody;
  }
}

void ViewControls::point(Watcher watcher, const PointerRequest& request, std::chrono::nanoseconds) {
  for (Hand& hand : hands_) {
    if (hand.index != request.hand || hand.owner != watcher) continue;
    if (request.held) {
      static_cast<void>(hand.pointer.lead(request.position.cast<double>(), request.grabs));
    } else {
      hand.pointer.release();
    }
  }
}

std::string ViewControls::set_network(const NetworkRequest& request) {
  if (!change_) return "this program has no simulated network to change";
  network_ = request;
  law_.delay = pdu::from_seconds(1e-3 * request.delay_ms);
  law_.jitter = pdu::from_seconds(1e-3 * request.jitter_ms);
  law_.loss = request.outage ? 1.0 : static_cast<double>(request.loss);
  change_(law_);
  return network_text(request);
}

std::string ViewControls::go_alone() {
  if (!rests_.load(std::memory_order_relaxed)) return "the bodies do not rest";
  go_alone_();
  return "the bodies go on without the missing peers";
}

}  // namespace reckon::tools
