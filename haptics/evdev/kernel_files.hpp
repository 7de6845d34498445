// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the kernel's files of devices have in common: their numbers, what it tells of them, and the
// calls on them.
#pragma once

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/haptics/evdev/event_calls.hpp"

namespace reckon::haptics {

/// A call again where a signal interrupted it. @return its result, or -errno
template <class Call>
auto kernel_call(Call call) noexcept {
  while (true) {
    const auto result = call();
    if (result >= 0) return result;
    if (errno != EINTR) return static_cast<decltype(result)>(-errno);
  }
}

/// Files of a folder whose names are `prefix` and a number, by their numbers.
[[nodiscard]] std::vector<std::string> numbered_files(const std::string& folder,
                                                      std::string_view prefix);

/// Empty: there is none.
[[nodiscard]] std::string first_line(const std::filesystem::path& file);

/// Of an interface of USB, by the endpoints that its folder lists.
[[nodiscard]] ReportIntervals intervals_of(const std::filesystem::path& interface);

/// Until a file has something to read; so long at most. @param file negative: of none
void wait_for(int file, std::chrono::microseconds longest) noexcept;

}  // namespace reckon::haptics
