// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/sweep/progress_bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "reckon/tools/command_line/duration_text.hpp"

namespace reckon::bench {
namespace {

using std::chrono::nanoseconds;

constexpr std::chrono::milliseconds kPeriod{200};
constexpr std::size_t kColumns = 30;

nanoseconds now() { return std::chrono::steady_clock::now().time_since_epoch(); }

}  // namespace

ProgressBar::ProgressBar(const tools::Console& console)
    : line_(console.err, now()), begin_(now()) {}

ProgressBar::~ProgressBar() { line_.clear(); }

void ProgressBar::show(double share, std::string_view text) {
  if (now() - shown_ < kPeriod) return;
  shown_ = now();
  share = std::clamp(share, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(kColumns * share);
  std::string out = fmt::format("[{:#<{}}{:.<{}}] {}", "", filled, "", kColumns - filled, text);
  if (share > 0) {
    const auto spent = std::chrono::duration<double>(shown_ - begin_);
    const auto left = std::chrono::ceil<std::chrono::seconds>(spent * ((1 - share) / share));
    out += fmt::format(", {} left", tools::duration_text(left));
  }
  line_.show(out, shown_);
}

}  // namespace reckon::bench
