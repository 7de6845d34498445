// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon devices measure` of a real device: the person is asked, the handle is pushed, any of them
// may stop it.
#pragma once

#include <string>
#include <vector>

#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/measurement/device_measurement.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/exercise/real_devices.hpp"

namespace reckon::tools {

/// What is asked for.
struct RealMeasuring {
  DeviceChoice choice;     ///< as of --device, not empty
  std::string max_force;   ///< --max-force, of a serial board; empty: as its driver assumes
  bool is_agreed = false;  ///< --yes: nobody is asked
  int keys = 0;            ///< descriptor of the person's keys, stdin
};

/// Opens the device, waits until it is ready, tells what will happen and asks, pushes it at 1 kHz
/// from a servo thread, and gives its descriptor. Sentences go to console.err. A key, Ctrl-C,
/// SIGUSR1 and each surprise end it without a force.
/// @throws UsageError for a device that cannot be measured, or where nobody can be asked;
/// EnvironmentError where it was ended, with the reason and the remedy
[[nodiscard]] std::string measure_real(const RealMeasuring& wanted, const Console& console);

/// What the person reads before anything moves. @param asks whether Enter is waited for
[[nodiscard]] std::string warning_of(const haptics::DeviceLimits& limits, bool asks);

/// What was relied on so far, and what a servo may rely on from now on.
struct MeasuredChain {
  haptics::MeasuredDevice found;
  haptics::DeviceLimits limits;  ///< that its driver gave
  double period = 1e-3;          ///< [s], of the servo
  int needed_delay = 0;          ///< see haptics::UsbDevice::needed_delay; 0: it has no such chain
};

/// The delay to state [s]: of a chain with reports what these need, and what motors lag behind
/// them, which is what pushes found beyond the delay that was stated. Half a period of that is
/// error.
[[nodiscard]] double delay_to_state(const MeasuredChain& chain);
/// Lines for a descriptor: what was assumed beside what was measured.
[[nodiscard]] std::vector<std::string> remarks_of(const MeasuredChain& chain);

}  // namespace reckon::tools
