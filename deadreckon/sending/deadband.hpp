// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A sampled signal, a force or a velocity, that is sent only if a person could feel the difference:
// the Weber deadband. Between updates it is predicted, as a held value or along a line. The model
// that recently needed fewer packets is used.
//
// For signals without a model: a contact is better sent as its force model.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace reckon::deadreckon {

/// Difference above which an update is sent.
struct Deadband {
  /// Share of the signal's size, 0 to 1. Default 0.1: people notice force changes of 7 to 10 %.
  double weber = 0.1;
  /// Difference [unit of the signal] up to which nothing is sent, >= 0. Without it, all noise
  /// around zero would be sent. Default 0.05, for newtons.
  double floor = 0.05;
};

/// The greatest difference from this value for which nothing is sent.
[[nodiscard]] double deadband_width(const Deadband& deadband,
                                    const Eigen::Vector3d& value) noexcept;

enum class SignalModel : std::uint8_t { hold, line };
[[nodiscard]] std::string_view name(SignalModel model) noexcept;

/// Content of an update: a value and, for a line, its rate (zero for a held value).
struct SignalUpdate {
  double time = 0;                                  ///< [s]
  Eigen::Vector3d value = Eigen::Vector3d::Zero();  ///< Any unit.
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();   ///< The unit a second.
  SignalModel model = SignalModel::hold;
};

/// Time [s] for which a line is followed. Then its last value holds, which bounds the error if the
/// next update is lost.
inline constexpr double kLongestLine = 0.25;

/// The signal at `time` [s] at every receiver. Before the update's time: its value.
[[nodiscard]] Eigen::Vector3d predict(const SignalUpdate& update, double time) noexcept;

/// The sender of one signal. Not synchronised, no allocation; some 100 ns a sample.
class DeadbandSender {
 public:
  explicit DeadbandSender(const Deadband& deadband = {}) noexcept : deadband_(deadband) {}
  /// Always uses this model; serves for comparison.
  DeadbandSender(const Deadband& deadband, SignalModel only) noexcept
      : deadband_(deadband), model_(only), chooses_(false) {}

  /// Takes the sample of `time` [s]. Returns the update to send, or nothing if receivers are within
  /// the deadband. Ignores times that do not increase and values that are not finite.
  std::optional<SignalUpdate> sample(double time, const Eigen::Vector3d& value) noexcept;

  /// The model that the next update will use.
  [[nodiscard]] SignalModel model() const noexcept { return model_; }

 private:
  /// State of a sender that uses only one model: its last update, and its packets over about the
  /// last second.
  struct Rival {
    SignalUpdate update;
    double packets = 0;
  };

  [[nodiscard]] Eigen::Vector3d slope() const noexcept;
  [[nodiscard]] SignalUpdate update_of(SignalModel model, double time,
                                       const Eigen::Vector3d& value) const noexcept;
  [[nodiscard]] bool outside(const SignalUpdate& update, double time,
                             const Eigen::Vector3d& value) const noexcept;
  void remember(double time, const Eigen::Vector3d& value) noexcept;
  void compare(double since, const Eigen::Vector3d& value) noexcept;

  static constexpr std::size_t kSlopeSamples = 5;

  Deadband deadband_;
  std::array<double, kSlopeSamples> times_{};  // newest first
  std::array<Eigen::Vector3d, kSlopeSamples> values_{};
  std::size_t samples_ = 0;
  std::array<Rival, 2> rivals_;
  SignalModel model_ = SignalModel::hold;
  bool chooses_ = true;
  SignalUpdate sent_;
  bool has_sent_ = false;
};

}  // namespace reckon::deadreckon
