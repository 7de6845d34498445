// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What pages may do in an exercise of this program: take hands that follow pointers, and change the
// network between its peers.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>

#include "reckon/peer/network/impairment.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"
#include "reckon/tools/viewer/viewer_controls.hpp"

namespace reckon::tools {

/// All by the viewer's thread, but add_hand() and is_free().
class ViewControls final : public ViewerControls {
 public:
  using ChangeNetwork = std::function<void(const peer::ImpairmentLaw&)>;

  /// @param law what the network does at the start; what a page does not set is kept
  /// @param change may be null: then there is no network to change
  ViewControls(peer::ImpairmentLaw law, ChangeNetwork change);

  /// Before pages come. @param index of the hand among those of the program
  void add_hand(std::size_t index, const PointerHand& pointer);
  /// Any thread: whether no page has this hand; false for one that follows no pointer.
  [[nodiscard]] bool is_free(std::size_t index) const;

  HandAnswer take_hand(Watcher watcher) override;
  void give_hand(Watcher watcher) override;
  void point(Watcher watcher, const PointerRequest& request, std::chrono::nanoseconds now) override;
  std::string set_network(const NetworkRequest& request) override;
  [[nodiscard]] NetworkRequest network() const override { return network_; }

 private:
  struct Hand {
    Hand(std::size_t hand_index, const PointerHand& followed)
        : index(hand_index), pointer(followed) {}
    std::size_t index;
    PointerHand pointer;
    std::atomic<Watcher> owner{kNobody};
  };
  static constexpr Watcher kNobody = ~Watcher{0};

  peer::ImpairmentLaw law_;
  ChangeNetwork change_;
  NetworkRequest network_;
  std::deque<Hand> hands_;
};

}  // namespace reckon::tools
