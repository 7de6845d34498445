// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon devices measure` with a real device: asks the user, pushes the handle; a key or a signal
// stops it.
#pragma once

#include <string>
#include <vector>

#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/measurement/device_measurement.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/exercise/real_devices.hpp"

namespace reckon::tools {

/// Options of a measurement.
struct RealMeasuring {
  DeviceChoice choice;     ///< as for --device, not empty
  std::string max_force;   ///< --max-force, for a serial board; empty: the driver's default
  bool is_agreed = false;  ///< --yes: do not ask
  int keys = 0;            ///< descriptor of the user's keys, stdin
};

/// Opens the device, waits until it is ready, warns and asks the user, pushes the device at 1 kHz
/// from a servo thread, and returns its descriptor. Messages go to console.err. A key, Ctrl-C,
/// SIGUSR1 or a fault ends it with zero force.
/// @throws UsageError for a device that cannot be measured, or if the user cannot be asked;
/// EnvironmentError if it was ended, with the reason and the remedy
[[nodiscard]] std::string measure_real(const RealMeasuring& wanted, const Console& console);

/// The warning before anything moves. @param asks whether Enter is required
[[nodiscard]] std::string warning_of(const haptics::DeviceLimits& limits, bool asks);

/// The limits used so far, and the measured ones.
struct MeasuredChain {
  haptics::MeasuredDevice found;
  haptics::DeviceLimits limits;  ///< given by its driver
  double period = 1e-3;          ///< [s], of the servo
  int needed_delay = 0;          ///< see haptics::UsbDevice::needed_delay; 0: it sends no
                                 ///< reports
};

/// The delay to declare [s]. For a device with reports: the delay that the reports need, plus the
/// lag of the motors behind them, which is the measured delay beyond the declared one. Lags up to
/// half a period are treated as error.
[[nodiscard]] double delay_to_state(const MeasuredChain& chain);
/// Comment lines for a descriptor: assumed values and measured ones.
[[nodiscard]] std::vector<std::string> remarks_of(const MeasuredChain& chain);

}  // namespace reckon::tools
