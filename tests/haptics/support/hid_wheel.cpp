// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/haptics/support/hid_wheel.hpp"

#include <algorithm>
#include <cerrno>
#include <utility>

#include "reckon/haptics/hid/hid_events.hpp"

namespace reckon::test {
namespace {

using std::chrono::microseconds;
using std::chrono::nanoseconds;

constexpr int kFile = 40;
constexpr microseconds kTick{100};
constexpr std::chrono::milliseconds kHeldTick{1};
constexpr std::size_t kKept = 64;  // reports kept by the kernel for a slow reader

/// A host without event devices.
class NoEvents final : public haptics::EventCalls {
 public:
  std::vector<std::string> paths() override { return {}; }
  std::string closed_name(const std::string&) override { return {}; }
  haptics::ReportIntervals report_intervals(const std::string&) override { return {}; }
  int open(const std::string&) override { return -ENOENT; }
  void close(int) noexcept override {}
  int control(int, unsigned long, void*) noexcept override { return -ENOTTY; }
  int read(int, std::span<input_event>) noexcept override { return -EAGAIN; }
  int write(int, const input_event&) noexcept override { return -ENOTTY; }
  void wait(int, microseconds longest) noexcept override { wait_(longest); }
  explicit NoEvents(std::function<void(microseconds)> wait) : wait_(std::move(wait)) {}

 private:
  std::function<void(microseconds)> wait_;
};

/// The wheel's; it stays with the test.
class Lent final : public haptics::HidCalls {
 public:
  explicit Lent(HidWheel& wheel) : wheel_(wheel) {}
  std::vector<std::string> paths() override { return wheel_.paths(); }
  haptics::HidSeen look(const std::string& path) override { return wheel_.look(path); }
  haptics::ReportIntervals report_intervals(const std::string& path) override {
    return wheel_.report_intervals(path);
  }
  int open(const std::string& path) override { return wheel_.open(path); }
  void close(int file) noexcept override { wheel_.close(file); }
  int take(int file) noexcept override { return wheel_.take(file); }
  bool is_there(int file) noexcept override { return wheel_.is_there(file); }
  int read(int file, std::span<std::uint8_t> report) noexcept override {
    return wheel_.read(file, report);
  }
  int write(int file, std::span<const std::uint8_t> report) noexcept override {
    return wheel_.write(file, report);
  }
  int set_feature(int file, std::span<const std::uint8_t> report) noexcept override {
    return wheel_.set_feature(file, report);
  }
  int get_feature(int file, std::span<std::uint8_t> report) noexcept override {
    return wheel_.get_feature(file, report);
  }
  int get_input(int file, std::span<std::uint8_t> report) noexcept override {
    return wheel_.get_input(file, report);
  }
  void wait(int file, microseconds longest) noexcept override { wheel_.wait(file, longest); }

