// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What is under way, each datagram once for all to whom it goes.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "reckon/tests/fuzz/peers/life.hpp"

namespace reckon::fuzz {

class DatagramsUnderWay {
 public:
  /// Keeps it until it has been released as often as `on_the_way` was raised, and once more.
  std::size_t put(Datagram datagram) {
    datagram.on_the_way = 1;
    if (free_.empty()) {
      all_.push_back(std::move(datagram));
      return all_.size() - 1;
    }
    const std::size_t place = free_.back();
    free_.pop_back();
    all_[place] = std::move(datagram);
    return place;
  }
  void release(std::size_t place) {
    if (--all_[place].on_the_way == 0) free_.push_back(place);
  }
  [[nodiscard]] Datagram& operator[](std::size_t place) noexcept { return all_[place]; }

 private:
  std::vector<Datagram> all_;
  std::vector<std::size_t> free_;
};

}  // namespace reckon::fuzz
