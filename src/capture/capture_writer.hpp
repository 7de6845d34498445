// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Captures as they are written: pcapng with times in nanoseconds, appended in whole blocks, so that
// whatever ends the program leaves a file that every reader of pcapng opens.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "reckon/peer/capture/datagram_source.hpp"

namespace reckon::peer {

class CaptureOutput;

/// A capture that could not be written on. The text names the file, the reason and what is safe.
struct CaptureWriteError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// How a capture is written.
struct CaptureWriterOptions {
  std::string path;
  bool overwrite{false};
  bool compress{false};                     ///< in zstd frames
  std::uint16_t link_type{kLinkTypeRawIp};  ///< of the source whose frames will be written
  /// A file that has reached this size [octets, as it lies on the disk] is followed by the next;
  /// 0 = one file of any size. Compressed, up to 64 KiB of blocks may come on top.
  std::uint64_t rotate_octets{0};
  /// A file whose first datagram is this old is followed by the next; 0 = never.
  std::chrono::nanoseconds rotate_after{0};
};

/// Writes datagrams to one file, or to path_00001.ext, path_00002.ext, ... where it rotates. One
/// thread. A datagram is on disk for every reader after flush(); write() flushes by itself every 64
/// KiB. Times before 1970 are written as 1970.
class CaptureWriter {
 public:
  /// Creates the file with its header. @throws CaptureWriteError with the remedy, also where the
  /// file exists and may not be overwritten.
  explicit CaptureWriter(CaptureWriterOptions options);
  /// Flushes what it can; call finish() or close() to learn whether it could.
  ~CaptureWriter();
  CaptureWriter(const CaptureWriter&) = delete;
  CaptureWriter& operator=(const CaptureWriter&) = delete;

  /// Appends one datagram: the frame as it was captured, or, where the source is no capture, an IP
  /// packet with the datagram's endpoints and right checksums. @throws CaptureWriteError where the
  /// file takes no more; the file then ends with the last block that is whole.
  void write(const SourceDatagram& datagram);
  /// Hands all to the kernel: not lost any more when the program is killed. @throws as write().
  void flush();
  /// Ends the file with the source's counts (interface statistics) and closes it. @throws as
  /// write(). Nothing may be written after it.
  void finish(std::uint64_t received, std::uint64_t dropped);
  /// The same without counts.
  void close();

  /// Datagrams that are safe in the files.
  [[nodiscard]] std::uint64_t datagrams() const noexcept;
  /// Octets of all files, as they lie on the disk.
  [[nodiscard]] std::uint64_t octets() const noexcept;
  /// The files made so far, in their order.
  [[nodiscard]] const std::vector<std::string>& paths() const noexcept { return paths_; }

 private:
  void open_next();
  void begin_section();
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
  std::unique_ptr<CaptureOutput> file_;
  std::vector<std::byte> buffer_;  ///< whole blocks that the kernel does not have yet
  std::vector<std::byte> flushing_;
  std::vector<std::byte> packet_;
  std::uint64_t earlier_octets_{0};   ///< of the files before this one
  std::uint64_t earlier_packets_{0};  ///< of the files before this one
  std::uint64_t in_file_{0};
  std::chrono::nanoseconds file_begin_{};
  std::chrono::nanoseconds last_time_{};
};

/// Fills `out` with the IP packet that carries the datagram: IPv4 (do not fragment) or IPv6 by the
/// group's family, then UDP, both with right checksums. At most 65,507 octets of payload fit IPv4,
/// 65,527 IPv6; what is beyond is left out.
void make_ip_packet(const SourceDatagram& datagram, std::vector<std::byte>& out);

}  // namespace reckon::peer
