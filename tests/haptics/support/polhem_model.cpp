// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/haptics/support/polhem_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace reckon::test {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

// Its dimensions, written out independently.
constexpr double kBase = 0.058, kUpper = 0.174, kFore = 0.133;
constexpr std::array<double, 3> kRatios{18, 10, 10};
constexpr double kTorque = 0.0538;  // [N m/A]
constexpr double kCounts = 2000;
const Vector3d kMiddle(0.14, 0, 0.1);  // in its own axes, x towards the operator

constexpr nanoseconds kFrame = milliseconds(1);
constexpr nanoseconds kWatchdog = milliseconds(500);  // its own

}  // namespace

PolhemModel::PolhemModel(const PolhemModelOptions& options, std::function<Vector3d(double)> hand)
    : HeldModel(options, std::move(hand)), options_(options), random_(options.seed) {
  begin();
  forget();
}

Vector3d PolhemModel::Care::hand(const Vector3d& wanted) const {
  const double share = std::max(0.0, share_);
  const double smooth = share * share * (3 - 2 * share);
  return start() + smooth * (wanted - start());
}

void PolhemModel::Care::tend(PolhemModel& model, const haptics::UsbLoop& loop) {
  constexpr double kStep = 1e-4;  // half a second for the path
  constexpr int kStill = 4'000;
  const auto stage = loop.stage();
  if (!model.is_tended_ || !stage) return;
  if (*stage == haptics::UsbStage::homing) share_ = std::max(kRest, share_ - kStep);
  if (*stage == haptics::UsbStage::running) share_ = std::min(1.0, share_ + kStep);
  model.carry(std::clamp(share_ / kRest, 0.0, 1.0));
  const bool is_there = share_ <= 0 && (model.position() - start()).norm() < 1e-6;
  still_ = is_there ? still_ + 1 : 0;
  if (*stage != haptics::UsbStage::homing || still_ < kStill) return;
  model.press();
  still_ = 0;
}

Vector3d PolhemModel::start() {
  const Vector3d own = Vector3d(kFore, 0, kBase + kUpper) - kMiddle;
  return {own.y(), -own.x(), own.z()};
}

// Of its two links in their plane, by the law of cosines.
std::optional<HeldModel::Joints> PolhemModel::joints_at(const Vector3d& position) const {
  const Vector3d own = Vector3d(-position.y(), position.x(), position.z()) + kMiddle;
  const double out = std::hypot(own.x(), own.y()), up = own.z() - kBase;
  const double far = std::hypot(out, up);
  const double at_base = (kUpper * kUpper + far * far - kFore * kFore) / (2 * kUpper * far);
  if (!(std::abs(at_base) < 1) || out < 0.01) return std::nullopt;
  const double lean = std::atan2(out, up) - std::acos(at_base);
  const double elbow_out = kUpper * std::sin(lean), elbow_up = kUpper * std::cos(lean);
  const double reach = std::atan2(out - elbow_out, elbow_up - up);
  // The base may turn more than once: the turn next to the present one.
  const double turn = std::atan2(own.y(), own.x());
  const double whole = std::round((angles_[0] - turn) / (2 * std::numbers::pi));
  Joints joints;
  joints.angles = {turn + 2 * std::numbers::pi * whole, lean, reach};
  const Vector3d away(std::cos(turn), std::sin(turn), 0);
  const Vector3d z = Vector3d::UnitZ();
  const auto row = [&](int joint, const Vector3d& own_slope) {
    joints.jacobian.col(joint) = Vector3d(own_slope.y(), -own_slope.x(), own_slope.z());
  };
  row(0, Vector3d(-own.y(), own.x(), 0));
  row(1, kUpper * (std::cos(lean) * away - std::sin(lean) * z));
  row(2, kFore * (std::cos(reach) * away + std::sin(reach) * z));
  return joints;
}

Vector3d PolhemModel::torques() const {
  Vector3d torques;
  for (std::size_t i = 0; i < 3; ++i)
    torques[static_cast<Eigen::Index>(i)] = -1e-3 * motors_[i] * kTorque * kRatios[i];
  return torques;
}

Vector3d PolhemModel::half_steps() const {
  return 0.5e-3 * kTorque * Vector3d(kRatios[0], kRatios[1], kRatios[2]);
}

double PolhemModel::height(const Vector3d& angles) const {
  if (options_.upper_weight == 0 && options_.fore_weight == 0) return 0;
  return options_.upper_weight * std::cos(angles[1]) - options_.fore_weight * std::cos(angles[2]);
}

