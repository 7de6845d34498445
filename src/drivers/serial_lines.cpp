// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/drivers/serial_lines.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <system_error>

namespace reckon::peer {
namespace {

namespace fs = std::filesystem;

std::string name_of_process(const fs::path& process) {
  std::string name;
  std::getline(std::ifstream(process / "comm"), name);
  return name;
}

bool has_open(const fs::path& process, const fs::path& line) {
  std::error_code error;
  for (fs::directory_iterator file(process / "fd", error), end; !error && file != end;
       file.increment(error)) {
    std::error_code gone;
    if (fs::read_symlink(*file, gone) == line) return true;
  }
  return false;
}

// @return name and number of a process that has the port open, among the processes visible to this
// user; empty: none
std::string user_of(const fs::path& line) {
  std::error_code error;
  for (fs::directory_iterator process("/proc", error), end; !error && process != end;
       process.increment(error)) {
    const std::string number = process->path().filename().string();
    const bool is_process =
        std::ranges::all_of(number, [](unsigned char c) { return std::isdigit(c) != 0; });
    if (is_process && has_open(process->path(), line))
      return fmt::format("{}, process {}", name_of_process(process->path()), number);
  }
  return {};
}

AttachedDevice line_at(const fs::path& named) {
  std::error_code error;
  const fs::path line = fs::canonical(named, error);
  AttachedDevice device;
  device.driver = "serial";
  device.name = fmt::format("{}, {}", named.filename().string(), line.string());
  device.use = fmt::format("if it is a board as in docs/devices.md: reckon demo --device {}",
                           named.string());
  if (error) {
    device.problem = "its link leads to no device: " + error.message();
    device.remedy = "plug it in again";
  } else if (access(line.c_str(), R_OK | W_OK) != 0) {
    device.problem = "this user may not open it";
    device.remedy = "sudo usermod -aG dialout $USER, and log in again";
  } else if (const std::string user = user_of(line); !user.empty()) {
    device.problem = "another program uses it: " + user;
    device.remedy = "end that program, for instance a serial monitor";
  }
  return device;
}

}  // namespace

std::vector<AttachedDevice> look_at_serial_lines(const fs::path& folder) {
  std::vector<AttachedDevice> lines;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    lines.push_back(line_at(entry->path()));
  std::ranges::sort(lines, {}, &AttachedDevice::name);
  return lines;
}

}  // namespace reckon::peer
