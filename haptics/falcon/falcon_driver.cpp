// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/falcon/falcon_driver.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "reckon/haptics/falcon/falcon_kinematics.hpp"
#include "reckon/haptics/input_files/input_file.hpp"
#include "reckon/haptics/usb/usb_torques.hpp"

namespace reckon::haptics {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

// Requests of the FTDI chip, and their values.
constexpr std::uint8_t kReset = 0, kModem = 1, kFlow = 2, kBaud = 3, kData = 4, kLatency = 9;
constexpr std::uint8_t kReadLatency = 10;
constexpr std::uint16_t kPurgeIn = 1, kPurgeOut = 2;
constexpr std::uint16_t kEightBits = 8;  // no parity, one stop bit
constexpr std::uint16_t kReadyLow = 0x0100, kReadyHigh = 0x0101, kRequestLow = 0x0200;
constexpr std::uint16_t kRunBaud = 2;                        // 1.5 M
constexpr std::uint16_t kSlowBaud = 0x4138;                  // 9,600
constexpr std::uint16_t kFirmwareBaud = 0x15;                // 140,000
constexpr std::uint16_t kRunLatency = 1, kSlowLatency = 16;  // [ms]

constexpr std::array<std::uint8_t, 3> kHello{0x0A, 0x43, 0x0D};
constexpr std::array<std::uint8_t, 4> kHelloBack{0x0A, 0x44, 0x2C, 0x0D};
constexpr std::array<std::uint8_t, 1> kReady{0x41};
constexpr int kHellos = 100;
constexpr nanoseconds kHelloTime = milliseconds(20);
constexpr nanoseconds kAnswerTime = milliseconds(50);
constexpr int kAnswers = 3;
constexpr nanoseconds kEchoTime = milliseconds(500);
constexpr std::size_t kPiece = 58;  // octets of firmware whose echo is awaited

constexpr std::uint8_t kAllHomed = 7;
constexpr std::uint8_t kGreen = 2, kBlue = 4, kRed = 8;
constexpr double kWordsPerTorque = -1e4;  // [1/(N m)]
constexpr double kMostWord = 32767.0;
// [m/rad]: a longer lever needs torques beyond the range of a motor's word.
constexpr double kLongestLever = 0.3;
constexpr double kMostSweep = 0.05;  // [rad], greatest rotation per exchange that prediction uses

constexpr const char* kRefusal = "its FTDI chip refuses a setting: unplug it and plug it in again";

bool set_line(UsbLine& line, bool for_firmware) {
  if (!for_firmware) {
    return line.request(kReset, 0) && line.request(kLatency, kRunLatency) &&
           line.request(kBaud, kRunBaud) && line.request(kData, kEightBits) &&
           line.request(kFlow, 0) && line.request(kReset, kPurgeIn) &&
           line.request(kReset, kPurgeOut);
  }
  return line.request(kReset, 0) && line.request(kLatency, kSlowLatency) &&
         line.request(kBaud, kSlowBaud) && line.request(kData, kEightBits) &&
         line.request(kFlow, 0) && line.request(kModem, kRequestLow) &&
         line.request(kModem, kReadyLow) && line.request(kModem, kReadyHigh) &&
         line.request(kReset, kPurgeIn) && line.request(kReset, kPurgeOut);
}

// Latency timer of the chip [ms]; 0: no answer.
int latency_timer(UsbLine& line) { return line.ask(kReadLatency).value_or(std::uint8_t{0}); }

// Waits until these octets are received, after any others.
bool hears(UsbSetUp& desk, std::span<const std::uint8_t> wanted, nanoseconds longest) {
  const nanoseconds end = desk.now() + longest;
  while (desk.goes_on()) {
    const auto heard = desk.line().received();
    const auto found = std::search(heard.begin(), heard.end(), wanted.begin(), wanted.end());
    if (found != heard.end()) return true;
    if (desk.now() >= end) return false;
    desk.wait();
  }
  return false;
}

}  // namespace

const UsbFacts& falcon_facts() noexcept {
  static constexpr UsbFacts kFacts{.name = "Falcon",
                                   .vendor = 0x0403,   // FTDI
                                   .product = 0xCB48,  // Novint's
                                   .most_force = 8.9,
                                   .sure_share = 0.9,
                                   .assumed_damping = 0.3,
                                   .reach = FalconGeometry::kReach,
                                   .resolution = FalconGeometry::kResolution,
                                   .lever = FalconGeometry::kLever,
                                   .joints_per_damping = 0.0048738};
  return kFacts;
}

FalconFirmware FalconFirmware::load(const std::string& file) {
  FalconFirmware firmware;
  std::string read;
  try {
    read = read_input_file(file, 4 * kMost);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(file + ": cannot be read (" + error.what() +
                             "); give the Falcon's firmware file");
  }
  if (read.size() < kLeast || read.size() > kMost) {
    throw std::runtime_error(file + ": not Falcon firmware, which has 1,000 to 262,144 " +
                             "octets; it is part of Novint's drivers");
  }
  firmware.octets.assign(read.begin(), read.end());
  return firmware;
}

FalconDriver::FalconDriver(FalconFirmware firmware) : firmware_(std::move(firmware)) {}

const char* FalconDriver::how_to_home() const noexcept {
  return "pull the handle out as far as it goes, then push it in";
}

std::optional<UsbPipes> FalconDriver::pipes(libusb_device_handle*) const {
  return UsbPipes{.are_interrupts = false, .in = 0x81, .out = 0x02, .header = kFalconHeader};
}

