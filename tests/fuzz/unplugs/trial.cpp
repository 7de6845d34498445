// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/unplugs/trial.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <functional>
#include <map>
#include <memory>
#include <utility>

#include "reckon/haptics/falcon/falcon_driver.hpp"
#include "reckon/haptics/polhem/polhem_driver.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/haptics/usb/usb_device.hpp"
#include "reckon/haptics/usb/usb_loop.hpp"
#include "reckon/tests/fuzz/unplugs/held_hand.hpp"
#include "reckon/tests/fuzz/unplugs/watch.hpp"
#include "reckon/tests/haptics/support/falcon_model.hpp"
#include "reckon/tests/haptics/support/plugged_device.hpp"
#include "reckon/tests/haptics/support/polhem_model.hpp"
#include "reckon/tests/haptics/support/usb_shim.hpp"

namespace reckon::fuzz::unplugs {
namespace {

using Eigen::Vector3d;
using haptics::UsbStage;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr nanoseconds kServoStep = milliseconds(1);
constexpr nanoseconds kMotionStep = microseconds(100);
// Set up anew, with a firmware to load and homed, and the force is back.
constexpr nanoseconds kBackWithin = seconds(5);
constexpr double kFelt = 0.1;    // [N]
constexpr double kDeep = 0.015;  // [m], of a hand in the wall that must feel it
// A handle that moves while nobody tells it a force.
constexpr nanoseconds kLoose = milliseconds(30);
constexpr nanoseconds kHurts = milliseconds(600);       // a line, and what came of it
constexpr nanoseconds kPersonTakes = milliseconds(20);  // to home it
constexpr nanoseconds kPersonTriesAgain = milliseconds(500);

struct Falcon {
  using Model = test::FalconModel;
  static constexpr nanoseconds kWatchdog = milliseconds(100);
  static Vector3d start() { return {0, 0, HeldHand::kGap}; }
  static std::vector<std::uint8_t> firmware() { return std::vector<std::uint8_t>(1'000, 0x5A); }
  static test::FalconModelOptions options(const Plan& plan) {
    test::FalconModelOptions options;
    options.seed = static_cast<unsigned>(plan.seed);
    options.out_at = plan.line.out_at;
    options.motion_step = kMotionStep;
    options.tick_at = plan.line.in_at;
    options.firmware = firmware();
    return options;
  }
  static std::unique_ptr<haptics::UsbDriver> driver() {
    return std::make_unique<haptics::FalconDriver>(haptics::FalconFirmware{firmware()});
  }
  static const haptics::UsbFacts& facts() { return haptics::falcon_facts(); }
  static constexpr bool kCanBeHomedAnywhere = true;
  static void home(Model& model) { model.home(); }
  static void damage(Model& model, int count) { model.damage_visibly(count); }
  // It does not answer.
  static void be_another(Model& model, nanoseconds time) { model.mute(time); }
  static void be_itself(Model&) {}
};

struct Polhem {
  using Model = test::PolhemModel;
  static constexpr nanoseconds kWatchdog = milliseconds(500);
  static Vector3d start() { return Model::start(); }
  static test::PolhemModelOptions options(const Plan& plan) {
    test::PolhemModelOptions options;
    options.seed = static_cast<unsigned>(plan.seed);
    options.out_at = plan.line.out_at;
    options.motion_step = kMotionStep;
    options.in_at = plan.line.in_at;
    return options;
  }
  static std::unique_ptr<haptics::UsbDriver> driver() {
    return std::make_unique<haptics::PolhemDriver>();
  }
  static const haptics::UsbFacts& facts() { return haptics::polhem_facts(); }
  static constexpr bool kCanBeHomedAnywhere = false;
  static void home(Model& model) { model.press(); }
  static void damage(Model& model, int count) { model.merge(count); }
  static void be_another(Model& model, nanoseconds) { model.disguise(true); }
  static void be_itself(Model& model) { model.disguise(false); }
};

template <class Kind>
class Trial {
 public:
  Trial(const Plan& plan, bool keep_log);
  ~Trial() { model_.beside({}); }
  [[nodiscard]] Outcome run();

 private:
  // Time.
  void step();
  bool go(const std::function<bool()>& until, nanoseconds longest);
  void pass_beside(nanoseconds now);
  void step_servo(nanoseconds now);
  void hold_handle(nanoseconds now);
  void book_own_work(nanoseconds now);
  void home(nanoseconds now);
  void in(nanoseconds time, std::function<void()> act) {
    agenda_.emplace(model_.now() + time, std::move(act));
  }

  // What befalls it.
  void play(const Fault& fault);
  bool reach(const Fault& fault);
  void open_anew();
  bool wait_and_strike(const Fault& fault);
  void strike(const Fault& fault);
  void strike_line(const Fault& fault);
  void pull(bool loses_power);
  void bounce(const Fault& fault, unsigned left);
  void plug();
  void begin_program();
  void end_program();
  void come_back();

  [[nodiscard]] std::optional<UsbStage> stage() const {
    return loop_ ? loop_->stage() : std::nullopt;
  }
  [[nodiscard]] bool runs() const { return stage() == UsbStage::running; }
  [[nodiscard]] bool motors_rest() const { return model_.motors() == decltype(model_.motors()){}; }
  /// Without what the device gave by itself.
  [[nodiscard]] double books() const {
    return model_.port_work() + model_.damping_loss() - own_work_;
  }
  void log(const std::string& sentence);
  void mix(std::uint64_t number) { hash_ = (hash_ ^ number) * 0x100000001B3U; }

  const Plan& plan_;
  HeldHand hand_{Kind::start()};
  typename Kind::Model model_;
  test::UsbShim shim_{model_};
  haptics::UsbExchange exchange_;
  haptics::UsbDevice device_;
  haptics::ServoLoop servo_;
  std::unique_ptr<haptics::UsbLoop> loop_;
  Watch watch_;
  std::multimap<nanoseconds, std::function<void()>> agenda_;
  nanoseconds next_step_ = kServoStep;
  bool servo_runs_ = true, is_homed_by_hand_ = true, stays_ = false, ends_ = false;
  double depth_ = 0.01;
  std::optional<nanoseconds> opened_at_;  // since the last look
  nanoseconds ran_at_{}, commanded_at_{};
  std::uint64_t commands_ = 0;
  double own_work_ = 0, work_ = 0;  // [J], of the motors
  std::optional<nanoseconds> homing_since_, hurt_at_;
  std::optional<unsigned> calls_left_;
  std::function<void()> at_call_;
  std::uint64_t hash_ = 0xCBF29CE484222325U;
  std::optional<std::vector<std::string>> log_;
  Outcome outcome_;
};

// A report in pieces takes a tick of the chip's timer more.
haptics::DeviceLimits limits_of(const haptics::UsbFacts& facts, const Line& line) {
  haptics::UsbSettings settings;
  settings.damping = 2.0;
  if (line.splits) settings.chain *= 2;
  return haptics::usb_limits(facts, settings);
}

// The wall lies where the hand's way begins.
haptics::ServoConfig servo_config(const Vector3d& start) {
  haptics::ServoConfig config;
  config.probe_radius = 0;
  config.device_origin = HeldHand::kGap * Vector3d::UnitZ() - start;
  return config;
}

template <class Kind>
Trial<Kind>::Trial(const Plan& plan, bool keep_log)
    : plan_(plan),
      model_(Kind::options(plan), [this](double t) { return hand_(t); }),
      device_(exchange_, limits_of(Kind::facts(), plan.line)),
      servo_(device_, haptics::EffectPlan(test::stiff_floor()), servo_config(Kind::start())),
      watch_(Kind::kWatchdog, servo_.force_limit()) {
  if (keep_log) log_.emplace();
  model_.split(plan.line.splits);
  model_.lead(hand_.start());
  model_.beside([this](nanoseconds now) { pass_beside(now); });
  shim_.at_each_call([this] {
    if (calls_left_ && (*calls_left_)-- == 0) {
      calls_left_.reset();
      std::exchange(at_call_, {})();
    }
  });
  begin_program();
}

template <class Kind>
void Trial<Kind>::begin_program() {
  haptics::UsbLoopOptions options;
  options.clock = [this] { return model_.now(); };
  options.discover = false;
  options.open = [this](libusb_context* context) {
    haptics::UsbOpening opening{shim_.open(context), {}};
    if (opening.handle == nullptr) opening.problem = "none is attached";
    opened_at_ = model_.now();
    return opening;
  };
  loop_ = std::make_unique<haptics::UsbLoop>(exchange_, Kind::driver(), std::move(options));
}

// It may have been told to stop while it was setting the device up.
template <class Kind>
void Trial<Kind>::end_program() {
  ends_ = false;
  const bool is_sound = !hurt_at_ || model_.now() - *hurt_at_ > kHurts;
  const bool takes_it = is_sound && shim_.is_plugged() && runs();
  loop_.reset();
  watch_.count(false, shim_.outstanding(), model_.now());
  if (takes_it) {
    model_.pass(milliseconds(2));
    if (!motors_rest()) watch_.fail(2, model_.now(), "the end of the program leaves a force on");
  }
  watch_.happens(1);  // who is new says all of it anew
  begin_program();
}

template <class Kind>
void Trial<Kind>::log(const std::string& sentence) {
  if (log_) log_->push_back(fmt::format("{:.4f} s {}", pdu::to_seconds(model_.now()), sentence));
}

template <class Kind>
void Trial<Kind>::step() {
  loop_->step(stage() ? milliseconds(1) : milliseconds(10));
  for (const std::string& notice : loop_->take_notices()) {
    log(notice);
    watch_.hear(notice, model_.now());
    mix(std::hash<std::string>{}(notice));
  }
  watch_.count(stage().has_value(), shim_.outstanding(), model_.now());
  if (ends_) end_program();
}

template <class Kind>
bool Trial<Kind>::go(const std::function<bool()>& until, nanoseconds longest) {
  const nanoseconds end = model_.now() + longest;
  while (!until()) {
    if (watch_.finding() || model_.now() >= end) return false;
    step();
  }
  return true;
}

template <class Kind>
void Trial<Kind>::pass_beside(nanoseconds now) {
  while (!agenda_.empty() && agenda_.begin()->first <= now) {
    const std::function<void()> act = std::move(agenda_.begin()->second);
    agenda_.erase(agenda_.begin());
    act();
  }
  home(now);
  hold_handle(now);
  book_own_work(now);
  watch_.see({now, runs(), motors_rest(), model_.commands()});
  while (now >= next_step_) {
    next_step_ += kServoStep;
    if (servo_runs_) step_servo(now);
  }
}

template <class Kind>
void Trial<Kind>::step_servo(nanoseconds now) {
  servo_.step(now);
  servo_.snapshots().update();
  const haptics::ServoSnapshot& snapshot = servo_.snapshots().read();
  watch_.see(snapshot, books() + snapshot.loan + snapshot.encoder_allowance, now);
}

template <class Kind>
void Trial<Kind>::home(nanoseconds now) {
  if (stage() != UsbStage::homing) return homing_since_.reset();
  if (!homing_since_) homing_since_ = now;
  if (!is_homed_by_hand_ || now - *homing_since_ < kPersonTakes || !model_.is_led()) return;
  Kind::home(model_);
  homing_since_ = now + kPersonTriesAgain;
}

// Where its places are known it stays where it is; else it is brought to where it can be homed.
template <class Kind>
void Trial<Kind>::hold_handle(nanoseconds now) {
  if (runs()) {
    ran_at_ = now;
    if (!model_.is_led()) return;
    hand_.press(model_.position(), depth_, now);
    return model_.let_go();
  }
  const bool is_loose = now - ran_at_ < kLoose || !motors_rest();
  if (!model_.is_led() && !is_loose) model_.lead(model_.position());
  const bool may_go = !shim_.is_plugged() || stage() == UsbStage::homing;
  const bool stays = stays_ && Kind::kCanBeHomedAnywhere;
  if (model_.is_led() && may_go && !stays) model_.lead(hand_.start());
}

// A device that is pulled out holds its last force until its own watchdog acts. Its driver can do
// nothing about it, and the servo relies on 10 ms: what comes later is not of its books.
template <class Kind>
void Trial<Kind>::book_own_work(nanoseconds now) {
  if (model_.commands() != std::exchange(commands_, model_.commands())) commanded_at_ = now;
  const double work = model_.port_work() - std::exchange(work_, model_.port_work());
  if (now - commanded_at_ > haptics::HapticDevice::kWatchdog) own_work_ += work;
}

template <class Kind>
void Trial<Kind>::pull(bool loses_power) {
  log(fmt::format("unplugged{} at {:.3f} N", loses_power ? ", without power" : "",
                  model_.force().norm()));
  ++outcome_.received;
  if (!motors_rest()) ++outcome_.pressed;
  shim_.unplug();
  watch_.happens(1);
  watch_.broken(model_.now());
  model_.forget_line();
  if (loses_power) model_.forget();
}

template <class Kind>
void Trial<Kind>::plug() {
  if (shim_.is_plugged()) return;
  log("plugged in");
  shim_.plug();
  watch_.plugged();
}

template <class Kind>
void Trial<Kind>::bounce(const Fault& fault, unsigned left) {
  pull(fault.loses_power);
  in(fault.lasts % milliseconds(5), [this, &fault, left] {
    plug();
    if (left > 1)
      in(fault.lasts % milliseconds(3), [this, &fault, left] { bounce(fault, left - 1); });
  });
}

// A line that breaks and is there still.
template <class Kind>
void Trial<Kind>::strike_line(const Fault& fault) {
  static constexpr std::array kErrors{EPROTO, EILSEQ, EOVERFLOW, ETIME, EPIPE, ENOSR, ENOENT};
  if (fault.kind == FaultKind::stall) {
    model_.stall();
  } else if (fault.kind == FaultKind::cut) {
    model_.cut();
  } else if (fault.kind == FaultKind::errors) {
    shim_.fail(kErrors[fault.call % kErrors.size()], fault.number);
  } else {
    shim_.reset_port();
    model_.forget_line();
  }
  // A transfer that is called off is none that failed.
  const bool is_called_off =
      fault.kind == FaultKind::reset_port ||
      (fault.kind == FaultKind::errors && kErrors[fault.call % kErrors.size()] == ENOENT);
  if (runs() && !is_called_off) watch_.broken(model_.now());
}

template <class Kind>
void Trial<Kind>::strike(const Fault& fault) {
  watch_.happens(is_unplug(fault.kind) ? 1 : fault.number);
  if (!is_unplug(fault.kind) && fault.kind != FaultKind::end_program) hurt_at_ = model_.now();
  const nanoseconds short_time = fault.lasts % milliseconds(300);
  switch (fault.kind) {
    case FaultKind::unplug:
      pull(fault.loses_power);
      return in(fault.lasts, [this] { plug(); });
    case FaultKind::loose:
      shim_.fail(EPROTO, 1'000'000);
      if (runs()) watch_.broken(model_.now());
      return in(milliseconds(fault.number), [this, &fault] {
        pull(fault.loses_power);
        in(fault.lasts, [this] { plug(); });
      });
    case FaultKind::bounce:
      return bounce(fault, fault.number);
    case FaultKind::other_device:
      pull(fault.loses_power);
      return in(fault.lasts, [this, short_time] {
        Kind::be_another(model_, short_time);
        plug();
        in(short_time, [this] {
          pull(false);
          Kind::be_itself(model_);
          in(milliseconds(1), [this] { plug(); });
        });
      });
    case FaultKind::end_program:
      if (!loop_) return;  // it is ending
      loop_->stop();
      ends_ = true;
      return;
    case FaultKind::hang:
      return model_.hang(short_time);
    case FaultKind::mute:
      return model_.mute(short_time);
    case FaultKind::damage:
      return Kind::damage(model_, static_cast<int>(fault.number));
    case FaultKind::silent_servo:
      servo_runs_ = false;
      return in(short_time, [this] { servo_runs_ = true; });
    case FaultKind::reset_port:
    case FaultKind::errors:
    case FaultKind::stall:
    case FaultKind::cut:
      return strike_line(fault);
  }
}

// So that it is set up from the begin.
template <class Kind>
void Trial<Kind>::open_anew() {
  if (shim_.is_plugged() && stage()) {
    pull(false);
    go([this] { return !stage(); }, milliseconds(100));
  }
  plug();
}

// Lets time pass until it is struck; at once is left to who calls.
template <class Kind>
bool Trial<Kind>::reach(const Fault& fault) {
  if (fault.phase == Phase::any) return true;
  if (!go([this] { return agenda_.empty(); }, seconds(10))) return false;
  if (fault.phase == Phase::running) {
    come_back();
    return wait_and_strike(fault);
  }
  open_anew();
  if (fault.phase == Phase::opening) {
    bool is_there = false;
    calls_left_ = fault.call;
    at_call_ = [&] {
      is_there = true;
      strike(fault);
    };
    const bool is_struck = go([&] { return is_there; }, kBackWithin);
    calls_left_.reset();
    return is_struck;
  }
  opened_at_.reset();
  if (fault.phase == Phase::homing) {
    is_homed_by_hand_ = false;
    model_.forget();
    const bool homes = go([this] { return stage() == UsbStage::homing; }, kBackWithin);
    is_homed_by_hand_ = true;
    if (!homes) watch_.fail(4, model_.now(), "it is not taken up to be homed");
  } else {
    go([this] { return opened_at_.has_value(); }, kBackWithin);
  }
  return wait_and_strike(fault);
}

template <class Kind>
bool Trial<Kind>::wait_and_strike(const Fault& fault) {
  bool is_there = false;
  in(fault.after, [&] {
    is_there = true;
    strike(fault);
  });
  return go([&] { return is_there; }, kBackWithin);
}

template <class Kind>
void Trial<Kind>::come_back() {
  if (!go([this] { return runs(); }, kBackWithin))
    watch_.fail(4, model_.now(), "it is not taken up again");
}

template <class Kind>
void Trial<Kind>::play(const Fault& fault) {
  log("-- " + text_of(fault));
  stays_ = fault.stays;
  depth_ = fault.depth;
  if (!reach(fault)) return;
  if (fault.phase == Phase::any) strike(fault);
  mix(static_cast<std::uint64_t>(model_.now().count()));
  mix(std::bit_cast<std::uint64_t>(model_.position().z()));
  mix(model_.commands());
}

template <class Kind>
Outcome Trial<Kind>::run() {
  for (const Fault& fault : plan_.faults) {
    if (!watch_.finding()) play(fault);
  }
  go([this] { return agenda_.empty(); }, seconds(10));
  come_back();
  depth_ = kDeep;
  hand_.press(model_.position(), kDeep, model_.now());
  const bool is_felt = go([this] { return model_.force().norm() > kFelt; }, kBackWithin);
  if (!is_felt && !plan_.line.splits) watch_.fail(4, model_.now(), "the force does not come back");
  model_.beside({});
  loop_.reset();
  watch_.count(false, shim_.outstanding(), model_.now());
  outcome_.finding = watch_.finding();
  outcome_.hash = hash_;
  if (log_) outcome_.log = std::move(*log_);
  return std::move(outcome_);
}

// What the program holds of memory and files may not grow. The allocator's caches come and go.
std::optional<std::string> growth() {
  constexpr std::size_t kSettled = 64;          // seeds
  constexpr std::size_t kLeeway = 128 * 1'024;  // octets
  static std::size_t seeds = 0, most = 0;
  static int next_file = -1;
  const int file = ::dup(STDIN_FILENO);  // the lowest number that is free
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

}  // namespace

Outcome try_out(const Plan& plan, bool keep_log) {
  Outcome outcome = plan.device == DeviceKind::polhem ? Trial<Polhem>(plan, keep_log).run()
                                                      : Trial<Falcon>(plan, keep_log).run();
  if (outcome.finding || keep_log) return outcome;
  if (std::optional<std::string> sentence = growth())
    outcome.finding = Finding{7, {}, std::move(*sentence)};
  return outcome;
}

}  // namespace reckon::fuzz::unplugs
