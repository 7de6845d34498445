// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A force feedback device of Linux; a model answers the kernel calls.
#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <utility>

#include "reckon/tests/fuzz/unplugs/tried_event_loop.hpp"
#include "reckon/tests/haptics/support/evdev_model.hpp"

namespace reckon::fuzz::unplugs {
namespace {

using std::chrono::microseconds;
using test::EvdevModel;

constexpr std::int32_t kCoarse = 1'023;  // steps of an axis of another device

/// The differences of another device.
struct Shape {
  std::optional<int> hidden_axis;
  bool is_coarse = false;
};

/// Faults of the calls; it outlives the loops that make them.
struct Calls {
  Calls(EvdevModel& of, NthCall& counted) : model(of), nth(counted) {}

  EvdevModel& model;
  NthCall& nth;
  bool is_dead = false;  // for the open file
  Shape shape;
  unsigned tries = 0;
  std::uint64_t commands = 0;  // calls that changed or played an effect
  nanoseconds busy_until{0};
  nanoseconds slow{0};  // of each of the next uploads
  unsigned slow_left = 0;
  unsigned read_errors = 0;
  unsigned long refused = 0;  // request; 0: a play
  int error = 0;
  unsigned refused_left = 0;
};

std::int32_t coarse(std::int32_t reading) {
  return static_cast<std::int32_t>((std::int64_t{reading} + 32'768) * kCoarse / 65'535);
}

/// A file that was open when the device was pulled out stays dead.
class StruckCalls final : public haptics::EventCalls {
 public:
  explicit StruckCalls(Calls& calls) : calls_(calls), model_(calls.model) {}

  std::vector<std::string> paths() override {
    calls_.nth.count();
    return model_.paths();
  }
  std::string closed_name(const std::string& path) override { return model_.closed_name(path); }
  haptics::ReportIntervals report_intervals(const std::string& path) override {
    return model_.report_intervals(path);
  }
  int open(const std::string& path) override {
    calls_.nth.count();
    ++calls_.tries;
    const int file = model_.open(path);
    if (file >= 0) calls_.is_dead = false;
    return file;
  }
  void close(int file) noexcept override { model_.close(file); }
  int control(int file, unsigned long request, void* argument) noexcept override;
  int read(int file, std::span<input_event> events) noexcept override;
  int write(int file, const input_event& event) noexcept override;
  void wait(int file, microseconds longest) noexcept override { model_.wait(file, longest); }

 private:
  [[nodiscard]] bool is_busy() const { return model_.now() < calls_.busy_until; }
  [[nodiscard]] bool is_refused(unsigned long request) {
    if (calls_.refused_left == 0 || request != calls_.refused) return false;
    --calls_.refused_left;
    return true;
  }
  int upload(int file, void* effect) noexcept;
  void reshape(unsigned long request, void* answer) const noexcept;

  Calls& calls_;
  EvdevModel& model_;
};

// The change leaves at once, because it has to be within the stated delay.
int StruckCalls::upload(int file, void* effect) noexcept {
  if (is_busy()) return -EAGAIN;
  const int result = model_.control(file, EVIOCSFF, effect);
  if (result >= 0) ++calls_.commands;
  if (calls_.slow_left == 0) return result;
  --calls_.slow_left;
  model_.pass(calls_.slow);
  return result;
}

int StruckCalls::control(int file, unsigned long request, void* argument) noexcept {
  calls_.nth.count();
  if (calls_.is_dead) return -ENODEV;
  if (is_refused(request)) return -calls_.error;
  if (request == EVIOCSFF) return upload(file, argument);
  const int result = model_.control(file, request, argument);
  if (result >= 0) reshape(request, argument);
  return result;
}

void StruckCalls::reshape(unsigned long request, void* answer) const noexcept {
  const int nr = static_cast<int>(_IOC_NR(request));
  if (nr == 0x20 + EV_ABS && calls_.shape.hidden_axis)
    *static_cast<std::uint8_t*>(answer) &=
        static_cast<std::uint8_t>(~(1U << *calls_.shape.hidden_axis));
  if ((nr == 0x40 || nr == 0x41) && calls_.shape.is_coarse) {
    auto& axis = *static_cast<input_absinfo*>(answer);
    axis.value = coarse(axis.value);
    axis.minimum = 0;
    axis.maximum = kCoarse;
  }
}

int StruckCalls::read(int file, std::span<input_event> events) noexcept {
  calls_.nth.count();
  if (calls_.is_dead) return -ENODEV;
  if (calls_.read_errors > 0) {
    --calls_.read_errors;
    return -EIO;
  }
  const int count = model_.read(file, events);
  if (!calls_.shape.is_coarse) return count;
  for (int i = 0; i < count; ++i) {
    input_event& event = events[static_cast<std::size_t>(i)];
    if (event.type == EV_ABS) event.value = coarse(event.value);
  }
  return count;
}

int StruckCalls::write(int file, const input_event& event) noexcept {
  calls_.nth.count();
  if (calls_.is_dead) return -ENODEV;
  const bool plays = event.type == EV_FF && event.code < FF_GAIN;
  if (is_busy()) return -EAGAIN;
  if (plays && is_refused(0)) return -calls_.error;
  const int result = model_.write(file, event);
  if (result >= 0 && plays && event.value > 0) ++calls_.commands;
  return result;
}

class TriedEventDevice final : public TriedEventLoop {
 public:
  TriedEventDevice(const Plan& plan, const HeldHand& hand)
      : TriedEventLoop(settings()), model_(options(plan), [&hand](double t) {
          return EvdevModel::Places{hand(t).z(), 0};
        }) {}
  ~TriedEventDevice() override {
    end_loop();
    model_.beside({});
  }

  nanoseconds now() const override { return model_.now(); }
  void pass(nanoseconds time) override { model_.pass(time); }
  void beside(Beside call) override { model_.beside(std::move(call)); }
  Vector3d place() const override { return {0, model_.place()[1], model_.place()[0]}; }
  void lead(const Vector3d& place) override { model_.hold({place.z(), place.y()}); }
  void let_go() override { model_.release(); }
  bool is_led() const override { return model_.is_held(); }

  double force() const override { return std::hypot(model_.force(0), model_.force(1)); }
  std::uint64_t commands() const override { return calls_of_.commands; }
  // Energy of its springs: the device's own ledger has no debts and no allowances.
  double books(const haptics::ServoSnapshot&) const override { return model_.least_absorbed(); }

  unsigned tries() const override { return calls_of_.tries; }

  void pull(bool) override {
    model_.plug(false);
    calls_of_.is_dead = true;
    calls_of_.refused_left = calls_of_.read_errors = calls_of_.slow_left = 0;
  }
  void plug() override { model_.plug(true); }
  bool is_plugged() const override { return model_.is_plugged(); }
  // The kernel reports it when an effect is played.
  bool loosen() override {
    refuse(0, EIO, 1'000'000);
    return false;
  }
  void be_another(const Fault& fault, nanoseconds) override;
  void be_itself() override {
    model_.without.clear();
    model_.most_effects = EvdevModel::kEffects;
    calls_of_.shape = {};
  }
  void deny(int error) override { model_.opening = -error; }
  bool strike(const Fault& fault, nanoseconds time) override;

 protected:
  std::unique_ptr<haptics::EventCalls> make_calls() override {
    return std::make_unique<StruckCalls>(calls_of_);
  }
  int open_files() const override { return model_.open_files(); }
  std::size_t effects() const override { return model_.effects(); }

 private:
  static test::EvdevModelOptions options(const Plan& plan) {
    test::EvdevModelOptions options;
    options.seed = static_cast<unsigned>(plan.seed);
    options.substeps = 1;
    return options;
  }
  static haptics::EvdevSettings settings() {
    haptics::EvdevSettings settings = test::settings_for({});
    settings.max_speed = 2.0;
    return settings;
  }
  void refuse(unsigned long request, int error, unsigned count) {
    calls_of_.refused = request;
    calls_of_.error = error;
    calls_of_.refused_left = count;
  }
  void strike_effects(const Fault& fault);

  EvdevModel model_;
  Calls calls_of_{model_, calls_};
};

void TriedEventDevice::be_another(const Fault& fault, nanoseconds) {
  switch (fault.call % 5) {
    case 0:
      model_.without = {FF_SPRING};
      return;
    case 1:
      model_.most_effects = 1;
      return;
    case 2:
    case 3:
      calls_of_.shape.hidden_axis = static_cast<int>(fault.call % 2);
      return;
    default:
      calls_of_.shape.is_coarse = true;
  }
}

// Refuses an upload, an erase, a play or a position request.
void TriedEventDevice::strike_effects(const Fault& fault) {
  static constexpr std::array<unsigned long, 4> kRequests{EVIOCSFF, EVIOCRMFF, 0, EVIOCGABS(ABS_X)};
  static constexpr std::array kErrors{ENOSPC, EIO, EINVAL, ENOMEM, EPERM};
  refuse(kRequests[fault.call % kRequests.size()], kErrors[fault.call % kErrors.size()],
         fault.number);
}

bool TriedEventDevice::strike(const Fault& fault, nanoseconds time) {
  switch (fault.kind) {
    case FaultKind::errors:
      calls_of_.read_errors = fault.number;
      return true;
    case FaultKind::busy:
      calls_of_.busy_until = now() + time;
      return false;
    case FaultKind::slow:
      calls_of_.slow = time;
      calls_of_.slow_left = fault.number;
      return false;
    case FaultKind::refusal:
      strike_effects(fault);
      return false;
    default:
      model_.drop_events();
      return false;
  }
}

}  // namespace

std::unique_ptr<TriedDevice> tried_event_device(const Plan& plan, const HeldHand& hand) {
  return std::make_unique<TriedEventDevice>(plan, hand);
}

}  // namespace reckon::fuzz::unplugs
