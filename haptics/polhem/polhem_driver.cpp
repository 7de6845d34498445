// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/polhem/polhem_driver.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "reckon/haptics/usb/usb_torques.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr std::uint16_t kAsksToBeHomed = 1;
constexpr nanoseconds kStale = milliseconds(20);  // older reports have arrived by then
constexpr nanoseconds kReportTime = milliseconds(50);
constexpr int kAttempts = 3;
// [rad] of a joint between two reports: more means that the counters were reset.
constexpr double kMostJump = 0.5;
constexpr double kMostAdvance = 0.05;  // [rad], greatest rotation per exchange that prediction uses
constexpr double kHoldUpStep =
    1.0 / 250;  // growth of the share of the weights per exchange: 250 of 2 ms
constexpr double kMilli = 1e-3;

constexpr const char* kSilence = "it does not answer: switch its power supply on";

std::string refusal_of(std::size_t octets) {
  if (octets == static_cast<std::size_t>(PolhemForm::eight)) {
    return "its reports have 8 octets, as in older firmware such as WoodenHaptics, and do not "
           "identify their command: use a Polhem with firmware of 2019 or later";
  }
  return "its reports have " + std::to_string(octets) + " octets instead of 14";
}

}  // namespace

const UsbFacts& polhem_facts() noexcept {
  static constexpr UsbFacts kFacts{.name = "Polhem",
                                   .vendor = 0x1234,  // as in its firmware
                                   .product = 0x0006,
                                   .most_force = 5.0,
                                   .sure_share = 0.9,
                                   .assumed_damping = 0.2,
                                   .reach = 0.05,
                                   .resolution = 95e-6,
                                   .lever = 0.196715,
                                   .joints_per_damping = 0.036477};
  return kFacts;
}

double polhem_spent_joint_damping(const PolhemWeights& weights) noexcept {
  const double slope = std::max(weights.upper, weights.fore);  // [N m/rad]
  return slope * pdu::to_seconds(kUsbExchange);
}

double polhem_spent_damping(const PolhemWeights& weights) noexcept {
  return polhem_spent_joint_damping(weights) / (kPolhemLeastLever * kPolhemLeastLever);
}

PolhemDriver::PolhemDriver(const PolhemWeights& weights) : weights_(weights) {
  // Written so that not-a-number is refused.
  if (!(weights.upper >= 0) || !(weights.fore >= 0))
    throw std::invalid_argument("Polhem: weights of its links must be 0 or more N m");
}

const char* PolhemDriver::how_to_home() const noexcept {
  return "hold it straight ahead, its upper link upright and its fore link level, and press its "
         "calibration button";
}

std::optional<UsbPipes> PolhemDriver::pipes(libusb_device_handle* handle) const {
  return hid_pipes(handle);
}

std::string PolhemDriver::set_up(UsbSetUp& desk) {
  UsbLine& line = desk.line();
  // It keeps an old report until a host reads it.
  if (!desk.sends(octets_of(PolhemCommand{}))) return kSilence;
  const nanoseconds begin = desk.now();
  while (desk.goes_on() && desk.now() - begin < kStale) desk.wait();
  for (int attempt = 0; attempt < kAttempts && desk.goes_on(); ++attempt) {
    line.clear();
    if (!desk.sends(octets_of(PolhemCommand{}))) break;
    const nanoseconds end = desk.now() + kReportTime;
    while (desk.goes_on() && line.received().empty() && desk.now() < end) desk.wait();
    std::size_t octets = 0;
    line.each_transfer([&](std::span<const std::uint8_t> transfer) { octets = transfer.size(); });
    if (octets == octets_.size()) return {};
    if (octets > 0) return refusal_of(octets);
  }
  return kSilence;
}

// Without power it loses the reference of its counts.
void PolhemDriver::lost(bool is_unplugged) noexcept {
  asks_ = sets_counts_ = has_set_ = false;
  if (is_unplugged) homed_ = false;
}

bool PolhemDriver::read(std::span<const std::uint8_t>& transfer) noexcept {
  if (transfer.empty()) return false;
  const auto report = polhem_report(PolhemForm::fourteen, transfer);
  transfer = {};
  if (!report) {
    ++malformed_;
    return false;
  }
  report_ = *report;
  return true;
}

