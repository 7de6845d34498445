// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A capture file as a stream for libpcap: plain or in zstd frames, a file or a pipe. Private to the
// peer library.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "reckon/peer/capture/zstd_codec.hpp"

namespace reckon::peer {

/// The octets of a capture. Memory does not grow with its length. One thread; outlives the FILE
/// that it gives.
class CaptureStream {
 public:
  /// Opens a file; "-" is stdin. @throws std::runtime_error with the path, the reason and the
  /// remedy where it is missing, a folder, empty, or compressed by something else.
  explicit CaptureStream(const std::string& path);
  ~CaptureStream();
  CaptureStream(const CaptureStream&) = delete;
  CaptureStream& operator=(const CaptureStream&) = delete;

  /// A stream to read from, which is the caller's to close. Once only.
  [[nodiscard]] std::FILE* open();

  /// What is wrong with the compression at the place where the stream ended; empty where nothing
  /// is.
  [[nodiscard]] std::string problem() const;
  [[nodiscard]] bool is_compressed() const noexcept { return zstd_ != nullptr; }
  /// Neither compressed, nor a pipe or a device: what open() gives can be sought in.
  [[nodiscard]] bool is_plain_file() const noexcept { return is_plain_file_ && !zstd_; }
  /// zstd frames that were whole; 0 where the file is not compressed.
  [[nodiscard]] std::uint64_t zstd_frames() const noexcept;
  /// Octets read so far, of the file and of what it holds.
  [[nodiscard]] std::uint64_t octets() const noexcept { return octets_; }
  [[nodiscard]] std::uint64_t content() const noexcept { return content_; }

 private:
  static ssize_t read_cookie(void* cookie, char* to, std::size_t size);
  std::size_t read_as_is(std::span<std::byte> out);
  std::size_t read_zstd(std::span<std::byte> out);
  std::size_t read_file(std::span<std::byte> out);
  void look_at_head();

  std::string path_;
  std::string name_;  ///< for people
  int file_;
  bool is_plain_file_{false};  ///< neither a pipe nor a device
  std::unique_ptr<ZstdDecompressor> zstd_;
  std::vector<std::byte> buffer_;
  std::span<const std::byte> input_;  ///< of the buffer: read, not handed out
  bool at_end_{false};
  int error_{0};  ///< errno of the read that failed
  std::uint64_t octets_{0};
  std::uint64_t content_{0};
};

}  // namespace reckon::peer
