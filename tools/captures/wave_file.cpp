// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/captures/wave_file.hpp"

#include <array>
#include <bit>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {
namespace {

// Layout of the file.
struct WaveHeader {
  std::array<char, 4> riff{'R', 'I', 'F', 'F'};
  std::uint32_t octets_behind;
  std::array<char, 8> wave{'W', 'A', 'V', 'E', 'f', 'm', 't', ' '};
  std::uint32_t format_octets = 16;
  std::uint16_t format = 1, channels = 1;  // PCM
  std::uint32_t rate, octets_per_s;
  std::uint16_t sample_octets = 2, sample_bits = 16;
  std::array<char, 4> data{'d', 'a', 't', 'a'};
  std::uint32_t data_octets;
};
static_assert(sizeof(WaveHeader) == WaveFile::kHeader);
static_assert(std::endian::native == std::endian::little, "files of this format are little endian");

}  // namespace

WaveFile::WaveFile(const std::string& path, bool overwrite, std::uint32_t rate)
    : path_(path), rate_(rate), file_(std::fopen(path.c_str(), overwrite ? "wb" : "wbx")) {
  if (!file_ && errno == EEXIST)
    throw UsageError(path_ + " exists; choose another name, or --force to overwrite it");
  if (!file_) throw UsageError(path_ + " cannot be written; name a file in a writable folder");
  write_header();
}

WaveFile::~WaveFile() {
  if (!file_) return;
  std::error_code ignored;
  if (std::filesystem::is_regular_file(std::filesystem::symlink_status(path_, ignored)))
    std::filesystem::remove(path_, ignored);
}

void WaveFile::check(bool good) const {
  if (!good) throw EnvironmentError(path_ + ": could not be written completely; is the disk full?");
}

void WaveFile::write_header() {
  const auto octets = static_cast<std::uint32_t>(2 * samples_);
  const WaveHeader header{.octets_behind = octets + std::uint32_t{kHeader - 8},
                          .rate = rate_,
                          .octets_per_s = 2 * rate_,
                          .data_octets = octets};
  check(std::fwrite(&header, sizeof header, 1, file_.get()) == 1);
}

void WaveFile::write(std::uint64_t silence, std::span<const std::int16_t> samples) {
  if (silence > 0) check(fseeko(file_.get(), static_cast<off_t>(2 * silence), SEEK_CUR) == 0);
  check(std::fwrite(samples.data(), 2, samples.size(), file_.get()) == samples.size());
  samples_ += silence + samples.size();
}

void WaveFile::finish() {
  std::rewind(file_.get());
  write_header();
  check(std::fflush(file_.get()) == 0);
  file_.reset();
}

}  // namespace reckon::tools
