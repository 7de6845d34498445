// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/sweep/journal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

std::vector<std::string_view> options_of(std::string_view text) {
  std::vector<std::string_view> options;
  for (;;) {
    const std::size_t end = text.find("; ");
    options.push_back(text.substr(0, end));
    if (end == text.npos) return options;
    text.remove_prefix(end + 2);
  }
}

/// "it has a=1, this one a=2".
std::string difference(std::string_view there, std::string_view ours) {
  const auto old = options_of(there), now = options_of(ours);
  const auto [a, b] = std::ranges::mismatch(old, now);
  return fmt::format("it has {}, this study {}", a == old.end() ? "no more" : *a,
                     b == now.end() ? "no more" : *b);
}

[[noreturn]] void cannot_write(const std::string& path) {
  throw tools::UsageError(
      fmt::format("{}: cannot be written; name a file in a writable folder", path));
}

}  // namespace

SweepJournal::SweepJournal(std::string path, std::string_view study, std::string_view options,
                           std::string_view columns)
    : path_(std::move(path)),
      header_(fmt::format("# {}: {}", study, options)),
      columns_(columns),
      file_(nullptr, std::fclose) {
  if (path_.empty()) return;
  read();
}

SweepJournal::~SweepJournal() = default;

void SweepJournal::read() {
  std::string text;
  if (std::filesystem::exists(path_)) {
    std::ifstream file(path_, std::ios::binary);
    std::stringstream all;
    all << file.rdbuf();
    text = all.str();
    if (!file) cannot_write(path_);
  }
  const std::size_t whole = text.rfind('\n') + 1;  // 0 if there is none
  std::vector<std::string> lines;
  std::istringstream stream(text.substr(0, whole));
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  const bool cut_in_header = lines.empty() && header_.starts_with(text);
  const bool cut_in_columns = lines.size() == 1 && lines[0] == header_;
  if (cut_in_header || cut_in_columns) return begin();
  const std::string_view study = std::string_view(header_).substr(0, header_.find(": ") + 2);
  if (lines.empty() || !lines[0].starts_with(study))
    throw tools::UsageError(
        fmt::format("{}: does not contain this study; write a new file", path_));
  if (lines[0] != header_)
    throw tools::UsageError(
        fmt::format("{}: contains the study with other options: {}; write a new file, or use its "
                    "options to continue",
                    path_,
                    difference(std::string_view(lines[0]).substr(study.size()),
                               std::string_view(header_).substr(study.size()))));
  if (lines[1] != columns_)
    throw tools::UsageError(
        fmt::format("{}: has the columns of another version; write a new file", path_));
  std::filesystem::resize_file(path_, whole);
  found_.assign(lines.begin() + 2, lines.end());
  file_.reset(std::fopen(path_.c_str(), "ab"));
  if (!file_) cannot_write(path_);
}

void SweepJournal::begin() {
  file_.reset(std::fopen(path_.c_str(), "wb"));
  if (!file_) cannot_write(path_);
  append(header_ + "\n" + columns_);
}

void SweepJournal::append(const std::string& line) {
  if (!file_) return;
  // Flushed line by line: a killed program leaves complete lines and at most one partial line.
  fmt::print(file_.get(), "{}\n", line);
  if (std::fflush(file_.get()) != 0)
    throw tools::UsageError(fmt::format("{}: cannot be extended; is the disk full?", path_));
}

void SweepJournal::finish(const std::vector<std::string>& lines) {
  if (path_.empty()) return;
  file_.reset();
  const std::string next = path_ + ".new";
  std::ofstream file(next, std::ios::binary | std::ios::trunc);
  file << header_ << '\n' << columns_ << '\n';
  for (const std::string& line : lines) file << line << '\n';
  file.close();
  if (!file)
    throw tools::UsageError(
        fmt::format("{}: could not be written completely; is the disk full?", next));
  std::filesystem::rename(next, path_);
}

}  // namespace reckon::bench
