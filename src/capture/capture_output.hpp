// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One growing capture file, plain or in zstd frames; it always ends with a whole block. Private to
// the peer library.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reckon/peer/capture/zstd_codec.hpp"

namespace reckon::peer {

/// A file of whole pcapng blocks. One thread. Frames also hold whole blocks, and each can be
/// decompressed separately; all blocks passed to append() can be decompressed, even within an
/// unfinished frame.
class CaptureOutput {
 public:
  /// Creates the file.
  /// @throws CaptureWriteError with the remedy, also if it exists and may not be overwritten.
  CaptureOutput(std::string path, bool overwrite, bool compress);
  /// Ends the frame if possible; only finish() reports a failure.
  ~CaptureOutput();
  CaptureOutput(const CaptureOutput&) = delete;
  CaptureOutput& operator=(const CaptureOutput&) = delete;

  /// Passes blocks to the kernel.
  /// @throws CaptureWriteError if a write fails: the file is then truncated to a whole block and
  /// closed, and accepts no more blocks.
  void append(std::span<const std::byte> blocks);
  /// Ends the frame and closes the file.  @throws CaptureWriteError as append().
  void finish();
  /// Removes the file. Leaves it if it was moved, or if another file now has its name.
  /// @returns whether it was removed.  @throws CaptureWriteError if it may not be removed.
  bool remove() const;

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] std::uint64_t octets() const noexcept { return position_; }
  /// Packets that are safe in the file.
  [[nodiscard]] std::uint64_t packets() const noexcept { return packets_; }

 private:
  /// Octets that the kernel accepted, and its error if not all.
  struct Written {
    std::size_t octets;
    int error;
  };
  Written write(std::span<const std::byte> octets);
  void append_plain(std::span<const std::byte> blocks);
  void append_frame(std::span<const std::byte> blocks, bool end);
  bool cut_back_frame();
  void fail(int error, bool whole);
  bool truncate();
  void close();

  std::string path_;
  int file_{-1};
  dev_t device_{};  ///< with inode_: the file that was created, under any name
  ino_t inode_{};
  std::uint64_t position_{0};  ///< octets passed to the kernel
  std::uint64_t packets_{0};
  std::optional<ZstdCompressor> compressor_;
  std::vector<std::byte> compressed_;
  std::vector<std::byte> frame_;  ///< blocks of the frame in progress
  std::uint64_t frame_begin_{0};
  std::uint64_t frame_packets_{0};  ///< packets of the frame in progress
};

}  // namespace reckon::peer
