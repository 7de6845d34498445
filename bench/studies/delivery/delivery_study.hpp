// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The study of assured interactions: whole peers over a simulated network, in simulated time.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace reckon::bench {

/// A run: one sender, kReceivers receivers; each peer moves an entity.
struct DeliveryOptions {
  double loss = 0.0;  ///< share, in each direction
  std::chrono::nanoseconds length = std::chrono::seconds(60);
  std::uint64_t seed = 1;
};
inline constexpr std::size_t kReceivers = 3;

/// Results at the receivers.
struct Deliveries {
  double loss = 0.0;
  std::size_t sent = 0;     ///< assured interactions
  std::size_t missed = 0;   ///< of sent times kReceivers: not received
  std::size_t doubled = 0;  ///< received again
  double p50_ms = 0.0, p99_ms = 0.0, max_ms = 0.0;
  double transmissions = 0.0;       ///< of the sender, for each assured interaction
  double best_effort_lost = 0.0;    ///< share
  double age_p99_ms = 0.0;          ///< of poses, with the assured interactions
  double age_without_p99_ms = 0.0;  ///< .. and without
};

/// Two runs of the same motions, with and without the assured interactions.
[[nodiscard]] Deliveries measure_deliveries(const DeliveryOptions& options);

}  // namespace reckon::bench
