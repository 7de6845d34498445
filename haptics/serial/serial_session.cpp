// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/serial/serial_session.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {
namespace {

using std::chrono::nanoseconds;

constexpr std::uint32_t kLongestPause = 1'000'000;  // [us] between reports
constexpr int kMostLost = 1'000;  // reports; a larger step means that reports are out of order

}  // namespace

const UsbFacts& serial_facts() noexcept {
  static constexpr UsbFacts kFacts{.name = "serial board",
                                   .most_force = 1e3,
                                   .sure_share = 0.9,
                                   .assumed_damping = 0.1,
                                   .reach = 0.05,
                                   .resolution = 100e-6};
  return kFacts;
}

SerialSession::SerialSession(UsbExchange& exchange, const DeviceLimits& limits, std::uint32_t run,
                             std::uint16_t question, nanoseconds now)
    : exchange_(exchange),
      max_force_(limits.max_force),
      resolution_(limits.resolution),
      run_(run),
      question_(question),
      began_(now),
      heard_at_(now),
      next_ask_(now) {}

void SerialSession::take(std::span<const std::uint8_t> octets, nanoseconds now) {
  for (const std::uint8_t octet : octets) {
    const std::span<const std::uint8_t> carried = parser_.take(octet);
    if (carried.empty()) continue;
    if (stage_ == SerialStage::asked) {
      greet(carried, now);
    } else if (stage_ >= SerialStage::greeted) {
      if (const auto report = serial_report(carried, greeting_.axes)) receive(*report, now);
    }
  }
}

void SerialSession::greet(std::span<const std::uint8_t> carried, nanoseconds now) {
  const auto version = serial_version(carried);
  if (!version) return;
  if (*version != kSerialVersion) {
    refusal_ = "it has version " + std::to_string(*version) + " of the protocol instead of " +
               std::to_string(kSerialVersion) + ": load firmware of that version";
    stage_ = SerialStage::refused;
    return;
  }
  const auto greeting = serial_greeting(carried);
  if (!greeting) return;
  // An answer to another program may still be on the line.
  const auto back = static_cast<std::uint16_t>(question_ - 1 - greeting->answers);
  if (back >= questions_) return;
  refusal_ = refusal_of(*greeting, max_force_, resolution_);
  greeting_ = *greeting;
  stage_ = refusal_.empty() ? SerialStage::greeted : SerialStage::refused;
  heard_at_ = now;
}

// Whether a report is new: no duplicate, and in order.
bool SerialSession::follows(const SerialReport& report) noexcept {
  if (!last_) return true;
  const auto ahead = static_cast<std::uint16_t>(report.sequence - last_->sequence);
  const std::uint32_t pause = report.stamp - last_->stamp;
  if (ahead == 0 || ahead > kMostLost || pause == 0 || pause > kLongestPause) {
    ++strange_;
    return false;
  }
  lost_ += ahead - 1U;
  clock_ += std::chrono::microseconds(pause);
  return true;
}

// The ledger books the energy of damping by the board's clock, so a wrong clock is refused.
bool SerialSession::keeps_time(nanoseconds now) {
  if (stage_ == SerialStage::greeted) first_heard_ = now;
  const nanoseconds ours = now - first_heard_;
  if (is_timed_ || ours < kTrial) return true;
  is_timed_ = true;
  if (clock_ > ours - ours / 20 && clock_ < ours + ours / 20) return true;
  leave();
  stage_ = SerialStage::refused;
  refusal_ = "its clock is wrong by more than 5 %: its timestamps must count microseconds";
  return false;
}

void SerialSession::receive(const SerialReport& report, nanoseconds now) {
  if (!follows(report)) return;
  const bool is_late = now - heard_at_ > kLate;
  last_ = report;
  heard_at_ = now;
  answers_ = true;
  if (!keeps_time(now)) return;
  const bool runs = report.homed && !is_late;
  if (!runs) leave();
  stage_ = report.homed ? SerialStage::running : SerialStage::homing;
  if (runs) read(report, now);
}

