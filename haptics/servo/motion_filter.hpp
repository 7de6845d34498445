// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Velocity and acceleration from sampled positions, for dead reckoning and dampers.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace reckon::haptics {

/// Least-squares parabolas through the newest samples, evaluated at the last one. They have no lag
/// for motion of constant acceleration, whatever the spacing of the samples. Velocity comes from
/// the longest window of 32, 16 or 8 samples that fits within the tolerance. It is long and smooth
/// in slow motion, where encoder steps dominate, and short and quick in a stroke. Acceleration
/// always comes from 32 samples. One thread; no allocation; about 60 ns a sample, or 140 ns where
/// encoder steps make a window doubtful. The sums for a fit are kept between samples and restarted
/// at every eighth.
class MotionFilter {
 public:
  /// Samples in the longest window.
  static constexpr std::size_t kWindow = 32;

  /// @param tolerance [m] > 0, largest misfit of a window. The default of 30 um suits encoder steps
  /// of up to 41 um. A higher value is smoother and follows a change of acceleration more slowly.
  explicit MotionFilter(double tolerance = 30e-6) noexcept : tolerance_(tolerance) {}

  /// Restarts: velocity and acceleration are zero until there are three samples.
  void reset() noexcept {
    count_ = 0;
    whole_ = Parabola{};
  }

  /// @param position [m], any fixed frame; a non-finite one is ignored
  /// @param time [s], strictly later than the last one, else the sample is ignored
  void add(const Eigen::Vector3d& position, double time) noexcept;

  /// [m/s]. Zero while the times in all windows are, to rounding, only two: after a pause of a
  /// million windows. Selects the window on each call: 20 to 40 ns.
  [[nodiscard]] Eigen::Vector3d velocity() const noexcept;
  /// [m/s^2]; zero in the same case.
  [[nodiscard]] Eigen::Vector3d acceleration() const noexcept {
    return 2.0 * whole_.quadratic.head<3>();
  }

 private:
  /// x, y, z [m] and time [s]. Time is the fourth component because a fit also needs the sums of
  /// its powers, which the same operations then produce.
  using Row = Eigen::Array4d;
  static constexpr Eigen::Index kTime = 3;

  /// Sums of row, t row, t^2 row, row^2 and t^4 over some samples, with t from the origin.
  struct Sums {
    Row zeroth = Row::Zero();
    Row first = Row::Zero();
    Row second = Row::Zero();
    Row squares = Row::Zero();
    double fourth = 0.0;

    void add(const Row& row) noexcept;
    void add(const Sums& other) noexcept;
  };

  /// row(t) = constant + t (linear + t quadratic), with t from the origin.
  struct Parabola {
    Row constant = Row::Zero();
    Row linear = Row::Zero();
    Row quadratic = Row::Zero();
    Sums sums;
    double rounding = 0.0;  // bound of the relative error of the result; 0 = not usable
  };

  void take(const Row& sample) noexcept;
  void restart_sums() noexcept;
  [[nodiscard]] Parabola fit(std::size_t count) const noexcept;
  [[nodiscard]] bool fits(const Parabola& parabola, std::size_t count) const noexcept;
  [[nodiscard]] bool each_fits(const Parabola& parabola, std::size_t count) const noexcept;
  [[nodiscard]] Row from_origin(std::size_t age) const noexcept {
    return samples_[(newest_ + kWindow - age) % kWindow] - origin_;
  }

  double tolerance_;
  std::array<Row, kWindow> samples_{};
  std::size_t count_ = 0;   // samples in the ring
  std::size_t newest_ = 0;  // index of the last one

  // Always a sample of the shortest window, so that no sum is large against the terms of a fit.
  Row origin_ = Row::Zero();
  std::size_t since_ = 0;                  // number of samples after the origin
  Sums after_;                             // sums over these
  std::array<Sums, kWindow + 1> up_to_{};  // [n]: sums over the n samples that end with the origin

  Parabola whole_;  // fit through all samples
};

}  // namespace reckon::haptics
