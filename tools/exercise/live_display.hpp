// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Output of demo and peer during a run: the live table on a terminal, else notices line by line.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/exercise/live_table.hpp"
#include "reckon/tools/exercise/notice_digest.hpp"
#include "reckon/tools/exercise/notice_log.hpp"
#include "reckon/tools/terminal/screen.hpp"

namespace reckon::tools {

/// Takes over the terminal if a table is wanted and can be drawn (`out` and stdin are terminals,
/// TERM is known and not "dumb"). The last lines of the table then show the notices; they are
/// printed to `err` once the terminal is restored. Without a table, notices go to `err` as they
/// come. If `out` is a terminal that cannot be drawn on, a line with the counts follows every
/// kStatusEvery. One thread.
class LiveDisplay {
 public:
  static constexpr std::chrono::nanoseconds kDrawEvery = std::chrono::milliseconds(200);
  /// Interval at which to call show() while the table is drawn; it limits the delay of a key.
  static constexpr std::chrono::nanoseconds kKeysEvery = std::chrono::milliseconds(20);
  static constexpr std::chrono::nanoseconds kStatusEvery = std::chrono::seconds(10);
  /// Notices that are printed after the table; older ones are only counted.
  static constexpr std::size_t kMostKept = 20;

  /// @param console outlives it  @param peers of this program  @param log file of notices, may be
  /// empty  @throws UsageError if it cannot be written
  LiveDisplay(const Console& console, bool wants_table, std::size_t peers, const std::string& log);
  ~LiveDisplay();
  LiveDisplay(const LiveDisplay&) = delete;
  LiveDisplay& operator=(const LiveDisplay&) = delete;

  /// Whether the table is shown.
  [[nodiscard]] bool is_drawn() const noexcept { return screen_ != nullptr; }
  void add(const ReceivedNotice& heard);
  /// Sentences of the program itself, one line each; not logged.
  void add(std::vector<std::string> sentences);
  /// Notices of devices, one line each; logged.
  void add_of_devices(std::vector<std::string> sentences);
  /// A sentence of the program itself: shown in the table's head from now on; without a table
  /// printed to `err` at once.
  void put_in_head(std::string sentence);
  /// Handles keys; draws when kDrawEvery has passed, after a key, and after a change of the
  /// terminal's size.
  void show(std::span<const TablePeer> peers, const peer::SceneFile& scene,
            std::chrono::nanoseconds elapsed);
  /// Whether the user has pressed the key of the software stop since the last call.
  [[nodiscard]] bool take_stop_key() noexcept { return std::exchange(stop_key_, false); }
  /// Whether the user asked to end.
  [[nodiscard]] bool quit() const noexcept { return quit_; }
  /// Restores the terminal and prints the pending notices. No call may follow.
  void close();

 private:
  void take_keys();

  const Console& console_;
  NoticeLog log_;
  peer::SteadyClock clock_;
  std::unique_ptr<TerminalScreen> screen_;  // null if none can be drawn
  bool tells_status_;
  NoticeDigest digest_;
  std::string head_;
  double strongest_ = 1;              // [N], greatest force shown so far
  std::vector<std::string> notices_;  // while the table is shown: the newest, at most kMostKept
  std::size_t dropped_ = 0;           // older notices dropped from it
  std::chrono::nanoseconds next_draw_{0};
  std::chrono::nanoseconds next_status_{kStatusEvery};  // in elapsed time
  bool quit_ = false;
  bool stop_key_ = false;
};

}  // namespace reckon::tools
