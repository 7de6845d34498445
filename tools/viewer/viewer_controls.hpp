// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Interface by which a page changes the exercise that serves it; only for pages with this start's
// access word.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "reckon/tools/viewer/protocol/page_request.hpp"

namespace reckon::tools {

/// Called by the viewer's thread, with checked requests: numbers are finite and in their ranges.
/// The functions must not wait for a loop of a peer.
class ViewerControls {
 public:
  using Watcher = std::uint64_t;  ///< unique number of a tab
  struct HandAnswer {
    std::optional<std::uint16_t> hand;  ///< index among the program's hands; none: none is free
    std::string text;                   ///< a sentence for the user
  };

  /// Assigns a hand to a tab; a repeated call returns the same hand.
  virtual HandAnswer take_hand(Watcher watcher) = 0;
  /// Releases the hand of a tab, if it has one; also called when the tab is closed.
  virtual void give_hand(Watcher watcher) = 0;
  /// Moves the tab's hand; ignored if the hand belongs to another tab.
  virtual void point(Watcher watcher, const PointerRequest& request,
                     std::chrono::nanoseconds now) = 0;
  /// @return a sentence about the new impairment
  virtual std::string set_network(const NetworkRequest& request) = 0;
  /// Lets the bodies go on without the missing peers, if they rest.
  /// @return a sentence for the user
  virtual std::string go_alone() = 0;
  /// The present impairment.
  [[nodiscard]] virtual NetworkRequest network() const { return {}; }

 protected:
  ~ViewerControls() = default;
};

}  // namespace reckon::tools
