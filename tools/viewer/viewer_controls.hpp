// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a page may change in the exercise that serves it: the one way in, for who knows the word of
// this start.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "reckon/tools/viewer/protocol/page_request.hpp"

namespace reckon::tools {

/// Called by the viewer's thread, with requests that are checked already: numbers are finite and in
/// their ranges. Nothing here may wait for a loop of a peer.
class ViewerControls {
 public:
  using Watcher = std::uint64_t;  ///< number of a tab; never the same twice
  struct HandAnswer {
    std::optional<std::uint16_t>
        hand;          ///< index among the program's hands; none: there is none free
    std::string text;  ///< a sentence for the user
  };

  /// A tab asks for a hand; asked again, it gets the same.
  virtual HandAnswer take_hand(Watcher watcher) = 0;
  /// It gives it back, or was closed; nothing where it has none.
  virtual void give_hand(Watcher watcher) = 0;
  /// Where the tab's hand is to go; nothing where the hand is another's.
  virtual void point(Watcher watcher, const PointerRequest& request,
                     std::chrono::nanoseconds now) = 0;
  /// @return a sentence: what the network does from now on
  virtual std::string set_network(const NetworkRequest& request) = 0;
  /// What the network does now.
  [[nodiscard]] virtual NetworkRequest network() const { return {}; }

 protected:
  ~ViewerControls() = default;
};

}  // namespace reckon::tools
