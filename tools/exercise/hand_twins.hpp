// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Hidden twins of an exercise's hands that follow pointers: the forces these hands would feel
// without the gate, computed separately from the peers, from recorded steps.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "reckon/haptics/servo/ungated_twin.hpp"
#include "reckon/peer/network/impairment.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tools/exercise/exercise.hpp"

namespace reckon::tools {

/// A twin has the same pointer, operator and device as its hand. It uses the contact models as its
/// hand received them; if the other hand has a twin, its model is placed at that twin. So twins
/// feel each other as two hands without the gate. Twins send each other updates by the scene's
/// thresholds, over the same simulated network.
///
/// If one twin diverges, or if all together have generated kMostMade of energy, all are reset.
///
/// Runs on the thread of the exercise. It steps a twin once for each recorded step of its hand, all
/// twins in the order of time. So the twins repeat the recorded motion as fast as the exercise
/// collects it, independent of the clock.
class HandTwins {
 public:
  /// Only the first kMost hands have twins.
  static constexpr std::size_t kMost = 8;
  /// Limit of the steps of a hand that wait for another hand; beyond it, it continues alone.
  static constexpr std::size_t kMostWaiting = 500;

  /// [J] of generated energy before a reset: two twins oscillate for about a second.
  static constexpr double kMostMade = 0.25;

  /// Construct before the first run of the exercise. @param exercise runs `scene` with
  /// ExerciseOptions::trace_contacts; outlives this. @throws as make_simulated_hands()
  HandTwins(const peer::SceneFile& scene, Exercise& exercise);
  ~HandTwins();
  HandTwins(const HandTwins&) = delete;
  HandTwins& operator=(const HandTwins&) = delete;

  /// Takes a recorded step of the exercise, see Exercise::on_step(). Ignored for a hand without a
  /// twin.
  void take(std::size_t peer, std::size_t device, const haptics::ServoSnapshot& step);
  /// Any thread: changes the network impairment. @param law without a problem()
  void change_impairment(const peer::ImpairmentLaw& law);

  /// The twin of a hand; null: it has none.
  [[nodiscard]] const haptics::UngatedTwin* find(std::size_t peer,
                                                 std::size_t device) const noexcept;
  /// Number of resets of all twins.
  [[nodiscard]] std::uint64_t resets() const noexcept { return resets_; }
  /// Energy that all their hands have given to the couplings and to their devices' damping, minus
  /// the energy that they got back [J]. Energy that passes from one hand to another cancels, so a
  /// passive coupling keeps the sum at zero or above.
  [[nodiscard]] double energy() const noexcept;
  /// A hand of Exercise::pointers(), with a recorder for its twin.
  [[nodiscard]] PointerHand followed(std::size_t peer, const PointerHand& pointer) const noexcept;

 private:
  struct Twin;
  [[nodiscard]] Twin* twin_of(std::size_t peer, std::size_t device) const noexcept;
  [[nodiscard]] Twin* next() const noexcept;
  void impair(const peer::ImpairmentLaw& law);
  void take_law();
  void step(Twin& twin);
  void take_contacts(Twin& twin, std::chrono::nanoseconds now) const;
  void show_contacts(Twin& twin) const;
  void report_others(Twin& twin);
  void look_for_lost(const Twin& twin);
  [[nodiscard]] std::optional<std::size_t> index_of(const pdu::EntityId& id) const noexcept;

  Exercise& exercise_;
  std::chrono::nanoseconds begun_;
  deadreckon::ForceModel hand_;  // force model of the scene's hands
  std::uint64_t seed_;
  std::vector<std::unique_ptr<Twin>> twins_;
  std::vector<peer::Impairment> networks_;  // by receiver, in the order of twins_
  std::uint64_t resets_ = 0;
  std::mutex mutex_;  // guards new_law_
  std::optional<peer::ImpairmentLaw> new_law_;
};

}  // namespace reckon::tools
