// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/heard_list_sender.hpp"

#include <algorithm>

#include "reckon/pdu/reckon/peers_heard.hpp"

namespace reckon::aoim {

using std::chrono::nanoseconds;

HeardListSender::HeardListSender(const PresenceConfig& config, const PeerTable& peers)
    : config_(config), peers_(peers) {
  list_.reserve(config.capacity);
}

std::optional<HeardList> HeardListSender::take(nanoseconds now, nanoseconds last_sent,
                                               std::optional<nanoseconds> announced,
                                               nanoseconds announcing) {
  if (now < next_) return {};
  const nanoseconds silence = 3 * config_.heartbeat / 4;
  if (announced != now) {
    const nanoseconds silent = std::max(last_sent, announced.value_or(last_sent)) + silence;
    if (now < silent) {
      next_ = announcing > now ? std::min(silent, announcing) : silent;
      return {};
    }
    next_ = announcing + silence;
  } else {
    next_ = now + silence;
  }
  list_.clear();
  for (std::size_t i = 0; i < peers_.size(); ++i) {
    list_.push_back(peers_.epoch(i));
  }
  if (list_.size() > config_.most_listed) return next_part();
  return HeardList{list_};
}

// A part begins with the last epoch of the part before. Without this overlap an unreceived peer
// between two parts would seem not to be covered.
HeardList HeardListSender::next_part() {
  std::sort(list_.begin(), list_.end());
  const auto above = std::upper_bound(list_.begin(), list_.end(), sent_to_);
  const auto begin = above == list_.begin() ? above : above - 1;
  const auto first = static_cast<std::size_t>(begin - list_.begin());
  const std::size_t count = std::min(config_.part, list_.size() - first);
  HeardList part{std::span(list_).subspan(first, count)};
  const bool ends = first + count == list_.size();
  if (first > 0) part.continues |= pdu::kPeersHeardBelow;
  if (!ends) part.continues |= pdu::kPeersHeardAbove;
  sent_to_ = ends ? 0 : part.epochs.back();
  return part;
}

}  // namespace reckon::aoim
