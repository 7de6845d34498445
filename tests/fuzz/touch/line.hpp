// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The line between the hands of a scenario: delay, loss, duplicates and silence.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/peer/network/impairment.hpp"
#include "reckon/tests/fuzz/touch/scenario.hpp"

namespace reckon::fuzz {

class Line {
 public:
  /// @param scenario outlives the line
  explicit Line(const Scenario& scenario);

  /// At `now` [s].
  void send(double now, std::size_t from, std::size_t to, const haptics::RemoteHand& hand);
  /// Whether anything has arrived; then `set` is all that `to` knows. Older datagrams than the
  /// newest are dropped, except duplicates.
  bool deliver(double now, std::size_t to, haptics::ContactSet& set);

 private:
  struct Sent {
    double arrival;
    std::uint64_t number;
    std::size_t from;
    bool duplicate;
    haptics::RemoteHand hand;
  };
  struct Known {
    std::uint64_t number = 0;
    haptics::RemoteHand hand;
  };

  // False for silences of the scenario, besides the impairment law.
  [[nodiscard]] bool carries(double now, std::size_t from) const;

  const Scenario& scenario_;
  peer::Impairment impairment_;
  std::vector<std::deque<Sent>> queues_;
  std::vector<std::vector<Known>> known_;
  std::uint64_t number_ = 0;
  std::uint32_t version_ = 0;
};

}  // namespace reckon::fuzz
