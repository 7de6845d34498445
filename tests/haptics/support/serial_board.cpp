// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/haptics/support/serial_board.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "reckon/pdu/seconds.hpp"

namespace reckon::test {
namespace {

using Eigen::Vector3d;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr microseconds kStep{50};

}  // namespace

SerialBoard::SerialBoard(const SerialBoardOptions& options, std::function<Vector3d(double)> hand)
    : options_(options),
      hand_(std::move(hand)),
      random_(options.seed),
      first_stamp_(0xFFFFFFFFU - 500'000U) {  // its clock wraps soon
  position_ = hand_(0);
  for (int i = options_.axes; i < 3; ++i) position_[i] = 0;
  next_tick_ = microseconds(random_() % 1'000);
  forget();
}

void SerialBoard::forget() {
  program = {};
  force_.setZero();
  program.name = "Board";
  program.axes = static_cast<std::uint8_t>(options_.axes);
  for (int i = 0; i < options_.axes && i < RECKON_AXES; ++i) {
    program.axis[i] = {static_cast<std::uint8_t>(i),
                       i == 1 ? -options_.nm_per_count : options_.nm_per_count,
                       static_cast<std::uint16_t>(options_.most_force)};
  }
  program.watchdog = static_cast<std::uint8_t>(options_.watchdog);
  program.period = static_cast<std::uint16_t>(options_.period);
  program.line = this;
  program.write = [](void* board, const std::uint8_t* octets, std::uint8_t length) {
    static_cast<SerialBoard*>(board)->sent_.emplace_back(octets, octets + length);
  };
}

void SerialBoard::take(std::uint8_t octet) {
  if (hangs_) return;
  const std::uint8_t has_frame = std::exchange(program.has_frame, std::uint8_t{0});
  reckon_board_take(&program, octet);
  if (program.has_frame != 0) ++commands_;
  program.has_frame = static_cast<std::uint8_t>(program.has_frame | has_frame);
}

bool SerialBoard::will_hold() const {
  if (program.has_next == 0) return program.drops == 0 && !force_.isZero(0);
  return std::ranges::any_of(program.next_force, [](std::int16_t force) { return force != 0; });
}

std::vector<std::vector<std::uint8_t>> SerialBoard::pass() {
  move(pdu::to_seconds(kStep));
  now_ += kStep;
  if (now_ >= next_tick_ + late_) {
    next_tick_ += microseconds(options_.period);
    late_ = microseconds(
        options_.jitter > 0 ? static_cast<int>(random_() % 1'000) * options_.jitter / 1'000 : 0);
    if (!hangs_) tick();
  }
  return std::exchange(sent_, {});
}

// Velocity first: each ledger uses the velocity that moves the handle.
void SerialBoard::move(double h) {
  if (held_at_) {
    position_ = *held_at_;
    velocity_.setZero();
    return;
  }
  const double t = pdu::to_seconds(now_);
  const Vector3d speed = (hand_(t + 1e-4) - hand_(t)) / 1e-4;
  if (options_.is_led) {
    position_ = hand_(t);
    return;
  }
  lagging_.push_back(force_);
  if (lagging_.size() > static_cast<std::size_t>(milliseconds(options_.lag) / kStep) + 1)
    lagging_.pop_front();
  const Vector3d held = lagging_.front();
  Vector3d pushed = options_.hand_stiffness * (hand_(t) - position_) +
                    options_.hand_damping * (speed - velocity_) + held -
                    options_.damping * velocity_;
  for (int i = options_.axes; i < 3; ++i) pushed[i] = 0;
  velocity_ += h / options_.mass * pushed;
  position_ += h * velocity_;
  damping_loss_ += h * options_.damping * velocity_.squaredNorm();
  port_work_ -= h * held.dot(velocity_);
  rounding_ += h * 0.5e-3 * velocity_.lpNorm<1>();
}

void SerialBoard::tick() {
  std::array<std::int32_t, 3> counts{};
  std::array<std::int16_t, 3> held{};
  for (int i = 0; i < options_.axes; ++i) {
    const double step = 1e-9 * program.axis[i].nm_per_count;
    counts[static_cast<std::size_t>(i)] =
        static_cast<std::int32_t>(std::lround(position_[i] / step));
  }
  const auto passed = static_cast<std::uint32_t>(clock_rate_ * 1e6 * pdu::to_seconds(now_));
  const std::uint32_t stamp = first_stamp_ + passed;
  reckon_board_tick(&program, stamp, counts.data(), buttons_, homed_ ? 1 : 0, held.data());
  for (int i = 0; i < options_.axes; ++i) {
    const double sign = program.axis[i].nm_per_count < 0 ? -1e-3 : 1e-3;
    force_[i] = sign * held[static_cast<std::size_t>(i)];
  }
  ticks_.push_back({stamp, counts, force_});
}

}  // namespace reckon::test
