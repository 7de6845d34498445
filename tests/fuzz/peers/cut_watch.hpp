// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A cut in one direction without another fault between its two ends. The unheard peer reports it,
// because the others' lists omit it; the deaf peer reports the silence.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "reckon/tests/fuzz/peers/life.hpp"

namespace reckon::fuzz {

/// Observes a trial: invariant I11.
class CutWatch {
 public:
  /// (life, other, sentence)
  using Report = std::function<void(std::size_t, std::size_t, std::string)>;

  CutWatch(const Plan& plan, const std::vector<Life>& lives) : plan_(plan), lives_(lives) {}

  /// How long a cut lasts until both must have reported it: the reported silence, the time a silent
  /// peer stays listed and the wait for the next list, and the datagrams under way.
  [[nodiscard]] nanoseconds patience() const noexcept;
  /// Whether a fault is a cut that lasts that long.
  [[nodiscard]] bool concerns(const Fault& fault) const noexcept;

  void see_event(std::size_t life, const aoim::PresenceEvent& event, nanoseconds now);
  /// The cut with this index begins.
  void see_begin(std::size_t fault, nanoseconds now);
  /// It has lasted for patience().
  void look(std::size_t fault, nanoseconds now, const Report& report) const;

 private:
  /// Two lives that received each other when the cut began.
  struct Pair {
    std::size_t fault, unheard, deaf;
    nanoseconds slept;  ///< of both together
    std::size_t ids;    ///< number of IDs that both have had
    nanoseconds begun;
  };
  /// Times of the latest reports.
  struct Told {
    nanoseconds quiet{-1}, unheard{-1};
  };
  [[nodiscard]] bool knows(std::size_t life, std::size_t other, nanoseconds now) const noexcept;
  [[nodiscard]] bool is_alone(std::size_t fault, std::size_t from, std::size_t to,
                              nanoseconds now) const noexcept;
  [[nodiscard]] nanoseconds slept(std::size_t a, std::size_t b) const noexcept {
    return lives_[a].slept + lives_[b].slept;
  }

  const Plan& plan_;
  const std::vector<Life>& lives_;
  std::vector<Pair> pairs_;
  std::map<std::pair<std::size_t, std::uint32_t>, Told> told_;  ///< (life, epoch of the other)
};

}  // namespace reckon::fuzz
