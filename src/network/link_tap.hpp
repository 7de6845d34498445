// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reports of a link with sockets to a DatagramTap. Private to the network.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "reckon/peer/network/datagram_tap.hpp"
#include "reckon/peer/network/fan_out_link.hpp"

namespace reckon::peer {

/// Passes events on if there is a tap; else does nothing. Threads as for a DatagramTap; no
/// allocation.
class LinkTap {
 public:
  /// @param tap outlives this; may be null
  /// @param framed pool of a FanOutLink around the link: the group of a datagram is then taken from
  /// its frame
  LinkTap(DatagramTap* tap, const std::optional<GroupPool>& framed) : tap_(tap), framed_(framed) {}

  [[nodiscard]] bool is_on() const noexcept { return tap_ != nullptr; }

  /// Reports the fate of a datagram.  @param place its destination
  void note(DatagramTap::Loop loop, DatagramFate fate, const IpEndpoint& place,
            std::span<const std::byte> bytes) noexcept {
    if (tap_ == nullptr) return;
    if (!framed_) return tap_->note(loop, fate, place, bytes);
    const GroupFrame said = group_frame_of(bytes, *framed_);
    tap_->note(loop, fate, said.place ? said.group : place, said.bytes);
  }
  /// Reports a group that was joined or left.  @param asked when the kernel was asked
  /// @param done when it had finished
  void note_membership(DatagramFate change, const GroupAddress& group,
                       std::chrono::nanoseconds asked, std::chrono::nanoseconds done) noexcept {
    if (tap_ == nullptr) return;
    DatagramEvent event;
    event.group = group;
    event.fate = change;
    event.asked = asked;
    event.time = done;
    tap_->push(DatagramTap::Loop::read, event);
  }
  /// Reports the number of datagrams that the kernel dropped before they were read.
  void note_drops(const GroupAddress& group, std::uint32_t count) noexcept {
    if (tap_ == nullptr || count == 0) return;
    DatagramEvent event;
    event.group = group;
    event.fate = DatagramFate::kernel_drops;
    event.count = count;
    tap_->push(DatagramTap::Loop::read, event);
  }

 private:
  DatagramTap* tap_;
  std::optional<GroupPool> framed_;
};

}  // namespace reckon::peer
