// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Times of the simulated leaders that differ from the defaults: shorter, so that much happens in a
// run.
#pragma once

#include <chrono>

namespace reckon::fuzz::leaders {

inline constexpr std::chrono::nanoseconds kQuarantine = std::chrono::seconds(6);
inline constexpr std::chrono::nanoseconds kLease = std::chrono::milliseconds(3500);
inline constexpr std::chrono::nanoseconds kRefresh = std::chrono::seconds(1);
inline constexpr std::chrono::nanoseconds kSettle = std::chrono::milliseconds(1500);
inline constexpr std::chrono::nanoseconds kEmpty = std::chrono::seconds(2);

}  // namespace reckon::fuzz::leaders
