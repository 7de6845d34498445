// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Orders from a peer's model loop to the thread that steps its bodies, and the states that come
// back when a body is no longer simulated.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

enum class BodyAct : std::uint8_t {
  own,     ///< this peer simulates the body, from `state` on; a copy within 50 mm of it
           ///< goes on from where it is
  disown,  ///< its mover carries it; it stands in its last state until its mover moves it
  wake,    ///< makes it active
  push,    ///< gives it an impulse, and wakes it
  place,   ///< puts it into `state`, and wakes it
  copy,    ///< simulates a copy of it, from `state` on, and moves that to the mover's poses;
           ///< if it is copied: sets `delay`
  follow,  ///< ends the copy: its mover carries the body
  adopt,   ///< `own` of a body that nobody simulates: a drawn copy gets the velocities of `state`
};

/// An order to one body. Except for `own`, `adopt`, `copy` and `follow`, an order to a body that
/// this peer does not own has no effect.
struct BodyOrder {
  BodyAct act = BodyAct::wake;
  std::uint32_t body = 0;
  ObjectMotion state{};  ///< for `own`, `adopt`, `copy`, `place`; frame S
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();  ///< [N s], S
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< [m], S, where the impulse acts
  /// Of the mover's poses [s], for `copy`; infinite: the copy does not follow them.
  double delay = 0.0;
};

/// The answer to each `disown` of a transaction.
struct BodyEnd {
  std::uint64_t serial = 0;  ///< of the transaction
  std::uint32_t body = 0;
  bool was_owned = false;            ///< else the order had no effect
  std::chrono::nanoseconds time{0};  ///< of the state, clock of the bodies
  ObjectMotion state{};              ///< the last simulated state
};

/// Carries transactions to the bodies, and their answers back. Two threads, one on each side.
/// Wait-free; allocates at construction only.
///
/// Example, in the model loop:
///   const std::uint64_t serial = world.exchange().send(orders);  // 0: no room, try again
///   ..
///   while (world.exchange().take_end(end)) ..
class BodyExchange {
 public:
  static constexpr std::size_t kMostOrders = 64;  ///< of a transaction
  static constexpr std::size_t kTransactions = 16;

  /// Model loop: sends orders that take effect in one advance, in this order.
  /// @return their serial, from 1 and ascending; 0: there is no room for them now, or they are none
  /// or more than kMostOrders
  std::uint64_t send(std::span<const BodyOrder> orders) noexcept {
    const auto ends =
        static_cast<std::size_t>(std::ranges::count(orders, BodyAct::disown, &BodyOrder::act));
    if (orders.empty() || orders.size() > kMostOrders || awaited_ + ends > kEnds) return 0;
    Transaction* out = sent_.claim();
    if (out == nullptr) return 0;
    std::ranges::copy(orders, out->orders.begin());
    out->count = orders.size();
    out->serial = ++serial_;
    sent_.publish();
    awaited_ += ends;
    return serial_;
  }
  /// Model loop: takes the oldest answer. @return false: there is none
  bool take_end(BodyEnd& end) noexcept {
    if (!ends_.pop(end)) return false;
    --awaited_;
    return true;
  }

  /// Whether no transaction waits. Any thread.
  [[nodiscard]] bool empty() const noexcept { return sent_.empty(); }
  /// Thread of the bodies: calls carry_out(serial, order) for each order that waits.
  void take(auto&& carry_out) noexcept {
    while (const Transaction* transaction = sent_.front()) {
      for (const BodyOrder& order : std::span(transaction->orders).first(transaction->count))
        carry_out(transaction->serial, order);
      sent_.pop();
    }
  }
  /// Thread of the bodies. There is always room for the answers to orders.
  void answer(const BodyEnd& end) noexcept { ends_.push(end); }

 private:
  struct Transaction {
    std::uint64_t serial = 0;
    std::size_t count = 0;
    std::array<BodyOrder, kMostOrders> orders{};
  };
  static constexpr std::size_t kEnds = kTransactions * kMostOrders;

  SpscRing<Transaction> sent_{kTransactions};
  SpscRing<BodyEnd> ends_{kEnds};
  std::uint64_t serial_ = 0;
  std::size_t awaited_ = 0;  // answers that are not taken yet
};

}  // namespace reckon::haptics
