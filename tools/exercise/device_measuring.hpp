// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon devices measure`: from a run of pushes to a descriptor.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/measurement/device_measurement.hpp"
#include "reckon/peer/scene/device_descriptor.hpp"

namespace reckon::tools {

/// A simulated device of a descriptor, at 1 kHz, that nobody holds.
[[nodiscard]] haptics::SimulatedDeviceConfig free_device_of(const peer::DeviceDescriptor& device);

/// What kept it from being measured, and the remedy; empty for `none`.
[[nodiscard]] std::string_view sentence_of(haptics::MeasurementProblem problem) noexcept;

/// Pushes a simulated device of `device` to the end, in no time. @throws std::runtime_error with
/// the reason where it cannot be measured
[[nodiscard]] haptics::MeasuredDevice measure_simulated(const peer::DeviceDescriptor& device);

/// The text of a descriptor: what was measured, and of the rest what `known` says. @param remarks
/// lines that it begins with
[[nodiscard]] std::string descriptor_text(std::string_view name,
                                          const peer::DeviceDescriptor& known,
                                          const haptics::MeasuredDevice& found,
                                          const std::vector<std::string>& remarks = {});

}  // namespace reckon::tools