 private:
  HidWheel& wheel_;
};

int copied(const std::vector<std::uint8_t>& from, std::span<std::uint8_t> to) {
  const std::size_t octets = std::min(from.size(), to.size());
  std::copy_n(from.begin(), octets, to.begin());
  return static_cast<int>(octets);
}

}  // namespace

haptics::EvdevSettings settings_for(const HidWheelOptions& options) {
  haptics::EvdevSettings settings;
  settings.axes = options.wheel.axes;
  settings.scale = {options.wheel.travel, options.wheel.full_force, options.wheel.full_stiffness};
  settings.max_stiffness = 1500;
  settings.max_speed = 1.0;
  settings.chain = 2 * options.reports + 4 * options.takes + std::chrono::milliseconds(1);
  return settings;
}

std::unique_ptr<haptics::EventCalls> calls_of(HidWheel& wheel) {
  return haptics::with_hid_devices(
      std::make_unique<NoEvents>([&wheel](microseconds time) { wheel.pass(time); }),
      std::make_unique<Lent>(wheel));
}

HidWheel::HidWheel(const HidWheelOptions& options, std::function<Places(double)> hand)
    : wheel(options.wheel), options_(options), hand_(std::move(hand)) {
  seen = {kName, wheel.descriptor(), false, 0x1209, 0xFFB0};
}

void HidWheel::pass(nanoseconds time) {
  for (const nanoseconds end = now_ + time; now_ < end;) {
    const bool is_cheap = wheel.is_held() && wheel.effects() == 0;
    now_ += is_cheap ? std::min<nanoseconds>(kHeldTick, end - now_) : kTick;
    const Places wanted = hand_(std::chrono::duration<double>(now_).count());
    for (std::size_t axis = 0; axis < wanted.size(); ++axis) wheel.want(axis, wanted[axis]);
    wheel.run_until(now_);
    if (now_ >= next_report_) {
      next_report_ = now_ + options_.reports;
      if (auto report = wheel.input(); plugged_ && open_ > 0 && report != sent_) {
        sent_ = report;
        reports_.push_back(std::move(report));
        if (reports_.size() > kKept) reports_.pop_front();
      }
    }
    if (beside_) beside_(now_);
  }
}

void HidWheel::plug(bool in) {
  if (!in) {
    wheel.lose_power();
    is_dead_ = true;  // the file that was open stays dead
    reports_.clear();
  }
  plugged_ = in;
}

std::vector<std::string> HidWheel::paths() {
  at_each_call();
  return plugged_ ? std::vector<std::string>{kPath} : std::vector<std::string>{};
}

haptics::HidSeen HidWheel::look(const std::string& path) {
  at_each_call();
  return path == kPath && plugged_ ? seen : haptics::HidSeen{};
}

haptics::ReportIntervals HidWheel::report_intervals(const std::string&) {
  at_each_call();
  if (!options_.tells_interval) return {};
  return {options_.takes, options_.reports};
}

int HidWheel::open(const std::string& path) {
  at_each_call();
  ++tries_;
  if (path != kPath || !plugged_) return -ENOENT;
  if (opening < 0) return opening;
  ++open_;
  is_dead_ = false;
  sent_ = wheel.input();
  reports_.clear();
  return kFile;
}

void HidWheel::close(int) noexcept { --open_; }

int HidWheel::take(int) noexcept {
  at_each_call();
  if (is_dead_) return -ENODEV;
  return is_taken ? -EBUSY : 0;
}

bool HidWheel::is_there(int) noexcept { return !is_dead_; }

int HidWheel::made(Call call, microseconds time) noexcept {
  at_each_call();
  const nanoseconds begin = now_;
  pass(time);
  longest_call_ = std::max(longest_call_, now_ - begin);
  if (is_dead_) return -ENODEV;
  Failure& failure = failing_[call];
  if (failure.left == 0) return 0;
  --failure.left;
  return failure.error;
}

int HidWheel::read(int, std::span<std::uint8_t> report) noexcept {
  at_each_call();
  if (is_dead_) return -EIO;  // as in hidraw
  if (failing_reads_ > 0) {
    --failing_reads_;
    return -EIO;
  }
  if (reports_.empty()) return -EAGAIN;
  const int octets = copied(reports_.front(), report);
  reports_.pop_front();
  return octets;
}

int HidWheel::write(int, std::span<const std::uint8_t> report) noexcept {
  const int result = made(Call::write, options_.takes);
  if (result == 0) wheel.take(report);
  if (slow_.left > 0) {
    --slow_.left;
    pass(slow_.each);
  }
  return result;
}

int HidWheel::set_feature(int, std::span<const std::uint8_t> report) noexcept {
  const int result = made(Call::set_feature, options_.answers);
  if (result == 0) wheel.take(report);
  return result;
}

int HidWheel::get_feature(int, std::span<std::uint8_t> report) noexcept {
  const int result = made(Call::get_feature, options_.answers);
  if (result < 0) return result;
  const auto answer = wheel.feature(report[0]);
  return answer ? copied(*answer, report) : -EPIPE;
}

int HidWheel::get_input(int, std::span<std::uint8_t> report) noexcept {
  at_each_call();
  if (is_dead_) return -ENODEV;
  return options_.says_where ? copied(wheel.input(), report) : -EPIPE;
}

void HidWheel::wait(int, microseconds longest) noexcept {
  for (const nanoseconds end = now_ + longest; now_ < end && reports_.empty() && !is_dead_;)
    pass(kTick);
}

}  // namespace reckon::test
