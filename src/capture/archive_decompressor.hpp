// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// gzip, bzip2, xz and lz4 for captures, by libarchive. Private to the peer library.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

struct archive;

namespace reckon::peer {

struct ArchiveLibrary;

/// The method of a file with these first octets: "gzip", "bzip2", "xz" or "lz4"; else empty.
[[nodiscard]] std::string_view archive_method(std::span<const std::byte> head) noexcept;

/// Decompresses a stream of any length. One thread. Memory depends on the method: 64 MiB for most
/// xz files, 1 GiB at most, less for the others.
class ArchiveDecompressor {
 public:
  /// The next octets of the file, valid until the next call; none at its end.
  using Read = std::function<std::span<const std::byte>()>;

  /// @param method one of archive_method().
  ArchiveDecompressor(std::string_view method, Read read);
  /// @param library that reads it, and outlives this object; without one, error() says so
  ArchiveDecompressor(std::string_view method, Read read, const ArchiveLibrary& library);
  ~ArchiveDecompressor();
  ArchiveDecompressor(const ArchiveDecompressor&) = delete;
  ArchiveDecompressor& operator=(const ArchiveDecompressor&) = delete;

  /// Returns the number of octets written to `out`; 0 at the end and after an error.
  std::size_t decompress(std::span<std::byte> out);
  /// Empty without an error, else a sentence about the stream.
  [[nodiscard]] const std::string& error() const noexcept { return error_; }
  [[nodiscard]] std::string_view method() const noexcept { return method_; }

 private:
  bool open();
  void fail();
  static std::ptrdiff_t read_callback(archive*, void* self, const void** buffer);

  const ArchiveLibrary& library_;
  std::string_view method_;
  Read read_;
  std::unique_ptr<archive, int (*)(archive*)> archive_;
  bool is_open_{false};
  std::span<const std::byte> content_;  ///< decompressed, not returned
  std::string error_;
};

}  // namespace reckon::peer
