// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A serial board with the example firmware, through the real SerialPort; a model of its line
// answers the kernel calls.
#include <fmt/format.h>

#include <array>
#include <utility>

#include "reckon/haptics/serial/serial_loop.hpp"
#include "reckon/haptics/usb/usb_device.hpp"
#include "reckon/tests/fuzz/unplugs/tried_device.hpp"
#include "reckon/tests/haptics/support/plugged_device.hpp"
#include "reckon/tests/haptics/support/serial_shim.hpp"

namespace reckon::fuzz::unplugs {
namespace {

using haptics::SerialStage;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using test::FalseBoard;

constexpr const char* kPort = "/dev/the-board";
constexpr unsigned kMostLost = 1'000;  // octets of a thousand

haptics::DeviceLimits limits() {
  haptics::UsbSettings settings;
  settings.damping = 2.0;
  settings.max_force = 5.0;
  settings.resolution = 20e-6;
  return haptics::usb_limits(haptics::serial_facts(), settings);
}

test::SerialBoardOptions board_options(const Plan& plan) {
  test::SerialBoardOptions options;
  options.seed = static_cast<unsigned>(plan.seed);
  return options;
}

nanoseconds time_of(double time_ms) {
  return nanoseconds(static_cast<std::int64_t>(1e6 * time_ms));
}

class TriedSerialBoard final : public TriedDevice {
 public:
  TriedSerialBoard(const Plan& plan, const HeldHand& hand)
      : board_(board_options(plan), [&hand](double t) { return hand(t); }),
        shim_(board_, kPort, time_of(plan.line.out_at), time_of(plan.line.in_at)),
        device_(exchange_, limits()) {
    shim_.piece(plan.line.splits);
    shim_.at_each_call([this] { calls_.count(); });
  }
  ~TriedSerialBoard() override { shim_.beside({}); }

  haptics::HapticDevice& device() override { return device_; }
  haptics::Scene scene() const override { return test::stiff_floor(); }
  Vector3d origin() const override { return Vector3d::Zero(); }

  nanoseconds now() const override { return board_.now(); }
  void pass(nanoseconds time) override { shim_.pass(time); }
  void beside(Beside call) override { shim_.beside(std::move(call)); }
  Vector3d place() const override { return board_.position(); }
  void lead(const Vector3d& place) override { board_.hold(place); }
  void let_go() override { board_.release(); }
  bool is_led() const override { return board_.is_held(); }

  // Counted from a tick on.
  nanoseconds watchdog() const override {
    return milliseconds(board_.program.watchdog) + microseconds(board_.program.period);
  }
  bool rests() const override { return !board_.will_hold(); }
  double force() const override { return board_.force().norm(); }
  std::uint64_t commands() const override { return board_.commands(); }
  double books(const haptics::ServoSnapshot& servo) const override {
    return board_.books() + servo.loan + servo.source_energy() + servo.encoder_allowance;
  }

  void begin_program() override {
    loop_ = std::make_unique<haptics::SerialLoop>(exchange_, limits(), haptics::SerialPlace{kPort},
                                                  [this] { return board_.now(); });
  }
  void end_program() override { loop_.reset(); }
  bool has_program() const override { return loop_ != nullptr; }
  void step(microseconds longest) override { loop_->step(longest); }
  std::vector<std::string> take_notices() override { return loop_->take_notices(); }
  Stage stage() const override;
  nanoseconds obeys_within() const override { return milliseconds(3); }
  std::optional<std::string> surplus() const override {
    const int needed = stage() == Stage::away ? 0 : 1;
    if (shim_.open_files() == needed) return {};
    return fmt::format("{} files are open, and {} needed", shim_.open_files(), needed);
  }
  unsigned tries() const override { return shim_.tries(); }

  void pull(bool loses_power) override {
    shim_.unplug();
    if (!loses_power) return;
    board_.forget();
    board_.lose_place(true);
  }
  void plug() override {
    shim_.lose(0, {});  // a firm plug
    shim_.plug(false_);
  }
  bool is_plugged() const override { return shim_.is_plugged(); }
  // Some octets still arrive.
  bool loosen() override {
    shim_.lose(kMostLost / 2, std::chrono::seconds(1));
    return false;
  }
  void be_another(const Fault& fault, nanoseconds) override {
    static constexpr std::array kBoards{FalseBoard::newer, FalseBoard::silent, FalseBoard::noisy,
                                        FalseBoard::weaker};
    false_ = kBoards[fault.call % kBoards.size()];
  }
  void be_itself() override { false_ = FalseBoard::none; }
  void deny(int error) override { shim_.deny(error); }
  bool strike(const Fault& fault, nanoseconds time) override;
  void lose_place() override { board_.lose_place(true); }
  void home() override { board_.lose_place(false); }

 private:
  test::SerialBoard board_;
  test::SerialShim shim_;
  haptics::UsbExchange exchange_;
  haptics::UsbDevice device_;
  FalseBoard false_ = FalseBoard::none;
  std::unique_ptr<haptics::SerialLoop> loop_;
};

Stage TriedSerialBoard::stage() const {
  const std::optional<SerialStage> stage = loop_ ? loop_->stage() : std::nullopt;
  if (!stage) return Stage::away;
  if (*stage == SerialStage::running) return Stage::running;
  return *stage == SerialStage::homing ? Stage::homing : Stage::opened;
}

bool TriedSerialBoard::strike(const Fault& fault, nanoseconds time) {
  switch (fault.kind) {
    case FaultKind::errors:
      shim_.fail(fault.number);
      return true;
    case FaultKind::hang:
      shim_.hang(time);
      return false;
    case FaultKind::mute:
      shim_.mute(time);
      return false;
    case FaultKind::damage:
      shim_.damage(fault.number);
      return false;
    case FaultKind::loss:
      shim_.lose(10 * fault.number, time);
      return false;
    case FaultKind::bunches:
      shim_.bunch(milliseconds(fault.number), time);
      return false;
    default:
      shim_.restart();
      return false;
  }
}

}  // namespace

std::unique_ptr<TriedDevice> tried_serial_board(const Plan& plan, const HeldHand& hand) {
  return std::make_unique<TriedSerialBoard>(plan, hand);
}

}  // namespace reckon::fuzz::unplugs
