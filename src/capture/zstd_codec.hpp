// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// zstd for captures: independent frames (RFC 8878). Private to the peer library.
#pragma once

#include <zstd.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace reckon::peer {

/// Makes zstd frames with checksums. One thread; holds about 4 MiB.
class ZstdCompressor {
 public:
  ZstdCompressor();

  /// Appends the compressed form of `raw` to `out`, flushed so that all of it can be decompressed;
  /// `end_frame` also ends the frame.  @throws std::bad_alloc.
  void compress(std::span<const std::byte> raw, bool end_frame, std::vector<std::byte>& out);
  /// Discards the frame in progress.
  void reset();

 private:
  std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context_;
};

/// Decompresses zstd frames of any origin and number. One thread; a window of 128 MiB limits the
/// memory: frames that need more are refused.
class ZstdDecompressor {
 public:
  ZstdDecompressor();

  /// Decompresses from the front of `in`, which is advanced, into `out`; returns the number of
  /// octets. Never throws: error() has the reason.
  std::size_t decompress(std::span<const std::byte>& in, std::span<std::byte> out) noexcept;
  /// Empty without an error, else the text of libzstd.
  [[nodiscard]] const std::string& error() const noexcept { return error_; }
  /// Whether the octets so far end inside a frame.
  [[nodiscard]] bool inside_frame() const noexcept { return inside_; }
  /// Whole frames so far.
  [[nodiscard]] std::uint64_t frames() const noexcept { return frames_; }

 private:
  std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context_;
  std::size_t step_;  ///< octets up to the end of the next block
  std::string error_;
  bool inside_ = false;
  std::uint64_t frames_ = 0;
};

/// Whether a file with these first octets contains zstd frames.
[[nodiscard]] bool begins_zstd(std::span<const std::byte> octets) noexcept;

}  // namespace reckon::peer
