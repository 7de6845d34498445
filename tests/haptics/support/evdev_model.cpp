// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/haptics/support/evdev_model.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

namespace reckon::test {
namespace {

using std::chrono::microseconds;
using std::chrono::nanoseconds;

constexpr const char* kPath = "/dev/input/event7";
constexpr int kFile = 7;
constexpr microseconds kStep{50};
// For a held handle without force: its time is cheap.
constexpr microseconds kHeldStep{1000};
constexpr std::int32_t kLeast = -32768, kMost = 32767;  // of its axes

}  // namespace

EvdevModel::EvdevModel(const EvdevModelOptions& options, std::function<Places(double)> hand)
    : options_(options), hand_(std::move(hand)), random_(options.seed) {
  place_ = hand_(0);
}

void EvdevModel::pass(nanoseconds time) {
  for (const nanoseconds end = now_ + time; now_ < end;) {
    const bool is_cheap = held_at_ && effects_.empty();
    const nanoseconds step = is_cheap ? std::min<nanoseconds>(kHeldStep, end - now_) : kStep;
    now_ += step;
    while (!orders_.empty() && orders_.front().at <= now_) {
      orders_.front().act();
      orders_.pop_front();
    }
    for (auto& [id, effect] : effects_)
      if (effect.plays && options_.ends_effects && now_ >= effect.until) effect.plays = false;
    for (int i = 0; i < options_.substeps; ++i)
      run(std::chrono::duration<double>(step).count() / options_.substeps);
    if (plugged_ && now_ >= next_report_) report();
    if (beside_) beside_(now_);
  }
}

// The energy input to a constant model is the difference of its potential, for any step.
void EvdevModel::run(double h) {
  if (held_at_) {
    place_ = *held_at_;
    speed_ = {};
    return;
  }
  const double t = std::chrono::duration<double>(now_).count();
  const Places to = hand_(t), before = hand_(t - 1e-4);
  for (std::size_t i = 0; i < static_cast<std::size_t>(options_.axes); ++i) {
    const double wanted_speed = (to[i] - before[i]) / 1e-4;
    const double force = force_at(i, place_[i]) + options_.hand_stiffness * (to[i] - place_[i]) +
                         options_.hand_damping * (wanted_speed - speed_[i]);
    greatest_ = std::max(greatest_, std::abs(force_at(i, place_[i])));
    speed_[i] += h * force / options_.mass;
    const double old = energy_at(i, place_[i]);
    place_[i] += h * speed_[i];
    absorbed_ += energy_at(i, place_[i]) - old;
    fastest_ = std::max(fastest_, std::abs(speed_[i]));
  }
  least_ = std::min(least_, absorbed_);
}

template <class Each>
void EvdevModel::each_spring(std::size_t axis, double x, Each&& each) const {
  if (!plugged_) return;
  for (const auto& [id, effect] : effects_) {
    if (!effect.plays) continue;
    const ff_condition_effect& c = effect.numbers.u.condition[axis];
    const double beyond = x - c.center / 32767.0 * options_.travel / 2;
    const bool is_right = beyond > 0;
    const double k = (is_right ? c.right_coeff : c.left_coeff) / 32767.0 * options_.full_stiffness;
    const double most =
        (is_right ? c.right_saturation : c.left_saturation) / 65535.0 * options_.full_force;
    if (k > 0) each(std::abs(beyond), k, most, is_right ? -1.0 : 1.0);
  }
}

double EvdevModel::force_at(std::size_t axis, double x) const {
  double force = 0;
  each_spring(axis, x, [&](double d, double k, double most, double sign) {
    force += sign * std::min(k * d, most);
  });
  return force;
}

double EvdevModel::energy_at(std::size_t axis, double x) const {
  double energy = 0;
  each_spring(axis, x, [&](double d, double k, double most, double /*sign*/) {
    const double f = std::min(k * d, most);
    energy += f * d - f * f / (2 * k);
  });
  return energy;
}

double EvdevModel::stored() const { return energy_at(0, place_[0]) + energy_at(1, place_[1]); }

std::int32_t EvdevModel::reading(std::size_t axis) const {
  const double share = place_[axis] / options_.travel + 0.5;
  const double whole = static_cast<double>(kMost) - kLeast;
  return static_cast<std::int32_t>(std::lround(kLeast + std::clamp(share, 0.0, 1.0) * whole));
}

void EvdevModel::send(std::uint16_t type, std::uint16_t code, std::int32_t value) {
  input_event event{};
  event.type = type;
  event.code = code;
  event.value = value;
  if (open_ > 0) events_.push_back(event);
}

void EvdevModel::report() {
  next_report_ = now_ + options_.report;
  if (drops_) {
    send(EV_SYN, SYN_DROPPED, 0);
    send(EV_ABS, ABS_X, 30000);  // an incomplete frame, which must be ignored
  }
  bool is_new = drops_;
  for (std::size_t i = 0; i < static_cast<std::size_t>(options_.axes); ++i) {
    const std::int32_t value = reading(i);
    if (value == sent_[i]) continue;
    sent_[i] = value;
    is_new = true;
    if (!drops_) send(EV_ABS, static_cast<std::uint16_t>(ABS_X + i), value);
  }
  if (is_new) {
    send(EV_SYN, SYN_REPORT, 0);
    sent_at_ = now_;
  }
  drops_ = false;
}

void EvdevModel::press(std::uint16_t key, bool down) {
  keys_[key] = down;
  send(EV_KEY, key, down ? 1 : 0);
  send(EV_SYN, SYN_REPORT, 0);
}

void EvdevModel::plug(bool in) {
  plugged_ = in;
  effects_.clear();
  events_.clear();
  orders_.clear();
}

// In the order of the requests.
void EvdevModel::order(int reports, std::function<void()> act) {
  std::uniform_int_distribution<std::int64_t> within(0, options_.latency.count());
  last_order_ = std::max(last_order_, now_ + microseconds(within(random_))) +
                (options_.misses_turns ? 2 : 1) * reports * options_.takes;
  orders_.push_back({last_order_, std::move(act)});
}

void EvdevModel::pull() {
  plug(false);
  is_dead_ = true;
}

std::vector<std::string> EvdevModel::paths() {
  at_each_call();
  std::vector<std::string> all = others;
  if (plugged_) all.emplace_back(kPath);
  return all;
}

std::string EvdevModel::closed_name(const std::string& path) {
  return path == kPath ? "Model wheel" : "";
}

haptics::ReportIntervals EvdevModel::report_intervals(const std::string& /*path*/) {
  if (!tells_interval) return {};
  return {options_.takes, options_.report};
}

int EvdevModel::open(const std::string& path) {
  at_each_call();
  if (path != kPath || !plugged_) return -ENOENT;
  if (opening < 0) return opening;
  is_dead_ = false;
  ++open_;
  return kFile;
}

// The next one to open it has its own effects.
void EvdevModel::close(int /*file*/) noexcept {
  --open_;
  events_.clear();
  if (open_ > 0) return;
  std::vector<int> its;
  for (const auto& [id, effect] : effects_) its.push_back(id);
  order(0, [this, its = std::move(its)] {
    for (const int id : its) effects_.erase(id);
  });
}

int EvdevModel::ask_bits(unsigned long request, void* argument) const {
  auto* const octets = static_cast<std::uint8_t*>(argument);
  const std::size_t length = _IOC_SIZE(request);
  std::memset(octets, 0, length);
  const auto set = [&](std::size_t bit) {
    octets[bit / 8] |= static_cast<std::uint8_t>(1U << bit % 8);
  };
  const int nr = _IOC_NR(request);
  if (nr == 0x20 + EV_FF) {
    for (const int bit : {FF_RUMBLE, FF_SPRING, FF_CONSTANT, FF_GAIN, FF_AUTOCENTER})
      if (std::ranges::find(without, bit) == without.end()) set(static_cast<std::size_t>(bit));
  }
  if (nr == 0x20 + EV_ABS)
    for (int i = 0; i < options_.axes; ++i) set(static_cast<std::size_t>(ABS_X + i));
  if (nr == 0x20 + EV_KEY) {
    set(BTN_TRIGGER);
    set(BTN_THUMB);
  }
  if (nr == 0x18) {
    for (const auto& [key, down] : keys_)
      if (down) set(key);
  }
  return static_cast<int>(length);
}

int EvdevModel::control(int /*file*/, unsigned long request, void* argument) noexcept {
  at_each_call();
  if (!plugged_ || is_dead_) return -ENODEV;
  if (const auto found = failing_.find(request); found != failing_.end() && found->second != 0)
    return -found->second;
  const int nr = _IOC_NR(request);
  if (request == EVIOCGRAB) return 0;
  if (request == EVIOCGEFFECTS) {
    *static_cast<int*>(argument) = most_effects;
    return 0;
  }
  if (request == EVIOCSFF) {
    auto& told = *static_cast<ff_effect*>(argument);
    const bool is_new = told.id < 0;
    if (is_new) {
      if (static_cast<int>(effects_.size()) >= most_effects) return -ENOSPC;
      told.id = 0;  // the lowest free one
      while (effects_.contains(told.id)) ++told.id;
      effects_[told.id].numbers.replay = told.replay;
    } else if (!effects_.contains(told.id)) {
      return -EINVAL;
    }
    ++uploads_;
    order(2, [this, numbers = told] {
      const double before = stored();
      if (effects_.contains(numbers.id)) effects_[numbers.id].numbers = numbers;
      rises_.push_back(stored() - before);
    });
    if (!is_new) slowest_change_ = std::max(slowest_change_, last_order_ - known_at_);
    return 0;
  }
  if (request == EVIOCRMFF) {
    const auto id = static_cast<int>(reinterpret_cast<std::intptr_t>(argument));
    order(1, [this, id] { effects_.erase(id); });
    return 0;
  }
  if (nr == 0x06) {  // EVIOCGNAME
    std::strncpy(static_cast<char*>(argument), "Model wheel", _IOC_SIZE(request));
    return 12;
  }
  if (nr == 0x18 || (nr >= 0x20 && nr < 0x40)) return ask_bits(request, argument);
  if (nr >= 0x40 && nr < 0x40 + options_.axes) {  // EVIOCGABS
    auto& info = *static_cast<input_absinfo*>(argument);
    info = {};
    info.value = sent_[static_cast<std::size_t>(nr - 0x40)];
    info.minimum = kLeast;
    info.maximum = kMost;
    return 0;
  }
  return -EINVAL;
}

int EvdevModel::read(int /*file*/, std::span<input_event> events) noexcept {
  at_each_call();
  if (!plugged_ || is_dead_) return -ENODEV;
  if (events_.empty()) return -EAGAIN;
  std::size_t count = 0;
  while (count < events.size() && !events_.empty()) {
    events[count++] = events_.front();
    events_.pop_front();
  }
  if (events_.empty()) known_at_ = sent_at_;
  return static_cast<int>(count);
}

int EvdevModel::write(int /*file*/, const input_event& event) noexcept {
  at_each_call();
  if (!plugged_ || is_dead_) return -ENODEV;
  if (failing_write_ != 0) return -failing_write_;
  if (event.type != EV_FF) return -EINVAL;
  if (event.code == FF_GAIN) {
    gain_ = event.value;
  } else if (event.code == FF_AUTOCENTER) {
    autocenter_ = event.value;
  } else {
    order(1, [this, event] {
      const auto found = effects_.find(event.code);
      if (found == effects_.end()) return;
      found->second.plays = event.value > 0;
      found->second.until = now_ + std::chrono::milliseconds(found->second.numbers.replay.length);
    });
  }
  return 0;
}

void EvdevModel::wait(int /*file*/, microseconds longest) noexcept { pass(longest); }

namespace {

class Lent final : public haptics::EventCalls {
 public:
  explicit Lent(EvdevModel& model) : model_(model) {}
  std::vector<std::string> paths() override { return model_.paths(); }
  std::string closed_name(const std::string& path) override { return model_.closed_name(path); }
  haptics::ReportIntervals report_intervals(const std::string& path) override {
    return model_.report_intervals(path);
  }
  int open(const std::string& path) override { return model_.open(path); }
  void close(int file) noexcept override { model_.close(file); }
  int control(int file, unsigned long request, void* argument) noexcept override {
    return model_.control(file, request, argument);
  }
  int read(int file, std::span<input_event> events) noexcept override {
    return model_.read(file, events);
  }
  int write(int file, const input_event& event) noexcept override {
    return model_.write(file, event);
  }
  void wait(int file, microseconds longest) noexcept override { model_.wait(file, longest); }

 private:
  EvdevModel& model_;
};

}  // namespace

std::unique_ptr<haptics::EventCalls> calls_of(EvdevModel& model) {
  return std::make_unique<Lent>(model);
}

}  // namespace reckon::test
