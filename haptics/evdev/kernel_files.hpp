// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Shared access to device files: their numbers, their sysfs entries and system calls on them.
#pragma once

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/haptics/evdev/event_calls.hpp"

namespace reckon::haptics {

/// Repeats a call that a signal interrupted. @return its result, or -errno
auto kernel_call(auto call) noexcept {
  while (true) {
    const auto result = call();
    if (result >= 0) return result;
    if (errno != EINTR) return static_cast<decltype(result)>(-errno);
  }
}

/// Files of a folder whose names are `prefix` and a number, in order of the numbers.
[[nodiscard]] std::vector<std::string> numbered_files(const std::string& folder,
                                                      std::string_view prefix);

/// First line of a file after leading white space; empty: unreadable.
[[nodiscard]] std::string first_line(const std::filesystem::path& file);

/// Report intervals of a USB interface, from the endpoints in its sysfs folder.
[[nodiscard]] ReportIntervals intervals_of(const std::filesystem::path& interface);

/// Waits until a file is readable, at most `longest`. @param file negative: waits `longest`
void wait_for(int file, std::chrono::microseconds longest) noexcept;

}  // namespace reckon::haptics
