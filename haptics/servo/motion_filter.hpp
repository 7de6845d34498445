// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Velocity and acceleration from sampled positions, for dead reckoning and for dampers.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace reckon::haptics {

/// Least-squares parabolas through the newest samples, read off at the last one: no lag for motion
/// of constant acceleration, whatever the spacing of the samples. Velocity comes from the longest
/// of windows of 32, 16 and 8 samples that fits to within the tolerance: long and smooth in slow
/// motion, where the encoder's steps dominate, short and quick in a stroke. Acceleration comes from
/// 32 samples always. One thread; O(1), about 200 ns a sample; no allocation.
class MotionFilter {
 public:
  /// Samples in the longest window.
  static constexpr std::size_t kWindow = 32;

  /// @param tolerance [m] > 0, largest misfit of a window; default 30 um suits encoders of up to 41
  /// um. Higher is smoother and slower to follow a change of acceleration.
  explicit MotionFilter(double tolerance = 30e-6) noexcept : tolerance_(tolerance) {}

  /// Starts anew: velocity and acceleration are zero until three samples are in.
  void reset() noexcept { count_ = 0; }

  /// @param position [m], any fixed frame; a non-finite one is ignored
  /// @param time [s], strictly later than the last one, else the sample is ignored
  void add(const Eigen::Vector3d& position, double time) noexcept;

  [[nodiscard]] const Eigen::Vector3d& velocity() const noexcept { return velocity_; }
  [[nodiscard]] const Eigen::Vector3d& acceleration() const noexcept { return acceleration_; }

 private:
  struct Sample {
    double time = 0.0;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
  };
  struct Parabola {
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
    Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
    double misfit = 0.0;  // [m], largest over the window
  };
  [[nodiscard]] Parabola fit(std::size_t count) const noexcept;
  [[nodiscard]] const Sample& back(std::size_t age) const noexcept;

  double tolerance_;
  std::array<Sample, kWindow> samples_{};
  std::size_t count_ = 0;   // samples in the ring
  std::size_t newest_ = 0;  // index of the last one
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_ = Eigen::Vector3d::Zero();
};

}  // namespace reckon::haptics
