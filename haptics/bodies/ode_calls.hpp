// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What ODE asks of its host while it steps, without allocation: memory and calls.
#pragma once

#define dDOUBLE
#include <ode/ode.h>

#include <memory>

namespace reckon::haptics {

/// Memory and calls of one ODE world. The world steps in the caller's thread and in memory that is
/// kept from step to step: ODE's own ways allocate 12 to 90 times a step, and not through the hook
/// that it has for that. Every thread may step and destroy the world, one at a time.
class StepHost {
 public:
  StepHost();
  ~StepHost();
  StepHost(const StepHost&) = delete;
  StepHost& operator=(const StepHost&) = delete;

  /// `world` is stepped by this host alone, which outlives it. Before the first step.
  void serve(dWorldID world);

  /// dWorldStep(), dWorldQuickStep().
  void step(dWorldID world, double dt) noexcept;
  void quick_step(dWorldID world, double dt) noexcept;

 private:
  struct Store;
  std::unique_ptr<Store> store_;
};

}  // namespace reckon::haptics
