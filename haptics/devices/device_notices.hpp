// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the thread of a real device has to say to the user.
#pragma once

#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace reckon::haptics {

/// Sentences about one device. One thread tells, any takes; never the servo, for it locks.
class DeviceNotices {
 public:
  /// @param device its name, or where it is
  void tell(const std::string& device, const std::string& sentence) {
    const std::lock_guard lock(mutex_);
    sentences_.push_back(device + ": " + sentence);
  }
  /// Tells what is in the way, but not the same again while it stays so.
  void tell_problem(const std::string& device, const std::string& problem) {
    if (problem == problem_) return;
    tell(device, problem);
    problem_ = problem;
  }
  /// Nothing is in the way any more.
  void clear_problem() { problem_.clear(); }
  /// Sentences since the last call, each once.
  [[nodiscard]] std::vector<std::string> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(sentences_, {});
  }

 private:
  std::string problem_;  // told already
  std::mutex mutex_;
  std::vector<std::string> sentences_;
};

}  // namespace reckon::haptics
