// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The lead of another peer's clock over ours, measured with the ordinary datagrams in both
// directions: each ends with its send time, and once a second each side sends back when it received
// the other.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "reckon/aoim/groups/epoch_index.hpp"
#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/pdu/reckon/time_exchange.hpp"
#include "reckon/peer/clocks/leap_watch.hpp"
#include "reckon/peer/clocks/least_transit.hpp"

namespace reckon::peer {

/// A peer's clock relative to ours.
struct ClockDifference {
  std::chrono::nanoseconds ahead{0};       ///< theirs minus ours, within round_trip / 2
  std::chrono::nanoseconds round_trip{0};  ///< least transit there plus least transit back
  double drift = 0.0;                      ///< growth of `ahead` [s/s]
};

/// One peer's clock. The least "arrival - sending" of each direction bounds the difference from one
/// side; the estimate is the middle. Its error is half the difference of the two least transits.
/// One thread, no allocation. Times are UTC as in trailers, valid while the clocks are within 35
/// min.
class PeerClock {
 public:
  /// Time without an echo after which nothing is known. Each of 256 peers has its turn in 32 s,
  /// each of 1,024 in 43 s.
  static constexpr std::chrono::nanoseconds kForgotten = std::chrono::seconds(60);
  /// Longest round trip for which an estimate is usable.
  static constexpr std::chrono::nanoseconds kMostRoundTrip = std::chrono::seconds(2);

  /// Records a datagram of the peer: its send time, from its trailer, and its arrival on our clock.
  void receive(std::uint32_t sent, std::chrono::nanoseconds utc,
               std::chrono::nanoseconds now) noexcept;
  /// Takes the peer's echo of a datagram of ours, in a datagram that it sent at `answered` and that
  /// arrived at `utc`. False if it is refused: its times are impossible, or the transit was too
  /// long.
  bool take(const pdu::TimeEcho& echo, std::uint32_t answered, std::chrono::nanoseconds utc,
            std::chrono::nanoseconds now) noexcept;

  /// The estimate; nullopt before the first echo and after the last one has become too old.
  [[nodiscard]] std::optional<ClockDifference> difference(
      std::chrono::nanoseconds now) const noexcept;

 private:
  void note(LeastTransit& way, LeapWatch& watch, std::chrono::nanoseconds difference,
            std::chrono::nanoseconds now) noexcept;

  LeastTransit from_it_, to_it_;
  LeapWatch watch_from_, watch_to_;
  std::optional<std::chrono::nanoseconds> last_echo_;
};

/// The clocks of all peers, by the epoch of their process. Fixed capacity: a new peer replaces the
/// one that was silent for the longest. One thread; allocates only at construction; recording a
/// datagram and a query cost 16 ns for one peer, 30 ns among 1,000.
class PeerClocks {
 public:
  static constexpr std::size_t kCapacity = 1024;
  /// Echoes in one PDU: eight, or as many as it takes to send all in 32 s, up to kMostEchoes.
  static constexpr std::size_t kEchoes = 8, kMostEchoes = 24;
  /// Peers silent for this long are not echoed.
  static constexpr std::chrono::nanoseconds kRecent = std::chrono::seconds(5);

  PeerClocks();

  /// Records a datagram of another peer, which arrived at steady time `now` = UTC `utc`.
  void receive(const pdu::DatagramTrailer& trailer, std::chrono::nanoseconds utc,
               std::chrono::nanoseconds now) noexcept;
  /// Takes an exchange for the process of epoch `own` from a datagram that was already recorded;
  /// counts good echoes and refused ones.
  void take(const pdu::TimeExchange& exchange, std::uint32_t own,
            const pdu::DatagramTrailer& trailer, std::chrono::nanoseconds utc,
            std::chrono::nanoseconds now) noexcept;
  /// Fills in the echoes for the peers whose turn it is; false if there is none. They are stored in
  /// this object until the next call.
  [[nodiscard]] bool fill(pdu::TimeExchange& exchange, std::chrono::nanoseconds now) noexcept;

  /// Lead of a peer's UTC over ours, for its timestamps. Exactly zero if both clocks are stated to
  /// be UTC (`aligned` for us) and the exchanges do not contradict: with a lead of zero, neither
  /// transit is negative, nor longer than the other by both 8 ms and a factor of three. Nullopt if
  /// nothing is known.
  [[nodiscard]] std::optional<std::chrono::nanoseconds> ahead(
      std::uint32_t epoch, bool aligned, std::chrono::nanoseconds now) const noexcept;
  /// The estimate itself.
  [[nodiscard]] std::optional<ClockDifference> difference(
      std::uint32_t epoch, std::chrono::nanoseconds now) const noexcept;

  [[nodiscard]] std::uint64_t taken() const noexcept { return taken_; }
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }

 private:
  struct Row {
    PeerClock clock;
    std::uint32_t sent = 0;   // of its latest datagram
    std::uint32_t heard = 0;  // when that arrived
    std::chrono::nanoseconds last_heard{0};
    bool aligned = false;  // states that its clock is UTC
  };

  [[nodiscard]] std::size_t find(std::uint32_t epoch) const noexcept;
  [[nodiscard]] std::size_t find_or_add(std::uint32_t epoch) noexcept;

  aoim::EpochIndex places_;
  std::vector<std::uint32_t> epochs_;  // by place
  std::vector<Row> rows_;              // by place
  std::size_t turn_ = 0;
  std::array<std::byte, kMostEchoes * pdu::kFixedSize<pdu::TimeEcho>> echoes_{};
  std::uint64_t taken_ = 0;
  std::uint64_t refused_ = 0;
};

}  // namespace reckon::peer
