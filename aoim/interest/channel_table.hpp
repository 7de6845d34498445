// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How much of an entity a receiver gets and how often: one table by distance, and the same table by
// the octets that the receiver can take.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace reckon::aoim {

/// What an update on a channel holds.
enum class Body : std::uint8_t {
  rigid,        ///< position and orientation
  approximate,  ///< also size and the main articulations
  full,         ///< everything
};

/// One row: a channel for entities up to a distance.
struct Channel {
  double farthest = 0.0;  ///< [m], >= 0; of the last row often infinite
  Body body = Body::full;
  double active_hz = 0.0;   ///< updates a second of who moves by itself, >= 0
  double passive_hz = 0.0;  ///< of who changes by events alone, >= 0
  double octets = 0.0;      ///< of an update on the wire, > 0
  /// Given whatever the budget, such as contact: distances are not stretched.
  bool kept = false;
  /// With near groups: the owner's thresholds of place and turn count so many times as wide to
  /// them, >= 1; no row has less than the one before it.
  double coarser = 1.0;
};

/// Contact within 1 m at 1 kHz; full bodies to 50 m at 30 Hz, approximate ones to 200 m at 10 Hz,
/// rigid ones beyond at 1 Hz; passive ones at a heartbeat of 1/5 Hz. Octets as in wire_format.md.
/// Thresholds are 1, 1, 4 and 16 times as wide: what the same angle is at the far end.
[[nodiscard]] std::span<const Channel> default_channels() noexcept;

/// One remote entity, as far as channels go.
struct ChannelClient {
  double distance = 0.0;  ///< to the nearest focus [m]; NaN counts as infinite
  bool active = true;
};

/// What a budget comes to.
struct ChannelBudget {
  /// Distances count as this many times as long, >= 1: the least by which the budget is met.
  double stretch = 1.0;
  double octets_per_second = 0.0;  ///< that all clients then take
  bool met = true;                 ///< false: what is kept and the last row alone take more
};

/// The table. One thread; allocates only in fit(), where there are more clients than ever before.
class ChannelTable {
 public:
  /// @throws std::invalid_argument for a table without rows, distances that do not grow, kept rows
  /// behind others, rates or octets out of range, or a row that takes more octets a second than the
  /// one before it.
  explicit ChannelTable(std::span<const Channel> channels = default_channels());

  /// The row for a distance; beyond the last row: size(), nothing.
  [[nodiscard]] std::size_t row(double distance, double stretch = 1.0) const noexcept;
  [[nodiscard]] const Channel& channel(std::size_t row) const noexcept { return channels_[row]; }
  [[nodiscard]] std::size_t size() const noexcept { return channels_.size(); }
  /// Rows that are kept: they come first.
  [[nodiscard]] std::size_t kept_rows() const noexcept { return kept_rows_; }
  /// Rows that are neither kept nor the last: those that have near groups.
  [[nodiscard]] std::size_t near_rows() const noexcept {
    return size() > kept_rows_ ? size() - kept_rows_ - 1 : 0;
  }

  /// Octets a second of one client.
  [[nodiscard]] double rate(const ChannelClient& client, double stretch = 1.0) const noexcept;
  /// The least stretch by which all clients together take at most `octets_per_second`: everybody
  /// moves outwards by the same factor, so that nearer ones never get less than farther ones.
  /// Cost: clients x rows, sorted.
  [[nodiscard]] ChannelBudget fit(std::span<const ChannelClient> clients, double octets_per_second);

 private:
  /// A client takes another row from this stretch on.
  struct Passage {
    double stretch;
    double saved;  // octets a second
  };

  std::vector<Passage> passages_;  // of the last fit()
  std::vector<Channel> channels_;
  std::size_t kept_rows_ = 0;
};

}  // namespace reckon::aoim
