// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the view `top` has collected, and how it is written where no terminal shows it: text, JSON
// Lines, CSV.
#pragma once

#include <array>
#include <bitset>
#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "reckon/tools/datagrams/traffic_totals.hpp"
#include "reckon/tools/datagrams/trailer_loss.hpp"
#include "reckon/tools/inspect/output/format.hpp"
#include "reckon/tools/listener/entity_table.hpp"

namespace reckon::tools {

/// Everything that `top` shows.
struct TopData {
  std::string source;  ///< as the user said it
  EntityTable entities;
  TrafficTotals totals;
  TrailerLoss loss;
  std::bitset<256> exercises;
  std::array<std::uint64_t, 17> bundle_sizes{};      ///< datagrams by PDUs; the last: 16 and more
  std::map<std::string_view, std::uint64_t> faults;  ///< PDUs by the rule that they broke
  std::uint64_t dropped = 0;                         ///< by the kernel, before they reached us
  std::chrono::nanoseconds
      now{};  ///< ages are of this instant; that of the last datagram in a file
};

/// "capture.pcap   ex 1   0:42   1206 PDU/s   134 dgram/s   1.43 Mbit/s   9.0 PDU/dgram = 96.9 %
/// payload   lost 0   bad 5". `lost` counts gaps of sequence numbers and what the kernel dropped.
[[nodiscard]] std::string top_head(const TopData& data, const TrafficRates::Rates& rates);

/// Who spends most octets, with the jumps that it does so for; empty below half of all octets or
/// among few entities.
[[nodiscard]] std::string top_advice(const TopData& data);

/// Head and table.
void append_top_text(std::string& out, const TopData& data, const TrafficRates::Rates& rates);
/// One object an entity, then one with the sums.
void append_top_json(std::string& out, const TopData& data, const TrafficRates::Rates& rates);
/// Titles, then one line an entity.
void append_top_csv(std::string& out, const TopData& data);

}  // namespace reckon::tools
