// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Who receives an entity of a light peer, by the library's table of channels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reckon/aoim/interest/receiver_channels.hpp"
#include "reckon/bench/studies/scale/crowd.hpp"

namespace reckon::bench {

/// The crowd sorted into cells as wide as the farthest row that has an end. One thread.
class NearOthers {
 public:
  /// @param owners of the entities, by number; outlives this  @param channels the table
  NearOthers(std::span<const std::uint32_t> owners, std::span<const aoim::Channel> channels);

  [[nodiscard]] const aoim::ChannelTable& table() const noexcept { return channels_.table(); }
  /// Where all are now; some 20 ns an entity.
  void update(const Crowd& crowd);
  /// The row of an entity: by those of other peers who were near at the last update(). 1 us where
  /// a hundred are.
  [[nodiscard]] const aoim::Channel& channel(std::uint32_t entity, const Crowd& crowd);
  /// See ReceiverChannels::served_row(), for an entity whose copies are off by `slack` [m].
  [[nodiscard]] std::size_t served_row(std::uint32_t entity, const Crowd& crowd, double slack);

 private:
  void find_near(std::uint32_t entity, const Crowd& crowd);
  [[nodiscard]] std::size_t column_of(double x) const noexcept;
  [[nodiscard]] std::size_t row_of(double y) const noexcept;

  std::span<const std::uint32_t> owners_;
  aoim::ReceiverChannels channels_;
  double reach_;  // [m] of the last row that ends
  double left_ = 0, bottom_ = 0;
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<std::uint32_t> begins_;    // by cell, where its entities begin
  std::vector<std::uint32_t> entities_;  // by cell
};

}  // namespace reckon::bench
