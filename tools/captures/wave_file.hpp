// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Writes sound to a WAV file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>

namespace reckon::tools {

/// A WAV file in progress: PCM of 16 bits, one channel. An unfinished file is removed.
class WaveFile {
 public:
  static constexpr std::size_t kHeader = 44;  ///< [octets] before the samples
  /// Limit by the 32-bit lengths of the format.
  static constexpr std::uint64_t kMostSamples = (0xFFFFFFFFU - (kHeader - 8)) / 2;

  /// Creates the file. @throws UsageError if that fails, or it exists and may not be overwritten.
  /// @param rate samples a second
  WaveFile(const std::string& path, bool overwrite, std::uint32_t rate);
  ~WaveFile();
  WaveFile(const WaveFile&) = delete;
  WaveFile& operator=(const WaveFile&) = delete;

  /// Appends zeros, which take no room on most disks, and then samples; kMostSamples in all.
  /// @throws EnvironmentError on a full disk
  void write(std::uint64_t silence, std::span<const std::int16_t> samples);
  /// Completes the file. @throws EnvironmentError on a full disk
  void finish();

  [[nodiscard]] std::uint64_t samples() const noexcept { return samples_; }

 private:
  void write_header();
  void check(bool good) const;

  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };
  std::string path_;
  std::uint32_t rate_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uint64_t samples_ = 0;
};

}  // namespace reckon::tools
