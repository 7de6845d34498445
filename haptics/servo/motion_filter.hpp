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
/// 32 samples always. One thread; no allocation; about 60 ns a sample, 140 ns
/// where an encoder's steps make a window doubtful, for the sums that a fit
/// needs are kept from sample to sample and begun anew at every eighth.
class MotionFilter {
 public:
  /// Samples in the longest window.
  static constexpr std::size_t kWindow = 32;

  /// @param tolerance [m] > 0, largest misfit of a window; default 30 um suits encoders of up to 41
  /// um. Higher is smoother and slower to follow a change of acceleration.
  explicit MotionFilter(double tolerance = 30e-6) noexcept : tolerance_(tolerance) {}

  /// Starts anew: velocity and acceleration are zero until three samples are in.
  void reset() noexcept {
    count_ = 0;
    whole_ = Parabola{};
  }

  /// @param position [m], any fixed frame; a non-finite one is ignored
  /// @param time [s], strictly later than the last one, else the sample is ignored
  void add(const Eigen::Vector3d& position, double time) noexcept;

  /// [m/s]; zero while all windows hold samples at what is, to rounding, only two times: after a
  /// pause of a million windows. Looks for the window: 20 to 40 ns, for those that want it.
  [[nodiscard]] Eigen::Vector3d velocity() const noexcept;
  /// [m/s^2]; zero likewise.
  [[nodiscard]] Eigen::Vector3d acceleration() const noexcept {
    return 2.0 * whole_.quadratic.head<3>();
  }

 private:
  /// x, y, z [m] and time [s]: the time goes along as a fourth place, so that the sums of its
  /// powers, which a fit needs as well, are made by the same operations.
  using Row = Eigen::Array4d;
  static constexpr Eigen::Index kTime = 3;

  /// Over some samples, all counted from the origin: sums of row, t row, t^2 row, row^2 and t^4.
  struct Sums {
    Row zeroth = Row::Zero();
    Row first = Row::Zero();
    Row second = Row::Zero();
    Row squares = Row::Zero();
    double fourth = 0.0;

    void add(const Row& row) noexcept;
    void add(const Sums& other) noexcept;
  };

  /// Row(t) = constant + t (linear + t quadratic), t from the origin.
  struct Parabola {
    Row constant = Row::Zero();
    Row linear = Row::Zero();
    Row quadratic = Row::Zero();
    Sums sums;
    double rounding = 0.0;  // bound of the relative error of what was computed; 0 = not usable
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

  // Always a sample of the shortest window, so that no sum is large against what a fit takes of it.
  Row origin_ = Row::Zero();
  std::size_t since_ = 0;                  // samples after the origin
  Sums after_;                             // over these
  std::array<Sums, kWindow + 1> up_to_{};  // [n]: over the n samples that end with the origin

  Parabola whole_;  // through all samples
};

}  // namespace reckon::haptics
