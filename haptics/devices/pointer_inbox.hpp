// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where a page or a program puts what its pointer does, for a device that follows it.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <cstdint>

#include "reckon/haptics/exchange/triple_buffer.hpp"

namespace reckon::haptics {

/// Where a pointer wants the hand to be.
struct PointerSample {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], frame D
  bool held = true;    ///< false: it lets go, and the position says nothing
  bool grabs = false;  ///< the device's button 0 is pressed
};

/// Samples come at any rate and carry no time: the newest one counts, from when the device reads
/// it. One thread puts, the servo's takes, neither waits for the other; any thread may ask.
///
///     inbox.put({{0.02, 0.0, 0.1}, true});   // 60 times a second, while the button is down
///     inbox.put({{}, false});                // let go
class PointerInbox {
 public:
  /// [m], of any coordinate; what is farther from the device's origin is not meant.
  static constexpr double kFarthest = 100.0;

  /// The writer's thread. A position that is not finite or beyond kFarthest is refused and counted,
  /// as if it had not come. @return false where it was refused
  bool put(const PointerSample& sample) noexcept {
    // Written so that not-a-number is refused.
    if (sample.held && !(sample.position.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kFarthest)) {
      refused_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    newest_.write(sample);
    return true;
  }

  /// Any thread: whether the device's hand follows a pointer now; a few milliseconds old.
  [[nodiscard]] bool is_held() const noexcept { return held_.load(std::memory_order_relaxed); }
  /// Any thread: samples refused since the start.
  [[nodiscard]] std::uint64_t refused() const noexcept {
    return refused_.load(std::memory_order_relaxed);
  }

  /// The device: whether there is a sample that it has not seen; sample() then has it.
  [[nodiscard]] bool take() noexcept { return newest_.update(); }
  [[nodiscard]] const PointerSample& sample() const noexcept { return newest_.read(); }
  void tell(bool held) noexcept { held_.store(held, std::memory_order_relaxed); }

 private:
  TripleBuffer<PointerSample> newest_;
  std::atomic<std::uint64_t> refused_{0};
  std::atomic<bool> held_{false};
};

}  // namespace reckon::haptics
