// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reads a file that a scene, a descriptor or an option names. Set-up code.
//
//   const std::string text = read_input_file("scenes/two_hands.toml", 16 << 20);
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace reckon::haptics {

/// A regular file, open for reading. A folder, device, pipe or socket is refused, and no call waits
/// for data. It ends at its size at the opening: a file of /proc has size 0 and is empty.
class InputFile {
 public:
  /// Starts the time of LoadProgress for this file, and charges its octets to LoadBudget.
  /// @throws std::invalid_argument without the file's name: it cannot be opened, is no regular
  /// file, or has more than `most_octets`
  InputFile(const std::filesystem::path& file, std::size_t most_octets);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  [[nodiscard]] std::size_t octets() const noexcept { return octets_; }
  /// Fills as much of `room` as the file has left. @return octets read; 0 at the end
  /// @throws std::invalid_argument when the file cannot be read on
  [[nodiscard]] std::size_t read(std::span<char> room);

 private:
  int descriptor_;
  std::size_t octets_ = 0, left_ = 0;
};

/// Bounds of one file [octets].
inline constexpr std::size_t kMostMeshOctets = 256 << 20, kMostTableOctets = 128 << 20;

/// The whole content. @throws std::invalid_argument as InputFile
[[nodiscard]] std::string read_input_file(const std::filesystem::path& file,
                                          std::size_t most_octets);

}  // namespace reckon::haptics
