// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/input_files/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "reckon/haptics/input_files/load_budget.hpp"
#include "reckon/haptics/input_files/load_progress.hpp"

namespace reckon::haptics {
namespace {

constexpr std::size_t kMebi = 1 << 20;

// Without waiting for a writer of a pipe, or for data of a device.
int open_to_read(const std::filesystem::path& file) noexcept {
  return ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
}

std::string refusal(int descriptor, const struct stat& state, std::size_t most_octets) {
  if (descriptor < 0) return std::strerror(errno);
  if (S_ISDIR(state.st_mode)) return "is a folder; name a file in it";
  if (!S_ISREG(state.st_mode))
    return "is a device, a pipe or a socket; name a regular file, or write the data to one";
  if (static_cast<std::size_t>(state.st_size) > most_octets)
    return "has more than " + std::to_string(most_octets / kMebi) + " MiB; give a smaller file";
  return {};
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& file, std::size_t most_octets)
    : descriptor_(open_to_read(file)) {
  struct stat state {};
  if (descriptor_ >= 0 && ::fstat(descriptor_, &state) != 0) state = {};
  std::string why = refusal(descriptor_, state, most_octets);
  try {
    if (!why.empty()) throw std::invalid_argument(why);
    octets_ = left_ = static_cast<std::size_t>(state.st_size);
    LoadBudget::take(LoadWork::octets, octets_);
  } catch (...) {
    if (descriptor_ >= 0) ::close(descriptor_);
    throw;
  }
  LoadProgress::begin(file);
}

InputFile::~InputFile() { ::close(descriptor_); }

std::size_t InputFile::read(std::span<char> room) {
  const std::size_t wanted = std::min(room.size(), left_);
  ssize_t got = 0;
  do {
    got = ::read(descriptor_, room.data(), wanted);
  } while (got < 0 && errno == EINTR);
  if (got < 0) throw std::invalid_argument(std::string("cannot be read: ") + std::strerror(errno));
  left_ -= static_cast<std::size_t>(got);
  return static_cast<std::size_t>(got);
}

std::string read_input_file(const std::filesystem::path& file, std::size_t most_octets) {
  InputFile input(file, most_octets);
  std::string bytes(input.octets(), '\0');
  std::size_t filled = 0;
  while (const std::size_t got = input.read(std::span(bytes).subspan(filled))) filled += got;
  bytes.resize(filled);
  return bytes;
}

}  // namespace reckon::haptics
