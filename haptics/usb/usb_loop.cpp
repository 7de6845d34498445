// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/usb/usb_loop.hpp"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

namespace reckon::haptics {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr nanoseconds kFarewell = milliseconds(10);
constexpr microseconds kGlance{500};

}  // namespace

UsbLoop::UsbLoop(UsbExchange& exchange, std::unique_ptr<UsbDriver> driver, UsbLoopOptions options)
    : exchange_(exchange),
      driver_(std::move(driver)),
      options_(std::move(options)),
      context_(options_.discover),
      run_(exchange.ended_run + 1) {
  if (!options_.open) {
    options_.open = [&facts = driver_->facts()](libusb_context* context) {
      return open_usb_device(context, facts.vendor, facts.product);
    };
  }
}

// The device would hold the last force for as long as it likes.
UsbLoop::~UsbLoop() {
  if (!line_) return;
  if (session_) session_->end_run();
  const nanoseconds end = options_.clock() + kFarewell;
  const auto drain = [&] {
    while (line_->is_sending() && options_.clock() < end) line_->pump(kGlance);
  };
  drain();
  line_->send(driver_->command(UsbStage::silent, nullptr));
  drain();
  // A device that waits for its report to be fetched obeys after that.
  const nanoseconds heard = std::min(end, options_.clock() + 2 * kUsbExchange);
  while (line_->fault() == UsbFault::none && options_.clock() < heard) line_->pump(kGlance);
}

std::optional<UsbStage> UsbLoop::stage() const noexcept {
  if (!session_) return std::nullopt;
  return session_->stage();
}

void UsbLoop::tell(const std::string& sentence) { notices_.tell(driver_->facts().name, sentence); }

void UsbLoop::step(microseconds longest) {
  if (!line_) {
    if (options_.clock() >= next_try_) return attach();
    return context_.wait(longest);
  }
  line_->pump(longest);
  const nanoseconds now = options_.clock();
  line_->each_transfer(
      [&](std::span<const std::uint8_t> transfer) { session_->take(transfer, now); });
  line_->clear();
  if (line_->fault() == UsbFault::gone) return detach("was unplugged");
  if (line_->fault() == UsbFault::stalled) return detach("refuses transfers");
  if (line_->fault() == UsbFault::failed) return detach("a transfer failed or was cut short");
  if (session_->is_lost(now)) return detach("does not answer any more");
  if (line_->is_sending()) {
    if (session_->is_late(now)) detach("takes no command for 6 ms");
    return;
  }
  if (const auto command = session_->next(now)) line_->send(*command);
  tell_stage();
}

void UsbLoop::tell_stage() {
  const nanoseconds exchange = session_->exchange_time();
  if (exchange > nanoseconds(0) && !timed_) {
    timed_ = true;
    const auto tenths = static_cast<int>((exchange + microseconds(99)) / microseconds(100));
    tell("an exchange takes " + std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) +
         " ms at most: three of them and a half are enough for the 'delay' of its [[device]]");
  }
  const UsbStage stage = session_->stage();
  if (stage == UsbStage::silent || told_ == stage) return;
  told_ = stage;
  if (stage == UsbStage::homing)
    tell(std::string("not homed: ") + driver_->how_to_home() + "; no force until then");
  if (stage == UsbStage::outside) tell("the handle is at the end of its reach: no force there");
  if (stage == UsbStage::running) tell("ready: forces are shown");
}

// What is still there is set up at once: that tells it a zero.
void UsbLoop::detach(const std::string& why) {
  const bool is_gone = line_->fault() == UsbFault::gone;
  session_->end_run();
  run_ = session_->run();
  session_.reset();
  line_.reset();
  driver_->lost(is_gone);
  told_.reset();
  notices_.clear_problem();
  next_try_ = options_.clock() + (is_gone ? nanoseconds(kRetry) : nanoseconds(0));
  tell(why + ": its force is zero; it is taken up again as soon as it is there");
}

// What is in the way, as a sentence; empty: the device is set up.
std::string UsbLoop::open() {
  UsbOpening opening = options_.open(context_.get());
  if (opening.handle == nullptr) {
    if (options_.discover) context_.look_again();
    return std::move(opening.problem);
  }
  const std::optional<UsbPipes> pipes = driver_->pipes(opening.handle);
  if (!pipes) {
    close_usb_device(opening.handle);
    return "what is attached under its number is another device: it has none of its pipes";
  }
  try {
    line_.emplace(context_, opening.handle, *pipes);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  UsbSetUp desk(*line_, options_.clock, stopped_,
                [this](const std::string& sentence) { tell(sentence); });
  return driver_->set_up(desk);
}

void UsbLoop::attach() {
  std::string problem = open();
  const nanoseconds now = options_.clock();
  next_try_ = now + kRetry;
  if (problem.empty()) {
    notices_.clear_problem();
    line_->clear();
    session_.emplace(exchange_, *driver_, run_, now);
    return;
  }
  if (line_) {
    const bool is_gone = line_->fault() == UsbFault::gone;
    driver_->lost(is_gone);
    if (is_gone)
      problem = "was unplugged while it was set up; it is taken up again as soon as it is there";
    line_.reset();
  }
  notices_.tell_problem(driver_->facts().name, problem);
}

}  // namespace reckon::haptics
