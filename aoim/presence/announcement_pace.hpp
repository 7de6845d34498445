// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// When we announce ourselves: once a heartbeat, and sooner and more often while somebody may not
// have heard us.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "reckon/aoim/presence/presence_config.hpp"
#include "reckon/aoim/presence/source_address.hpp"

namespace reckon::aoim {

/// The schedule of our announcements, between start and stop. One thread; allocates nothing.
class AnnouncementPace {
 public:
  /// @param config outlives this
  explicit AnnouncementPace(const PresenceConfig& config) noexcept : config_(config) {}

  /// The first announcement is due at once.
  void start(std::chrono::nanoseconds now) noexcept;
  /// None is due any more.
  void stop() noexcept { running_ = false; }
  [[nodiscard]] bool is_running() const noexcept { return running_; }

  /// Somebody may not know us: at once, and again for a while, since announcements are lost.
  void announce_soon(std::chrono::nanoseconds now) noexcept;
  /// Others hear us and may believe another of us: every `brisk_gap` for the time `brisk`, since no
  /// list reports when that is over.
  void insist(std::chrono::nanoseconds now) noexcept;
  /// The next one leaves at `time` at the latest, if that is far enough from the last one.
  void announce_by(std::chrono::nanoseconds time) noexcept;
  /// Where we send from. After a change we announce ourselves at once and some times more.
  void note_own_source(const SourceAddress& source, std::chrono::nanoseconds now) noexcept;

  /// Whether one is to leave now.
  [[nodiscard]] bool is_due(std::chrono::nanoseconds now) const noexcept {
    return running_ && now >= next_;
  }
  /// One leaves now, and the next one is scheduled. @param acquainted whether all whom we hear list
  /// us: nothing is to be repeated  @return whether it is more than a heartbeat
  bool note_announced(std::chrono::nanoseconds now, bool acquainted) noexcept;

  /// Whether the next one repeats the last one for those who do not list us yet.
  [[nodiscard]] bool is_repeating() const noexcept {
    return running_ && next_cause_ == Cause::repetition;
  }
  /// All list us: the next one is a heartbeat. Only where is_repeating().
  void end_repetition() noexcept;
  /// We have another id, which nobody has heard: there is no gap to keep.
  void forget_last() noexcept { last_.reset(); }

  /// When the last one under our id left.
  [[nodiscard]] std::optional<std::chrono::nanoseconds> last() const noexcept { return last_; }
  /// When the next one leaves.
  [[nodiscard]] std::chrono::nanoseconds next() const noexcept { return next_; }

 private:
  using Nanoseconds = std::chrono::nanoseconds;
  // What our next announcement is for.
  enum class Cause : std::uint8_t { heartbeat, repetition, news };

  const PresenceConfig& config_;
  bool running_ = false;
  Nanoseconds next_ = Nanoseconds::max();
  Cause next_cause_ = Cause::news;
  Nanoseconds brisk_until_ = Nanoseconds::min();
  Nanoseconds insist_until_ = Nanoseconds::min();
  Nanoseconds gap_{0};               // until we repeat ourselves again
  std::optional<Nanoseconds> last_;  // our last announcement under this id
  SourceAddress own_source_;         // where we send from
};

}  // namespace reckon::aoim
