// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A device with faults for tests that keep an account of its energy.
#pragma once

#include <chrono>
#include <random>

#include "reckon/haptics/devices/simulated_device.hpp"

namespace reckon::haptics::faults {

/// One reading in `rate` fails; none does if that is 0.
class FlakyDevice : public SimulatedDevice {
 public:
  using SimulatedDevice::SimulatedDevice;
  DeviceSample read(std::chrono::nanoseconds now) noexcept override {
    DeviceSample sample = SimulatedDevice::read(now);
    sample.ok = rate == 0 || random() % rate != 0;
    return sample;
  }

  std::mt19937 random{1};
  unsigned rate = 0;
};

/// Draws limits of a device: little strength, a delay, encoder steps, released forces.
inline void weaken(SimulatedDeviceConfig& config, std::mt19937& random) {
  std::uniform_real_distribution<double> any(0.0, 1.0);
  config.max_force = random() % 2 == 0 ? 0.5 + 2 * any(random) : 30.0;
  config.delay_samples = random() % 4 == 0 ? 1 : 0;
  config.resolution = random() % 4 == 0 ? 1e-5 : 0.0;
  if (random() % 3 == 0) config.hold = std::chrono::microseconds(1500);
}

}  // namespace reckon::haptics::faults
