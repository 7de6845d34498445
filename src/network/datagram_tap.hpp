// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reports the fate of each datagram from the loops to a reader that keeps the balance
// (DatagramBalance), so that every missing datagram has a known reason. Off unless a program
// requests it.
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

/// Fate of a datagram, or an event of a group's socket. An arrived datagram gets exactly one of the
/// fates from lost_by_law on, and one more for each copy that the impairment made of it.
enum class DatagramFate : std::uint8_t {
  // Out: numbered + copied_to_list = sent + sealed + the reasons for not sending.
  numbered,        ///< the model loop gave it the next number of its group
  sent,            ///< the kernel took it
  held_back,       ///< it would have waited too long for the wire
  send_error,      ///< the kernel refused it
  write_overflow,  ///< no room in the ring towards the network
  stale_unsent,  ///< it was pending for more than 1 s, for example while the process was suspended
  withheld,      ///< a mechanism of the peer refused it
  copied_to_list,  ///< a copy for another address of a list
  to_nobody,       ///< the list has no other address
  sealed,          ///< it was sent in an envelope, which has its own number
  unsealable,      ///< the numbers of envelopes are used up
  // Sockets of groups.
  joined,        ///< not before `asked`, and certainly from `time` on
  left,          ///< between `asked` and `time`; datagrams pending there are reported as `unread`
  kernel_drops,  ///< `count` were dropped by a full buffer
  // In.
  arrived,         ///< the kernel handed it over, copies included
  copied_by_law,   ///< the impairment made a copy of it
  lost_by_law,     ///< the impairment lost it
  queue_overflow,  ///< the impairment had no room for it
  not_listened,    ///< of a list: sent to a group that is not joined
  opened,          ///< an envelope; its content arrives under its own number
  held,            ///< an envelope whose sender has to answer first; its content may arrive then
  greeting,        ///< an envelope of the protocol between links
  not_opened,      ///< no envelope of this group, or received before
  unread,          ///< pending in a group that was left, or when the peer ended
  stale,           ///< read more than 1 s after it had arrived
  muted,           ///< of a flooding sender
  refused,         ///< not of this exercise, or sealed
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
  stranger,  ///< of a sender that has not announced itself yet
  unicast,   ///< sent to this host alone
};
inline constexpr std::size_t kFates = static_cast<std::size_t>(DatagramFate::unicast) + 1;

/// As in the JSON: "lost_by_law".
[[nodiscard]] std::string_view name(DatagramFate fate) noexcept;

/// One event.
struct DatagramEvent {
  GroupAddress group;
  std::uint64_t epoch = 0;  ///< epoch of the sender, or boot of its envelopes; 0: it has no number
  std::uint32_t sequence =
      0;                    ///< its number in the group; of an envelope in the stream, modulo 2^32
  std::uint8_t stream = 0;  ///< 0: numbered by its trailer; n: stream n - 1 of its envelopes
  std::uint32_t count = 1;  ///< of kernel_drops
  std::int32_t lost = 0;    ///< change of the sequence tracker's count of losses
  /// For joined and left: when the kernel was asked, and when it had finished, by the link's clock.
  std::chrono::nanoseconds asked{0}, time{0};
  DatagramFate fate = DatagramFate::numbered;
  /// Verdict of the sequence tracker, if it was asked.
  std::optional<aoim::SequenceVerdict> verdict;
};

/// Puts epoch, sequence and stream of an envelope into `out`; false if the octets are no envelope.
using EnvelopeNumber = bool (*)(std::span<const std::byte> octets, DatagramEvent& out) noexcept;

/// From the loops of one peer to one reader. Three threads write, with one queue each; wait-free,
/// no allocation after construction; 14 ns an event. Events without room are counted as missed:
/// then the sums are wrong.
class DatagramTap {
 public:
  /// The loop whose thread writes.
  enum class Loop : std::uint8_t { model, write, read };

  /// @param events room for each loop: as many as come between two calls of the reader
  explicit DatagramTap(std::size_t events = std::size_t{1} << 14);

  /// Sets the reader of envelopes, if there are any. Call it before the loops begin.
  void read_envelopes_by(EnvelopeNumber reader) noexcept { envelope_number_ = reader; }

  /// The event of a whole datagram; its trailer or envelope identifies the sender.
  [[nodiscard]] DatagramEvent event_of(DatagramFate fate, const GroupAddress& group,
                                       std::span<const std::byte> octets) const noexcept;
  void note(Loop loop, DatagramFate fate, const GroupAddress& group,
            std::span<const std::byte> octets) noexcept {
    push(loop, event_of(fate, group, octets));
  }
  void push(Loop loop, const DatagramEvent& event) noexcept;

  /// For the reader: takes the next event, events of the model loop first. This order means that
  /// only the most recent datagrams can appear to be used before they arrived. False if there is
  /// none.
  bool pop(DatagramEvent& event) noexcept;
  /// Events without room. Any thread.
  [[nodiscard]] std::uint64_t missed() const noexcept;

 private:
  EnvelopeNumber envelope_number_ = nullptr;
  std::array<haptics::SpscRing<DatagramEvent>, 3> rings_;
};

}  // namespace reckon::peer
