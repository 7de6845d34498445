// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Groups the contacts of one step by islands of bodies.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

namespace reckon::haptics {

/// Bodies that touch one another, directly or through others, are an island. O(1) for each contact
/// in practice; allocates nothing. @tparam most bodies, numbered from 0
template <std::size_t most>
class ContactIslands {
 public:
  ContactIslands() { clear(); }

  void clear() noexcept {
    std::iota(roots_.begin(), roots_.end(), std::size_t{0});
    contacts_.fill(0);
  }
  /// Adds contacts of a body with static objects.
  void add(std::size_t body, int contacts) noexcept { contacts_[root_of(body)] += contacts; }
  /// Adds contacts between two bodies.
  void join(std::size_t a, std::size_t b, int contacts) noexcept {
    const std::size_t one = root_of(a), other = root_of(b);
    if (one != other) {
      roots_[other] = one;
      contacts_[one] += contacts_[other];
    }
    contacts_[one] += contacts;
  }
  /// Number of contacts of the largest island.
  [[nodiscard]] int largest() const noexcept { return *std::ranges::max_element(contacts_); }

  /// Number of contacts of a body's island.
  [[nodiscard]] int contacts_of(std::size_t body) noexcept { return contacts_[root_of(body)]; }
  /// A number that is the same for all bodies of an island.
  [[nodiscard]] std::size_t island_of(std::size_t body) noexcept { return root_of(body); }

 private:
  [[nodiscard]] std::size_t root_of(std::size_t body) noexcept {
    while (roots_[body] != body) body = roots_[body] = roots_[roots_[body]];
    return body;
  }

  std::array<std::size_t, most> roots_;
  std::array<int, most> contacts_;
};

}  // namespace reckon::haptics
