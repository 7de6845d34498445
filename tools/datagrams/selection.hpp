// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Selection of a capture's datagrams for a verb: time range, groups, PDU types, entities, filter.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reckon/peer/capture/capture_writer.hpp"
#include "reckon/peer/capture/datagram_source.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/datagrams/filter.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"

namespace reckon::tools {

/// The options as typed. Times are relative to the first datagram of the capture. Without `from`
/// and `to` any time is in range, including times before the first datagram.
struct SelectionOptions {
  std::optional<std::chrono::nanoseconds> from;
  std::optional<std::chrono::nanoseconds> to;
  std::vector<std::string> groups;    ///< 239.192.1.0 or 239.192.1.0:3000
  std::vector<std::string> types;     ///< names of inspect --json
  std::vector<std::string> entities;  ///< site:application:entity, each a number or *
  std::string where;                  ///< a filter of inspect
  bool lenient = false;               ///< reads PDUs like inspect --lenient

  /// Declares the flags except the one for the end of the range.
  void declare(CommandLine& line);
  /// Declares only the flag that needs no file.
  void declare_filter(CommandLine& line);
};

/// Declares `--lenient` of a verb that shows PDUs; see DatagramInspector.
void declare_lenient(CommandLine& line, bool& lenient);

/// Selects whole datagrams. Several words of one kind are alternatives; words of different kinds
/// must all match.
class CaptureSelection {
 public:
  /// @throws UsageError with the word and the remedy.
  explicit CaptureSelection(const SelectionOptions& options);
  /// Whether the datagram is selected. The first one passed is the origin of time.
  [[nodiscard]] bool takes(const peer::SourceDatagram& datagram);

 private:
  using EntityPattern = std::array<std::optional<std::uint16_t>, 3>;
  static EntityPattern parse_entity(const std::string& text);
  [[nodiscard]] bool in_range(std::chrono::nanoseconds time);
  [[nodiscard]] bool in_groups(const peer::GroupAddress& group) const;
  [[nodiscard]] bool has_wanted_pdu(const peer::SourceDatagram& datagram);
  [[nodiscard]] bool is_wanted(const PduRow& row, const peer::SourceDatagram& datagram) const;

  std::optional<std::chrono::nanoseconds> from_;
  std::optional<std::chrono::nanoseconds> to_;
  std::vector<peer::GroupAddress> groups_;  ///< port 0: any
  std::vector<std::string> types_;
  std::vector<EntityPattern> entities_;
  std::optional<Filter> filter_;
  std::optional<std::chrono::nanoseconds> origin_;
  DatagramInspector inspector_;
};

/// Opens a capture file, stdin or raw:FILE. @throws UsageError for a live source and for a file
/// that cannot be read.
[[nodiscard]] std::unique_ptr<peer::DatagramSource> open_recording(const std::string& name);

/// A name that ends in .zst enables compression, and compression appends that ending.
void settle_compression(peer::CaptureWriterOptions& options);

/// Opens a capture for writing. @throws UsageError if that fails.
[[nodiscard]] std::unique_ptr<peer::CaptureWriter> create_recording(
    const peer::CaptureWriterOptions& options);

/// Report about damaged or incomplete places of the capture; empty if there are none.
[[nodiscard]] std::string damage_text(const peer::SourceReport& report);

}  // namespace reckon::tools
