// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// zstd as captures use it: frames (RFC 8878) that do not depend on each other. Private to the peer
// library.
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

  /// Appends to `out` what stands for `raw`, so that all of it can be decompressed at once;
  /// `end_frame` also ends the frame. @throws std::bad_alloc.
  void compress(std::span<const std::byte> raw, bool end_frame, std::vector<std::byte>& out);
  /// Forgets the frame that was begun.
  void reset();

 private:
  std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context_;
};

/// Takes zstd frames apart, of any origin and in any number. One thread; memory is bounded by a
/// window of 128 MiB: frames that ask for more are refused.
class ZstdDecompressor {
 public:
  ZstdDecompressor();

  /// Decompresses from the front of `in`, which it shortens, into `out`; how many octets it gave.
  /// Never throws: error() says what is wrong.
  std::size_t decompress(std::span<const std::byte>& in, std::span<std::byte> out) noexcept;
  /// Empty while all is well, else what libzstd says.
  [[nodiscard]] const std::string& error() const noexcept { return error_; }
  /// Whether the octets so far end inside a frame.
  [[nodiscard]] bool inside_frame() const noexcept { return inside_; }
  /// Frames that were whole.
  [[nodiscard]] std::uint64_t frames() const noexcept { return frames_; }

 private:
  std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context_;
  std::size_t step_;  ///< octets up to the end of the next block
  std::string error_;
  bool inside_ = false;
  std::uint64_t frames_ = 0;
};

/// Whether a file that begins with these octets holds zstd frames.
[[nodiscard]] bool begins_zstd(std::span<const std::byte> octets) noexcept;

}  // namespace reckon::peer
