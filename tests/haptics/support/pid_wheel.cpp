// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Numbers of usages from the class definition of Physical Interface Devices 1.0.
#include "reckon/tests/haptics/support/pid_wheel.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace reckon::test {
namespace {

using std::chrono::nanoseconds;
using Octets = std::span<const std::uint8_t>;

// Numbers of its reports.
enum : std::uint8_t {
  kPlaces = 1,
  kState,
  kSetEffect,
  kOperation,
  kFree,
  kControl,
  kGain,
  kSetCondition,
  kCreate,
  kLoad,
  kPool
};

constexpr std::uint8_t kLoadedWell = 1, kLoadFull = 2;  // places in their lists
constexpr std::uint8_t kStart = 1, kStartAlone = 2, kStop = 3;
constexpr int kReading = 32767;  // of an axis at its end
constexpr std::chrono::microseconds kStep{100};

constexpr int kDesktop = 0x01, kButtons = 0x09, kOrdinals = 0x0A, kForces = 0x0F;
constexpr std::uint8_t kInput = 0x80, kOutput = 0x90, kFeature = 0xB0;
constexpr int kVariable = 2, kArray = 0, kConstant = 3;

/// Items of a report descriptor.
class Items {
 public:
  explicit Items(std::vector<int> without) : without_(std::move(without)) {}

  Items& item(int tag, int value) {
    const bool is_one = value >= -128 && value <= 127, is_two = value >= -32768 && value <= 32767;
    const int octets = is_one ? 1 : is_two ? 2 : 4;
    add(tag | (octets == 4 ? 3 : octets));
    for (int i = 0; i < octets; ++i) add(value >> 8 * i);
    return *this;
  }
  Items& page(int number) { return item(0x04, number); }
  Items& usage(int number) {
    add(0x09);
    add(number);
    return *this;
  }
  Items& open(int use, int kind) { return usage(use).item(0xA0, kind); }
  Items& close() {
    add(0xC0);
    return *this;
  }
  Items& report(int use, int number) { return open(use, 2).item(0x84, number); }
  /// `count` numbers of the preceding usages.
  Items& numbers(int main, int least, int most, int bits, int count, int kind) {
    item(0x14, least).item(0x24, most);
    return item(0x74, bits).item(0x94, count).item(main, kind);
  }
  Items& number(int main, int use, int least, int most, int bits) {
    if (lacks(use)) return unused(main, bits);
    return usage(use).numbers(main, least, most, bits, 1, kVariable);
  }
  Items& unused(int main, int bits) { return item(0x74, bits).item(0x94, 1).item(main, kConstant); }
  /// One of a list, from 1.
  Items& choice(int main, int use, std::initializer_list<int> list) {
    if (lacks(use)) return unused(main, 8);
    open(use, 2);
    for (const int one : list) usage(one);
    return numbers(main, 1, static_cast<int>(list.size()), 8, 1, kArray).close();
  }
  Items& block(int main) { return number(main, 0x22, 1, PidWheel::kMostEffects, 8); }
  [[nodiscard]] std::vector<std::uint8_t> take() { return std::move(octets_); }

 private:
  void add(int octet) { octets_.push_back(static_cast<std::uint8_t>(octet)); }
  [[nodiscard]] bool lacks(int use) const {
    return std::ranges::find(without_, use) != without_.end();
  }

  std::vector<int> without_;
  std::vector<std::uint8_t> octets_;
};

int word(Octets report, std::size_t at) {
  return static_cast<std::int16_t>(report[at] | report[at + 1] << 8);
}

void add_word(std::vector<std::uint8_t>& to, int value) {
  to.push_back(static_cast<std::uint8_t>(value));
  to.push_back(static_cast<std::uint8_t>(value >> 8));
}

// Octets of a report of the host, with its number; 0: no such report.
std::size_t size_of(std::uint8_t number) {
  switch (number) {
    case kSetEffect:
      return 18;
    case kOperation:
      return 4;
    case kFree:
    case kControl:
    case kGain:
      return 2;
    case kSetCondition:
      return 15;
    case kCreate:
      return 4;
    default:
      return 0;
  }
}

}  // namespace