// Whether the counts of the last report are angles. Extends them beyond 16 bits.
bool PolhemDriver::is_homed() noexcept {
  // It requests homing until its counts are set: a single request is a damaged report.
  const bool asked_before = std::exchange(asks_, report_.info == kAsksToBeHomed);
  if (asks_) {
    sets_counts_ = asked_before;
    homed_ = homed_ && !asked_before;
    return false;
  }
  if (has_set_) {
    has_set_ = false;
    homed_ = true;
    std::ranges::copy_n(polhem_1().home_counts.begin(), 3, counts_.begin());
  }
  if (!homed_) return false;
  const Vector3d steps = polhem_count_steps(polhem_1());
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    const auto low = static_cast<std::uint16_t>(counts_[i]);
    const auto way = static_cast<std::int16_t>(static_cast<std::uint16_t>(report_.arm[i]) - low);
    if (std::abs(way) * steps[static_cast<Eigen::Index>(i)] > kMostJump) homed_ = false;
    counts_[i] += way;
  }
  return homed_;
}

// Whether its motors can hold the largest force at this pose.
bool PolhemDriver::bears(const PolhemPose& pose, const Vector3d& angles) const noexcept {
  const Vector3d torques = polhem_facts().most_force * pose.jacobian.colwise().norm().transpose() +
                           polhem_hold_up(weights_, angles).cwiseAbs();
  return polhem_currents(polhem_1(), torques).cwiseAbs().maxCoeff() < polhem_1().most_current;
}

UsbStage PolhemDriver::judge(bool follows, UsbReading& reading) noexcept {
  if (!is_homed()) return UsbStage::homing;
  const Vector3d angles = polhem_angles_at(polhem_1(), counts_);
  const auto pose = polhem_pose(polhem_1(), angles);
  if (!pose || !bears(*pose, angles)) return UsbStage::outside;
  const Vector3d levers = levers_of(pose->jacobian);
  if (!(levers[0] > kPolhemLeastLever)) return UsbStage::outside;
  turn_.setZero();
  if (follows) turn_ = (angles - angles_).cwiseMin(kMostAdvance).cwiseMax(-kMostAdvance);
  angles_ = angles;
  jacobian_ = pose->jacobian;
  reading.lever = levers[2];
  reading.step = polhem_count_steps(polhem_1()).maxCoeff() * levers[2];
  reading.position = polhem_to_device(pose->position - polhem_1().middle);
  reading.orientation = polhem_orientation(polhem_1(), angles, report_.gimbal);
  reading.buttons = report_.button ? 1 : 0;
  return UsbStage::running;
}

std::span<const std::uint8_t> PolhemDriver::command(UsbStage stage,
                                                    const UsbForce* force) noexcept {
  PolhemCommand command;
  if (stage == UsbStage::homing && sets_counts_) {
    command.counts = polhem_1().home_counts;
    sets_counts_ = false;
    has_set_ = true;
  } else if (force != nullptr) {
    held_up_ = std::min(1.0, held_up_ + kHoldUpStep);
    command.currents = currents(*force);
  }
  if (force == nullptr) held_up_ = 0;
  octets_ = octets_of(command);
  return octets_;
}

// The weight of the links is compensated first; the force gets the rest of the motors' current.
std::array<std::int16_t, 3> PolhemDriver::currents(const UsbForce& force) noexcept {
  const Vector3d angles = angles_ + kUsbAhead * turn_;
  const auto ahead = polhem_pose(polhem_1(), angles);
  const Eigen::Matrix3d& jacobian = ahead ? ahead->jacobian : jacobian_;
  const Vector3d torques = polhem_torques(jacobian, device_to_polhem(force.force));
  const Vector3d up = held_up_ * polhem_hold_up(weights_, angles);
  const Vector3d lifts = polhem_currents(polhem_1(), up) / kMilli;
  const Vector3d shows = polhem_currents(polhem_1(), torques) / kMilli;
  const double most = polhem_1().most_current / kMilli;
  const Vector3d left = (most - lifts.array().abs()).max(0.0);
  share_ = std::min(paid_share(force, torques), share_within(shows, left));
  std::array<std::int16_t, 3> currents{};
  for (std::size_t i = 0; i < currents.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double current = std::clamp(share_ * shows[k] + lifts[k], -most, most);
    currents[i] = static_cast<std::int16_t>(std::lround(current));
  }
  return currents;
}

}  // namespace reckon::haptics
