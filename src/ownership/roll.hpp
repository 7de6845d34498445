// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The voters of a scene, and what is a majority of them.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

namespace reckon::peer {

/// A peer that may own objects.
struct Voter {
  std::uint32_t epoch = 0;
  std::uint8_t host = 0;  ///< equal for peers of one host; below Roll::kMost

  friend constexpr bool operator==(const Voter&, const Voter&) = default;
};

/// Voters in the order of their seniority. Each host has one vote, which its peers share in equal
/// parts, so a user gains no votes by starting more peers. No allocation.
class Roll {
 public:
  static constexpr std::size_t kMost = 64;
  static constexpr std::size_t kNone = kMost;

  [[nodiscard]] std::span<const Voter> voters() const noexcept {
    return std::span(voters_).first(count_);
  }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
  /// False if it is full, or the epoch is 0 or already listed.
  bool add(const Voter& voter) noexcept;
  void remove(std::uint32_t epoch) noexcept;
  /// kNone if it is not listed.
  [[nodiscard]] std::size_t index_of(std::uint32_t epoch) const noexcept;
  [[nodiscard]] bool contains(std::uint32_t epoch) const noexcept {
    return index_of(epoch) != kNone;
  }
  /// Epoch of the first voter; 0 if there is none.
  [[nodiscard]] std::uint32_t senior() const noexcept { return count_ > 0 ? voters_[0].epoch : 0; }

  /// Whether the voters for which has(Voter) is true are a majority: more than half of all votes,
  /// or half of them with the senior. Two majorities have a voter in common.
  [[nodiscard]] bool is_majority(auto&& has) const noexcept {
    std::array<bool, kMost> in{};
    for (std::size_t i = 0; i < count_; ++i) in[i] = has(voters_[i]);
    return is_majority_of(in);
  }
  /// Index of the voter with the latest time t such that the voters with times >= t are a
  /// majority; kNone for an empty roll.  @param times of the voters, in order
  [[nodiscard]] std::size_t last_of_majority(
      std::span<const std::chrono::nanoseconds> times) const noexcept;
  /// Of the voters in order.
  [[nodiscard]] std::uint32_t hash() const noexcept;

  friend bool operator==(const Roll& a, const Roll& b) noexcept;

 private:
  [[nodiscard]] bool is_majority_of(const std::array<bool, kMost>& in) const noexcept;
  /// The share of its host's vote that each voter has, and the number of hosts.
  double share(std::array<double, kMost>& shares) const noexcept;
  [[nodiscard]] static bool is_most(double votes, double all, bool with_senior) noexcept;

  std::array<Voter, kMost> voters_{};
  std::size_t count_ = 0;
};

}  // namespace reckon::peer
