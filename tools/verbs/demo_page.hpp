// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The page of a demo: shows all its hands, which pages may take over, and its network, which they
// may change.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tools/exercise/exercise.hpp"
#include "reckon/tools/exercise/hand_twins.hpp"
#include "reckon/tools/verbs/view_controls.hpp"
#include "reckon/tools/viewer/self_view.hpp"

namespace reckon::tools {

/// If the scene has no pointer hand, makes each of its hands one; its operator moves it while no
/// pointer is active. A hand whose grip has no damping is left unchanged, because it would
/// oscillate.
void let_pages_move_hands(peer::SceneFile& scene, std::size_t peers);

struct DemoPageOptions {
  std::string source;        ///< the scene, as named
  std::string iface;         ///< interface of the peers
  double raw_bit_per_s = 0;  ///< rate without dead reckoning
};

/// One thread, the one that runs the exercise.
class DemoPage {
 public:
  /// Least interval between log lines about resets of twins.
  static constexpr std::chrono::seconds kTellEvery{5};

  /// @param exercise outlives this; its hands have IDs. @param twins of its hands, outlive this
  /// @throws as SelfView
  DemoPage(const ViewFlags& flags, const peer::SceneFile& scene, const DemoPageOptions& options,
           Exercise& exercise, HandTwins& twins);

  /// A step of a servo; peer and device are numbered from 0.
  void take(std::size_t peer, std::size_t device, const haptics::ServoSnapshot& step) {
    view_.hands().take(first_[peer] + device, step);
  }
  /// Shows the present state of the hands.
  void show(Exercise& exercise);
  void note(const ReceivedNotice& heard) { view_.note(heard.notice.text.data()); }
  [[nodiscard]] const SelfView& view() const noexcept { return view_; }

 private:
  [[nodiscard]] std::vector<std::size_t> add_pointers(const Exercise& exercise);
  void mark_pointers(OwnHands& hands) const;
  void show_twins(const Exercise& exercise);
  void report_lost(std::chrono::nanoseconds now);
  [[nodiscard]] OwnHands hands_of(const Exercise& exercise, const peer::SceneFile& scene) const;

  HandTwins& twins_;
  ViewControls controls_;              // used by the page, so declared before it
  std::vector<std::size_t> first_;     // index of each peer's first hand
  std::vector<std::size_t> pointers_;  // hands that pages may move
  std::uint64_t told_resets_ = 0;      // reported so far
  std::chrono::nanoseconds told_at_ = -kTellEvery;
  SelfView view_;
};

}  // namespace reckon::tools
