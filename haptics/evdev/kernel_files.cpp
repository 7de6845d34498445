// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/evdev/kernel_files.hpp"

#include <poll.h>

#include <algorithm>
#include <charconv>
#include <ctime>
#include <fstream>
#include <system_error>
#include <utility>

namespace reckon::haptics {
namespace {

// Parses an interval of sysfs, "1ms" or "125us". 0: malformed, or above 10,000.
std::chrono::microseconds interval_of(const std::string& text) {
  long number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string_view unit(read.ptr, text.data() + text.size());
  if (read.ec != std::errc() || number <= 0 || number > 10'000) return {};
  if (unit == "us") return std::chrono::microseconds(number);
  return unit == "ms" ? std::chrono::milliseconds(number) : std::chrono::milliseconds(0);
}

}  // namespace

std::vector<std::string> numbered_files(const std::string& folder, std::string_view prefix) {
  std::vector<std::pair<int, std::string>> found;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix)) continue;
    int number = 0;
    const char* const end = name.data() + name.size();
    const auto read = std::from_chars(name.data() + prefix.size(), end, number);
    if (read.ec == std::errc() && read.ptr == end)
      found.emplace_back(number, entry.path().string());
  }
  std::ranges::sort(found);
  std::vector<std::string> out;
  for (auto& [number, path] : found) out.push_back(std::move(path));
  return out;
}

std::string first_line(const std::filesystem::path& file) {
  std::string line;
  std::getline(std::ifstream(file) >> std::ws, line);
  return line;
}

ReportIntervals intervals_of(const std::filesystem::path& interface) {
  ReportIntervals found;
  std::error_code none;
  // It may be unplugged meanwhile.
  for (std::filesystem::directory_iterator each(interface, none), end; each != end;
       each.increment(none)) {
    const auto& place = each->path();
    if (!place.filename().string().starts_with("ep_")) continue;
    const std::string direction = first_line(place / "direction");
    if (direction == "out") found.takes = interval_of(first_line(place / "interval"));
    if (direction == "in") found.sends = interval_of(first_line(place / "interval"));
  }
  return found;
}

void wait_for(int file, std::chrono::microseconds longest) noexcept {
  pollfd one{file, POLLIN, 0};
  const auto time = std::chrono::nanoseconds(longest).count();
  const timespec most{time / 1'000'000'000, time % 1'000'000'000};
  ::ppoll(&one, 1, &most, nullptr);
}

}  // namespace reckon::haptics
