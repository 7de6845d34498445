// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/unplugs/watch.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "reckon/pdu/seconds.hpp"

namespace reckon::fuzz::unplugs {
namespace {

using std::chrono::milliseconds;

constexpr nanoseconds kZeroWithin = milliseconds(10);
// A command that was under way when the force was dropped.
constexpr nanoseconds kUnderWay = milliseconds(3);
constexpr double kLeastBooks = -1e-9;    // [J]
constexpr int kRamp = 100;               // steps
constexpr std::uint64_t kSentences = 6;  // per event

double ms_of(nanoseconds time) { return 1e3 * pdu::to_seconds(time); }

}  // namespace

void Watch::fail(int invariant, nanoseconds now, std::string sentence) {
  if (!finding_) finding_ = Finding{invariant, now, std::move(sentence)};
}

void Watch::broken(nanoseconds now) {
  if (!broken_at_) broken_at_ = now;
  was_down_ = !runs_;
}

void Watch::see(const Sight& sight) {
  if (runs_ != sight.runs) steps_ = 0;
  runs_ = sight.runs;
  if (!runs_) was_down_ = true;
  if (runs_ && was_down_) broken_at_.reset();
  if (runs_) ran_at_ = sight.now;
  if (sight.commands != std::exchange(commands_, sight.commands)) {
    commanded_at_ = sight.now;
    const bool is_late = !runs_ && (!ran_at_ || sight.now - *ran_at_ > kUnderWay);
    if (!sight.motors_rest && is_late)
      fail(2, sight.now, "the device is told a force though it was not taken up");
  }
  if (!sight.motors_rest && sight.now - commanded_at_ > watchdog_ + milliseconds(2))
    fail(3, sight.now, "its own watchdog leaves a force on");
}

void Watch::see(const haptics::ServoSnapshot& servo, double asked, double books, nanoseconds now) {
  const double force = servo.force.norm();
  if (broken_at_ && now - *broken_at_ > kZeroWithin && asked > 0) {
    fail(1, now,
         fmt::format("the servo asks for {:.3f} N {:.2f} ms after the line broke", asked,
                     ms_of(now - *broken_at_)));
  }
  if (broken_at_ && now - *broken_at_ > kZeroWithin + watchdog_ && force > 0) {
    fail(1, now,
         fmt::format("the servo tells of {:.3f} N {:.2f} ms after the line broke", force,
                     ms_of(now - *broken_at_)));
  }
  if (runs_) ++steps_;
  const double most =
      force_limit_ * static_cast<double>(std::min<std::uint64_t>(steps_, kRamp)) / kRamp;
  if (runs_ && force > most + 1e-9) {
    fail(5, now,
         fmt::format("{:.3f} N in step {} after it was taken up, where {:.3f} N are allowed", force,
                     steps_, most));
  }
  if (books < kLeastBooks) fail(8, now, fmt::format("the device's own books have {:.3g} J", books));
}

void Watch::hear(const std::string& sentence, nanoseconds now) {
  if (sentence == heard_ && events_ == events_before_)
    fail(6, now, fmt::format("nothing befell it, and it says again: {}", sentence));
  heard_ = sentence;
  events_before_ = events_;
  if (++sentences_ > kSentences * (events_ + 1))
    fail(6, now, fmt::format("{} sentences for {} events", sentences_, events_));
}

// The allocator's caches vary.
std::optional<std::string> growth() {
  constexpr std::size_t kSettled = 64;          // seeds
  constexpr std::size_t kLeeway = 128 * 1'024;  // octets
  static std::size_t seeds = 0, most = 0;
  static int next_file = -1;
  const int file = ::dup(STDIN_FILENO);  // the lowest free number
  ::close(file);
  const std::size_t now = mallinfo2().uordblks;
  if (++seeds <= kSettled) {
    most = std::max(most, now);
    next_file = file;
    return {};
  }
  if (now > most + kLeeway) return fmt::format("{} octets are left allocated", now - most);
  if (file != next_file) return "files are left open";
  return {};
}

}  // namespace reckon::fuzz::unplugs
