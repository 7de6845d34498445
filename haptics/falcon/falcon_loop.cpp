// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/falcon/falcon_loop.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace reckon::haptics {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

// Requests of the FTDI chip, and their values.
constexpr std::uint8_t kReset = 0, kModem = 1, kFlow = 2, kBaud = 3, kData = 4, kLatency = 9;
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
constexpr nanoseconds kFarewell = milliseconds(10);
constexpr std::size_t kPiece = 58;  // octets of firmware whose echo is awaited
constexpr microseconds kLook{500};

constexpr const char* kName = "Falcon: ";

}  // namespace

FalconFirmware FalconFirmware::load(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  FalconFirmware firmware;
  std::vector<char> read(kMost + 1);
  in.read(read.data(), static_cast<std::streamsize>(read.size()));
  const auto count = static_cast<std::size_t>(in.gcount());
  if (in.bad() || (!in.eof() && count == 0))
    throw std::runtime_error(file + ": cannot be read; name the file of the Falcon's firmware");
  if (count < kLeast || count > kMost) {
    throw std::runtime_error(file + ": is no firmware of a Falcon, which has 1,000 to 262,144 " +
                             "octets; it is part of the drivers of Novint");
  }
  firmware.octets.assign(read.begin(), read.begin() + static_cast<std::ptrdiff_t>(count));
  return firmware;
}

FalconLoop::FalconLoop(FalconExchange& exchange, FalconLoopOptions options)
    : exchange_(exchange), options_(std::move(options)), context_(options_.discover) {
  if (!options_.open) {
    options_.open = [](libusb_context* context) {
      return open_usb_device(context, kFalconVendor, kFalconProduct);
    };
  }
}

// The device would hold the last force for as long as it likes.
FalconLoop::~FalconLoop() {
  if (!line_) return;
  const nanoseconds end = options_.clock() + kFarewell;
  const auto drain = [&] {
    while (line_->is_sending() && options_.clock() < end) line_->pump(kLook);
  };
  drain();
  line_->send(octets_of(FalconCommand{}));
  drain();
}

std::optional<FalconStage> FalconLoop::stage() const noexcept {
  if (!session_) return std::nullopt;
  return session_->stage();
}

void FalconLoop::tell(std::string sentence) {
  const std::lock_guard lock(telling_);
  notices_.push_back(kName + std::move(sentence));
}

std::vector<std::string> FalconLoop::take_notices() {
  const std::lock_guard lock(telling_);
  return std::exchange(notices_, {});
}

void FalconLoop::step(microseconds longest) {
  if (!line_) {
    if (options_.clock() >= next_try_) return attach();
    return context_.wait(longest);
  }
  line_->pump(longest);
  const nanoseconds now = options_.clock();
  session_->take(line_->received(), now);
  line_->clear();
  if (line_->fault() == UsbFault::gone) return detach("was unplugged");
  if (line_->fault() == UsbFault::stalled) return detach("refuses transfers");
  if (line_->fault() == UsbFault::failed) return detach("a transfer failed or was cut short");
  if (session_->is_lost(now)) return detach("does not answer any more");
  if (line_->is_sending()) {
    if (session_->is_late(now)) detach("takes no command for 6 ms");
    return;
  }
  if (const auto command = session_->next(now)) line_->send(octets_of(*command));
  tell_stage();
}

void FalconLoop::tell_stage() {
  const nanoseconds exchange = session_->exchange_time();
  if (exchange > nanoseconds(0) && !timed_) {
    timed_ = true;
    const auto tenths = static_cast<int>((exchange + microseconds(99)) / microseconds(100));
    tell("an exchange takes " + std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) +
         " ms at most: three of them and a half are enough for the 'delay' of its [[device]]");
  }
  const FalconStage stage = session_->stage();
  if (stage == FalconStage::silent || told_ == stage) return;
  told_ = stage;
  if (stage == FalconStage::homing)
    tell("not homed: pull the handle out as far as it goes, then push it in; no force until then");
  if (stage == FalconStage::outside) tell("the handle is at the end of its reach: no force there");
  if (stage == FalconStage::running) tell("ready: forces are shown");
}

// What is still there is set up at once: that tells it a zero.
void FalconLoop::detach(const std::string& why) {
  const bool is_gone = line_->fault() == UsbFault::gone;
  run_ = session_->run() + 1;
  session_.reset();
  line_.reset();
  told_.reset();
  problem_.clear();
  next_try_ = options_.clock() + (is_gone ? nanoseconds(kRetry) : nanoseconds(0));
  tell(why + ": its force is zero; it is taken up again as soon as it is there");
}

void FalconLoop::attach() {
  UsbOpening opening = options_.open(context_.get());
  std::string problem = std::move(opening.problem);
  if (opening.handle != nullptr) {
    try {
      line_.emplace(context_, opening.handle);
      problem = set_up();
    } catch (const std::runtime_error& error) {
      problem = error.what();
    }
  }
  const nanoseconds now = options_.clock();
  next_try_ = now + kRetry;
  if (problem.empty()) {
    problem_.clear();
    line_->clear();
    session_.emplace(exchange_, run_, now);
    return;
  }
  line_.reset();
  if (problem != problem_) tell(problem);
  problem_ = std::move(problem);
}

