// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/counters/counters.hpp"

namespace reckon::peer {

Counters::Entry& Counters::entry_of(std::string_view name, std::string_view meaning) {
  for (Entry& entry : entries_) {
    if (entry.name == name) return entry;
  }
  Entry& entry = entries_.emplace_back();
  entry.name = name;
  entry.meaning = meaning;
  return entry;
}

Counter& Counters::make(std::string_view name, std::string_view meaning) {
  return entry_of(name, meaning).counter;
}

Counter& Counters::make_level(std::string_view name, std::string_view meaning) {
  Entry& entry = entry_of(name, meaning);
  entry.is_level = true;
  return entry.counter;
}

Counter& Counters::make_in(const CounterGroup& group, std::string_view member,
                           std::string_view name, std::string_view meaning) {
  Entry& entry = entry_of(name, meaning);
  entry.group = &group;
  entry.member = member;
  return entry.counter;
}

const Counter* Counters::find(std::string_view name) const noexcept {
  for (const Entry& entry : entries_) {
    if (entry.name == name) return &entry.counter;
  }
  return nullptr;
}

}  // namespace reckon::peer
