// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Lets pages take over hands that follow pointers, change the network between the peers of this
// program, and let its bodies go on alone.
#pragma once

#include <atomic>
#include <cstddef>
#include <deque>
#include <functional>
#include <string>

#include "reckon/peer/network/impairment.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"
#include "reckon/tools/viewer/viewer_controls.hpp"

namespace reckon::tools {

/// Called by the viewer's thread, except add_hand(), is_free() and set_rests().
class ViewControls final : public ViewerControls {
 public:
  using ChangeNetwork = std::function<void(const peer::ImpairmentLaw&)>;
  using GoAlone = std::function<void()>;

  /// @param law impairment at the start; values that a page does not set are kept
  /// @param change null: there is no network to change
  /// @param go_alone called only while the bodies rest
  ViewControls(peer::ImpairmentLaw law, ChangeNetwork change, GoAlone go_alone);

  /// Call it before the first page connects. @param index of the hand among the program's hands
  void add_hand(std::size_t index, const PointerHand& pointer);
  /// Any thread: whether no page has this hand; false for a hand that follows no pointer.
  [[nodiscard]] bool is_free(std::size_t index) const;
  /// Any thread: whether the bodies rest, see PeerView::bodies_rest.
  void set_rests(bool rests) noexcept { rests_.store(rests, std::memory_order_relaxed); }

  HandAnswer take_hand(Watcher watcher) override;
  void give_hand(Watcher watcher) override;
  void point(Watcher watcher, const PointerRequest& request, std::chrono::nanoseconds now) override;
  std::string set_network(const NetworkRequest& request) override;
  std::string go_alone() override;
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
  GoAlone go_alone_;
  std::atomic<bool> rests_{false};
  NetworkRequest network_;
  std::deque<Hand> hands_;
};

}  // namespace reckon::tools