std::vector<std::uint8_t> PidWheel::descriptor() const {
  constexpr int kMost = static_cast<int>(kSteps);
  Items d(options_.without);
  d.page(kDesktop).open(0x04, 1);  // joystick
  d.item(0x84, kPlaces).page(kButtons).item(0x18, 1).item(0x28, 8);
  d.numbers(kInput, 0, 1, 1, 8, kVariable).page(kDesktop).usage(0x30);
  if (options_.axes == 2) d.usage(0x31);
  d.numbers(kInput, -kReading, kReading, 16, options_.axes, kVariable);

  d.page(kForces).report(0x92, kState);
  for (const int use : {0x9F, 0xA0, 0xA4, 0xA5, 0xA6}) d.usage(use);
  d.numbers(kInput, 0, 1, 1, 5, kVariable).unused(kInput, 3);
  d.number(kInput, 0x94, 0, 1, 1).number(kInput, 0x22, 1, kMostEffects, 7).close();

  d.report(0x21, kSetEffect).block(kOutput).choice(kOutput, 0x25, {0x40});
  for (const int use : {0x50, 0x54, 0x51, 0xA7}) d.number(kOutput, use, 0, 0x7FFF, 16);
  d.number(kOutput, 0x52, 0, 255, 8).number(kOutput, 0x53, 1, 8, 8);
  d.open(0x55, 2).page(kDesktop).usage(0x30).usage(0x31);
  d.numbers(kOutput, 0, 1, 1, 2, kVariable).close().page(kForces);
  d.number(kOutput, 0x56, 0, 1, 1).unused(kOutput, 5);
  d.open(0x57, 2).page(kOrdinals).usage(1).usage(2);
  d.numbers(kOutput, 0, 35900, 16, 2, kVariable).close().page(kForces).close();

  d.report(0x77, kOperation).block(kOutput).choice(kOutput, 0x78, {0x79, 0x7A, 0x7B});
  d.number(kOutput, 0x7C, 0, 255, 8).close();
  d.report(0x90, kFree).block(kOutput).close();
  d.report(0x95, kControl).choice(kOutput, 0x96, {0x97, 0x98, 0x99, 0x9A, 0x9B, 0x9C}).close();
  d.report(0x7D, kGain).number(kOutput, 0x7E, 0, 255, 8).close();

  d.report(0x5F, kSetCondition).block(kOutput).number(kOutput, 0x23, 0, 1, 8);
  for (const int use : {0x60, 0x61, 0x62}) d.number(kOutput, use, -kMost, kMost, 16);
  for (const int use : {0x63, 0x64, 0x65}) d.number(kOutput, use, 0, kMost, 16);
  d.close();

  d.report(0xAB, kCreate).choice(kFeature, 0x25, {0x40}).page(kDesktop);
  d.number(kFeature, 0x3B, 0, 511, 16).page(kForces).close();
  d.report(0x89, kLoad).block(kFeature).choice(kFeature, 0x8B, {0x8C, 0x8D, 0x8E});
  d.number(kFeature, 0xAC, 0, 0x7FFF, 16).close();
  d.report(0x7F, kPool).number(kFeature, 0x80, 0, 0x7FFF, 16).number(kFeature, 0x83, 0, 127, 8);
  d.number(kFeature, 0xA9, 0, 1, 1).number(kFeature, 0xAA, 0, 1, 1).unused(kFeature, 6).close();
  d.close();
  return d.take();
}

void PidWheel::lose_power() {
  effects_.clear();
  loaded_ = load_status_ = 0;
  actuates_ = false;
  gain_ = 1;
}

PidWheel::Effect* PidWheel::effect_of(Octets report) {
  const auto found = effects_.find(report[1]);
  if (found != effects_.end()) return &found->second;
  ++strange_;
  return nullptr;
}

void PidWheel::take(Octets report) {
  told_ = now_;
  if (report.empty() || size_of(report[0]) == 0 || report.size() < size_of(report[0])) {
    ++strange_;
    return;
  }
  switch (report[0]) {
    case kSetEffect:
      return set_effect(report);
    case kOperation:
      return operate(report);
    case kFree:
      effects_.erase(report[1]);
      return;
    case kControl:
      return control(report[1]);
    case kGain:
      gain_ = report[1] / 255.0;
      return;
    case kSetCondition:
      return set_condition(report);
    case kCreate:
      return create(report[1]);
    default:
      return;
  }
}

void PidWheel::create(std::uint8_t type) {
  load_status_ = kLoadFull;
  loaded_ = 0;
  if (type != 1) ++strange_;
  for (std::uint8_t number = 1; number <= options_.most_effects && loaded_ == 0; ++number)
    if (!effects_.contains(number)) loaded_ = number;
  if (loaded_ == 0) return;
  load_status_ = kLoadedWell;
  effects_[loaded_] = {};
}

void PidWheel::set_effect(Octets report) {
  Effect* const effect = effect_of(report);
  if (effect == nullptr) return;
  effect->length = std::chrono::milliseconds(word(report, 3));
  effect->gain = report[11] / 255.0;
}

