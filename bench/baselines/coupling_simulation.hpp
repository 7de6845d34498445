// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Two ends of a coupling in one simulation: an operator at a simulated device against a server, or
// two of them against each other, over an impaired line. Every mode
// meets the same world, so that its numbers can stand beside those of the others.
//
//     CouplingRun run;
//     run.mode = CouplingMode::printed_dead_reckoning;
//     run.environment = {EnvironmentKind::hardening, 500.0};
//     run.network = peer::delayed_by(0.05);
//     const CouplingOutcome outcome = simulate(run);
//     outcome.least_energy;   // [J], below 0: the hand got energy that nobody put in
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "reckon/bench/baselines/coupling_end.hpp"
#include "reckon/bench/baselines/coupling_world.hpp"
#include "reckon/bench/baselines/sample_link.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"

namespace reckon::bench {

/// Samples of one run: 2 h 46 min at 1 kHz. Each takes 32 octets while it runs.
inline constexpr double kMostCouplingSamples = 1e7;

/// A study's device, simulated; both hands have the same.
struct CouplingDevice {
  double mass = 0.1;     ///< [kg] > 0
  double damping = 1.0;  ///< b [N s/m] > 0, all of it sure
  double period = 1e-3;  ///< T [s], 0.1 to 10 ms
};

/// One run, whole: the same run gives the same outcome to the last bit.
struct CouplingRun {
  CouplingMode mode = CouplingMode::reckon;
  Counterpart counterpart = Counterpart::server;
  CouplingDevice device;
  /// Two hands have a linear one between them.
  Environment environment{EnvironmentKind::linear, 500.0};
  OperatorModel hand = operator_model(OperatorKind::push);
  OperatorModel other_hand = resting_operator();  ///< where the counterpart is a hand
  peer::ImpairmentLaw network;
  double uplink_hz = 200;  ///< samples to a server, 0 < .. <= 1/T; rounded to whole periods
  double update_hz = 50;   ///< samples to a hand, likewise
  double duration = 12;    ///< [s], above 0, at most kMostCouplingSamples of them
  std::uint64_t seed = 1;
  bool gate = true;      ///< of mode reckon: off, whatever is wanted is held
  double impedance = 0;  ///< of the transmission line [N s/m]; 0 takes b/2
  bool keep_trace = false;
};

/// One sample of a hand. Forces are along x, on the hand.
struct CouplingTrace {
  double position = 0.0;  ///< [m]
  double force = 0.0;     ///< [N], held from here on

  bool operator==(const CouplingTrace&) const = default;
};

/// What came of it. Energy of a port: work that the force took from the hand, the device's
/// friction, and what the port was lent and still owes: a passive environment keeps it >= 0.
struct CouplingOutcome {
  std::array<double, 2> least_port{};  ///< [J], of each hand; the second is 0 with a server
  /// [J], least of all ports together, with the work that the world itself did where it is rendered
  /// beyond the line: below 0 the coupling made energy.
  double least_sum = 0.0;
  /// [J], the verdict on the run: with a server that of the hand, whatever the world did, with two
  /// hands the sum. A run made energy where this is below -1e-9.
  double least_energy = 0.0;
  double most_loan = 0.0;   ///< [J], most that the ports owed together
  double peak_force = 0.0;  ///< [N], of both hands
  /// Of the first hand in the last third: what does not settle under a push cycles.
  double rms_speed = 0.0;  ///< [m/s]
  double amplitude = 0.0;  ///< [m], half of the way to and fro
  double farthest = 0.0;   ///< [m], of the first hand from 0
  /// Against what the hands would feel at that time without line and sampling, while either force
  /// is not 0.
  double error_rms = 0.0, error_p95 = 0.0;  ///< [N]
  double truth_rms = 0.0, truth_p95 = 0.0;  ///< [N], what was right
  /// What is shown as a share of the environment's force where the hands are, in phase with it: 1
  /// for the whole stiffness.
  double stiffness_kept = 0.0;
  /// Ended early: a hand was beyond 10 m or a force beyond 1 MN, or no number.
  bool diverged = false;
  double simulated = 0.0;  ///< [s]
  /// By hand and sample, where the run asks for it.
  std::array<std::vector<CouplingTrace>, 2> trace;

  [[nodiscard]] bool made_energy() const noexcept { return least_energy < -1e-9; }
};

/// Stiffness [N/m] that gain_cut shows at most: .95 of what is passive at the greatest delay that
/// the network has without loss, K (T/2 + D) < b for a server with D there and back, K (T + D) < b
/// between two hands with D one way. D counts jitter and the time between samples.
[[nodiscard]] double gain_cut_stiffness(const CouplingRun& run);

/// One side of a run: operator, device and end. simulate() steps two of them; over sockets each
/// process steps one.
class CouplingPeer {
 public:
  /// @param link outlives the peer
  /// @throws std::invalid_argument for numbers out of range; the text says which and why
  CouplingPeer(const CouplingRun& run, CouplingSide side, SampleLink& link);

  /// The next sample. @throws what the link throws
  void step();

  [[nodiscard]] std::uint32_t samples() const noexcept { return number_; }
  [[nodiscard]] bool has_hand() const noexcept { return device_ != nullptr; }
  [[nodiscard]] double position() const noexcept { return position_; }  ///< [m], at the sample
  [[nodiscard]] double speed() const noexcept { return speed_; }        ///< [m/s], likewise
  [[nodiscard]] double force() const noexcept { return force_; }        ///< [N], held since
  /// Work taken from the hand, friction, and what is owed, up to the sample [J].
  [[nodiscard]] double port_energy() const noexcept { return port_energy_ + loan_; }
  [[nodiscard]] double loan() const noexcept { return loan_; }  ///< [J], of it what is owed
  [[nodiscard]] double world_work() const noexcept { return end_->world_work(); }

 private:
  [[nodiscard]] OwnMotion read();

  double period_;
  std::uint32_t every_;  // samples between two that are sent
  SampleLink& link_;
  std::unique_ptr<haptics::SimulatedDevice> device_;  // null: a server
  std::unique_ptr<CouplingEnd> end_;
  std::uint32_t number_ = 0;
  double position_ = 0.0, speed_ = 0.0, force_ = 0.0, port_energy_ = 0.0, loan_ = 0.0;
};

/// Deterministic, shares nothing with other calls: any thread, some 10 ms for 12 s.
/// @throws std::invalid_argument for numbers out of range; the text says which and why
[[nodiscard]] CouplingOutcome simulate(const CouplingRun& run);

}  // namespace reckon::bench
