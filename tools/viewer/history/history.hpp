// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The datagrams of the last minute, or of a whole capture, and now and then the world as it was
// when they came: so that any instant can be shown again without looking at all that was before it.
#pragma once

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
  /// How long what was received is kept; none: all of it, until `octets` are full.
  std::optional<std::chrono::nanoseconds> span = std::chrono::seconds(60);
  /// Of datagrams and worlds. A live history that would take more is shorter.
  std::size_t octets = std::size_t{64} << 20;
  std::size_t entities = 16384;          ///< shown at most; below kNoNumber
  std::optional<std::uint8_t> exercise;  ///< alone; none: all
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
    std::uint64_t segment_ = 0;  // number of the one whose datagrams are being taken
    std::size_t next_ = 0;       // of them
  };

  explicit History(const HistoryOptions& options);

  /// A datagram, in the order of arrival. @return false where it found no room: a history without a
  /// span is full
  bool take(const peer::SourceDatagram& datagram);
  /// Time has come to `now`: samples are added, and what is too old is forgotten.
  void pass(std::chrono::nanoseconds now);
  /// Says when the source began, where that is before its first datagram.
  void begin_at(std::chrono::nanoseconds time);

  /// The world after all that was received.
  [[nodiscard]] const ReceivedWorld& live() const noexcept { return live_; }
  [[nodiscard]] Roster& roster() noexcept { return roster_; }
  [[nodiscard]] const Roster& roster() const noexcept { return roster_; }
  [[nodiscard]] const TrafficNumbers& numbers() const noexcept { return numbers_; }

  /// When the source began; zero before that is known.
  [[nodiscard]] std::chrono::nanoseconds start() const noexcept { return start_.value_or(Time{}); }
  /// The first and the last instant that can be shown.
  [[nodiscard]] std::chrono::nanoseconds begin() const noexcept;
  [[nodiscard]] std::chrono::nanoseconds end() const noexcept { return end_; }

  /// The world at `time`, cut to begin(); from `cursor` on where that is on the way, else from the
  /// world kept before `time`. Makes a cursor where there is none. Up to some 50 ms.
  void seek(std::unique_ptr<Cursor>& cursor, std::chrono::nanoseconds time);
  /// The first datagram's time after `time`, and the last one's before it.
  [[nodiscard]] std::optional<std::chrono::nanoseconds> update_after(
      std::chrono::nanoseconds time) const;
  [[nodiscard]] std::optional<std::chrono::nanoseconds> update_before(
      std::chrono::nanoseconds time) const;

  /// Octets that are held, about.
  [[nodiscard]] std::size_t weight() const noexcept { return weight_; }

 private:
  using Time = std::chrono::nanoseconds;
  struct Entry {
    Time at{};  // rises
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
    std::size_t kept = 0;  // octets of `world`, about
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
  std::optional<Time> start_;
  Time end_{};
};

}  // namespace reckon::tools
