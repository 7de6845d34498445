// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A log file of notices.
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/exercise/notice_digest.hpp"

namespace reckon::tools {

/// Adds `--log FILE` to a verb.
void add_log_flag(CommandLine& line, std::string& path);

/// Appends a line for each notice, with the time of this host in UTC, and flushes it at once:
///
///   2026-11-29T08:15:02.413Z warning touch-refused 1:2 900:1:4 at 10.77.0.3:52634 is not felt: ..
///
/// A file that cannot be written any more is reported once and closed. One thread.
class NoticeLog {
 public:
  /// @param path empty: nothing is written  @param console outlives it  @throws UsageError
  NoticeLog(const std::string& path, const Console& console);

  void add(const ReceivedNotice& heard);
  /// A sentence of a device: kind `device`.
  void add(std::string_view sentence);

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };
  void write(const peer::NoticeFacts& facts, peer::Severity severity, std::string_view by,
             std::string_view sentence);

  std::string path_;
  const Console& console_;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace reckon::tools
