// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/unplugs/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <functional>
#include <memory>
#include <utility>

#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/fuzz/search/agenda.hpp"
#include "reckon/tests/fuzz/unplugs/tried_device.hpp"
#include "reckon/tests/fuzz/unplugs/watch.hpp"

namespace reckon::fuzz::unplugs {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr nanoseconds kServoStep = milliseconds(1);
// Time until it is set up again, with a firmware download and homing, and the force is back.
constexpr nanoseconds kBackWithin = seconds(5);
constexpr double kFelt = 0.1;    // [N]
constexpr double kDeep = 0.015;  // [m], of a hand in the wall that must feel it
// A handle that moves while no force is commanded.
constexpr nanoseconds kLoose = milliseconds(30);
constexpr nanoseconds kHurts = milliseconds(600);       // disturbance of a line and its effects
constexpr nanoseconds kPersonTakes = milliseconds(20);  // to home it
constexpr nanoseconds kPersonTriesAgain = milliseconds(500);

std::unique_ptr<TriedDevice> tried_device(const Plan& plan, const HeldHand& hand) {
  if (plan.device == DeviceKind::serial_board) return tried_serial_board(plan, hand);
  if (plan.device == DeviceKind::event_device) return tried_event_device(plan, hand);
  if (plan.device == DeviceKind::hid_device) return tried_hid_device(plan, hand);
  return tried_usb_device(plan, hand);
}

haptics::ServoConfig servo_config(const TriedDevice& tried) {
  haptics::ServoConfig config;
  config.probe_radius = 0;
  config.device_origin = tried.origin();
  return config;
}

class Trial {
 public:
  Trial(const Plan& plan, bool keep_log);
  ~Trial() { tried_->beside({}); }
  [[nodiscard]] Outcome run();

 private:
  // --- time
  void step();
  bool go(const std::function<bool()>& until, nanoseconds longest);
  void pass_beside(nanoseconds now);
  void step_servo(nanoseconds now);
  void hold_handle(nanoseconds now);
  void home(nanoseconds now);
  void in(nanoseconds time, std::function<void()> act) {
    agenda_.add(now() + time, std::move(act));
  }

  // --- faults
  void play(const Fault& fault);
  bool reach(const Fault& fault);
  void open_anew();
  bool wait_and_strike(const Fault& fault);
  void strike(const Fault& fault);
  void strike_plug(const Fault& fault, nanoseconds short_time);
  void pull(bool loses_power);
  void bounce(const Fault& fault, unsigned left);
  void plug();
  void end_program();
  void come_back();
  bool comes_to_feel();

  [[nodiscard]] nanoseconds now() const { return tried_->now(); }
  [[nodiscard]] bool runs() const { return tried_->stage() == Stage::running; }
  void log(const std::string& sentence);
  void mix(std::uint64_t number) { hash_ = (hash_ ^ number) * 0x100000001B3U; }

