// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Step of simulated time in runs whose results are evaluated.
#pragma once

#include <chrono>

namespace reckon::tools {

/// Results depend on it: every complete run of a scene uses it.
inline constexpr std::chrono::nanoseconds kSimulatedSlice = std::chrono::milliseconds(200);

}  // namespace reckon::tools
