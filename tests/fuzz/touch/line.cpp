// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/touch/line.hpp"

#include <algorithm>

#include "reckon/pdu/seconds.hpp"

namespace reckon::fuzz {

namespace {

peer::ImpairmentLaw law_of(const Scenario& s) {
  peer::ImpairmentLaw law = peer::delayed_by(s[Shared::delay], s[Shared::jitter], s[Shared::loss]);
  law.duplicate = s[Shared::duplicates];
  if (s[Shared::outage_for] > 0)
    law.outages = {
        {pdu::from_seconds(s[Shared::outage_at]), pdu::from_seconds(s[Shared::outage_for])}};
  return law;
}

}  // namespace

Line::Line(const Scenario& scenario)
    : scenario_(scenario),
      impairment_(law_of(scenario), scenario.seed),
      queues_(scenario.hands()),
      known_(scenario.hands(), std::vector<Known>(scenario.hands())) {}

bool Line::carries(double now, std::size_t from) const {
  const Scenario& s = scenario_;
  const auto name = static_cast<double>(from + 1);
  const auto within = [now](double begin, double length) {
    return now >= begin && now <= begin + length;
  };
  if (s[Shared::unknown_hand] == name && now < s[Shared::unknown_until]) return false;
  return s[Shared::silent_hand] != name || !within(s[Shared::silent_at], s[Shared::silent_for]);
}

void Line::send(double now, std::size_t from, std::size_t to, const haptics::RemoteHand& hand) {
  const peer::Fate fate = impairment_.decide(from, ++number_, pdu::from_seconds(now));
  if (!carries(now, from)) return;
  for (std::size_t copy = 0; copy < fate.copies; ++copy) {
    const double arrival = now + pdu::to_seconds(fate.delay[copy]);
    queues_[to].push_back({arrival, number_, from, copy > 0, hand});
  }
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
