// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/input_files/load_progress.hpp"

#include <utility>

namespace reckon::haptics {
namespace {

constexpr std::uint32_t kCallsForALook = 64;

thread_local LoadProgress* current_progress = nullptr;

}  // namespace

LoadProgress::LoadProgress(Clock clock, Report report)
    : holds_(current_progress == nullptr), clock_(std::move(clock)), report_(std::move(report)) {
  if (holds_) current_progress = this;
}

LoadProgress::~LoadProgress() {
  if (holds_) current_progress = nullptr;
}

void LoadProgress::begin(const std::filesystem::path& file) {
  if (current_progress == nullptr) return;
  current_progress->file_ = file;
  current_progress->begin_ = current_progress->clock_();
  current_progress->reported_ = {};
}

void LoadProgress::look() {
  if (current_progress != nullptr && ++current_progress->calls_ % kCallsForALook == 0) look_now();
}

void LoadProgress::look_now() {
  if (current_progress == nullptr || current_progress->file_.empty()) return;
  const auto since = std::chrono::duration_cast<std::chrono::seconds>(current_progress->clock_() -
                                                                      current_progress->begin_);
  if (since <= current_progress->reported_) return;
  current_progress->reported_ = since;
  current_progress->report_(current_progress->file_, since);
}

}  // namespace reckon::haptics
