// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/evdev/event_calls.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

namespace reckon::haptics {
namespace {

constexpr std::string_view kEvent = "event";

// A call again where a signal interrupted it. @return its result, or -errno
template <class Call>
auto made(Call call) noexcept {
  while (true) {
    const auto result = call();
    if (result >= 0) return result;
    if (errno != EINTR) return static_cast<decltype(result)>(-errno);
  }
}

std::string first_line(const std::filesystem::path& file) {
  std::string line;
  std::getline(std::ifstream(file) >> std::ws, line);
  return line;
}

// As the kernel writes it: "1ms", "125us". 0: it is none.
std::chrono::microseconds interval_of(const std::string& text) {
  long number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string_view unit(read.ptr, text.data() + text.size());
  if (read.ec != std::errc() || number <= 0 || number > 10'000) return {};
  if (unit == "us") return std::chrono::microseconds(number);
  return unit == "ms" ? std::chrono::milliseconds(number) : std::chrono::milliseconds(0);
}

class KernelCalls final : public EventCalls {
 public:
  KernelCalls(std::string devices, std::string facts)
      : devices_(std::move(devices)), facts_(std::move(facts)) {}

  std::vector<std::string> paths() override {
    std::vector<std::pair<int, std::string>> found;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(devices_, none)) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with(kEvent)) continue;
      int number = 0;
      const char* const end = name.data() + name.size();
      const auto read = std::from_chars(name.data() + kEvent.size(), end, number);
      if (read.ec == std::errc() && read.ptr == end)
        found.emplace_back(number, entry.path().string());
    }
    std::ranges::sort(found);
    std::vector<std::string> out;
    for (auto& [number, path] : found) out.push_back(std::move(path));
    return out;
  }
  // The bits of its effects are words of hexadecimal digits.
  std::string closed_name(const std::string& path) override {
    const auto of =
        std::filesystem::path(facts_) / std::filesystem::path(path).filename() / "device";
    const std::string effects = first_line(of / "capabilities" / "ff");
    return effects.find_first_not_of("0 ") == std::string::npos ? "" : first_line(of / "name");
  }
  // The input device is of a device of HID, and that is of an interface of USB, which lists its
  // endpoints.
  std::chrono::microseconds report_interval(const std::string& path) override {
    const auto of = std::filesystem::path(facts_) / std::filesystem::path(path).filename() /
                    "device" / "device" / "..";
    std::error_code none;
    // It may be unplugged meanwhile.
    for (std::filesystem::directory_iterator each(of, none), end; each != end;
         each.increment(none)) {
      const auto& place = each->path();
      if (place.filename().string().starts_with("ep_") && first_line(place / "direction") == "out")
        return interval_of(first_line(place / "interval"));
    }
    return {};
  }
  int open(const std::string& path) override {
    return made([&] { return ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC); });
  }
  void close(int file) noexcept override { ::close(file); }
  int control(int file, unsigned long request, void* argument) noexcept override {
    return made([&] { return ::ioctl(file, request, argument); });
  }
  // The kernel gives whole events. Less is no event.
  int read(int file, std::span<input_event> events) noexcept override {
    const auto octets = made([&] { return ::read(file, events.data(), events.size_bytes()); });
    if (octets < 0) return static_cast<int>(octets);
    if (octets == 0) return -ENODEV;
    return octets % sizeof(input_event) == 0 ? static_cast<int>(octets / sizeof(input_event))
                                             : -EIO;
  }
  int write(int file, const input_event& event) noexcept override {
    const auto octets = made([&] { return ::write(file, &event, sizeof event); });
    if (octets < 0) return static_cast<int>(octets);
    return octets == sizeof event ? 0 : -EIO;
  }
  void wait(int file, std::chrono::microseconds longest) noexcept override {
    pollfd one{file, POLLIN, 0};
    const auto time = std::chrono::nanoseconds(longest).count();
    const timespec most{time / 1'000'000'000, time % 1'000'000'000};
    ::ppoll(&one, 1, &most, nullptr);
  }

 private:
  std::string devices_, facts_;
};

}  // namespace

std::unique_ptr<EventCalls> kernel_event_calls(const std::string& devices,
                                               const std::string& facts) {
  return std::make_unique<KernelCalls>(devices, facts);
}

}  // namespace reckon::haptics
