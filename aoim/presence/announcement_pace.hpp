// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Schedule of our announcements: once a heartbeat, and more often while a peer may not have
// received one.
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
  /// No announcement is due after this.
  void stop() noexcept { running_ = false; }
  [[nodiscard]] bool is_running() const noexcept { return running_; }

  /// A peer may not have accepted us: announces at once, and repeats for a while because of loss.
  void announce_soon(std::chrono::nanoseconds now) noexcept;
  /// Others may have accepted another peer in our place: announces every `brisk_gap` during
  /// `brisk`, because no list shows when they accept us.
  void insist(std::chrono::nanoseconds now) noexcept;
  /// Sends the next one at `time` or earlier, if that is long enough after the last one.
  void announce_by(std::chrono::nanoseconds time) noexcept;
  /// Sets our source address. A change is announced at once and repeated.
  void note_own_source(const SourceAddress& source, std::chrono::nanoseconds now) noexcept;

  /// Our source address; port 0: unknown.
  [[nodiscard]] const SourceAddress& own_source() const noexcept { return own_source_; }

  /// Whether an announcement is due.
  [[nodiscard]] bool is_due(std::chrono::nanoseconds now) const noexcept {
    return running_ && now >= next_;
  }
  /// Counts an announcement that is sent now, and schedules the next. @param acquainted whether all
  /// received peers list us, so that nothing is repeated  @return whether it is more than a
  /// heartbeat
  bool note_announced(std::chrono::nanoseconds now, bool acquainted) noexcept;

  /// Delays the next heartbeat, if it would come late in its slot, to the start of the next slot: a
  /// MAC that arrives late proves nothing. Call it after note_announced().
  /// @param slot_time of the announcement that was just sent
  void align(std::chrono::nanoseconds slot_time) noexcept;

  /// Whether the next one is a repetition for peers that do not list us yet.
  [[nodiscard]] bool is_repeating() const noexcept {
    return running_ && next_cause_ == Cause::repetition;
  }
  /// All peers list us, so the next one is a heartbeat. Call it only if is_repeating().
  void end_repetition() noexcept;
  /// Our ID has changed and no peer has received it, so no gap applies.
  void forget_last() noexcept { last_.reset(); }

  /// When the last one with our present ID was sent.
  [[nodiscard]] std::optional<std::chrono::nanoseconds> last() const noexcept { return last_; }
  /// When the next one is due.
  [[nodiscard]] std::chrono::nanoseconds next() const noexcept { return next_; }

 private:
  using Nanoseconds = std::chrono::nanoseconds;
  // Purpose of the next announcement.
  enum class Cause : std::uint8_t { heartbeat, repetition, news };

  const PresenceConfig& config_;
  bool running_ = false;
  Nanoseconds next_ = Nanoseconds::max();
  Cause next_cause_ = Cause::news;
  Nanoseconds brisk_until_ = Nanoseconds::min();
  Nanoseconds insist_until_ = Nanoseconds::min();
  Nanoseconds gap_{0};               // until the next repetition
  std::optional<Nanoseconds> last_;  // last announcement with this ID
  SourceAddress own_source_;         // our source address
};

}  // namespace reckon::aoim
