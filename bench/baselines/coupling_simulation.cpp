// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/baselines/coupling_simulation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "reckon/bench/baselines/force_comparison.hpp"
#include "reckon/bench/baselines/undelayed_truth.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::bench {
namespace {

constexpr double kShareOfLimit = 0.95;
constexpr double kFarthest = 10.0;  // [m]
constexpr double kStrongest = 1e6;  // [N]

void require(bool good, const char* what, double value) {
  if (good) return;
  throw std::invalid_argument("coupling run: " + std::string(what) + ", got " +
                              std::to_string(value));
}

void check(const CouplingRun& run) {
  const double T = run.device.period;
  require(T >= 1e-4 && T <= 1e-2, "the sample period must be 0.1 to 10 ms", T);
  require(run.device.damping > 0, "the device's damping must be above 0", run.device.damping);
  const auto is_rate = [T](double hz) { return hz > 0 && hz * T <= 1 + 1e-9; };
  require(is_rate(run.uplink_hz), "the uplink rate must be above 0, at most 1/T", run.uplink_hz);
  require(is_rate(run.update_hz), "the update rate must be above 0, at most 1/T", run.update_hz);
  require(run.duration >= T && run.duration <= kMostCouplingSamples * T,
          "the duration must be T to 10 million T", run.duration);
  require(run.impedance >= 0, "the impedance must be 0 or more", run.impedance);
}

double between(double hz, double period) { return std::max(1.0, std::round(1 / (hz * period))); }

CouplingEndConfig config_of(const CouplingRun& run, CouplingSide side) {
  CouplingEndConfig config;
  config.mode = run.mode;
  config.side = side;
  config.counterpart = run.counterpart;
  config.period = run.device.period;
  config.damping = run.device.damping;
  config.mass = run.device.mass;
  config.impedance = run.impedance > 0 ? run.impedance : 0.5 * run.device.damping;
  const double whole = run.environment.stiffness();
  config.gain = whole > 0 ? std::min(1.0, gain_cut_stiffness(run) / whole) : 1.0;
  config.gate = run.gate;
  config.environment = run.environment;
  return config;
}

std::unique_ptr<haptics::SimulatedDevice> device_of(const CouplingRun& run, CouplingSide side) {
  const bool first = side == CouplingSide::first;
  if (!first && run.counterpart == Counterpart::server) return nullptr;
  const OperatorModel& hand = first ? run.hand : run.other_hand;
  haptics::SimulatedDeviceConfig config;
  config.mass = run.device.mass;
  config.damping = run.device.damping;
  config.hand_stiffness = hand.stiffness;
  config.hand_damping = hand.damping;
  config.start.x() = first ? kCouplingStart : 0.0;
  return std::make_unique<haptics::SimulatedDevice>(config, hand.script);
}

std::uint32_t every(const CouplingRun& run, CouplingSide side) {
  const bool up = side == CouplingSide::first && run.counterpart == Counterpart::server;
  const double samples = between(up ? run.uplink_hz : run.update_hz, run.device.period);
  return static_cast<std::uint32_t>(samples);
}

}  // namespace

double gain_cut_stiffness(const CouplingRun& run) {
  const double T = run.device.period;
  const peer::ImpairmentLaw& law = run.network;
  const double way = std::max(T, pdu::to_seconds(law.delay + law.jitter)) +
                     (law.reorder > 0 ? pdu::to_seconds(law.reorder_delay) : 0.0);
  const double update = between(run.update_hz, T) * T, uplink = between(run.uplink_hz, T) * T;
  const double loop =
      run.counterpart == Counterpart::hand ? T + way + update : T / 2 + 2 * way + uplink + update;
  return kShareOfLimit * run.device.damping / loop;
}

CouplingPeer::CouplingPeer(const CouplingRun& run, CouplingSide side, SampleLink& link)
    : period_(run.device.period), every_(0), link_(link) {
  check(run);
  every_ = every(run, side);
  device_ = device_of(run, side);
  end_ = make_coupling_end(config_of(run, side));
}

OwnMotion CouplingPeer::read() {
  OwnMotion own;
  own.number = number_;
  if (device_ == nullptr) return own;
  const haptics::DeviceSample sample = device_->read(pdu::from_seconds(number_ * period_));
  own.position = sample.position.x();
  own.velocity = sample.velocity.x();
  return own;
}