void PidWheel::set_condition(Octets report) {
  Effect* const effect = effect_of(report);
  if (effect == nullptr || report[2] >= kAxes) return;
  const auto share = [&](std::size_t at) { return word(report, at) / kSteps; };
  Condition next;
  next.at = share(3) * options_.travel / 2;
  next.stiffness = {share(7) * options_.full_stiffness, share(5) * options_.full_stiffness};
  next.most = {share(11) * options_.full_force, share(9) * options_.full_force};
  next.half_dead = share(13) * options_.travel / 2;
  ++orders_;
  Condition& condition = effect->conditions[report[2]];
  if (condition != next) ++changes_;
  condition = next;
}

void PidWheel::operate(Octets report) {
  Effect* const effect = effect_of(report);
  if (effect == nullptr) return;
  if (report[2] == kStartAlone)
    for (auto& [number, other] : effects_) other.plays = false;
  effect->plays = report[2] != kStop;
  if (effect->plays) ++orders_;
  effect->until = effect->length.count() == 0 ? nanoseconds::max() : now_ + effect->length;
  if (report[2] < kStart || report[2] > kStop) ++strange_;
}

void PidWheel::control(std::uint8_t what) {
  switch (what) {
    case 1:
      actuates_ = true;
      return;
    case 2:
      actuates_ = false;
      return;
    case 3:
      for (auto& [number, effect] : effects_) effect.plays = false;
      return;
    case 4:
      effects_.clear();
      return;
    default:
      ++strange_;  // to pause and to continue
  }
}

std::optional<std::vector<std::uint8_t>> PidWheel::feature(std::uint8_t number) const {
  std::vector<std::uint8_t> out{number};
  if (number == kLoad) {
    out.push_back(loaded_);
    out.push_back(load_status_);
    add_word(out, 1000);
  } else if (number == kPool) {
    add_word(out, 1000);
    out.push_back(static_cast<std::uint8_t>(options_.most_effects));
    out.push_back(options_.has_room_of_its_own ? 1 : 0);
  } else {
    return std::nullopt;
  }
  return out;
}

std::vector<std::uint8_t> PidWheel::input() const {
  std::vector<std::uint8_t> out{kPlaces, 0};
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(options_.axes); ++axis) {
    const double share = std::clamp(2 * place_[axis] / options_.travel, -1.0, 1.0);
    add_word(out, static_cast<int>(std::lround(share * kReading)));
  }
  return out;
}

std::size_t PidWheel::playing() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(effects_, [](const auto& one) { return one.second.plays; }));
}

void PidWheel::run_until(nanoseconds now) {
  if (now_.count() == 0) now_ = now;
  while (now_ + kStep <= now) {
    now_ += kStep;
    for (auto& [number, effect] : effects_)
      if (effect.plays && now_ >= effect.until) effect.plays = false;
    run(std::chrono::duration<double>(kStep).count());
  }
}

// The energy input to constant springs is the difference of their potential, for any step.
void PidWheel::run(double h) {
  if (held_) {
    place_ = wanted_ = *held_;
    speed_ = {};
    return;
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(options_.axes); ++i) {
    const double way =
        std::clamp(goal_[i] - wanted_[i], -h * options_.hand_speed, h * options_.hand_speed);
    wanted_[i] += way;
    const double force = force_at(i, place_[i]) +
                         options_.hand_stiffness * (wanted_[i] - place_[i]) +
                         options_.hand_damping * (way / h - speed_[i]);
    speed_[i] += h * force / options_.mass;
    const double before = energy_at(i, place_[i]);
    place_[i] += h * speed_[i];
    absorbed_ += energy_at(i, place_[i]) - before;
    fastest_ = std::max(fastest_, std::abs(speed_[i]));
  }
  least_ = std::min(least_, absorbed_);
}

template <class Each>
void PidWheel::each_spring(std::size_t axis, double x, Each&& each) const {
  if (!actuates_) return;
  for (const auto& [number, effect] : effects_) {
    const Condition& c = effect.conditions[axis];
    const std::size_t side = x < c.at ? 0 : 1;
    const double depth = std::abs(x - c.at) - c.half_dead;
    const double share = gain_ * effect.gain;
    if (effect.plays && depth > 0 && c.stiffness[side] > 0)
      each(depth, share * c.stiffness[side], share * c.most[side], side == 0 ? 1.0 : -1.0);
  }
}

double PidWheel::force_at(std::size_t axis, double x) const {
  double force = 0;
  each_spring(axis, x, [&](double depth, double stiffness, double most, double sign) {
    force += sign * std::min(stiffness * depth, most);
  });
  return force;
}

double PidWheel::energy_at(std::size_t axis, double x) const {
  double energy = 0;
  each_spring(axis, x, [&](double depth, double stiffness, double most, double) {
    const double force = std::min(stiffness * depth, most);
    energy += force * depth - force * force / (2 * stiffness);
  });
  return energy;
}

}  // namespace reckon::test
