// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Input of pointer samples from a page or a program to a device that follows them.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <cstdint>

#include "reckon/haptics/exchange/triple_buffer.hpp"

namespace reckon::haptics {

/// Target of the hand from a pointer.
struct PointerSample {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], frame D
  bool held = true;                                    ///< false: released; the position is ignored
  bool grabs = false;                                  ///< the device's button 0 is pressed
};

/// Samples arrive at any rate without timestamps: the newest takes effect when the device reads it.
/// One thread puts, the servo's takes; neither blocks on the other. Any thread may query.
///
///     inbox.put({{0.02, 0.0, 0.1}, true});   // 60 times a second, while the button is down
///     inbox.put({{}, false});                // let go
class PointerInbox {
 public:
  /// [m], greatest coordinate; samples farther from the device's origin are refused.
  static constexpr double kFarthest = 100.0;

  /// The writer's thread. A position that is not finite or beyond kFarthest is refused and counted,
  /// and has no effect. @return false if it was refused
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

  /// For the device: whether there is a new sample, which sample() then returns.
  [[nodiscard]] bool take() noexcept { return newest_.update(); }
  [[nodiscard]] const PointerSample& sample() const noexcept { return newest_.read(); }
  void tell(bool held) noexcept { held_.store(held, std::memory_order_relaxed); }

 private:
  TripleBuffer<PointerSample> newest_;
  std::atomic<std::uint64_t> refused_{0};
  std::atomic<bool> held_{false};
};

}  // namespace reckon::haptics
