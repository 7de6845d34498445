// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Content and rate of an entity's updates for a receiver: one table by distance, which is stretched
// to fit the octets that the receiver can take.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace reckon::aoim {

/// Content of an update on a channel.
enum class Body : std::uint8_t {
  rigid,        ///< position and orientation
  approximate,  ///< also size and the main articulations
  full,         ///< everything
};

/// One row: a channel for entities up to a distance.
struct Channel {
  double farthest = 0.0;  ///< [m], >= 0; of the last row often infinite
  Body body = Body::full;
  double active_hz = 0.0;   ///< of entities that move by themselves [1/s], >= 0
  double passive_hz = 0.0;  ///< of entities that change only by events [1/s], >= 0
  double octets = 0.0;      ///< of an update on the wire, > 0
  /// Independent of the budget, such as contact: its distance is not stretched.
  bool kept = false;
  /// If the inner rows have tiers: factor on the owner's thresholds of place and turn, >= 1; no row
  /// has a smaller one than the row before it.
  double coarser = 1.0;
};

/// Contact within 1 m at 1 kHz; full bodies to 50 m at 30 Hz, approximate ones to 200 m at 10 Hz,
/// rigid ones beyond at 1 Hz; passive ones at a heartbeat of 1/5 Hz. Octets as in wire_format.md.
/// Thresholds are 1, 1, 4 and 16 times as wide: the same angle at the far end of the row.
[[nodiscard]] std::span<const Channel> default_channels() noexcept;

/// One remote entity as a client of channels.
struct ChannelClient {
  double distance = 0.0;  ///< to the nearest focus [m]; NaN counts as infinite
  bool active = true;
};

/// Result of fitting to a budget.
struct ChannelBudget {
  /// Factor on distances, >= 1: the least that meets the budget.
  double stretch = 1.0;
  double octets_per_second = 0.0;  ///< of all clients with it
  bool met = true;                 ///< false: the kept rows and the last row alone take more
};

/// The table. One thread; allocates only in fit(), if there are more clients than ever before.
class ChannelTable {
 public:
  /// @throws std::invalid_argument for a table without rows, distances that do not grow, kept rows
  /// after others, rates or octets out of range, or a row with more octets a second than the row
  /// before it.
  explicit ChannelTable(std::span<const Channel> channels = default_channels());

  /// The row for a distance; size() beyond the last row.
  [[nodiscard]] std::size_t row(double distance, double stretch = 1.0) const noexcept;
  [[nodiscard]] const Channel& channel(std::size_t row) const noexcept { return channels_[row]; }
  [[nodiscard]] std::size_t size() const noexcept { return channels_.size(); }
  /// Number of kept rows, which come first.
  [[nodiscard]] std::size_t kept_rows() const noexcept { return kept_rows_; }
  /// Number of rows that are neither kept nor the last. Each may have a recipient tier.
  [[nodiscard]] std::size_t inner_rows() const noexcept {
    return size() > kept_rows_ ? size() - kept_rows_ - 1 : 0;
  }

  /// Octets a second of one client.
  [[nodiscard]] double rate(const ChannelClient& client, double stretch = 1.0) const noexcept;
  /// The least stretch by which all clients together take at most `octets_per_second`. All move
  /// outwards by the same factor, so nearer ones never get less than farther ones. Cost: clients x
  /// rows, sorted.
  [[nodiscard]] ChannelBudget fit(std::span<const ChannelClient> clients, double octets_per_second);

 private:
  /// The stretch from which a client is in the next row.
  struct Passage {
    double stretch;
    double saved;  // octets a second
  };

  std::vector<Passage> passages_;  // of the last fit()
  std::vector<Channel> channels_;
  std::size_t kept_rows_ = 0;
};

}  // namespace reckon::aoim
