// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/mesh_files/position_table.hpp"

#include <algorithm>
#include <bit>

namespace reckon::haptics {

namespace {

using Eigen::Vector3d;

constexpr std::uint32_t kEmpty = 0xffffffffu;
constexpr std::size_t kLeastSlots = 64;

std::uint64_t hash_of(const Vector3d& p) noexcept {
  std::uint64_t hash = 0;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double value = p[i] + 0.0;  // -0 becomes 0
    hash = (std::rotl(hash, 25) ^ std::bit_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15ull;
    hash ^= hash >> 32;
  }
  return hash * 0x9E3779B97F4A7C15ull;
}

}  // namespace

PositionTable::PositionTable(std::vector<Vector3d>& points, std::size_t expected)
    : points_(points) {
  points_.reserve(expected);
  grow(std::bit_ceil(std::max(kLeastSlots, 2 * expected)));
}

std::uint32_t PositionTable::number_of(const Vector3d& p) {
  std::size_t slot = slot_of(p);
  if (slots_[slot] != kEmpty) return slots_[slot];
  if (2 * (points_.size() + 1) > slots_.size()) {
    grow(2 * slots_.size());
    slot = slot_of(p);
  }
  points_.push_back(p);
  return slots_[slot] = static_cast<std::uint32_t>(points_.size() - 1);
}

void PositionTable::grow(std::size_t slots) {
  slots_ = std::vector<std::uint32_t>(slots, kEmpty);
  for (std::uint32_t i = 0; i < points_.size(); ++i) slots_[slot_of(points_[i])] = i;
}

void PositionTable::fetch(const Vector3d& p) const noexcept {
  __builtin_prefetch(&slots_[first_slot_of(p)]);
}

std::size_t PositionTable::first_slot_of(const Vector3d& p) const noexcept {
  return hash_of(p) >> (64 - std::countr_zero(slots_.size()));
}

std::size_t PositionTable::slot_of(const Vector3d& p) const noexcept {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = first_slot_of(p);
  while (slots_[slot] != kEmpty && points_[slots_[slot]] != p) slot = (slot + 1) & mask;
  return slot;
}

}  // namespace reckon::haptics
