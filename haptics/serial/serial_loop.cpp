// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/serial/serial_loop.hpp"

#include <span>
#include <utility>

namespace reckon::haptics {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr nanoseconds kShutdownDrain = milliseconds(10);
constexpr microseconds kPollInterval{500};
constexpr std::uint16_t kQuestions = 4'096;  // by which the question numbers of two sessions differ

}  // namespace

SerialLoop::SerialLoop(UsbExchange& exchange, const DeviceLimits& limits, SerialPlace place,
                       SteadyTime time)
    : DeviceSession(std::move(time), kRetry),
      exchange_(exchange),
      limits_(limits),
      place_(std::move(place)),
      run_(exchange.ended_run + 1),
      question_(static_cast<std::uint16_t>(now().count() >> 10)) {}

// Sends a zero force: else the board would hold the last force until its watchdog ends it.
SerialLoop::~SerialLoop() {
  if (!port_ || !session_) return;
  session_->end_run();
  const nanoseconds end = now() + kShutdownDrain;
  const auto drain = [&] {
    while (!port_->is_gone() && port_->is_sending() && now() < end)
      wait_without_line(kPollInterval);
  };
  drain();
  port_->send(session_->farewell().span());
  drain();
}

std::optional<SerialStage> SerialLoop::stage() const noexcept {
  if (!session_) return std::nullopt;
  return session_->stage();
}

void SerialLoop::exchange(microseconds longest) {
  port_->wait(longest);
  const nanoseconds time = now();
  exchange_octets(time);
  if (port_->is_gone()) return detach("was unplugged", kRetry);
  if (session_->is_lost(time)) return detach("stopped answering", nanoseconds(0));
  if (time - taken_at_ > kStuck) return detach("has accepted no octets for 6 ms", nanoseconds(0));
  tell_stage(time);
}

void SerialLoop::exchange_octets(nanoseconds now) {
  for (auto octets = port_->read(); !octets.empty(); octets = port_->read())
    session_->take(octets, now);
  if (port_->is_sending()) return;
  taken_at_ = now;
  if (const auto frame = session_->next(now)) port_->send(frame->span());
}

void SerialLoop::tell_stage(nanoseconds now) {
  if (session_->is_unanswered(now)) {
    tell_problem(session_->hears_noise()
                     ? "it sends data that are not frames of this protocol: is its baud rate " +
                           std::to_string(place_.baud) + "?"
                     : "it does not answer: does the board run firmware of this protocol, at " +
                           std::to_string(place_.baud) + " baud?");
  }
  const nanoseconds chain = session_->chain();
  if (chain > nanoseconds(0) && !timed_) {
    timed_ = true;
    tell("the time from a command to the report of its effect is at most " +
         in_tenths(chain + microseconds(500)) + "; 'delay' of its [[device]] can be that low");
  }
  const SerialStage stage = session_->stage();
  if (stage == SerialStage::asked || stage == SerialStage::greeted || told_ == stage) return;
  told_ = stage;
  const std::string name = std::string(session_->greeting().name.data());
  if (stage == SerialStage::refused)
    tell_problem((name.empty() ? "the board" : name) + " cannot be used: " + session_->refusal());
  if (stage == SerialStage::homing) tell(name + " is not homed; no force until it is");
  if (stage == SerialStage::running) {
    clear_problem();
    unsigned axes = 0;
    for (std::size_t i = 0; i < session_->greeting().axes; ++i)
      axes |= 1U << session_->greeting().axis[i].direction;
    axes_ = axes;
    tell(name + " is ready: forces are active");
  }
}

void SerialLoop::detach(const std::string& why, nanoseconds pause) {
  session_->end_run();
  run_ = session_->run();
  question_ = static_cast<std::uint16_t>(question_ + kQuestions);
  session_.reset();
  port_.reset();
  told_.reset();
  retry_after(pause);
  tell_problem(why + ": its force is zero" + kIsTakenUpAgain);
}

std::string SerialLoop::open() {
  SerialOpening opening = SerialPort::open(place_.port, place_.baud);
  port_ = std::move(opening.port);
  return opening.problem + (opening.remedy.empty() ? "" : ": " + opening.remedy);
}

void SerialLoop::opened(nanoseconds now, std::string& problem) {
  if (!problem.empty()) return;
  taken_at_ = now;
  session_.emplace(exchange_, limits_, run_, question_, now);
}

}  // namespace reckon::haptics
