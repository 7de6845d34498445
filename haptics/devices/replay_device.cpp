// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/devices/replay_device.hpp"

#include <utility>

namespace reckon::haptics {
namespace {

SimulatedDeviceConfig starting_on(const HandTrace& trace, SimulatedDeviceConfig config) {
  config.start = trace.at(0.0).position;
  return config;
}

}  // namespace

ReplayDevice::ReplayDevice(HandTrace trace, SimulatedDeviceConfig config)
    : SimulatedDevice(starting_on(trace, config), [trace](double time) { return trace.at(time); }) {
}

}  // namespace reckon::haptics
