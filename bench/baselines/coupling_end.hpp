// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One end of a coupling: computes the force from the own motion and the samples that arrived. One
// object for each end; the ends of a mode share only the samples.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "reckon/bench/baselines/coupling_mode.hpp"
#include "reckon/bench/baselines/coupling_world.hpp"

namespace reckon::bench {

/// The handle at a sample; for a server, the position at which its world begins.
struct OwnMotion {
  std::uint32_t number = 0;  ///< number of the sample, from 0
  double position = 0.0;     ///< [m]
  double velocity = 0.0;     ///< [m/s]
};

/// The sample that is sent, for all modes; each mode uses the members that it needs and leaves the
/// rest 0.
struct CouplingSample {
  std::uint32_t number = 0;  ///< number of the sample at which it was sent
  double position = 0.0;     ///< [m], position of the handle, or of the surface of a model
  double velocity = 0.0;     ///< [m/s]
  double effort = 0.0;       ///< [N], or the wave [sqrt W]
  double stiffness = 0.0;    ///< [N/m], stiffness of the model
  double given = 0.0;        ///< [J], running total: see RemoteHand
  double need = 0.0;         ///< [J]
  double spring_need = 0.0;  ///< [J]

  bool operator==(const CouplingSample&) const = default;
};

/// One end. Single thread; step() and sample() do not allocate or lock.
class CouplingEnd {
 public:
  virtual ~CouplingEnd() = default;

  /// One sample. @param arrived samples since the last call, in order of arrival, which may differ
  /// from the order of sending @returns the force on the own handle [N], held until the next step;
  /// 0 for a server
  virtual double step(const OwnMotion& own, std::span<const CouplingSample> arrived) noexcept = 0;
  /// The sample to send, called after step() if one is due.
  [[nodiscard]] virtual CouplingSample sample() noexcept = 0;
  /// Work that changes of the world did on the touched object [J]; 0 if the end renders no world.
  [[nodiscard]] virtual double world_work() const noexcept { return 0.0; }
  /// Energy lent to its port and not yet repaid [J], see haptics::exchange_energy(); 0 if nothing
  /// is lent.
  [[nodiscard]] virtual double loan() const noexcept { return 0.0; }

 protected:
  CouplingEnd() = default;
  CouplingEnd(const CouplingEnd&) = default;
  CouplingEnd& operator=(const CouplingEnd&) = default;
};

/// The other end of the line, seen from the first hand.
enum class Counterpart : std::uint8_t { server, hand };

/// Which end. The overlap of two hands is the first one's position minus the second one's.
enum class CouplingSide : std::uint8_t { first, second };

/// Settings of an end.
struct CouplingEndConfig {
  CouplingMode mode = CouplingMode::reckon;
  CouplingSide side = CouplingSide::first;
  Counterpart counterpart = Counterpart::server;
  double period = 1e-3;    ///< T [s]
  double damping = 1.0;    ///< guaranteed damping of the own device [N s/m]
  double mass = 0.1;       ///< [kg]
  double impedance = 0.5;  ///< of the transmission line [N s/m]
  double gain = 1.0;       ///< of gain_cut: share of the stiffness that is rendered
  bool gate = true;        ///< of reckon: if false, the port may hold any force
  Environment environment{EnvironmentKind::linear, 500.0};
};

/// @throws std::invalid_argument for numbers out of range
[[nodiscard]] std::unique_ptr<CouplingEnd> make_coupling_end(const CouplingEndConfig& config);

}  // namespace reckon::bench
