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

constexpr nanoseconds kShutdownDrain = milliseconds(10);
constexpr microseconds kPollInterval{500};

}  // namespace

UsbLoop::UsbLoop(UsbExchange& exchange, std::unique_ptr<UsbDriver> driver, UsbLoopOptions options)
    : DeviceSession(std::move(options.clock), kRetry),
      exchange_(exchange),
      driver_(std::move(driver)),
      opener_(std::move(options.open)),
      discover_(options.discover),
      context_(discover_),
      run_(exchange.ended_run + 1) {
  if (!opener_) {
    opener_ = [&facts = driver_->facts()](libusb_context* context) {
      return open_usb_device(context, facts.vendor, facts.product);
    };
  }
}

// Sends a zero force: else the device may hold the last force indefinitely.
UsbLoop::~UsbLoop() {
  if (!line_) return;
  if (session_) session_->end_run();
  const nanoseconds end = now() + kShutdownDrain;
  const auto drain = [&] {
    while (line_->is_sending() && now() < end) line_->pump(kPollInterval);
  };
  drain();
  line_->send(driver_->command(UsbStage::silent, nullptr));
  drain();
  // Some devices act on a command only after their report has been fetched.
  const nanoseconds heard = std::min(end, now() + 2 * kUsbExchange);
  while (line_->fault() == UsbFault::none && now() < heard) line_->pump(kPollInterval);
}

std::optional<UsbStage> UsbLoop::stage() const noexcept {
  if (!session_) return std::nullopt;
  return session_->stage();
}

void UsbLoop::exchange(microseconds longest) {
  line_->pump(longest);
  const nanoseconds time = now();
  line_->each_transfer(
      [&](std::span<const std::uint8_t> transfer) { session_->take(transfer, time); });
  line_->clear();
  if (line_->fault() == UsbFault::gone) return detach("was unplugged");
  if (line_->fault() == UsbFault::stalled) return detach("refuses transfers");
  if (line_->fault() == UsbFault::failed) return detach("a transfer failed or was cut short");
  if (session_->is_lost(time)) return detach("stopped answering");
  if (line_->is_sending()) {
    if (session_->is_late(time)) detach("has accepted no command for 6 ms");
    return;
  }
  if (const auto command = session_->next(time)) line_->send(*command);
  tell_stage();
}

void UsbLoop::tell_stage() {
  const nanoseconds exchange = session_->exchange_time();
  if (exchange > nanoseconds(0) && !timed_) {
    timed_ = true;
    tell("an exchange takes " + in_tenths(exchange) +
         " at most: 'delay' of its [[device]] can be as low as 3.5 exchanges");
  }
  const UsbStage stage = session_->stage();
  if (stage == UsbStage::silent || told_ == stage) return;
  told_ = stage;
  if (stage == UsbStage::homing)
    tell(std::string("not homed: ") + driver_->how_to_home() + "; no force until it is homed");
  if (stage == UsbStage::outside) tell("the handle is at the end of its range: no force there");
  if (stage == UsbStage::running) tell("ready: forces are active");
}

// A device still attached is set up again at once, which sends it a zero force.
void UsbLoop::detach(const std::string& why) {
  const bool is_gone = line_->fault() == UsbFault::gone;
  session_->end_run();
  run_ = session_->run();
  session_.reset();
  line_.reset();
  driver_->lost(is_gone);
  told_.reset();
  clear_problem();
  retry_after(is_gone ? nanoseconds(kRetry) : nanoseconds(0));
  tell(why + ": its force is zero" + kIsTakenUpAgain);
}

std::string UsbLoop::open() {
  UsbOpening opening = opener_(context_.get());
  if (opening.handle == nullptr) {
    if (discover_) context_.look_again();
    return std::move(opening.problem);
  }
  const std::optional<UsbPipes> pipes = driver_->pipes(opening.handle);
  if (!pipes) {
    close_usb_device(opening.handle);
    return "another device has its USB ID: it lacks the endpoints";
  }
  try {
    line_.emplace(context_, opening.handle, *pipes);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  UsbSetUp desk(*line_, time(), stopped_, [this](const std::string& sentence) { tell(sentence); });
  return driver_->set_up(desk);
}

void UsbLoop::opened(nanoseconds now, std::string& problem) {
  if (problem.empty()) {
    clear_problem();
    line_->clear();
    session_.emplace(exchange_, *driver_, run_, now);
  } else if (line_) {
    const bool is_gone = line_->fault() == UsbFault::gone;
    driver_->lost(is_gone);
    if (is_gone) problem = std::string("was unplugged during set-up") + kIsTakenUpAgain;
    line_.reset();
  }
}

}  // namespace reckon::haptics
