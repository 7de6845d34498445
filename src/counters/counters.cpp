// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/counters/counters.hpp"

namespace reckon::peer {

Counter& Counters::make(std::string_view name, std::string_view meaning) {
  for (Entry& entry : entries_) {
    if (entry.name == name) return entry.counter;
  }
  Entry& entry = entries_.emplace_back();
  entry.name = name;
  entry.meaning = meaning;
  return entry.counter;
}

const Counter* Counters::find(std::string_view name) const noexcept {
  for (const Entry& entry : entries_) {
    if (entry.name == name) return &entry.counter;
  }
  return nullptr;
}

}  // namespace reckon::peer
