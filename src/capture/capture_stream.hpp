// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A capture file as a stream: plain, in zstd frames or compressed by another method, a file or a
// pipe. Private to the peer library.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/peer/capture/archive_decompressor.hpp"
#include "reckon/peer/capture/zstd_codec.hpp"

namespace reckon::peer {

/// The octets of a capture. Memory does not grow with its length. One thread; outlives the FILE
/// that it returns.
class CaptureStream {
 public:
  /// Opens a file; "-" is stdin.
  /// @throws std::runtime_error with the path, the reason and the remedy if it is missing, a folder
  /// or empty.
  explicit CaptureStream(const std::string& path);
  ~CaptureStream();
  CaptureStream(const CaptureStream&) = delete;
  CaptureStream& operator=(const CaptureStream&) = delete;

  /// A stream for reading, which the caller closes. Once only.
  [[nodiscard]] std::FILE* open();

  /// The error of the compression at the end of the stream; empty if there is none.
  [[nodiscard]] std::string problem() const;
  /// "zstd", "gzip", "bzip2", "xz" or "lz4"; empty if it is not compressed.
  [[nodiscard]] std::string_view compression() const noexcept;
  [[nodiscard]] bool is_compressed() const noexcept { return !compression().empty(); }
  /// Neither compressed, nor a pipe or a device: the result of open() is seekable.
  [[nodiscard]] bool is_plain_file() const noexcept { return is_plain_file_ && !is_compressed(); }
  /// Whole zstd frames; 0 if the file has none.
  [[nodiscard]] std::uint64_t zstd_frames() const noexcept;
  /// Octets read so far: of the file, and of its decompressed content.
  [[nodiscard]] std::uint64_t octets() const noexcept { return octets_; }
  [[nodiscard]] std::uint64_t content() const noexcept { return content_; }

 private:
  static ssize_t read_cookie(void* cookie, char* to, std::size_t size);
  std::size_t read_as_is(std::span<std::byte> out);
  std::size_t read_zstd(std::span<std::byte> out);
  std::size_t read_content(std::span<std::byte> out);
  std::span<const std::byte> read_buffer();
  std::size_t read_file(std::span<std::byte> out);
  void look_at_head();

  std::string path_;
  std::string name_;  ///< for messages
  int file_;
  bool is_plain_file_{false};  ///< neither a pipe nor a device
  std::unique_ptr<ZstdDecompressor> zstd_;
  std::unique_ptr<ArchiveDecompressor> archive_;
  std::vector<std::byte> buffer_;
  std::span<const std::byte> input_;  ///< of the buffer: read, not returned
  bool at_end_{false};
  int error_{0};  ///< errno of the failed read
  std::uint64_t octets_{0};
  std::uint64_t content_{0};
};

}  // namespace reckon::peer
