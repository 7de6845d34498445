// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The datagrams of the last minute, or of a whole capture, with snapshots of the world at
// intervals. Any instant can be shown by replay from the snapshot before it.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "reckon/peer/capture/datagram_source.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"
#include "reckon/tools/viewer/history/received_world.hpp"
#include "reckon/tools/viewer/history/roster.hpp"
#include "reckon/tools/viewer/history/traffic_numbers.hpp"

namespace reckon::tools {

struct HistoryOptions {
  /// How long received datagrams are kept; none: all, until `octets` are full.
  std::optional<std::chrono::nanoseconds> span = std::chrono::seconds(60);
  /// Limit of datagrams and snapshots. A live history that would exceed it is shortened.
  std::size_t octets = std::size_t{64} << 20;
  std::size_t entities = 16384;          ///< limit of shown entities; below kNoNumber
  std::optional<std::uint8_t> exercise;  ///< only this exercise; none: all
  bool lenient = false;                  ///< as DatagramInspector
  deadreckon::ConvergenceSettings convergence;
  GroupTiers tiers;
};

/// One thread. Allocates within its bounds.
class History {
 public:
  /// A world at some instant of the history.
  class Cursor {
   public:
    [[nodiscard]] const ReceivedWorld& world() const noexcept { return world_; }
    [[nodiscard]] std::chrono::nanoseconds time() const noexcept { return time_; }

   private:
    friend class History;
    explicit Cursor(const ReceivedWorld& world) : world_(world) {}
    ReceivedWorld world_;
    std::chrono::nanoseconds time_{};
    std::uint64_t segment_ = 0;  // number of the segment that is being replayed
    std::size_t next_ = 0;       // its next entry
  };

  explicit History(const HistoryOptions& options);

  /// Takes a datagram, in the order of arrival. @return false if it found no room: a history
  /// without a span is full
  bool take(const peer::SourceDatagram& datagram);
  /// Advances the time to `now`: adds samples, and drops old segments.
  void pass(std::chrono::nanoseconds now);
  /// Sets the start of the source, if it is before the first datagram.
  void begin_at(std::chrono::nanoseconds time);

  /// The world after all received datagrams.
  [[nodiscard]] const ReceivedWorld& live() const noexcept { return live_; }
  [[nodiscard]] Roster& roster() noexcept { return roster_; }
  [[nodiscard]] const Roster& roster() const noexcept { return roster_; }
  [[nodiscard]] const TrafficNumbers& numbers() const noexcept { return numbers_; }

  /// Start of the source; zero while unknown.
  [[nodiscard]] std::chrono::nanoseconds start() const noexcept { return start_.value_or(Time{}); }
  /// The instant at which the world is shown for `time`: of a whole capture at the earliest that of
  /// its first entity, so that no picture is empty before it.
  [[nodiscard]] std::chrono::nanoseconds peopled(std::chrono::nanoseconds time) const noexcept {
    return options_.span ? time : std::max(time, first_entity_.value_or(time));
  }
  /// The first and the last instant that can be shown.
  [[nodiscard]] std::chrono::nanoseconds begin() const noexcept;
  [[nodiscard]] std::chrono::nanoseconds end() const noexcept { return end_; }

  /// Moves `cursor` to the world at `time`, limited to begin(): forward from `cursor` if possible,
  /// else from the snapshot before `time`. Creates a missing cursor. Up to some 50 ms.
  void seek(std::unique_ptr<Cursor>& cursor, std::chrono::nanoseconds time);
  /// Time of the first datagram after `time`, and of the last one before it.
  [[nodiscard]] std::optional<std::chrono::nanoseconds> update_after(
      std::chrono::nanoseconds time) const;
  [[nodiscard]] std::optional<std::chrono::nanoseconds> update_before(
      std::chrono::nanoseconds time) const;

  /// Octets held, approximately.
  [[nodiscard]] std::size_t weight() const noexcept { return weight_; }

 private:
  using Time = std::chrono::nanoseconds;
  struct Entry {
    Time at{};  // non-decreasing
    Time time{};
    std::size_t offset = 0, size = 0;
    std::uint64_t frame = 0;
    peer::IpEndpoint source;
    peer::GroupAddress group;
    peer::Portion portion{};
  };
  struct Segment {
    explicit Segment(const ReceivedWorld& before) : world(before) {}
    ReceivedWorld world;  // before its first datagram
    Time first{};
    std::vector<Entry> entries;
    std::vector<std::byte> octets;
    std::size_t pdus = 0;
    std::size_t kept = 0;  // octets of `world`, approximately
    [[nodiscard]] std::size_t weight() const noexcept;
  };

  [[nodiscard]] Segment& segment_for(Time at, std::size_t size);
  [[nodiscard]] bool is_long(const Segment& segment, Time at) const noexcept;
  void forget_old(Time now);
  void drop_first();
  void replay(Cursor& cursor, const Segment& segment, Time time);
  [[nodiscard]] const Segment* segment_at(std::uint64_t number) const noexcept;
  [[nodiscard]] std::uint64_t number_for(Time time) const noexcept;

  HistoryOptions options_;
  Roster roster_;
  ReceivedWorld live_;
  TrafficNumbers numbers_;
  DatagramInspector inspector_;
  std::deque<std::unique_ptr<Segment>> segments_;
  std::uint64_t first_number_ = 0;  // of segments_.front()
  std::size_t weight_ = 0;
  std::optional<Time> start_, first_entity_;
  Time end_{};
};

}  // namespace reckon::tools
