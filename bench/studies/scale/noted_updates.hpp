// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Updates that a witness may care for, until it is told.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "reckon/bench/studies/scale/witnesses.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/pdu/entity/entity_state.hpp"

namespace reckon::bench {

/// One thread.
class NotedUpdates {
 public:
  /// @param state an encoded Entity State
  void add(const SentUpdate& update, std::span<const std::byte> state);
  /// Tells what was added, and forgets it.
  void tell(Witnesses& witnesses, const deadreckon::LocalFrame& frame);

 private:
  struct Noted {
    SentUpdate update;
    std::array<std::byte, pdu::kFixedSize<pdu::EntityState>> octets;
  };
  std::vector<Noted> noted_;
};

}  // namespace reckon::bench
