// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// All clocks of the model loop: its own UTC, the clocks of the other peers, and the exchange that
// measures them.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/pdu/reckon/time_exchange.hpp"
#include "reckon/peer/clocks/peer_clock.hpp"
#include "reckon/peer/clocks/sender_clock.hpp"
#include "reckon/peer/clocks/steady_utc.hpp"
#include "reckon/peer/clocks/transit_times.hpp"
#include "reckon/peer/counters/counters.hpp"

namespace reckon::peer {

/// One peer's time. One thread (the model loop's); allocates only at construction.
class TimeKeeper {
 public:
  /// @param epoch of this process. @param counters outlives the keeper.
  TimeKeeper(std::uint32_t epoch, std::uint8_t exercise, Counters& counters);

  /// Begins a pass: `host_utc` is the host's clock at `now`.
  void begin(std::chrono::nanoseconds now, std::chrono::nanoseconds host_utc) noexcept;

  /// UTC of this pass, without a jump.
  [[nodiscard]] std::chrono::nanoseconds utc() const noexcept { return utc_; }
  /// Whether that is the host's UTC.
  [[nodiscard]] bool is_aligned() const noexcept { return steady_utc_.is_aligned(); }
  /// The DIS timestamp of an instant of utc(): absolute while aligned.
  [[nodiscard]] std::uint32_t stamp(std::chrono::nanoseconds utc) const noexcept;
  /// A jump of the host's clock found in this pass [s].
  [[nodiscard]] std::optional<double> leap() const noexcept;

  /// Records a datagram that arrived at steady time `arrival`, at or before this pass. Returns the
  /// knowledge of its sender's clock.  @param trailer epoch 0 = plain DIS.
  /// @param datagram its octets if it may contain an exchange (base group), else empty.
  ClockEvidence receive(const pdu::DatagramTrailer& trailer, std::span<const std::byte> datagram,
                        std::chrono::nanoseconds arrival) noexcept;

  /// Knowledge of a peer's clock, for its states that another peer relays.
  [[nodiscard]] ClockEvidence evidence(std::uint32_t epoch) const noexcept;

  /// Fills in the exchange for our next announcement; false if it has no content. Its echoes are
  /// valid until the next call.
  [[nodiscard]] bool echo(const pdu::SimulationAddress& own, pdu::TimeExchange& exchange) noexcept;

  [[nodiscard]] const PeerClocks& peers() const noexcept { return peers_; }
  /// Transit times of all received datagrams; any thread may read them.
  [[nodiscard]] const TransitTimes& transits() const noexcept { return transits_; }

 private:
  std::uint32_t epoch_;
  std::uint8_t exercise_;
  std::chrono::nanoseconds now_{0};
  std::chrono::nanoseconds utc_{0};
  SteadyUtc steady_utc_;
  PeerClocks peers_;
  TransitTimes transits_;

  Counter& clock_leaps_;
  Counter& exchanges_;
  Counter& exchanges_refused_;
};

}  // namespace reckon::peer
