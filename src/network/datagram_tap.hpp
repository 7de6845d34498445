// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What becomes of each datagram, reported by the loops as it happens to whoever keeps the balance
// (DatagramBalance): so that not one can be missing without a reason. Off unless a program asks.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "reckon/aoim/groups/sequence_tracker.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// What befell a datagram, or the socket of a group. One that arrived has exactly one of those from
/// lost_by_law on, and one more for each copy that the law made of it.
enum class DatagramFate : std::uint8_t {
  // Out: numbered + copied_to_list = sent + sealed + the reasons not to go.
  numbered,        ///< the model loop gave it the next number of its group
  sent,            ///< the kernel took it
  held_back,       ///< it would have waited too long for the wire
  send_error,      ///< the kernel refused it
  write_overflow,  ///< no room in the ring towards the network
  stale_unsent,    ///< it had waited for more than 1 s, as while the process stood still
  copied_to_list,  ///< one more of it goes to another address of a list
  to_nobody,       ///< the list names nobody else
  sealed,          ///< it went on in an envelope, which has a number of its own
  unsealable,      ///< the envelopes' numbers are at their end
  // Sockets of groups.
  joined,        ///< from `asked` on at the soonest, from `time` on surely
  left,          ///< between `asked` and `time`; what still waited there is reported as `unread`
  kernel_drops,  ///< `count` were dropped for want of room
  // In.
  arrived,         ///< the kernel gave it to us, copies included
  copied_by_law,   ///< the impairment made another of it
  lost_by_law,     ///< the impairment lost it
  queue_overflow,  ///< the impairment had no room for it
  not_listened,    ///< of a list: said to a group that is not joined
  opened,          ///< an envelope; what was in it arrives under its own number
  held,            ///< an envelope whose sender has to answer first: what is in it may arrive then
  greeting,        ///< an envelope of what links say to each other
  not_opened,      ///< no envelope of this group, or one that had come before
  unread,          ///< it waited in a group that was left, or when the peer ended
  stale,           ///< read more than 1 s after it had arrived
  muted,           ///< of a sender that floods
  refused,         ///< no datagram of this exercise, or a sealed one
  too_long,        ///< longer than any peer sends
  delivered,       ///< its PDUs are read
  own,             ///< this and the next ones: see aoim::IncomingVerdict
  not_joined,
  other_scene,
  former_life,
  duplicate,
  too_old,
  other_exercise,
  impostor,
  stranger,  ///< of who has not announced itself yet
  unicast,   ///< sent to this host alone
};
inline constexpr std::size_t kFates = static_cast<std::size_t>(DatagramFate::unicast) + 1;

/// As in the JSON: "lost_by_law".
[[nodiscard]] std::string_view name(DatagramFate fate) noexcept;

/// One of them.
struct DatagramEvent {
  GroupAddress group;
  std::uint64_t epoch = 0;  ///< of the sender's life, or boot of its envelopes; 0: it has no number
  std::uint32_t sequence =
      0;                    ///< its number in the group; of an envelope in the stream, modulo 2^32
  std::uint8_t stream = 0;  ///< 0: numbered by its trailer; n: stream n - 1 of its envelopes
  std::uint32_t count = 1;  ///< of kernel_drops
  std::int32_t lost = 0;    ///< by how much it changed what the sequence tracker counts as lost
  /// Of joined and left: when the kernel was asked to, and when it had done so, by the link's
  /// clock.
  std::chrono::nanoseconds asked{0}, time{0};
  DatagramFate fate = DatagramFate::numbered;
  /// What the sequence tracker said of its number, where it was asked.
  std::optional<aoim::SequenceVerdict> verdict;
};

/// Puts epoch, sequence and stream of an envelope into `out`; false where the octets are none.
using EnvelopeNumber = bool (*)(std::span<const std::byte> octets, DatagramEvent& out) noexcept;

/// From the loops of one peer to one reader. Three threads write, one each; wait-free, no
/// allocation after construction; 14 ns an event. What finds no room is counted: then nothing
/// adds up.
class DatagramTap {
 public:
  /// The loop whose thread writes.
  enum class Loop : std::uint8_t { model, write, read };

  /// @param events that fit from each loop: as many as come between two looks of the reader
  explicit DatagramTap(std::size_t events = std::size_t{1} << 14);

  /// How envelopes are read, where there are some. Before the loops begin.
  void read_envelopes_by(EnvelopeNumber reader) noexcept { envelope_number_ = reader; }

  /// Of a whole datagram: its trailer or envelope says whose it is.
  [[nodiscard]] DatagramEvent event_of(DatagramFate fate, const GroupAddress& group,
                                       std::span<const std::byte> octets) const noexcept;
  void note(Loop loop, DatagramFate fate, const GroupAddress& group,
            std::span<const std::byte> octets) noexcept {
    push(loop, event_of(fate, group, octets));
  }
  void push(Loop loop, const DatagramEvent& event) noexcept;

  /// Reader: the next event, those of the model loop first, so that nothing is seen to be used
  /// before it has arrived by more than what came meanwhile. False where there is none.
  bool pop(DatagramEvent& event) noexcept;
  /// Events that found no room. Any thread.
  [[nodiscard]] std::uint64_t missed() const noexcept;

 private:
  EnvelopeNumber envelope_number_ = nullptr;
  std::array<haptics::SpscRing<DatagramEvent>, 3> rings_;
};

}  // namespace reckon::peer
