// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Data of the view `top`, and its output without a terminal: text, JSON Lines, CSV.
#pragma once

#include <array>
#include <bitset>
#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/tools/datagrams/traffic_totals.hpp"
#include "reckon/tools/datagrams/trailer_loss.hpp"
#include "reckon/tools/inspect/output/format.hpp"
#include "reckon/tools/listener/entity_table.hpp"

namespace reckon::tools {

/// All data that `top` shows.
struct TopData {
  std::string source;  ///< as typed
  EntityTable entities;
  TrafficTotals totals;
  TrailerLoss loss;
  std::bitset<256> exercises;
  std::array<std::uint64_t, 17> bundle_sizes{};      ///< by number of PDUs; last: 16 and more
  std::map<std::string_view, std::uint64_t> faults;  ///< PDUs by violated rule
  std::vector<std::string> notices;                  ///< while the source is silent
  std::string interfaces;                            ///< that have received a datagram: "lo, eth0"
  std::uint64_t dropped = 0;                         ///< by the kernel, before reception
  std::chrono::nanoseconds now{};  ///< reference time of ages; in a file the time of the last
                                   ///< datagram
};

/// "capture.pcap   on lo   ex 1   0:42   1206 PDU/s   134 dgram/s   1.43 Mbit/s   9.0 PDU/dgram
/// = 96.9 % payload   lost 0   bad 5". `lost` counts gaps of sequence numbers and drops by the
/// kernel.
[[nodiscard]] std::string top_head(const TopData& data, const TrafficRates::Rates& rates);

/// The simulation that sends most octets, with its jumps. Empty if it sends less than half of all
/// octets, or there are few entities.
[[nodiscard]] std::string top_advice(const TopData& data);

/// Head and table.
void append_top_text(std::string& out, const TopData& data, const TrafficRates::Rates& rates);
/// One object for each entity, then one with the sums.
void append_top_json(std::string& out, const TopData& data, const TrafficRates::Rates& rates);
/// Titles, then one line for each entity.
void append_top_csv(std::string& out, const TopData& data);

}  // namespace reckon::tools
