// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A board that runs the example firmware, behind a serial line.
#include <algorithm>
#include <utility>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/fuzz/touch/model_handle.hpp"
#include "reckon/tests/haptics/support/wired_board.hpp"

namespace reckon::fuzz {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr double kFinest = 1e-6;     // [m] per count
constexpr double kPlainStep = 2e-5;  // [m] per count
constexpr nanoseconds kReady = milliseconds(1000);
constexpr std::uint16_t kQuestions = 4'096;  // requests in one exchange
constexpr unsigned kOften = 100;             // of a thousand frames

double step_of(const Scenario& s) {
  return s[Shared::encoder] > 0 ? std::max(kFinest, s[Shared::encoder]) : kPlainStep;
}

class BoardHandle final : public ModelHandle {
 public:
  BoardHandle(const Scenario& s, nanoseconds period, Way way)
      : ModelHandle(s, std::move(way)),
        limits_(haptics::usb_limits(haptics::serial_facts(), settings(s, period))),
        wired_(
            options(s), [this](double t) { return wanted(t); }, limits_, haptics::Scene()) {
    wired_.in.latency = wired_.out.latency = microseconds(100) + pdu::from_seconds(s[Shared::lag]);
    while (now() < kReady && !runs()) wired_.run(milliseconds(1));
    begin_books();
    wired_.run(milliseconds(50));
    wired_.servo_runs = false;
    begin_at(now());
  }

  [[nodiscard]] haptics::HapticDevice& device() override { return wired_.device; }
  [[nodiscard]] Eigen::Vector3d force() const override { return wired_.board.force(); }
  [[nodiscard]] double rounding() const override { return wired_.board.rounding(); }
  [[nodiscard]] bool tells_why() const override { return !runs(); }

 private:
  static test::SerialBoardOptions options(const Scenario& s) {
    test::SerialBoardOptions options;
    options.seed = s.seed;
    options.mass = s[Shared::mass];
    options.damping = s[Shared::model_damping];
    options.hand_stiffness = s[Shared::grip];
    options.hand_damping = s[Shared::grip_damping];
    options.nm_per_count = static_cast<int>(1e9 * step_of(s));
    options.period = static_cast<int>(1e6 * s[Shared::report]);
    return options;
  }
  static haptics::UsbSettings settings(const Scenario& s, nanoseconds period) {
    haptics::UsbSettings settings;
    settings.damping = s[Shared::stated] * s[Shared::model_damping];
    settings.period = period;
    settings.chain = pdu::from_seconds(s[Shared::chain]);
    settings.max_force = 5;
    settings.resolution = step_of(s);
    return settings;
  }
  [[nodiscard]] bool runs() const {
    return wired_.session->stage() == haptics::SerialStage::running;
  }

  void pass(nanoseconds time) override {
    for (const nanoseconds end = now() + time; now() < end;) {
      wired_.run(microseconds(50));
      if (wired_.session->is_lost(now())) begin_talk();
      tick(now());
    }
  }
  [[nodiscard]] nanoseconds now() const override { return wired_.board.now(); }
  // It has one energy ledger for both.
  [[nodiscard]] double port_work_now() const override { return work_now(); }
  [[nodiscard]] double work_now() const override { return wired_.board.books(); }
  [[nodiscard]] nanoseconds known_until() const override {
    return wired_.device.heard() - wired_.in.latency - milliseconds(3);
  }

  // As SerialLoop does.
  void begin_talk() {
    wired_.session->end_run();
    const std::uint32_t run = wired_.session->run();
    wired_.session.emplace(wired_.exchange, limits_, run, question_ += kQuestions, now());
  }
  void cut_line(bool in, bool out) {
    wired_.in_is_cut = in;
    wired_.out_is_cut = out;
  }
  void pull() {
    const nanoseconds latency = wired_.in.latency;
    wired_.in = wired_.out = test::LineWay();
    wired_.in.latency = wired_.out.latency = latency;
    cut_line(true, true);
    begin_talk();
  }

  void befall(Fault fault, nanoseconds /*lasts*/) override {
    test::LineFaults& faults = wired_.faults;
    switch (fault) {
      case Fault::hang:
        return cut_line(true, true);
      case Fault::mute:
        return cut_line(true, false);
      case Fault::cut:
        return cut_line(false, true);
      case Fault::damage:
        faults.changed = kOften;
        return;
      case Fault::disorder:
        faults.doubled = faults.swapped = kOften;
        return;
      case Fault::errors:
        faults.changed_out = kOften;
        return;
      case Fault::reset:
        faults.lost = kOften;
        return;
      case Fault::unplug:
        return pull();
      case Fault::power:
        pull();
        return wired_.board.forget();
      default:
        return;
    }
  }
  void mend(Fault /*fault*/) override {
    wired_.faults = {};
    cut_line(false, false);
  }

  haptics::DeviceLimits limits_;
  test::WiredBoard wired_;
  std::uint16_t question_ = 100;
};

}  // namespace

std::unique_ptr<ModelHandle> board_handle(const Scenario& scenario, nanoseconds period,
                                          ModelHandle::Way way) {
  return std::make_unique<BoardHandle>(scenario, period, std::move(way));
}

}  // namespace reckon::fuzz
