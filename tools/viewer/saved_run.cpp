// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/saved_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/viewer/view_server.hpp"
#include "reckon/tools/viewer/web/base64.hpp"

namespace reckon::tools {
namespace {

/// Texts that a saved file keeps, as in recorder.js; numbers once a second.
constexpr std::array<std::string_view, 8> kKeptText{"hello", "origin", "roster", "touch",
                                                    "cells", "groups", "bodies", "numbers"};
/// Pictures farther apart are played faster: at normal speed the stage would mark a gap.
constexpr double kApart = 0.25;  // [s]

double seconds_of(std::chrono::nanoseconds time) { return pdu::to_seconds(time); }

std::string_view type_of(std::string_view text) {
  constexpr std::string_view kBegin = R"({"type":")";
  if (!text.starts_with(kBegin)) return {};
  text.remove_prefix(kBegin.size());
  return text.substr(0, text.find('"'));
}

std::uint16_t entities_in(const std::string& picture) {
  constexpr std::size_t kPlace = 16;
  std::uint16_t count = 0;
  std::memcpy(&count, picture.data() + kPlace, sizeof count);
  return count;
}

/// A tab that draws each picture at once and stores it.
class SavingTab {
 public:
  SavingTab(ViewStage& stage, const SaveOptions& options)
      : stage_(stage),
        length_(seconds_of(stage.history().end() - stage.history().start())),
        span_(std::min(length_, seconds_of(options.span))),
        budget_(static_cast<double>(options.budget)),
        speed_(speed_for(stage.history().roster().size())),
        watcher_(stage.admit(false)) {
    watcher_->pictures.store();
    stage_.heed(*watcher_, SeekRequest{length_ - span_});
    stage_.heed(*watcher_, SpeedRequest{static_cast<float>(speed_)});
  }
  ~SavingTab() { stage_.leave(*watcher_); }
  SavingTab(const SavingTab&) = delete;
  SavingTab& operator=(const SavingTab&) = delete;

  SavedRun play() {
    std::chrono::nanoseconds now = stage_.now();
    for (bool is_over = false; !is_over; is_over = watcher_->state == PlayState::end) {
      stage_.pass(now);
      while (const auto message = stage_.next_message(*watcher_)) take(*message);
      now += pdu::from_seconds(spacing_ / speed_);
    }
    run_.left_out = length_ - span_;
    run_.seconds = time_ - first_;
    run_.items = fmt::format("[{}]", fmt::join(items_, ","));
    return std::move(run_);
  }

 private:
  /// Time from a picture of `octets` to the next one [s].
  [[nodiscard]] double spacing_after(std::size_t octets) const {
    return std::max(seconds_of(ViewServer::kTick), static_cast<double>(octets) / budget_ * span_);
  }
  [[nodiscard]] double speed_for(std::size_t entities) const {
    const double apart = spacing_after(kPictureHead + entities * kEntityOctets);
    return std::clamp(std::ceil(apart / kApart), 1.0, double{SpeedRequest::kMost});
  }

  void take(const ViewStage::Message& message) {
    if (message.opcode == WebSocketOpcode::binary) return take_picture(*message.payload);
    const std::string_view type = type_of(*message.payload);
    if (std::ranges::find(kKeptText, type) == kKeptText.end()) return;
    if (type == "numbers") {
      if (time_ - numbers_ < 1) return;
      numbers_ = time_;
    }
    texts_.push_back(message.payload);
  }
  // Texts are stored before the next picture.
  void take_picture(const std::string& picture) {
    time_ = seconds_of(*watcher_->shown - stage_.history().start());
    if (run_.pictures++ == 0) first_ = time_;
    const double ms = 1e3 * (time_ - first_);
    for (const auto& text : std::exchange(texts_, {}))
      items_.push_back(fmt::format(R"([{:.3f},"text",{}])", ms, *text));
    items_.push_back(
        fmt::format(R"([{:.3f},"picture","{}"])", ms, base64(std::as_bytes(std::span(picture)))));
    spacing_ = spacing_after(picture.size());
    run_.spacing = std::max(run_.spacing, spacing_);
    run_.entities = std::max(run_.entities, entities_in(picture));
    stage_.heed(*watcher_, DrawnRequest{watcher_->under_way.back()});
  }

  ViewStage& stage_;
  double length_, span_;  // [s]
  double budget_;         // [octets]
  double speed_;
  std::unique_ptr<Watcher> watcher_;
  double spacing_ = seconds_of(ViewServer::kTick);
  double first_ = 0, time_ = 0;  // [s], of pictures
  double numbers_ = -std::numeric_limits<double>::infinity();
  std::vector<std::shared_ptr<const std::string>> texts_;
  std::vector<std::string> items_;
  SavedRun run_;
};

}  // namespace

SavedRun save_run(ViewStage& stage, const SaveOptions& options) {
  return SavingTab(stage, options).play();
}

}  // namespace reckon::tools