std::array<int, 3> PolhemModel::counts() const {
  std::array<int, 3> counts = zero_;
  for (std::size_t i = 0; i < 3; ++i) {
    const double turns = angles_[static_cast<Eigen::Index>(i)] / (2 * std::numbers::pi);
    counts[i] -= static_cast<int>(std::lround(kCounts * kRatios[i] * turns));
  }
  return counts;
}

void PolhemModel::forget() {
  motors_ = {};
  command_.reset();
  reports_.clear();
  asks_ = false;
  const std::array<int, 3> now = counts();
  for (std::size_t i = 0; i < 3; ++i) zero_[i] -= now[i];
  report();
}

void PolhemModel::take_transfer(std::span<const std::uint8_t> octets) {
  command_.emplace(octets.begin(), octets.end());
}

void PolhemModel::run_line() {
  if (now_ - obeyed_at_ > kWatchdog) motors_ = {};
  if (!reports_.empty() || !command_) return;
  const std::vector<std::uint8_t> command = *std::exchange(command_, std::nullopt);
  obey(command);
  if (now_ >= mute_until_) report();
}

void PolhemModel::obey(std::span<const std::uint8_t> octets) {
  if (octets.size() != options_.report) return;
  ++commands_;
  obeyed_at_ = now_;
  const auto word = [&](std::size_t i) {
    return static_cast<std::int16_t>(octets[2 * i] | octets[2 * i + 1] << 8);
  };
  if (octets.size() == 14 && word(3) == 1) {
    motors_ = {};
    const std::array<int, 3> now = counts();
    for (std::size_t i = 0; i < 3; ++i) {
      zero_[i] += word(4 + i) - now[i];
      gimbal_[2 - i] = word(i);
    }
    asks_ = false;
    return;
  }
  for (std::size_t i = 0; i < 3; ++i) motors_[i] = word(i);
}

void PolhemModel::report() {
  std::vector<std::uint8_t> octets;
  const auto put = [&](int word) {
    octets.push_back(static_cast<std::uint8_t>(word & 0xFF));
    octets.push_back(static_cast<std::uint8_t>(word >> 8 & 0xFF));
  };
  const std::array<int, 3> arm = counts();
  put(arm[0] + std::exchange(lie_, 0));
  put(arm[1]);
  put(arm[2]);
  if (options_.report == 14) {
    put(gimbal_[2] + (button_ ? 10'000 : 0));
    put(gimbal_[1]);
    put(gimbal_[0]);
  }
  put(std::exchange(asks_once_, false) || asks_ ? 1 : 0);
  octets.resize(options_.report);
  if (damaged_ > 0) {
    --damaged_;
    octets[random_() % octets.size()] = static_cast<std::uint8_t>(random_());
    if (random_() % 3 == 0) octets.resize(random_() % octets.size());
  }
  if (merged_ > 0) {
    --merged_;
    const std::vector<std::uint8_t> once = octets;
    octets.insert(octets.end(), once.begin(), once.end());
  }
  if (splits_) {
    const auto at = octets.begin() + static_cast<std::ptrdiff_t>(1 + random_() % 13);
    reports_.emplace_back(octets.begin(), at);
    octets.erase(octets.begin(), at);
  }
  reports_.push_back(std::move(octets));
  const auto at = nanoseconds(static_cast<std::int64_t>(1e6 * options_.in_at));
  fetched_at_ = ((now_ - at) / kFrame + 1) * kFrame + at;
}

int PolhemModel::control(std::uint8_t, std::uint16_t, std::span<std::uint8_t>) { return -32; }

std::optional<int> PolhemModel::in_done(std::span<std::uint8_t> octets) {
  if (reports_.empty() || now_ < fetched_at_ || now_ < hangs_until_) return std::nullopt;
  const std::vector<std::uint8_t> report = std::move(reports_.front());
  reports_.pop_front();
  fetched_at_ += kFrame;
  std::ranges::copy(report, octets.begin());
  return static_cast<int>(report.size());
}

std::vector<std::uint8_t> PolhemModel::descriptors() const {
  const auto kind = static_cast<std::uint8_t>(options_.is_hid ? 3 : 0xFF);
  return {18,   1,    0x00, 0x02, 0,  0,    0,    64,   0x34,
          0x12, 0x06, 0x00, 0x01, 0,  0,    0,    0,    1,   // device
          9,    2,    41,   0,    1,  1,    0,    0xC0, 50,  // configuration
          9,    4,    0,    0,    2,  kind, 0,    0,    0,   // interface
          9,    0x21, 0x11, 0x01, 0,  1,    0x22, 32,   0,   // HID
          7,    5,    0x81, 3,    64, 0,    1,               // in
          7,    5,    0x01, 3,    64, 0,    1};              // out
}

}  // namespace reckon::test
