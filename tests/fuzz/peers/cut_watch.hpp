// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A cut in one direction, where nothing else befalls the two on its ends: who is not heard is told
// that, for the others' lists leave it out, and who does not hear is told of the silence.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "reckon/tests/fuzz/peers/life.hpp"

namespace reckon::fuzz {

/// Stands beside a trial: I11.
class CutWatch {
 public:
  /// (life, other, sentence)
  using Report = std::function<void(std::size_t, std::size_t, std::string)>;

  CutWatch(const Plan& plan, const std::vector<Life>& lives) : plan_(plan), lives_(lives) {}

  /// How long a cut lasts until both are told: the silence that is told, one for which a peer is
  /// still listed and the wait for the next list, and what was under way.
  [[nodiscard]] nanoseconds patience() const noexcept;
  /// Whether a fault is a cut that lasts for so long.
  [[nodiscard]] bool concerns(const Fault& fault) const noexcept;

  void see_event(std::size_t life, const aoim::PresenceEvent& event, nanoseconds now);
  /// The cut with this number begins.
  void see_begin(std::size_t fault, nanoseconds now);
  /// It has lasted for patience().
  void look(std::size_t fault, nanoseconds now, const Report& report) const;

 private:
  /// Two lives that heard each other when the cut began.
  struct Pair {
    std::size_t fault, unheard, deaf;
    nanoseconds slept;  ///< by both
    std::size_t ids;    ///< that both have had
    nanoseconds begun;
  };
  /// When each was told last.
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
