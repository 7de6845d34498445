// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Two ends of a coupling in one simulation: an operator at a simulated device against a server, or
// two of them against each other, over an impaired line. All modes have the same world, so that
// their numbers are comparable.
//
//     CouplingRun run;
//     run.mode = CouplingMode::printed_dead_reckoning;
//     run.environment = {EnvironmentKind::hardening, 500.0};
//     run.network = peer::delayed_by(0.05);
//     const CouplingOutcome outcome = simulate(run);
//     outcome.least_energy; // [J], below 0: the hand received energy that nobody supplied
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

/// Greatest number of samples in a run: 2 h 46 min at 1 kHz. Each uses 32 octets during the run.
inline constexpr double kMostCouplingSamples = 1e7;

/// The simulated device of a study; both hands have the same.
struct CouplingDevice {
  double mass = 0.1;     ///< [kg] > 0
  double damping = 1.0;  ///< b [N s/m] > 0, all of it guaranteed
  double period = 1e-3;  ///< T [s], 0.1 to 10 ms
};

/// A complete run: the same run gives the same outcome to the last bit.
struct CouplingRun {
  CouplingMode mode = CouplingMode::reckon;
  Counterpart counterpart = Counterpart::server;
  CouplingDevice device;
  /// Two hands have a linear environment between them.
  Environment environment{EnvironmentKind::linear, 500.0};
  OperatorModel hand = operator_model(OperatorKind::push);
  OperatorModel other_hand = resting_operator();  ///< if the counterpart is a hand
  peer::ImpairmentLaw network;
  double uplink_hz = 200;  ///< rate of samples to a server, 0 < .. <= 1/T; rounded to whole periods
  double update_hz = 50;   ///< rate of samples to a hand, likewise
  double duration = 12;    ///< [s], above 0, with at most kMostCouplingSamples samples
  std::uint64_t seed = 1;
  bool gate = true;      ///< of mode reckon: if off, the port may hold any force
  double impedance = 0;  ///< of the transmission line [N s/m]; 0 takes b/2
  bool keep_trace = false;
};

/// One sample of a hand. Forces are along x, on the hand.
struct CouplingTrace {
  double position = 0.0;  ///< [m], position
  double force = 0.0;     ///< [N], held from here on

  bool operator==(const CouplingTrace&) const = default;
};

/// Result of a run. The energy of a port is the work that the force took from the hand, plus the
/// device's friction, plus energy lent to the port and still owed: a passive environment keeps it
/// >= 0.
struct CouplingOutcome {
  std::array<double, 2> least_port{};  ///< [J], for each hand; the second is 0 with a server
  /// [J], least sum over all ports, plus the work of the world itself if it is rendered at the
  /// other end of the line: below 0 the coupling made energy.
  double least_sum = 0.0;
  /// [J], verdict on the run: with a server the energy of the hand's port, whatever the world did;
  /// with two hands the sum. A run made energy if this is below -1e-9.
  double least_energy = 0.0;
  double most_loan = 0.0;   ///< [J], greatest total debt of the ports
  double peak_force = 0.0;  ///< [N], over both hands
  /// Of the first hand in the last third: a motion that does not settle under a push oscillates.
  double rms_speed = 0.0;  ///< [m/s]
  double amplitude = 0.0;  ///< [m], half of the peak-to-peak motion
  double farthest = 0.0;   ///< [m], greatest distance of the first hand from 0
  /// Error against the force at that time without line and sampling, while either force is not 0.
  double error_rms = 0.0, error_p95 = 0.0;  ///< [N]
  double truth_rms = 0.0, truth_p95 = 0.0;  ///< [N], of the true force
  /// Rendered force as a share of the environment's force at the positions of the hands, in phase
  /// with it: 1 for the whole stiffness.
  double stiffness_kept = 0.0;
  /// Ended early: a hand was beyond 10 m, a force was beyond 1 MN, or a number was NaN.
  bool diverged = false;
  double simulated = 0.0;  ///< [s]
  /// By hand and sample, if the run requests it.
  std::array<std::vector<CouplingTrace>, 2> trace;

  [[nodiscard]] bool made_energy() const noexcept { return least_energy < -1e-9; }
};

/// Greatest stiffness [N/m] that gain_cut renders: .95 of the stiffness that is passive at the
/// greatest delay of the network without loss: K (T/2 + D) < b for a server with round-trip delay
/// D, K (T + D) < b between two hands with one-way delay D. D includes jitter and the time between
/// samples.
[[nodiscard]] double gain_cut_stiffness(const CouplingRun& run);

/// One side of a run: operator, device and end. simulate() steps two of them; over sockets each
/// process steps one.
class CouplingPeer {
 public:
  /// @param link must outlive the peer
  /// @throws std::invalid_argument for numbers out of range; the text says which and why
  CouplingPeer(const CouplingRun& run, CouplingSide side, SampleLink& link);

  /// Computes the next sample. @throws the exceptions of the link
  void step();

  [[nodiscard]] std::uint32_t samples() const noexcept { return number_; }
  [[nodiscard]] bool has_hand() const noexcept { return device_ != nullptr; }
  [[nodiscard]] double position() const noexcept { return position_; }  ///< [m], at the sample
  [[nodiscard]] double speed() const noexcept { return speed_; }        ///< [m/s], likewise
  [[nodiscard]] double force() const noexcept { return force_; }        ///< [N], held since
  /// Work taken from the hand, friction, and energy owed, up to the sample [J].
  [[nodiscard]] double port_energy() const noexcept { return port_energy_ + loan_; }
  [[nodiscard]] double loan() const noexcept { return loan_; }  ///< [J], the part that is owed
  [[nodiscard]] double world_work() const noexcept { return end_->world_work(); }

 private:
  [[nodiscard]] OwnMotion read();

  double period_;
  std::uint32_t every_;  // samples between two that are sent
  SampleLink& link_;
  std::unique_ptr<haptics::SimulatedDevice> device_;  // null for a server
  std::unique_ptr<CouplingEnd> end_;
  std::uint32_t number_ = 0;
  double position_ = 0.0, speed_ = 0.0, force_ = 0.0, port_energy_ = 0.0, loan_ = 0.0;
};

/// Deterministic, shares no state with other calls: any thread, about 10 ms for 12 s.
/// @throws std::invalid_argument for numbers out of range; the text says which and why
[[nodiscard]] CouplingOutcome simulate(const CouplingRun& run);

}  // namespace reckon::bench
