// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Hidden twins of the hands of an exercise that follow pointers: what these would feel without the
// gate, computed beside the peers from what they record.
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

/// Each twin has the pointer, the operator and the device of its hand, and of the contact sets that
/// the hand's servo gets the models as they came. Where one of these is of a hand that has a twin
/// too, it stands where that twin is: twins feel each other as two hands would that both lack the
/// gate. What they tell each other of their motion goes by the scene's thresholds and over what the
/// network does to the peers.
///
/// Where one gets lost, or all together have made kMostMade of energy, all begin anew.
///
/// One thread, that which runs the exercise; it steps a twin once for each recorded step of its
/// hand, all of them in the order of time. So they catch up as fast as the exercise collects, and
/// what their hands did is done again, not what the clock says.
class HandTwins {
 public:
  /// More hands than this have no twins: the first ones have.
  static constexpr std::size_t kMost = 8;
  /// Steps of a hand that wait for those of others, at most: then it goes on without them.
  static constexpr std::size_t kMostWaiting = 500;

  /// [J], that twins may make: two of them shake for about a second.
  static constexpr double kMostMade = 0.25;

  /// Before the exercise first runs. @param exercise with ExerciseOptions::trace_contacts, of
  /// `scene`; outlives this. @throws as make_simulated_hands()
  HandTwins(const peer::SceneFile& scene, Exercise& exercise);
  ~HandTwins();
  HandTwins(const HandTwins&) = delete;
  HandTwins& operator=(const HandTwins&) = delete;

  /// A recorded step of the exercise, see Exercise::on_step(). Nothing for a hand without a twin.
  void take(std::size_t peer, std::size_t device, const haptics::ServoSnapshot& step);
  /// Any thread: what the network does from now on. @param law without a problem()
  void change_impairment(const peer::ImpairmentLaw& law);

  /// Null for a hand without one.
  [[nodiscard]] const haptics::UngatedTwin* find(std::size_t peer,
                                                 std::size_t device) const noexcept;
  /// How often they all began anew.
  [[nodiscard]] std::uint64_t resets() const noexcept { return resets_; }
  /// What all their hands have given to the couplings and to their devices' damping less what they
  /// got back [J]: what one hand puts in and another gets out is in it once, so that a passive
  /// coupling keeps it at zero or above.
  [[nodiscard]] double energy() const noexcept;
  /// A hand of Exercise::pointers() whose twin follows the same pointer.
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
  deadreckon::ForceModel hand_;  // that a hand of the scene shows
  std::uint64_t seed_;
  std::vector<std::unique_ptr<Twin>> twins_;
  std::vector<peer::Impairment> networks_;  // by receiver, in the order of twins_
  std::uint64_t resets_ = 0;
  std::mutex mutex_;  // of new_law_
  std::optional<peer::ImpairmentLaw> new_law_;
};

}  // namespace reckon::tools