// What is in the way, as a sentence; empty: it answers.
std::string FalconLoop::set_up() {
  if (!set_line(false)) return "its FTDI chip refuses a setting: unplug it and plug it in again";
  const int timer = line_->latency_timer();
  if (timer != kRunLatency) {
    return "the latency timer of its FTDI chip reads " + std::to_string(timer) +
           " ms where 1 ms was set: forces would come too late, so that it is not used";
  }
  if (answers()) return {};
  if (options_.firmware.octets.empty()) {
    return "it has no firmware, which it forgets without power: name the file of it (firmware = "
           "\"FILE\" of its [[device]], or --firmware FILE)";
  }
  const std::string problem = load_firmware();
  if (!problem.empty()) return problem;
  if (set_line(false) && line_->latency_timer() == kRunLatency && answers()) {
    tell("firmware loaded, " + std::to_string(options_.firmware.octets.size()) +
         " octets; no checksum of it is known, its echo was compared");
    return {};
  }
  return "it does not answer with the firmware that was loaded: is the file that of a Falcon?";
}

bool FalconLoop::set_line(bool for_firmware) {
  UsbLine& line = *line_;
  if (!for_firmware) {
    return line.control(kReset, 0) && line.control(kLatency, kRunLatency) &&
           line.control(kBaud, kRunBaud) && line.control(kData, kEightBits) &&
           line.control(kFlow, 0) && line.control(kReset, kPurgeIn) &&
           line.control(kReset, kPurgeOut);
  }
  return line.control(kReset, 0) && line.control(kLatency, kSlowLatency) &&
         line.control(kBaud, kSlowBaud) && line.control(kData, kEightBits) &&
         line.control(kFlow, 0) && line.control(kModem, kRequestLow) &&
         line.control(kModem, kReadyLow) && line.control(kModem, kReadyHigh) &&
         line.control(kReset, kPurgeIn) && line.control(kReset, kPurgeOut);
}

bool FalconLoop::sends(std::span<const std::uint8_t> octets) {
  const nanoseconds end = options_.clock() + kEchoTime;
  if (!line_->send(octets)) return false;
  while (line_->is_sending() && options_.clock() < end && !stopped_) line_->pump(kLook);
  return !line_->is_sending() && line_->fault() == UsbFault::none;
}

// Waits for exactly these octets, among others before them.
bool FalconLoop::hears(std::span<const std::uint8_t> wanted, nanoseconds longest) {
  const nanoseconds end = options_.clock() + longest;
  while (!stopped_ && line_->fault() == UsbFault::none) {
    const auto heard = line_->received();
    if (!std::ranges::search(heard, wanted).empty()) return true;
    if (options_.clock() >= end) return false;
    line_->pump(kLook);
  }
  return false;
}

// A zero, and a report in answer.
bool FalconLoop::answers() {
  for (int attempt = 0; attempt < kAnswers && !stopped_; ++attempt) {
    line_->clear();
    if (!sends(octets_of(FalconCommand{}))) return false;
    FalconReportParser parser;
    const nanoseconds end = options_.clock() + kAnswerTime;
    while (options_.clock() < end && line_->fault() == UsbFault::none && !stopped_) {
      line_->pump(kLook);
      for (const std::uint8_t octet : line_->received()) {
        if (parser.take(octet)) return true;
      }
      line_->clear();
    }
  }
  return false;
}

std::string FalconLoop::load_firmware() {
  const std::string unheard =
      "it does not take the firmware: unplug its power supply for ten seconds";
  if (!set_line(true)) return "its FTDI chip refuses a setting: unplug it and plug it in again";
  line_->clear();
  bool greeted = false;
  for (int i = 0; i < kHellos && !greeted && !stopped_; ++i) {
    if (!sends(kHello)) return unheard;
    greeted = hears(kHelloBack, kHelloTime);
  }
  if (!greeted || !line_->control(kModem, kReadyLow) || !line_->control(kBaud, kFirmwareBaud))
    return unheard;
  line_->clear();
  if (!sends(kReady) || !hears(kReady, kEchoTime)) return unheard;

  const std::span<const std::uint8_t> all(options_.firmware.octets);
  for (std::size_t at = 0; at < all.size(); at += kPiece) {
    const auto piece = all.subspan(at, std::min(kPiece, all.size() - at));
    line_->clear();
    if (!sends(piece)) return unheard;
    if (!hears(piece, kEchoTime)) {
      return "what it echoes is not the firmware that was sent, from octet " + std::to_string(at) +
             " on: unplug its power supply for ten seconds";
    }
  }
  return {};
}

}  // namespace reckon::haptics