void CouplingPeer::step() {
  const OwnMotion own = read();
  position_ = own.position;
  speed_ = own.velocity;
  if (device_ != nullptr) port_energy_ = device_->port_work() + device_->damping_loss();
  loan_ = end_->loan();
  force_ = end_->step(own, link_.receive(number_));
  if (device_ != nullptr)
    device_->write(Eigen::Vector3d(force_, 0, 0), pdu::from_seconds(number_ * period_));
  std::optional<CouplingSample> due;
  if (number_ % every_ == 0) due = end_->sample();
  link_.send(number_, due);
  ++number_;
}

namespace {

// All measurements of a run, sample by sample.
class Measures {
 public:
  Measures(const CouplingRun& run, std::uint32_t samples)
      : run_(run), samples_(samples), comparison_(samples) {
    if (!run.keep_trace) return;
    for (auto& trace : outcome_.trace) trace.reserve(samples);
  }

  /// @param truth [N], the undelayed force @returns false if the run has diverged and must end
  bool note(std::uint32_t number, const CouplingPeer& first, const CouplingPeer& second,
            double truth) {
    const bool two = second.has_hand();
    note_energy(first, second);
    note_motion(number, first);
    const double t = number * run_.device.period;
    const double here = run_.environment.at(t).force(first.position() - second.position());
    if (t > kCouplingWait) {
      comparison_.note(-first.force(), truth, here);
      if (two) comparison_.note(second.force(), truth, here);
    }
    outcome_.peak_force = std::max(outcome_.peak_force, std::abs(first.force()));
    if (two) outcome_.peak_force = std::max(outcome_.peak_force, std::abs(second.force()));
    if (run_.keep_trace) {
      outcome_.trace[0].push_back({first.position(), first.force()});
      if (two) outcome_.trace[1].push_back({second.position(), second.force()});
    }
    outcome_.simulated = t;
    outcome_.diverged = !(sane(first) && (!two || sane(second)));
    return !outcome_.diverged;
  }

  [[nodiscard]] CouplingOutcome finished() {
    outcome_.least_energy =
        run_.counterpart == Counterpart::hand ? outcome_.least_sum : outcome_.least_port[0];
    if (last_ > 0) outcome_.rms_speed = std::sqrt(speeds_ / last_);
    outcome_.amplitude = last_ > 0 ? 0.5 * (highest_ - lowest_) : 0.0;
    comparison_.finish(outcome_);
    return std::move(outcome_);
  }

 private:
  static bool sane(const CouplingPeer& peer) {
    return std::abs(peer.position()) < kFarthest && std::abs(peer.force()) < kStrongest;
  }

  void note_energy(const CouplingPeer& first, const CouplingPeer& second) {
    const double sum =
        first.port_energy() + second.port_energy() + first.world_work() + second.world_work();
    outcome_.least_port[0] = std::min(outcome_.least_port[0], first.port_energy());
    outcome_.least_port[1] = std::min(outcome_.least_port[1], second.port_energy());
    outcome_.least_sum = std::min(outcome_.least_sum, sum);
    outcome_.most_loan = std::max(outcome_.most_loan, first.loan() + second.loan());
  }

  void note_motion(std::uint32_t number, const CouplingPeer& first) {
    outcome_.farthest = std::max(outcome_.farthest, std::abs(first.position()));
    if (number < samples_ - samples_ / 3) return;
    lowest_ = last_ == 0 ? first.position() : std::min(lowest_, first.position());
    highest_ = last_ == 0 ? first.position() : std::max(highest_, first.position());
    speeds_ += first.speed() * first.speed();
    ++last_;
  }

  const CouplingRun& run_;
  std::uint32_t samples_;
  ForceComparison comparison_;
  CouplingOutcome outcome_;
  double speeds_ = 0.0, lowest_ = 0.0, highest_ = 0.0;
  std::uint32_t last_ = 0;
};

}  // namespace

CouplingOutcome simulate(const CouplingRun& run) {
  check(run);
  const double period = run.device.period;
  SampleQueue to_first(run.network, period, run.seed, CouplingSide::first);
  SampleQueue to_second(run.network, period, run.seed, CouplingSide::second);
  QueueLink first_link(to_first, to_second), second_link(to_second, to_first);
  CouplingPeer first(run, CouplingSide::first, first_link);
  CouplingPeer second(run, CouplingSide::second, second_link);
  const auto samples = static_cast<std::uint32_t>(std::llround(run.duration / period));
  Measures measures(run, samples);
  UndelayedTruth truth(run);
  for (std::uint32_t k = 0; k < samples; ++k) {
    first.step();
    second.step();
    if (!measures.note(k, first, second, truth.force())) break;
    truth.step();
  }
  return measures.finished();
}

}  // namespace reckon::bench
