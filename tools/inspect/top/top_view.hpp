// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The view `top`: every entity with its rate, the causes of its updates and its jumps.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "reckon/tools/inspect/output/view.hpp"
#include "reckon/tools/inspect/top/report.hpp"
#include "reckon/tools/inspect/top/screen.hpp"
#include "reckon/tools/terminal/screen.hpp"

namespace reckon::tools {

class TopView final : public View {
 public:
  TopView(const InspectOptions& options, const Console& console);

  /// Takes over the terminal, if there is one and the source is live.
  void begin(std::string& out) override;
  void pdu(const peer::SourceDatagram& datagram, const PduRow& row, std::chrono::nanoseconds,
           std::string&) override {
    ++pdus_;
    data_.totals.count(row);
    data_.loss.pdu(row);
    if (row.status != PduStatus::ok) ++data_.faults[row.rule];
    if (row.has_header) data_.exercises.set(row.header.exercise_id);
    data_.entities.take_pdu(row, datagram);
  }
  void datagram(const peer::SourceDatagram& datagram, std::chrono::nanoseconds start,
                std::string& out) override;
  /// Live sources: keys and the screen on a terminal, else the table each second if requested.
  void tick(std::chrono::nanoseconds now, const peer::SourceReport& report,
            std::string& out) override;
  /// On the screen, or not at all without a terminal.
  [[nodiscard]] bool show_notice(const std::string& sentence) override;
  [[nodiscard]] bool has_ended() const override { return screen_.quit(); }
  /// Restores the terminal, or writes the table.
  void finish(const InspectTally& tally, std::string& out) override;

 private:
  void show(std::chrono::nanoseconds now);
  void write(const TrafficRates::Rates& rates, std::string& out) const;

  Format format_;
  bool follow_;
  bool grows_;  // more datagrams may arrive
  const Console& console_;
  TopData data_;
  TrafficRates rates_;
  std::unique_ptr<TerminalScreen> terminal_;  // null without a terminal
  TopScreen screen_;
  std::size_t pdus_ = 0;  // in the present datagram
  std::chrono::nanoseconds next_write_{};
  std::chrono::nanoseconds next_keys_{};
};

}  // namespace reckon::tools
