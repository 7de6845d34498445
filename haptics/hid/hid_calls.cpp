// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/hid/hid_calls.hpp"

#include <fcntl.h>
#include <linux/hidraw.h>
#include <linux/input.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include "reckon/haptics/evdev/kernel_files.hpp"

namespace reckon::haptics {
namespace {

using std::filesystem::path;

constexpr std::size_t kMostDescriptor = HID_MAX_DESCRIPTOR_SIZE;

std::vector<std::uint8_t> octets_of(const path& file) {
  std::vector<std::uint8_t> octets(kMostDescriptor);
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(octets.data()), static_cast<std::streamsize>(octets.size()));
  octets.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return octets;
}

// Part 0 .. 2 of "bus:vendor:product", hexadecimal, up to eight digits each.
std::uint16_t number_of(std::string_view id, std::size_t part) {
  for (; part > 0 && id.find(':') != id.npos; --part) id.remove_prefix(id.find(':') + 1);
  id = id.substr(0, id.find(':'));
  std::uint32_t number = 0;
  std::from_chars(id.data(), id.data() + id.size(), number, 16);
  return static_cast<std::uint16_t>(number);
}

// Tests a bit of a bitmap in sysfs: hexadecimal words, the lowest bits last.
bool has_bit(std::string_view words, unsigned bit) {
  constexpr unsigned kWord = 8 * sizeof(long);
  for (; bit >= kWord; bit -= kWord) {
    const auto space = words.rfind(' ');
    if (space == words.npos) return false;
    words = words.substr(0, space);
  }
  if (const auto space = words.rfind(' '); space != words.npos) words.remove_prefix(space + 1);
  unsigned long word = 0;
  std::from_chars(words.data(), words.data() + words.size(), word, 16);
  return (word >> bit & 1U) != 0;
}

bool has_springs(const path& inputs) {
  std::error_code none;
  for (std::filesystem::directory_iterator each(inputs, none), end; each != end;
       each.increment(none)) {
    if (has_bit(first_line(each->path() / "capabilities" / "ff"), FF_SPRING)) return true;
  }
  return false;
}

// An unplugged device fails with ESHUTDOWN until its file is gone.
int result_of(long result) noexcept {
  return result == -ESHUTDOWN ? -ENODEV : static_cast<int>(result);
}

class KernelHidCalls final : public HidCalls {
 public:
  KernelHidCalls(std::string devices, std::string facts)
      : devices_(std::move(devices)), facts_(std::move(facts)) {}

  std::vector<std::string> paths() override { return numbered_files(devices_, "hidraw"); }
  HidSeen look(const std::string& file) override {
    const path of = facts_ / path(file).filename() / "device";
    HidSeen seen;
    seen.descriptor = octets_of(of / "report_descriptor");
    seen.kernel_has_springs = has_springs(of / "input");
    std::ifstream uevent(of / "uevent");
    for (std::string line; std::getline(uevent, line);) {
      constexpr std::string_view kName = "HID_NAME=", kId = "HID_ID=";
      if (line.starts_with(kName)) seen.name = line.substr(kName.size());
      if (!line.starts_with(kId)) continue;
      const std::string_view id = std::string_view(line).substr(kId.size());
      seen.vendor = number_of(id, 1);
      seen.product = number_of(id, 2);
    }
    return seen;
  }
  // The parent of a HID device is its USB interface.
  ReportIntervals report_intervals(const std::string& file) override {
    return intervals_of(facts_ / path(file).filename() / "device" / "..");
  }
  int open(const std::string& file) override {
    return kernel_call([&] { return ::open(file.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC); });
  }
  void close(int file) noexcept override { ::close(file); }
  int take(int file) noexcept override {
    const int result = kernel_call([&] { return ::flock(file, LOCK_EX | LOCK_NB); });
    return result == -EWOULDBLOCK ? -EBUSY : result;
  }
  bool is_there(int file) noexcept override {
    hidraw_devinfo info{};
    return kernel_call([&] { return ::ioctl(file, HIDIOCGRAWINFO, &info); }) >= 0;
  }
  int read(int file, std::span<std::uint8_t> report) noexcept override {
    const auto octets = kernel_call([&] { return ::read(file, report.data(), report.size()); });
    return octets == 0 ? -ENODEV : result_of(octets);
  }
  int write(int file, std::span<const std::uint8_t> report) noexcept override {
    const auto octets = kernel_call([&] { return ::write(file, report.data(), report.size()); });
    return octets < 0 ? result_of(octets) : 0;
  }
  int set_feature(int file, std::span<const std::uint8_t> report) noexcept override {
    auto* const octets = const_cast<std::uint8_t*>(report.data());  // it is only read
    const int result =
        kernel_call([&] { return ::ioctl(file, HIDIOCSFEATURE(report.size()), octets); });
    return result < 0 ? result_of(result) : 0;
  }
  int get_feature(int file, std::span<std::uint8_t> report) noexcept override {
    return result_of(
        kernel_call([&] { return ::ioctl(file, HIDIOCGFEATURE(report.size()), report.data()); }));
  }
  int get_input(int file, std::span<std::uint8_t> report) noexcept override {
    return result_of(
        kernel_call([&] { return ::ioctl(file, HIDIOCGINPUT(report.size()), report.data()); }));
  }
  void wait(int file, std::chrono::microseconds longest) noexcept override {
    wait_for(file, longest);
  }

 private:
  path devices_, facts_;
};

}  // namespace

std::unique_ptr<HidCalls> kernel_hid_calls(const std::string& devices, const std::string& facts) {
  return std::make_unique<KernelHidCalls>(devices, facts);
}

}  // namespace reckon::haptics
