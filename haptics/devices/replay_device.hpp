// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A simulated device whose operator repeats a recorded hand.
#pragma once

#include "reckon/haptics/devices/hand_trace.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"

namespace reckon::haptics {

/// The recorded motion is what the operator wants; what the handle does depends on what it touches,
/// as it did for the person. Starts at the trace's first position.
class ReplayDevice : public SimulatedDevice {
 public:
  ReplayDevice(HandTrace trace, SimulatedDeviceConfig config = {});
};

}  // namespace reckon::haptics
