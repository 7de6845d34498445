// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Schedule of an introduction. After a newcomer is received, every peer sends its Entity States
// once more, spread over 100 ms, or longer if it owns so many that they would flood the newcomer.
// The moment of each entity follows from its ID and from their number. Consecutive newcomers share
// one round, which begins with the first of them and repeats. So no entity is sent more than once
// in a round, for any number of newcomers.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::aoim {

/// Tunables of the introduction.
struct IntroductionConfig {
  /// The last entity is sent this long after the newcomer was received, or later because of `pace`;
  /// default 100 ms.
  std::chrono::nanoseconds spread = std::chrono::milliseconds(100);
  /// The first entity is sent no earlier than this, so that the newcomer's joins have taken effect;
  /// default 30 ms (the longest join measured on a snooping switch), <= spread.
  std::chrono::nanoseconds settle = std::chrono::milliseconds(30);
  /// G; groups 0 .. G are served.
  std::size_t pool = kDefaultPool;
  /// Newcomers to one group within one `memory` that have separate schedules; default 8, at least
  /// 2. If there are more, newcomers within `memory` / capacity share the schedule of the latest,
  /// which delays them by at most this time.
  std::size_t capacity = 8;
  /// A newcomer is removed after this time, plus the extra spread from `pace`; default 1 s, >
  /// spread. Call is_due() for each entity more often than this.
  std::chrono::nanoseconds memory = std::chrono::seconds(1);
  /// Greatest number of entities introduced per second; default 120,000: 15,000 datagrams of 8,
  /// where a kernel and a listener take 20,000 a second. A higher value is faster and loses more
  /// datagrams.
  double pace = 120'000.0;
};

/// Schedules the introductions to newcomers. One thread; allocates nothing after construction.
class Introduction {
 public:
  /// @throws std::invalid_argument for settle > spread, a capacity below 2, a pool above
  /// kMaximumPool, or a pace that is not positive.
  explicit Introduction(const IntroductionConfig& config);

  /// Sets the number of entities that we own, which determines the spread for later newcomers.
  void set_owned(std::size_t count) noexcept;

  /// A newcomer was received that now listens to `group`, at most the pool; kBaseGroup: to any
  /// group.
  void begin(GroupIndex group, std::chrono::nanoseconds now);

  /// Whether an entity must be sent to `group` now. False again once it is sent. @param last_sent
  /// time of its last Entity State through `group`; any time before all others if never
  [[nodiscard]] bool is_due(const pdu::EntityId& entity, GroupIndex group,
                            std::chrono::nanoseconds last_sent,
                            std::chrono::nanoseconds now) const noexcept;

  /// Delay of this entity after a newcomer that is received now and is the first: settle ..
  /// spread().
  [[nodiscard]] std::chrono::nanoseconds delay(const pdu::EntityId& entity) const noexcept;
  /// Delay of the last entity after a newcomer that is received now.
  [[nodiscard]] std::chrono::nanoseconds spread() const noexcept { return spread_; }

  /// Removes newcomers that have been sent everything.
  void expire(std::chrono::nanoseconds now);

  /// False if no introduction is pending: is_due() is false for each entity.
  [[nodiscard]] bool is_pending() const noexcept { return !active_.empty(); }

 private:
  /// Each entity has its moment in it, and again after `length`. A change of the number of entities
  /// does not change it, so none is due twice.
  struct Round {
    std::chrono::nanoseconds begin{0};  ///< the first entity's first moment
    std::chrono::nanoseconds length{0};
  };
  struct Window {
    std::chrono::nanoseconds start;
    Round round;
  };
  using Lane = std::vector<Window>;  ///< newcomers of one group, oldest first
  void add(Lane& lane, const Window& window) const;
  [[nodiscard]] bool is_due(const pdu::EntityId& entity, const Lane& lane,
                            std::chrono::nanoseconds last_sent,
                            std::chrono::nanoseconds now) const noexcept;
  [[nodiscard]] std::chrono::nanoseconds place(const pdu::EntityId& entity,
                                               std::chrono::nanoseconds length) const noexcept;
  [[nodiscard]] std::chrono::nanoseconds moment(const pdu::EntityId& entity,
                                                const Window& window) const noexcept;
  [[nodiscard]] std::chrono::nanoseconds memory(const Window& window) const noexcept;

  IntroductionConfig config_;
  std::chrono::nanoseconds spread_;
  Round round_;                        ///< of the latest newcomer
  std::vector<Lane> lanes_;            ///< by group
  std::vector<std::uint16_t> active_;  ///< lanes with newcomers
};

}  // namespace reckon::aoim
