// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Writes captures: pcapng with times in nanoseconds, appended in whole blocks, so that every reader
// of pcapng opens the file even if the program was killed.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "reckon/peer/capture/datagram_source.hpp"

namespace reckon::peer {

class CaptureOutput;

/// A capture could not be continued. The text has the file, the reason and the number of safe
/// datagrams.
struct CaptureWriteError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Options of a capture file.
struct CaptureWriterOptions {
  std::string path;
  bool overwrite{false};
  bool compress{false};  ///< in zstd frames
  /// Link type of the first interface, equal to the source's; frames of other link types get
  /// additional interfaces, which not all programs can read in one file.
  std::uint16_t link_type{kLinkTypeRawIp};
  std::string interface {};  ///< name of the first interface; empty: unknown
  /// A file that reaches this size [octets on the disk] is followed by the next; 0 = one file of
  /// any size. A compressed file may exceed it by up to 64 KiB of blocks.
  std::uint64_t rotate_octets{0};
  /// A file whose first datagram is this old is followed by the next; 0 = never.
  std::chrono::nanoseconds rotate_after{0};
  /// Limit of all files together [octets on the disk], at least twice `rotate_octets`; 0 = none.
  /// Before the next file, the oldest files of this writer are removed until there is room.
  /// Requires one of the two options above. Without `rotate_octets` a file ends at a tenth of the
  /// limit.
  std::uint64_t rotate_total{0};
};

/// Files that a writer removed to stay within `rotate_total`.
struct RemovedFiles {
  std::uint64_t files{0};
  std::uint64_t datagrams{0};  ///< datagrams in these files
  std::uint64_t octets{0};
};

/// Writes datagrams to one file, or with rotation to path_00001.ext, path_00002.ext, ... One
/// thread. After flush() every reader finds a datagram on disk; write() flushes by itself every 64
/// KiB. Times before 1970 are written as 1970.
class CaptureWriter {
 public:
  /// Creates the file with its header.
  /// @throws CaptureWriteError with the remedy, also if the file exists and may not be overwritten.
  explicit CaptureWriter(CaptureWriterOptions options);
  /// Flushes if possible; only finish() and close() report a failure.
  ~CaptureWriter();
  CaptureWriter(const CaptureWriter&) = delete;
  CaptureWriter& operator=(const CaptureWriter&) = delete;

  /// Appends one datagram: the captured frame, or, if the source is no capture, an IP packet with
  /// the datagram's endpoints and correct checksums.
  /// @throws CaptureWriteError if the file takes no more; it then ends with the last whole block.
  void write(const SourceDatagram& datagram);
  /// Passes all to the kernel, so that nothing is lost if the program is killed.
  /// @throws CaptureWriteError as write().
  void flush();
  /// Ends the file with the source's counts (interface statistics) and closes it. No call of
  /// write() may follow.  @throws CaptureWriteError as write().
  void finish(std::uint64_t received, std::uint64_t dropped);
  /// The same without counts.
  void close();

  /// Datagrams that are safe in the files.
  [[nodiscard]] std::uint64_t datagrams() const noexcept;
  /// Octets of all files on disk.
  [[nodiscard]] std::uint64_t octets() const noexcept;
  /// The files created so far and not removed, in their order.
  [[nodiscard]] const std::vector<std::string>& paths() const noexcept { return paths_; }
  [[nodiscard]] const RemovedFiles& removed() const noexcept { return removed_; }

 private:
  void open_next();
  void put_away();
  void make_room();
  void begin_section();
  std::uint32_t interface_of(std::uint16_t link_type);
  [[nodiscard]] bool is_full(std::chrono::nanoseconds time) const noexcept;
  void append_packet(const SourceDatagram& datagram, std::span<const std::byte> frame,
                     std::size_t on_wire);
  void append_statistics(std::uint64_t received, std::uint64_t dropped);
  void u16(std::uint16_t value);
  void u32(std::uint32_t value);
  void u64(std::uint64_t value);
  void time_words(std::chrono::nanoseconds time);

  CaptureWriterOptions options_;
  std::vector<std::string> paths_;
  std::unique_ptr<CaptureOutput> file_;  ///< null only if the next one could not be created
  std::deque<std::unique_ptr<CaptureOutput>> finished_;  ///< with rotate_total: the files that
                                                         ///< count for it
  RemovedFiles removed_;
  std::vector<std::byte> buffer_;  ///< whole blocks not passed to the kernel yet
  std::vector<std::byte> flushing_;
  std::vector<std::byte> packet_;
  std::vector<std::uint16_t> link_types_;  ///< of the interfaces in this file
  std::uint64_t earlier_octets_{0};        ///< of the files before this one
  std::uint64_t earlier_packets_{0};       ///< of the files before this one
  std::uint64_t in_file_{0};
  std::chrono::nanoseconds file_begin_{};
  std::chrono::nanoseconds last_time_{};
};

/// Fills `out` with the IP packet of the datagram: IPv4 (do not fragment) or IPv6 by the group's
/// family, then UDP, both with correct checksums. IPv4 has room for 65,507 octets of payload, IPv6
/// for 65,527; the rest is omitted.
void make_ip_packet(const SourceDatagram& datagram, std::vector<std::byte>& out);

}  // namespace reckon::peer
