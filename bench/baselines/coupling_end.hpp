// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One end of a coupling: what it makes of the own motion and of what arrived. One object per end;
// the ends of a mode share nothing but the samples.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "reckon/bench/baselines/coupling_mode.hpp"
#include "reckon/bench/baselines/coupling_world.hpp"

namespace reckon::bench {

/// The handle at a sample; of a server, where its world begins.
struct OwnMotion {
  std::uint32_t number = 0;  ///< of the sample, from 0
  double position = 0.0;     ///< [m]
  double velocity = 0.0;     ///< [m/s]
};

/// What travels, whatever the mode; each uses what it needs and leaves the rest 0.
struct CouplingSample {
  std::uint32_t number = 0;  ///< of the sample at which it was sent
  double position = 0.0;     ///< [m], of the handle, or of the surface of a model
  double velocity = 0.0;     ///< [m/s]
  double effort = 0.0;       ///< [N], or the wave [sqrt W]
  double stiffness = 0.0;    ///< [N/m], of the model
  double given = 0.0;        ///< [J], running total: see RemoteHand
  double need = 0.0;         ///< [J]
  double spring_need = 0.0;  ///< [J]

  bool operator==(const CouplingSample&) const = default;
};

/// One end. Single thread; step() and sample() neither allocate nor lock.
class CouplingEnd {
 public:
  virtual ~CouplingEnd() = default;

  /// One sample. @param arrived since the last one, in order of arrival, which need not be that of
  /// sending  @returns the force on the own handle [N], held until the next step; 0 for a server
  virtual double step(const OwnMotion& own, std::span<const CouplingSample> arrived) noexcept = 0;
  /// What to send, asked for after step() where a sample is due.
  [[nodiscard]] virtual CouplingSample sample() noexcept = 0;
  /// Work that changes of the world did on what is touched [J]; 0 where the end renders no world.
  [[nodiscard]] virtual double world_work() const noexcept { return 0.0; }
  /// What its port was lent and has not paid back [J], see haptics::exchange_energy(); 0 where
  /// nothing is lent.
  [[nodiscard]] virtual double loan() const noexcept { return 0.0; }

 protected:
  CouplingEnd() = default;
  CouplingEnd(const CouplingEnd&) = default;
  CouplingEnd& operator=(const CouplingEnd&) = default;
};

/// What is at the other end of the line from the first hand.
enum class Counterpart : std::uint8_t { server, hand };

/// Which end. Hands overlap by the first one's position less the second one's.
enum class CouplingSide : std::uint8_t { first, second };

/// What an end is made of.
struct CouplingEndConfig {
  CouplingMode mode = CouplingMode::reckon;
  CouplingSide side = CouplingSide::first;
  Counterpart counterpart = Counterpart::server;
  double period = 1e-3;    ///< T [s]
  double damping = 1.0;    ///< sure damping of the own device [N s/m]
  double mass = 0.1;       ///< [kg]
  double impedance = 0.5;  ///< of the transmission line [N s/m]
  double gain = 1.0;       ///< of gain_cut: share of the stiffness that is shown
  bool gate = true;        ///< of reckon: false lets the port hold whatever is wanted
  Environment environment{EnvironmentKind::linear, 500.0};
};

/// @throws std::invalid_argument for numbers out of range
[[nodiscard]] std::unique_ptr<CouplingEnd> make_coupling_end(const CouplingEndConfig& config);

}  // namespace reckon::bench
