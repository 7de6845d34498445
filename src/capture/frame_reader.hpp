// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reads the frames of a capture in any format. Private to the peer library.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "reckon/peer/capture/frame_parser.hpp"

namespace reckon::peer {

/// A frame. `octets` is valid until the next call of the reader.
struct CapturedFrame {
  std::chrono::nanoseconds time{};  ///< since 1970-01-01 UTC, in the years 1901 to 2160
  std::span<const std::byte> octets;
  std::size_t on_wire{0};          ///< length before the capture truncated it [octets]
  std::uint16_t link_type{0};      ///< LINKTYPE_... of pcap
  std::optional<LinkLayer> layer;  ///< none if frames of this link type are not supported
};

/// Result of FrameReader::next().
enum class FrameEvent : std::uint8_t {
  frame,
  nothing_yet,  ///< a live capture or a growing file has no further frame now
  end,
  damaged  ///< problem() has the reason; no further frame can be read
};

/// Reads frames one after another. One thread.
class FrameReader {
 public:
  virtual ~FrameReader() = default;

  [[nodiscard]] virtual FrameEvent next(CapturedFrame& out) = 0;
  [[nodiscard]] virtual std::string problem() const { return {}; }
  /// Link type of the first interface.
  [[nodiscard]] virtual std::uint16_t link_type() const noexcept = 0;
  /// The interface that captured the last frame, or the first interface of the file before any
  /// frame; empty if unnamed (pcapng if_name).
  [[nodiscard]] virtual std::string_view interface_name() const noexcept { return {}; }
  /// Waits after nothing_yet; true if there may be a frame before the time has passed.
  virtual bool wait(std::chrono::nanoseconds patience);
  /// Frames that the kernel dropped so far.
  [[nodiscard]] virtual std::uint64_t dropped() { return 0; }
};

/// A time from seconds and nanoseconds. Damaged files have times beyond 63 bits of nanoseconds;
/// they are limited to the years 1901 to 2160, so that sums cannot overflow.
[[nodiscard]] std::chrono::nanoseconds bounded_time(std::int64_t second,
                                                    std::int64_t nanosecond) noexcept;

/// The first layer for a LINKTYPE_... of pcap; none if it is not supported.
[[nodiscard]] std::optional<LinkLayer> link_layer_of(int link_type) noexcept;

/// "link type 220 (USB_LINUX_MMAPPED) is not read here; .." for a message.
[[nodiscard]] std::string unread_link_type(int link_type);

/// At the end of a growing file: seeks to `position`, the start of the incomplete part. False if it
/// is not at its end.
bool step_back(std::FILE* file, off_t position);

/// Opens a pcap or pcapng file, and takes ownership. With `grows`, its end or an incomplete frame
/// gives nothing_yet.  @throws std::runtime_error with the reason if it is neither; `file` is
/// closed.
[[nodiscard]] std::unique_ptr<FrameReader> open_frames(std::FILE* file, bool grows);

/// The same for a file that begins as pcapng.
[[nodiscard]] std::unique_ptr<FrameReader> open_pcapng_frames(std::FILE* file, bool grows);

/// All UDP frames of an interface.
/// @throws std::runtime_error with the remedy (CAP_NET_RAW).
[[nodiscard]] std::unique_ptr<FrameReader> open_interface_frames(const std::string& name);

}  // namespace reckon::peer
