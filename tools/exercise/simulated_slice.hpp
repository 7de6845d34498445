// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How much simulated time passes at once where a scene is run for its results.
#pragma once

#include <chrono>

namespace reckon::tools {

/// Results depend on it: everything that runs a scene to its end uses it.
inline constexpr std::chrono::nanoseconds kSimulatedSlice = std::chrono::milliseconds(200);

}  // namespace reckon::tools
