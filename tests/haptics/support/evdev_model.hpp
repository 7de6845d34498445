// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A force feedback device of Linux below the kernel's calls, and the hand that holds it: a mass on
// each axis, springs rendered by the device, its own ledger, and faults.
#pragma once

#include <linux/input.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "reckon/haptics/evdev/evdev_device.hpp"
#include "reckon/haptics/evdev/event_calls.hpp"

namespace reckon::test {

struct EvdevModelOptions {
  unsigned seed = 1;
  double mass = 0.2;                       ///< [kg]
  double hand_stiffness = 300;             ///< [N/m]
  double hand_damping = 6;                 ///< [N s/m]
  double travel = 0.2;                     ///< [m], of each axis
  double full_force = 20;                  ///< [N]
  double full_stiffness = 2000;            ///< [N/m]
  std::chrono::microseconds report{1000};  ///< between reports of its position
  std::chrono::microseconds latency{500};  ///< at most, until it obeys; seeded
  /// Time that it takes for one report of the host; a change of an effect is two reports, playing
  /// it is one.
  std::chrono::microseconds takes{125};
  bool misses_turns = false;  ///< every second turn: a report takes twice as long
  int substeps = 5;           ///< of its motion, within 50 us
  int axes = 2;
  bool ends_effects = true;  ///< obeys the length of an effect
};

/// The true facts of it, as in a scene, with a delay that it keeps.
inline haptics::EvdevSettings settings_for(const EvdevModelOptions& model) {
  haptics::EvdevSettings settings;
  settings.axes = model.axes;
  settings.scale = {model.travel, model.full_force, model.full_stiffness};
  settings.max_stiffness = 1500;
  settings.max_speed = 1.0;
  settings.chain =
      2 * model.report + model.latency + 8 * model.takes + std::chrono::milliseconds(1);
  return settings;
}

/// All time is the model's: wait() advances it. Calls take no time.
class EvdevModel final : public haptics::EventCalls {
 public:
  using Places = std::array<double, 2>;  // [m]

  /// @param hand the hand's goal for the handle [m] at a time [s]
  EvdevModel(const EvdevModelOptions& options, std::function<Places(double)> hand);

  [[nodiscard]] std::chrono::nanoseconds now() const { return now_; }
  /// Called every 50 us of its time, or every millisecond while it is held: the code that runs
  /// beside the device's thread.
  void beside(std::function<void(std::chrono::nanoseconds)> call) { beside_ = std::move(call); }
  void pass(std::chrono::nanoseconds time);

  /// An unyielding hand holds the handle here, at rest, until it is released. This is not booked.
  void hold(const Places& place) { held_at_ = place; }
  void release() { held_at_.reset(); }
  [[nodiscard]] bool is_held() const { return held_at_.has_value(); }

  // Faults.
  void plug(bool in);
  /// Unplugs it; the open file stays dead even after the device is plugged in again.
  void pull();
  std::function<void()> at_each_call = [] {};  ///< which may find it gone
  [[nodiscard]] bool is_plugged() const { return plugged_; }
  void fail(unsigned long request, int error) { failing_[request] = error; }  ///< 0: ends the fault
  void fail_writes(int error) { failing_write_ = error; }
  void drop_events() { drops_ = true; }  ///< of the next report
  void press(std::uint16_t key, bool down);
  std::vector<int> without;  ///< missing bits of EV_FF
  static constexpr int kEffects = 16;
  int most_effects = kEffects;      ///< at once
  int opening = 0;                  ///< result of open() if negative
  bool tells_interval = true;       ///< its report interval
  std::vector<std::string> others;  ///< paths before its own, which are no devices

  // Its own ledger, of its springs: energy taken from the hand since the start [J].
  [[nodiscard]] double absorbed() const { return absorbed_; }
  [[nodiscard]] double least_absorbed() const { return least_; }
  [[nodiscard]] double fastest() const { return fastest_; }  ///< [m/s], so far
  [[nodiscard]] double force(std::size_t axis) const { return force_at(axis, place_[axis]); }
  [[nodiscard]] double greatest_force() const { return greatest_; }
  [[nodiscard]] const Places& place() const { return place_; }
  [[nodiscard]] std::size_t effects() const { return effects_.size(); }
  [[nodiscard]] int uploads() const { return uploads_; }
  [[nodiscard]] std::int32_t gain() const { return gain_; }
  [[nodiscard]] std::int32_t autocenter() const { return autocenter_; }
  [[nodiscard]] int open_files() const { return open_; }
  /// Energy that each upload gave to its springs on arrival, in order [J].
  [[nodiscard]] const std::vector<double>& rises() const { return rises_; }
  /// Longest time so far from the newest position that was read to a change of an effect that
  /// followed, for a handle that moves all the time.
  [[nodiscard]] std::chrono::nanoseconds slowest_change() const { return slowest_change_; }

  std::vector<std::string> paths() override;
  std::string closed_name(const std::string& path) override;
  haptics::ReportIntervals report_intervals(const std::string& path) override;
  int open(const std::string& path) override;
  void close(int file) noexcept override;
  int control(int file, unsigned long request, void* argument) noexcept override;
  int read(int file, std::span<input_event> events) noexcept override;
  int write(int file, const input_event& event) noexcept override;
  void wait(int file, std::chrono::microseconds longest) noexcept override;

 private:
  struct Effect {
    ff_effect numbers{};
    bool plays = false;
    std::chrono::nanoseconds until{0};
  };
  struct Order {
    std::chrono::nanoseconds at{0};
    std::function<void()> act;
  };

  void order(int reports, std::function<void()> act);
  void run(double h);
  void report();
  void send(std::uint16_t type, std::uint16_t code, std::int32_t value);
  [[nodiscard]] int ask_bits(unsigned long request, void* argument) const;
  [[nodiscard]] std::int32_t reading(std::size_t axis) const;
  [[nodiscard]] double force_at(std::size_t axis, double x) const;
  [[nodiscard]] double energy_at(std::size_t axis, double x) const;
  [[nodiscard]] double stored() const;
  template <class Each>
  void each_spring(std::size_t axis, double x, Each&& each) const;

  EvdevModelOptions options_;
  std::function<Places(double)> hand_;
  std::function<void(std::chrono::nanoseconds)> beside_;
  std::mt19937 random_;
  std::chrono::nanoseconds now_{0}, next_report_{0}, last_order_{0}, slowest_change_{0};
  std::chrono::nanoseconds sent_at_{0}, known_at_{0};  // the newest position, and the one that was
                                                       // read
  Places place_{}, speed_{};
  std::optional<Places> held_at_;
  std::map<int, Effect> effects_;
  std::deque<Order> orders_;
  std::vector<double> rises_;
  std::deque<input_event> events_;
  std::array<std::int32_t, 2> sent_{};
  std::map<std::uint16_t, bool> keys_;
  std::map<unsigned long, int> failing_;
  int failing_write_ = 0;
  bool plugged_ = true, is_dead_ = false, drops_ = false;
  int open_ = 0, uploads_ = 0;
  std::int32_t gain_ = -1, autocenter_ = -1;
  double absorbed_ = 0, least_ = 0, fastest_ = 0, greatest_ = 0;
};

/// For a session that does not own the model; the model must outlive it.
std::unique_ptr<haptics::EventCalls> calls_of(EvdevModel& model);

}  // namespace reckon::test
