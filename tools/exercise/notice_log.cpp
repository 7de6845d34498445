// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/notice_log.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <cstring>

namespace reckon::tools {

void add_log_flag(CommandLine& line, std::string& path) {
  line.option("--log", path,
              "append each notice to this file: time in UTC, severity, id, peer, sentence");
}

NoticeLog::NoticeLog(const std::string& path, const Console& console)
    : path_(path), console_(console) {
  if (path.empty()) return;
  file_.reset(std::fopen(path.c_str(), "ae"));
  if (!file_)
    throw UsageError(
        fmt::format("--log {}: {}; name a file in a writable folder", path, std::strerror(errno)));
}

void NoticeLog::add(const ReceivedNotice& heard) {
  if (!file_) return;
  const peer::Notice& notice = heard.notice;
  write(peer::facts_of(notice.kind), notice.severity,
        fmt::format("{}:{}", heard.by.site, heard.by.application), notice.text.data());
}

void NoticeLog::add(std::string_view sentence) {
  const peer::NoticeFacts& facts = peer::facts_of(peer::NoticeKind::device);
  if (file_) write(facts, facts.severity, "-", sentence);
}

void NoticeLog::write(const peer::NoticeFacts& facts, peer::Severity severity, std::string_view by,
                      std::string_view sentence) {
  using std::chrono::floor, std::chrono::milliseconds, std::chrono::seconds;
  const auto now = floor<milliseconds>(std::chrono::system_clock::now());
  const std::string line =
      fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z {} {} {} {}\n", fmt::gmtime(floor<seconds>(now)),
                  (now - floor<seconds>(now)).count(), name_of(severity), facts.id, by, sentence);
  const bool written = std::fwrite(line.data(), 1, line.size(), file_.get()) == line.size();
  if (written && std::fflush(file_.get()) == 0) return;
  fmt::print(console_.err, "--log {}: {}; further notices are not logged\n", path_,
             std::strerror(errno));
  file_.reset();
}

}  // namespace reckon::tools
