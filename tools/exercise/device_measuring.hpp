// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon devices measure`: makes a device descriptor from a series of pushes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/measurement/device_measurement.hpp"
#include "reckon/peer/scene/device_descriptor.hpp"

namespace reckon::tools {

/// A simulated device by its descriptor, at 1 kHz, with no hand on it.
[[nodiscard]] haptics::SimulatedDeviceConfig free_device_of(const peer::DeviceDescriptor& device);

/// Why the device could not be measured, and the remedy; empty for `none`.
[[nodiscard]] std::string_view sentence_of(haptics::MeasurementProblem problem) noexcept;

/// Measures a simulated device of `device` in simulated time. @throws std::runtime_error with the
/// reason if it cannot be measured
[[nodiscard]] haptics::MeasuredDevice measure_simulated(const peer::DeviceDescriptor& device);

/// The text of a descriptor: the measured values, and all others from `known`. @param remarks
/// comment lines at its begin
[[nodiscard]] std::string descriptor_text(std::string_view name,
                                          const peer::DeviceDescriptor& known,
                                          const haptics::MeasuredDevice& found,
                                          const std::vector<std::string>& remarks = {});

}  // namespace reckon::tools