  const Plan& plan_;
  HeldHand hand_{start_of(plan_.device)};
  std::unique_ptr<TriedDevice> tried_{tried_device(plan_, hand_)};
  haptics::ServoLoop servo_;
  Watch watch_;
  Agenda<std::function<void()>> agenda_;
  nanoseconds next_step_ = kServoStep;
  bool servo_runs_ = true, is_homed_by_hand_ = true, stays_ = false, ends_ = false;
  nanoseconds frozen_until_{};
  double depth_ = 0.01;
  nanoseconds ran_at_{};
  std::optional<nanoseconds> homing_since_, hurt_at_;
  std::uint64_t hash_ = 0xCBF29CE484222325U;
  std::optional<std::vector<std::string>> log_;
  Outcome outcome_;
};

Trial::Trial(const Plan& plan, bool keep_log)
    : plan_(plan),
      servo_(tried_->device(), haptics::EffectPlan(tried_->scene()), servo_config(*tried_)),
      watch_(tried_->watchdog(), servo_.force_limit()) {
  if (keep_log) log_.emplace();
  tried_->lead(hand_.start());
  tried_->beside([this](nanoseconds now) { pass_beside(now); });
  tried_->begin_program();
}

// It may have been asked to stop during the setup of the device.
void Trial::end_program() {
  ends_ = false;
  const bool is_sound = !hurt_at_ || now() - *hurt_at_ > kHurts;
  const bool takes_it = is_sound && tried_->is_plugged() && runs();
  tried_->end_program();
  watch_.owns(tried_->surplus(), now());
  if (takes_it) {
    tried_->pass(tried_->obeys_within());
    if (!tried_->rests()) watch_.fail(2, now(), "the end of the program leaves a force on");
  }
  watch_.happens(1);  // a new loop reports everything again
  tried_->begin_program();
}

void Trial::log(const std::string& sentence) {
  if (log_) log_->push_back(fmt::format("{:.4f} s {}", pdu::to_seconds(now()), sentence));
}

void Trial::step() {
  if (now() < frozen_until_) return tried_->pass(milliseconds(1));
  tried_->step(tried_->stage() != Stage::away ? milliseconds(1) : milliseconds(10));
  for (const std::string& notice : tried_->take_notices()) {
    log(notice);
    watch_.hear(notice, now());
    mix(std::hash<std::string>{}(notice));
  }
  watch_.owns(tried_->surplus(), now());
  if (ends_) end_program();
}

bool Trial::go(const std::function<bool()>& until, nanoseconds longest) {
  const nanoseconds end = now() + longest;
  while (!until()) {
    if (watch_.finding() || now() >= end) return false;
    step();
  }
  return true;
}

void Trial::pass_beside(nanoseconds now) {
  while (agenda_.next() <= now) agenda_.take().event();
  home(now);
  hold_handle(now);
  watch_.see({now, runs(), tried_->rests(), tried_->commands()});
  while (now >= next_step_) {
    next_step_ += kServoStep;
    if (servo_runs_) step_servo(now);
  }
}

void Trial::step_servo(nanoseconds now) {
  servo_.step(now);
  servo_.snapshots().update();
  const haptics::ServoSnapshot& snapshot = servo_.snapshots().read();
  watch_.see(snapshot, tried_->asked(snapshot), tried_->books(snapshot), now);
}

void Trial::home(nanoseconds now) {
  if (tried_->stage() != Stage::homing) return homing_since_.reset();
  if (!homing_since_) homing_since_ = now;
  if (!is_homed_by_hand_ || now - *homing_since_ < kPersonTakes || !tried_->is_led()) return;
  tried_->home();
  homing_since_ = now + kPersonTriesAgain;
}

// If its position is known, the handle stays; otherwise it is brought to where it can be homed.
void Trial::hold_handle(nanoseconds now) {
  if (runs()) {
    ran_at_ = now;
    if (!tried_->is_led()) return;
    hand_.press(tried_->place(), depth_, now + tried_->shows_after());
    return tried_->let_go();
  }
  const bool is_loose = now - ran_at_ < kLoose || !tried_->rests();
  if (!tried_->is_led() && !is_loose) tried_->lead(tried_->place());
  const bool may_go = !tried_->is_plugged() || tried_->stage() == Stage::homing;
  const bool stays = stays_ && tried_->can_be_homed_anywhere();
  if (tried_->is_led() && may_go && !stays) tried_->lead(hand_.start());
}

void Trial::pull(bool loses_power) {
  log(fmt::format("unplugged{} at {:.3f} N", loses_power ? ", without power" : "",
                  tried_->force()));
  ++outcome_.received;
  if (!tried_->rests()) ++outcome_.pressed;
  watch_.happens(1);
  watch_.broken(now());
  tried_->pull(loses_power);
}

void Trial::plug() {
  if (tried_->is_plugged()) return;
  log("plugged in");
  tried_->plug();
  watch_.plugged();
}

void Trial::bounce(const Fault& fault, unsigned left) {
  pull(fault.loses_power);
  in(fault.lasts % milliseconds(5), [this, &fault, left] {
    plug();
    if (left > 1)
      in(fault.lasts % milliseconds(3), [this, &fault, left] { bounce(fault, left - 1); });
  });
}

void Trial::strike_plug(const Fault& fault, nanoseconds short_time) {
  switch (fault.kind) {
    case FaultKind::loose:
      if (tried_->loosen() && runs()) watch_.broken(now());
      return in(milliseconds(fault.number), [this, &fault] {
        pull(fault.loses_power);
        in(fault.lasts, [this] { plug(); });
      });
    case FaultKind::bounce:
      return bounce(fault, fault.number);
    case FaultKind::other_device:
      pull(fault.loses_power);
      return in(fault.lasts, [this, &fault, short_time] {
        tried_->be_another(fault, short_time);
        plug();
        in(short_time, [this] {
          pull(false);
          tried_->be_itself();
          in(milliseconds(1), [this] { plug(); });
        });
      });
    case FaultKind::denied:
      pull(fault.loses_power);
      return in(fault.lasts, [this, &fault, short_time] {
        static constexpr std::array kErrors{EACCES, EBUSY, EIO, ENXIO, EPERM};
        tried_->deny(kErrors[fault.call % kErrors.size()]);
        plug();
        in(short_time, [this] { tried_->deny(0); });
      });
    default:
      pull(fault.loses_power);
      return in(fault.lasts, [this] { plug(); });
  }
}

void Trial::strike(const Fault& fault) {
  watch_.happens(is_unplug(fault.kind) ? 1 : fault.number);
  const bool hurts = !is_unplug(fault.kind) || fault.kind == FaultKind::loose;
  if (hurts && fault.kind != FaultKind::end_program) hurt_at_ = now();
  const nanoseconds short_time = fault.lasts % milliseconds(300);
  if (is_unplug(fault.kind)) return strike_plug(fault, short_time);
  switch (fault.kind) {
    case FaultKind::end_program:
      if (!tried_->has_program()) return;  // it is ending
      tried_->stop();
      ends_ = true;
      return;
    case FaultKind::freeze:
      frozen_until_ = now() + short_time;
      return;
    case FaultKind::silent_servo:
      servo_runs_ = false;
      return in(short_time, [this] { servo_runs_ = true; });
    default: {
      const bool breaks = tried_->strike(fault, short_time);
      if (breaks && runs()) watch_.broken(now());
    }
  }
}

// Makes the loop set the device up from the beginning.
void Trial::open_anew() {
  if (tried_->is_plugged() && tried_->stage() != Stage::away) {
    pull(false);
    go([this] { return tried_->stage() == Stage::away; }, milliseconds(100));
  }
  plug();
}

// Advances time until the fault is executed; a fault of phase `any` is left to the caller.
bool Trial::reach(const Fault& fault) {
  if (fault.phase == Phase::any) return true;
  if (!go([this] { return agenda_.is_empty(); }, seconds(10))) return false;
  if (fault.phase == Phase::running) {
    come_back();
    return wait_and_strike(fault);
  }
  open_anew();
  if (fault.phase == Phase::opening) {
    bool is_there = false;
    tried_->calls().arm(fault.call, [&] {
      is_there = true;
      strike(fault);
    });
    const bool is_struck = go([&] { return is_there; }, kBackWithin);
    tried_->calls().disarm();
    return is_struck;
  }
  if (fault.phase == Phase::homing) {
    is_homed_by_hand_ = false;
    tried_->lose_place();
    const bool homes = go([this] { return tried_->stage() == Stage::homing; }, kBackWithin);
    is_homed_by_hand_ = true;
    if (!homes) watch_.fail(4, now(), "it is not taken up to be homed");
  } else {
    go([this, tries = tried_->tries()] { return tried_->tries() != tries; }, kBackWithin);
  }
  return wait_and_strike(fault);
}

bool Trial::wait_and_strike(const Fault& fault) {
  bool is_there = false;
  in(fault.after, [&] {
    is_there = true;
    strike(fault);
  });
  return go([&] { return is_there; }, kBackWithin);
}

void Trial::come_back() {
  if (!go([this] { return runs(); }, kBackWithin))
    watch_.fail(4, now(), "it is not taken up again");
}

void Trial::play(const Fault& fault) {
  log("-- " + text_of(fault));
  stays_ = fault.stays;
  depth_ = fault.depth;
  if (!reach(fault)) return;
  if (fault.phase == Phase::any) strike(fault);
  mix(static_cast<std::uint64_t>(now().count()));
  mix(std::bit_cast<std::uint64_t>(tried_->place().z()));
  mix(tried_->commands());
}

// A hand in the wall; or one that enters it repeatedly.
bool Trial::comes_to_feel() {
  const nanoseconds outside = tried_->shows_after();
  const nanoseconds end = now() + kBackWithin;
  while (now() < end && !watch_.finding()) {
    if (outside > nanoseconds(0)) {
      hand_.press(tried_->place(), -HeldHand::kGap, now());
      go([this, until = now() + 3 * outside] { return now() >= until; }, kBackWithin);
    }
    hand_.press(tried_->place(), kDeep, now());
    const nanoseconds inside = outside > nanoseconds(0) ? 3 * outside : kBackWithin;
    if (go([this] { return tried_->force() > kFelt; }, inside)) return true;
  }
  return false;
}

Outcome Trial::run() {
  for (const Fault& fault : plan_.faults) {
    if (!watch_.finding()) play(fault);
  }
  go([this] { return agenda_.is_empty() && now() >= frozen_until_; }, seconds(10));
  come_back();
  depth_ = kDeep;
  if (!comes_to_feel() && !plan_.line.splits) watch_.fail(4, now(), "the force does not come back");
  tried_->beside({});
  tried_->end_program();
  watch_.owns(tried_->surplus(), now());
  outcome_.finding = watch_.finding();
  outcome_.hash = hash_;
  if (log_) outcome_.log = std::move(*log_);
  return std::move(outcome_);
}

}  // namespace

Outcome try_out(const Plan& plan, bool keep_log) {
  Outcome outcome = Trial(plan, keep_log).run();
  if (outcome.finding || keep_log) return outcome;
  if (std::optional<std::string> sentence = growth())
    outcome.finding = Finding{7, {}, std::move(*sentence)};
  return outcome;
}

}  // namespace reckon::fuzz::unplugs
