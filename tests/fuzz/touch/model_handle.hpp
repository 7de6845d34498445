// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The model of a device in the first hand: its own clock, its faults, and its energy ledger.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "reckon/tests/fuzz/touch/handle.hpp"
#include "reckon/tests/fuzz/touch/scenario.hpp"

namespace reckon::fuzz {

/// All times are of its clock. begin() is far from the clock's start: before it the device is set
/// up, homed and led to the hand's first position.
class ModelHandle : public Handle {
 public:
  using Way = std::function<Eigen::Vector3d(double)>;  // [m], at a time [s] after begin()

  [[nodiscard]] std::chrono::nanoseconds begin() const { return begin_; }
  /// Advances its time. @param beside called every 50 us
  void run(std::chrono::nanoseconds until,
           const std::function<void(std::chrono::nanoseconds)>& beside);

  [[nodiscard]] double port_work() const final { return port_work_now() - first_work_; }
  [[nodiscard]] double work() const final { return work_now() - first_; }
  [[nodiscard]] double work_known() const override;
  [[nodiscard]] std::chrono::nanoseconds silence() final;

 protected:
  /// @param scenario outlives it
  ModelHandle(const Scenario& scenario, Way way) : scenario_(scenario), way_(std::move(way)) {}

  /// Begins so long before begin_at() that no reading of the servo is older.
  void begin_books();
  /// The last call of a constructor, when the device is ready.
  void begin_at(std::chrono::nanoseconds now);
  /// The hand's goal at a time of its clock [s].
  [[nodiscard]] Eigen::Vector3d wanted(double t) const;
  /// The model calls it every 50 us.
  void tick(std::chrono::nanoseconds now);
  [[nodiscard]] const Scenario& scenario() const { return scenario_; }

  virtual void pass(std::chrono::nanoseconds time) = 0;
  [[nodiscard]] virtual std::chrono::nanoseconds now() const = 0;
  [[nodiscard]] virtual double port_work_now() const = 0;
  [[nodiscard]] virtual double work_now() const = 0;
  /// The servo knows everything before this instant.
  [[nodiscard]] virtual std::chrono::nanoseconds known_until() const = 0;
  /// Begins a fault. @param lasts its length
  virtual void befall(Fault fault, std::chrono::nanoseconds lasts) = 0;
  /// Ends a fault that does not end by itself.
  virtual void mend(Fault fault) = 0;

 private:
  void play_faults(std::chrono::nanoseconds now);

  const Scenario& scenario_;
  Way way_;
  std::function<void(std::chrono::nanoseconds)> beside_;
  std::chrono::nanoseconds begin_{0};
  double first_ = 0, first_work_ = 0;
  std::vector<double> books_;  // every 50 us from begin() on
  std::chrono::nanoseconds next_fault_{0}, mends_{0}, silence_{0};
  bool is_begun_ = false, is_hurt_ = false;
};

/// The device that the scenario names. @param period of its servo  @param way of the hand
[[nodiscard]] std::unique_ptr<ModelHandle> model_handle(const Scenario& scenario,
                                                        std::chrono::nanoseconds period,
                                                        ModelHandle::Way way);

// One for each kind of device.
[[nodiscard]] std::unique_ptr<ModelHandle> usb_handle(const Scenario& scenario,
                                                      std::chrono::nanoseconds period,
                                                      ModelHandle::Way way);
[[nodiscard]] std::unique_ptr<ModelHandle> board_handle(const Scenario& scenario,
                                                        std::chrono::nanoseconds period,
                                                        ModelHandle::Way way);
[[nodiscard]] std::unique_ptr<ModelHandle> event_handle(const Scenario& scenario,
                                                        ModelHandle::Way way);

}  // namespace reckon::fuzz
