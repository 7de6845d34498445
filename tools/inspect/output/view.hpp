// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Interface of the inspector's views. A new view is one file with a class that overrides the
// required hooks and the row that makes it, and the name of that row in view_list.cpp.
//
//   class LengthsView final : public View {
//     void pdu(const peer::SourceDatagram&, const PduRow& row, std::chrono::nanoseconds,
//              std::string& out) override {
//       out += fmt::format("{}\n", row.header.length);
//     }
//   };
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"
#include "reckon/tools/inspect/output/options.hpp"

namespace reckon::tools {

/// Hooks in the order of a run, called by one thread. By default they do nothing. `out` is written
/// to stdout; `start` is the time of the first datagram [since 1970-01-01 UTC].
class View {
 public:
  View() = default;
  View(const View&) = default;
  View& operator=(const View&) = default;
  virtual ~View() = default;

  /// Titles, before the first datagram.
  virtual void begin(std::string&) {}
  /// A datagram, before its PDUs.
  virtual void expect(const peer::SourceDatagram&) {}
  /// Each of its PDUs, including PDUs that --where excludes.
  virtual void look(const PduRow&) {}
  /// Each PDU to be shown.
  virtual void pdu(const peer::SourceDatagram& /*datagram*/, const PduRow& /*row*/,
                   std::chrono::nanoseconds /*start*/, std::string& /*out*/) {}
  /// After the PDUs of a datagram with at least one shown PDU.
  virtual void datagram(const peer::SourceDatagram& /*datagram*/,
                        std::chrono::nanoseconds /*start*/, std::string& /*out*/) {}
  /// After the PDUs of a datagram without a shown PDU.
  virtual void skip() {}
  /// Live sources: after each datagram and every 0.1 s; `now` since 1970-01-01 UTC.
  virtual void tick(std::chrono::nanoseconds /*now*/, const peer::SourceReport& /*report*/,
                    std::string& /*out*/) {}
  /// Shows a sentence for the user while a live source is silent.
  /// @returns false if the view has no place for it: then it is printed to stderr
  [[nodiscard]] virtual bool show_notice(const std::string& /*sentence*/) { return false; }
  /// Whether the user ended the view itself, such as by a key.
  [[nodiscard]] virtual bool has_ended() const { return false; }
  /// The end of the source.
  virtual void finish(const InspectTally& /*tally*/, std::string& /*out*/) {}
  /// Whether the verb's exit status is 1. A view that returns a value prints the counts of good and
  /// bad PDUs itself. For other views the verb does.
  [[nodiscard]] virtual std::optional<bool> found_faults() const { return std::nullopt; }
};

/// Row of a view.
struct InspectViewKind {
  std::string_view name;
  std::string_view meaning;  ///< for --help
  bool takes_csv;
  /// @throws UsageError if the options name a file that cannot be opened. Options and console
  /// outlive the view.
  std::unique_ptr<View> (*make)(const InspectOptions& options, const Console& console);
};

}  // namespace reckon::tools
