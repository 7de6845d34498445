// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds points at the same position, for files and meshes that repeat them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace reckon::haptics {

/// Numbers positions in the order of their first appearance; 0.0 and -0.0 are the same. Set-up
/// code, 20 ns a point, 8 to 16 octets a position beside the list.
class PositionTable {
 public:
  /// @param points   empty, gets each position once, and outlives this object
  /// @param expected number of positions, to avoid growth
  explicit PositionTable(std::vector<Eigen::Vector3d>& points, std::size_t expected = 0);

  /// Number of a finite position; a new one is appended to the list, which has less than 2^32 - 1.
  [[nodiscard]] std::uint32_t number_of(const Eigen::Vector3d& p);
  /// Fetches the memory that number_of(p) reads, some calls later.
  void fetch(const Eigen::Vector3d& p) const noexcept;

 private:
  void grow(std::size_t slots);
  [[nodiscard]] std::size_t first_slot_of(const Eigen::Vector3d& p) const noexcept;
  /// The slot of p, or the empty one where it belongs.
  [[nodiscard]] std::size_t slot_of(const Eigen::Vector3d& p) const noexcept;

  std::vector<Eigen::Vector3d>& points_;
  std::vector<std::uint32_t> slots_;  // a power of two, at most half full
};

}  // namespace reckon::haptics
