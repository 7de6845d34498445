// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/touch/line.hpp"

#include <algorithm>

namespace reckon::fuzz {

Line::Line(const Scenario& scenario, std::mt19937& random)
    : scenario_(scenario),
      random_(random),
      queues_(scenario.hands()),
      known_(scenario.hands(), std::vector<Known>(scenario.hands())) {}

double Line::drawn() { return std::uniform_real_distribution<double>(0, 1)(random_); }

double Line::arrival(double now) {
  const double jitter = scenario_[Shared::jitter] * (2 * drawn() - 1);
  return now + scenario_[Shared::delay] * (1 + jitter);
}

bool Line::carries(double now, std::size_t from) const {
  const Scenario& s = scenario_;
  const auto name = static_cast<double>(from + 1);
  const auto within = [now](double begin, double length) {
    return now >= begin && now <= begin + length;
  };
  if (s[Shared::outage_for] > 0 && within(s[Shared::outage_at], s[Shared::outage_for])) {
    return false;
  }
  if (s[Shared::unknown_hand] == name && now < s[Shared::unknown_until]) return false;
  return s[Shared::silent_hand] != name || !within(s[Shared::silent_at], s[Shared::silent_for]);
}

void Line::send(double now, std::size_t from, std::size_t to, const haptics::RemoteHand& hand) {
  ++number_;
  const double first = arrival(now);
  if (drawn() < scenario_[Shared::loss] || !carries(now, from)) return;
  queues_[to].push_back({first, number_, from, false, hand});
  if (drawn() >= scenario_[Shared::duplicates]) return;
  queues_[to].push_back({arrival(now), number_, from, true, hand});
}

bool Line::deliver(double now, std::size_t to, haptics::ContactSet& set) {
  bool news = false;
  std::deque<Sent>& queue = queues_[to];
  for (auto it = queue.begin(); it != queue.end();) {
    if (it->arrival > now) {
      ++it;
      continue;
    }
    Known& known = known_[to][it->from];
    if (it->number > known.number || it->duplicate) {
      known = {std::max(known.number, it->number), it->hand};
      known.hand.version = ++version_;
      news = true;
    }
    it = queue.erase(it);
  }
  if (!news) return false;
  for (const Known& known : known_[to]) {
    if (known.number > 0) set.hands[set.count++] = known.hand;
  }
  return true;
}

}  // namespace reckon::fuzz