std::string FalconDriver::set_up(UsbSetUp& desk) {
  UsbLine& line = desk.line();
  if (!set_line(line, false)) return kRefusal;
  const int timer = latency_timer(line);
  if (timer != kRunLatency) {
    return "the latency timer of its FTDI chip reads " + std::to_string(timer) +
           " ms instead of 1 ms: forces would be late, so the device is not used";
  }
  if (answers(desk)) return {};
  if (firmware_.octets.empty()) {
    return "it has lost its firmware, as after a power cut: give its file (firmware = \"FILE\" in "
           "its [[device]], or --firmware FILE)";
  }
  const std::string problem = load_firmware(desk);
  if (!problem.empty()) return problem;
  if (set_line(line, false) && latency_timer(line) == kRunLatency && answers(desk)) {
    desk.tell("firmware loaded, " + std::to_string(firmware_.octets.size()) +
              " octets; checked by its echo, because no checksum is known");
    return {};
  }
  return "it does not answer with the loaded firmware: is the file Falcon firmware?";
}

// Sends a zero force. @return whether a report answers it
bool FalconDriver::answers(UsbSetUp& desk) {
  for (int attempt = 0; attempt < kAnswers && desk.goes_on(); ++attempt) {
    desk.line().clear();
    if (!desk.sends(octets_of(FalconCommand{}))) return false;
    parser_.restart();
    const nanoseconds end = desk.now() + kAnswerTime;
    while (desk.now() < end && desk.goes_on()) {
      desk.wait();
      std::span<const std::uint8_t> heard = desk.line().received();
      if (read(heard)) return true;
      desk.line().clear();
    }
  }
  return false;
}

std::string FalconDriver::load_firmware(UsbSetUp& desk) {
  const std::string unheard =
      "it does not accept the firmware: unplug its power supply for ten seconds";
  UsbLine& line = desk.line();
  if (!set_line(line, true)) return kRefusal;
  line.clear();
  bool greeted = false;
  for (int i = 0; i < kHellos && !greeted && desk.goes_on(); ++i) {
    if (!desk.sends(kHello)) return unheard;
    greeted = hears(desk, kHelloBack, kHelloTime);
  }
  if (!greeted || !line.request(kModem, kReadyLow) || !line.request(kBaud, kFirmwareBaud))
    return unheard;
  line.clear();
  if (!desk.sends(kReady) || !hears(desk, kReady, kEchoTime)) return unheard;

  const std::span<const std::uint8_t> all(firmware_.octets);
  for (std::size_t at = 0; at < all.size(); at += kPiece) {
    const auto piece = all.subspan(at, std::min(kPiece, all.size() - at));
    line.clear();
    if (!desk.sends(piece)) return unheard;
    if (!hears(desk, piece, kEchoTime)) {
      return "its echo differs from the firmware sent, from octet " + std::to_string(at) +
             " on: unplug its power supply for ten seconds";
    }
  }
  return {};
}

void FalconDriver::lost(bool) noexcept { parser_.restart(); }

bool FalconDriver::read(std::span<const std::uint8_t>& transfer) noexcept {
  while (!transfer.empty()) {
    const auto report = parser_.take(transfer.front());
    transfer = transfer.subspan(1);
    if (!report) continue;
    report_ = *report;
    return true;
  }
  return false;
}

UsbStage FalconDriver::judge(bool follows, UsbReading& reading) noexcept {
  if (report_.homed != kAllHomed) return UsbStage::homing;
  Eigen::Vector3d angles;
  for (int i = 0; i < 3; ++i) angles[i] = falcon_angle(report_.counts[static_cast<std::size_t>(i)]);
  const auto pose = falcon_pose(angles);
  if (!pose || !(pose->jacobian.norm() < kLongestLever)) return UsbStage::outside;
  turn_.setZero();
  if (follows) turn_ = (angles - angles_).cwiseMin(kMostSweep).cwiseMax(-kMostSweep);
  angles_ = angles;
  jacobian_ = pose->jacobian;
  reading.lever = levers_of(pose->jacobian)[2];
  reading.step = falcon_count_step() * reading.lever;
  reading.position = device_place(pose->position);
  reading.buttons = report_.buttons;
  return UsbStage::running;
}

std::span<const std::uint8_t> FalconDriver::command(UsbStage stage,
                                                    const UsbForce* force) noexcept {
  FalconCommand command;
  command.homing = stage == UsbStage::homing;
  command.lights = command.homing ? kBlue : force != nullptr ? kGreen : kRed;
  if (force != nullptr) command.motors = motors(*force);
  octets_ = octets_of(command);
  return octets_;
}

std::array<std::int16_t, 3> FalconDriver::motors(const UsbForce& force) noexcept {
  const auto ahead = falcon_pose(angles_ + kUsbAhead * turn_);
  const Eigen::Matrix3d& jacobian = ahead ? ahead->jacobian : jacobian_;
  const Eigen::Vector3d torques = falcon_torques(jacobian, falcon_axes(force.force));
  const Eigen::Vector3d words = kWordsPerTorque * torques;
  share_ = std::min(paid_share(force, torques),
                    share_within(words, Eigen::Vector3d::Constant(kMostWord)));
  std::array<std::int16_t, 3> motors{};
  for (std::size_t i = 0; i < motors.size(); ++i)
    motors[i] =
        static_cast<std::int16_t>(std::lround(share_ * words[static_cast<Eigen::Index>(i)]));
  return motors;
}

}  // namespace reckon::haptics