// Makes a reading of a report if the board has held only forces of the servo since the reading
// before.
void SerialSession::read(const SerialReport& report, nanoseconds now) noexcept {
  const auto from = report.from ? frame_at(*report.from) : std::nullopt;
  if (!from || !are_its(*from, *from)) return leave();
  UsbReading reading;
  if (held_) {
    const auto until = report.until ? frame_at(*report.until) : std::nullopt;
    const bool joins = until && *until >= *held_ && *until <= *from && are_its(*held_, *until) &&
                       report.force_drops == drops_;
    if (!joins) return leave();
    reading.before = sent(*until).number;
    if (sent(*from).number > sent(*held_).number) time(sent(*held_), sent(*from), now);
  }
  held_ = *from;
  drops_ = report.force_drops;
  reading.position = place_of(report);
  reading.at = clock_;
  reading.heard = now;
  reading.after = sent(*from).number;
  reading.run = run_;
  reading.buttons = report.buttons;
  exchange_.readings.push(reading);
}

void SerialSession::end_run() noexcept {
  exchange_.ended_run.store(run_++, std::memory_order_release);
}

// Later readings do not continue the earlier ones: a new run begins.
void SerialSession::leave() noexcept {
  if (held_) end_run();
  held_.reset();
}

// Of the writes that now take effect, the oldest follows the write whose force was held until now.
void SerialSession::time(const Sent& held, const Sent& next, nanoseconds now) noexcept {
  if (timed_ == kTimed) return;
  const nanoseconds written = held.at + (next.at - held.at) / (next.number - held.number);
  longest_ = std::max(longest_, now - written);
  ++timed_;
}

std::optional<std::int64_t> SerialSession::frame_at(std::uint16_t number) const noexcept {
  const auto back = static_cast<std::uint16_t>(static_cast<std::uint16_t>(told_) - number);
  if (back >= std::min(told_, kKept)) return std::nullopt;
  return told_ - back;
}

Eigen::Vector3d SerialSession::place_of(const SerialReport& report) const noexcept {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < greeting_.axes; ++i) {
    const SerialAxis& axis = greeting_.axis[i];
    place[axis.direction] = 1e-9 * axis.nm_per_count * report.counts[i];
  }
  return place;
}

SerialForce SerialSession::force_of(const Eigen::Vector3d& force) const noexcept {
  SerialForce command;
  for (std::size_t i = 0; i < greeting_.axes; ++i) {
    const SerialAxis& axis = greeting_.axis[i];
    const double most = std::min<double>(axis.most_force, 32'767);
    const double along = (axis.nm_per_count < 0 ? -1e3 : 1e3) * force[axis.direction];
    command.force[i] = static_cast<std::int16_t>(std::lround(std::clamp(along, -most, most)));
  }
  return command;
}

SerialFrame SerialSession::tell(const UsbForce& force, bool is_its) noexcept {
  ++told_;
  const std::int64_t zero = is_its ? sent(told_ - 1).zero : told_;
  frames_[static_cast<std::size_t>(told_ % kKept)] = {force.number, force.at, zero};
  SerialForce command = force_of(is_its ? force.force : Eigen::Vector3d(Eigen::Vector3d::Zero()));
  command.number = static_cast<std::uint16_t>(told_);
  return frame_of(command, greeting_.axes);
}

std::optional<SerialFrame> SerialSession::next(nanoseconds now) {
  if (stage_ == SerialStage::refused) return std::nullopt;
  if (stage_ == SerialStage::asked) {
    if (now < next_ask_) return std::nullopt;
    next_ask_ = now + kAsk;
    ++questions_;
    return spoiling(ask_frame(question_++));
  }
  exchange_.force.update();
  const UsbForce& newest = exchange_.force.read();
  const bool silent = newest.number == 0 || now - newest.at > kSilence;
  const bool late = now - heard_at_ > kLate;
  if (late) leave();
  const bool is_its = stage_ == SerialStage::running && !silent && !late;
  if (!answers_ && is_its == is_its_ && now - sent_at_ < kKeep) return std::nullopt;
  answers_ = false;
  is_its_ = is_its;
  sent_at_ = now;
  return tell(newest, is_its);
}

SerialFrame SerialSession::farewell() noexcept {
  if (stage_ < SerialStage::greeted) return spoiling(ask_frame(question_++));
  return tell({}, false);
}

}  // namespace reckon::haptics
