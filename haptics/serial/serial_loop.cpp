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

constexpr nanoseconds kFarewell = milliseconds(10);
constexpr microseconds kGlance{500};
constexpr std::uint16_t kQuestions = 4'096;  // between those of one session and of the next

}  // namespace

SerialLoop::SerialLoop(UsbExchange& exchange, const DeviceLimits& limits, SerialPlace place,
                       std::function<nanoseconds()> clock)
    : exchange_(exchange),
      limits_(limits),
      place_(std::move(place)),
      clock_(std::move(clock)),
      run_(exchange.ended_run + 1),
      question_(static_cast<std::uint16_t>(clock_().count() >> 10)) {}

// The board would hold the last force until its watchdog ends it.
SerialLoop::~SerialLoop() {
  if (!port_ || !session_) return;
  session_->end_run();
  const nanoseconds end = clock_() + kFarewell;
  const auto drain = [&] {
    while (!port_->is_gone() && port_->is_sending() && clock_() < end) wait_without_line(kGlance);
  };
  drain();
  port_->send(session_->farewell().span());
  drain();
}

std::optional<SerialStage> SerialLoop::stage() const noexcept {
  if (!session_) return std::nullopt;
  return session_->stage();
}

void SerialLoop::tell(const std::string& sentence) { notices_.tell(place_.port, sentence); }

void SerialLoop::tell_problem(const std::string& problem) {
  notices_.tell_problem(place_.port, problem);
}

void SerialLoop::step(microseconds longest) {
  if (!port_) {
    if (clock_() >= next_try_) return attach();
    return wait_without_line(longest);
  }
  port_->wait(longest);
  const nanoseconds now = clock_();
  exchange_octets(now);
  if (port_->is_gone()) return detach("was unplugged", kRetry);
  if (session_->is_lost(now)) return detach("does not answer any more", nanoseconds(0));
  if (now - taken_at_ > kStuck) return detach("takes no octets for 6 ms", nanoseconds(0));
  tell_stage(now);
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
                     ? "what it sends are no frames of this line: is its baud " +
                           std::to_string(place_.baud) + "?"
                     : "it does not answer: does the board run a program for this line, at " +
                           std::to_string(place_.baud) + " baud?");
  }
  const nanoseconds chain = session_->chain();
  if (chain > nanoseconds(0) && !timed_) {
    timed_ = true;
    const auto tenths = static_cast<int>((chain + microseconds(599)) / microseconds(100));
    tell("a force is at the handle, and told so, within " + std::to_string(tenths / 10) + "." +
         std::to_string(tenths % 10) + " ms: that is enough for the 'delay' of its [[device]]");
  }
  const SerialStage stage = session_->stage();
  if (stage == SerialStage::asked || stage == SerialStage::greeted || told_ == stage) return;
  told_ = stage;
  const std::string name = std::string(session_->greeting().name.data());
  if (stage == SerialStage::refused)
    tell_problem((name.empty() ? "the board" : name) + " is not driven: " + session_->refusal());
  if (stage == SerialStage::homing)
    tell(name + " does not know its place yet; no force until then");
  if (stage == SerialStage::running) {
    notices_.clear_problem();
    unsigned axes = 0;
    for (std::size_t i = 0; i < session_->greeting().axes; ++i)
      axes |= 1U << session_->greeting().axis[i].direction;
    axes_ = axes;
    tell(name + " is ready: forces are shown");
  }
}

void SerialLoop::detach(const std::string& why, nanoseconds pause) {
  session_->end_run();
  run_ = session_->run();
  question_ = static_cast<std::uint16_t>(question_ + kQuestions);
  session_.reset();
  port_.reset();
  told_.reset();
  next_try_ = clock_() + pause;
  tell_problem(why + ": its force is zero; it is taken up again as soon as it is there");
}

void SerialLoop::attach() {
  SerialOpening opening = SerialPort::open(place_.port, place_.baud);
  const nanoseconds now = clock_();
  next_try_ = now + kRetry;
  if (!opening.port)
    return tell_problem(std::move(opening.problem) +
                        (opening.remedy.empty() ? "" : ": " + opening.remedy));
  port_ = std::move(opening.port);
  taken_at_ = now;
  session_.emplace(exchange_, limits_, run_, question_, now);
}

}  // namespace reckon::haptics
