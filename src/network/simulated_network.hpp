// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A network inside one process: links with groups, impaired by the common law, driven by a clock of
// the test. The same calls in the same order give the same datagrams, bit for bit.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/impairment.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// Limits of a simulated network; all of it is allocated at construction.
struct SimulatedNetworkOptions {
  std::size_t links{2};
  std::size_t datagrams_in_flight{1024};  ///< to one link; more are counted as overflow
  std::size_t max_payload{1372};          ///< longest payload [octets]; longer ones are refused
  std::size_t max_groups{1024};           ///< joins per link
  std::uint64_t seed{1};                  ///< of the law, for all directions
  bool deliver_own{false};                ///< links receive their own datagrams
  /// Delay after a join before datagrams of the group arrive: a switch that opens the port late.
  std::chrono::nanoseconds join_delay{0};
};

/// The hub. One thread; links must not outlive it. A datagram reaches the links that are joined to
/// its group both when it is sent and when it arrives, or the link with its destination endpoint.
class SimulatedNetwork {
 public:
  /// `clock` must outlive the network; its time at construction is the start of the run.
  SimulatedNetwork(const SimulatedNetworkOptions& options, const Clock& clock);
  ~SimulatedNetwork();

  /// Link `index`, 0 <= index < options.links (assert). Its endpoint is 198.18.0.1 + index, port
  /// 3000.
  [[nodiscard]] Link& link(std::size_t index) noexcept;

  /// The law for every direction. Set-up only; throws std::invalid_argument (Impairment).
  void impair(const ImpairmentLaw& law);
  /// The law from `sender` to `receiver`.
  void impair(std::size_t sender, std::size_t receiver, const ImpairmentLaw& law);

  /// Datagrams in flight. When the next one arrives, by the clock; nanoseconds::max() if none.
  [[nodiscard]] std::size_t in_flight() const noexcept;
  [[nodiscard]] std::chrono::nanoseconds next_arrival() const noexcept;
  /// Datagrams in flight to a link that left their group: no kernel hands them to a closed socket,
  /// and no other counter has them.
  [[nodiscard]] std::uint64_t arrived_after_leaving() const noexcept;

 private:
  class Port;
  struct Hub;
  std::unique_ptr<Hub> hub_;
};

}  // namespace reckon::peer
