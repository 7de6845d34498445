// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Memory and calls that ODE requests from its host in a step, without allocation.
#pragma once

#define dDOUBLE
#include <ode/ode.h>

#include <memory>

namespace reckon::haptics {

/// Memory and calls of one ODE world. The world steps in the caller's thread, in memory that is
/// reused from step to step. ODE alone allocates 12 to 90 times a step, and not through its
/// allocation hook. Any thread may step and destroy the world, one at a time.
class StepHost {
 public:
  StepHost();
  ~StepHost();
  StepHost(const StepHost&) = delete;
  StepHost& operator=(const StepHost&) = delete;

  /// Only this host steps `world`, and outlives it. Call before the first step.
  void serve(dWorldID world);

  /// dWorldStep(), dWorldQuickStep().
  void step(dWorldID world, double dt) noexcept;
  void quick_step(dWorldID world, double dt) noexcept;

 private:
  struct Store;
  std::unique_ptr<Store> store_;
};

}  // namespace reckon::haptics
