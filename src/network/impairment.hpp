// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The law by which datagrams are delayed, lost, duplicated and reordered. A pure function: the
// in-process network and the wrapper around a real link make the same decisions from the same seed.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace reckon::peer {

/// A time in which nothing passes, counted from the start of the run; again every `period` if > 0.
struct Outage {
  std::chrono::nanoseconds start{0};
  std::chrono::nanoseconds duration{0};
  std::chrono::nanoseconds period{0};
};

/// What the network does to a datagram. All defaults together are a perfect network.
struct ImpairmentLaw {
  static constexpr double kMostBurstLength = 1e4;  ///< [datagrams]

  std::chrono::nanoseconds delay{0};   ///< every datagram, >= 0
  std::chrono::nanoseconds jitter{0};  ///< delay +- jitter, uniform; never below 0 in sum
  double loss{0.0};                    ///< share lost independently, 0 to 1
  double burst_loss{0.0};              ///< share lost in bursts (Gilbert chain), 0 to below 1
  double burst_length{1.0};            ///< mean length of a burst [datagrams], >= 1
  double reorder{0.0};                 ///< share held back by reorder_delay, 0 to 1
  std::chrono::nanoseconds reorder_delay{std::chrono::milliseconds{5}};
  double duplicate{0.0};        ///< share that arrives twice, 0 to 1
  std::vector<Outage> outages;  ///< set-up only; read, never changed, while running

  /// True if every datagram passes immediately and unchanged.
  [[nodiscard]] bool is_perfect() const noexcept;
  /// A sentence with the value that is out of range; empty if all are valid.
  [[nodiscard]] std::string problem() const;
};

/// `delay` [s] +- `jitter_share` of it, 0 to 1, with the given share lost. Values out of range are
/// reported by problem().
[[nodiscard]] ImpairmentLaw delayed_by(double delay, double jitter_share = 0, double loss = 0);
/// Jitter as a share of the delay; 0 without a delay.
[[nodiscard]] double jitter_share(const ImpairmentLaw& law) noexcept;

/// A law and the seed for its random decisions.
struct ImpairmentConfig {
  ImpairmentLaw law;       ///< all defaults together are a perfect network
  std::uint64_t seed = 1;  ///< equal seeds give equal damage
};

/// The result for one datagram: how many copies arrive (0, 1, 2), and the delay of each.
struct Fate {
  enum class Loss : std::uint8_t { none, random, burst, outage };
  std::uint8_t copies{1};
  Loss loss{Loss::none};
  std::array<std::chrono::nanoseconds, 2> delay{};

  auto operator<=>(const Fate&) const = default;
};

/// One seed for each receiver, so that a multicast datagram lost for one may reach another.
[[nodiscard]] std::uint64_t direction_seed(std::uint64_t seed, std::uint64_t receiver) noexcept;

/// The law with its seed. decide() depends on nothing but its arguments: any order, any thread.
class Impairment {
 public:
  /// @throws std::invalid_argument with law.problem().
  Impairment(const ImpairmentLaw& law, std::uint64_t seed);

  /// The fate of datagram `sequence` (0, 1, 2 ...) of `sender` that enters the network at `time`
  /// since the start of the run. Costs about 12 ns; with bursts some 4 ns more for each of the
  /// burst_length x (1 - burst_loss) datagrams looked back on average, at most kLookBack.
  [[nodiscard]] Fate decide(std::uint64_t sender, std::uint64_t sequence,
                            std::chrono::nanoseconds time) const noexcept;

  [[nodiscard]] const ImpairmentLaw& law() const noexcept { return law_; }

  /// Farthest look back for the state of the burst chain; beyond it the chain counts as good.
  static constexpr std::uint64_t kLookBack = 100'000;

 private:
  [[nodiscard]] bool in_burst(std::uint64_t sender, std::uint64_t sequence) const noexcept;
  [[nodiscard]] bool in_outage(std::chrono::nanoseconds time) const noexcept;
  [[nodiscard]] std::chrono::nanoseconds draw_delay(std::uint64_t key, int copy) const noexcept;

  ImpairmentLaw law_;
  std::uint64_t seed_;
  double enter_{0.0};  ///< probability per datagram of going from good to bad
  double leave_{1.0};  ///< and back
};

}  // namespace reckon::peer
