// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The screen of `top` without a terminal: keys go in, lines come out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reckon/tools/datagrams/filter.hpp"
#include "reckon/tools/inspect/top/report.hpp"
#include "reckon/tools/terminal/screen_line.hpp"

namespace reckon::tools {

/// What the user has chosen to see, and the lines for it. One thread.
class TopScreen {
 public:
  /// Takes a key. `data` is what would be shown now: space freezes it.
  void press(KeyPress press, const TopData& data);

  /// The whole screen: at most `size.rows` lines of at most `size.columns` columns each.
  [[nodiscard]] std::vector<ScreenLine> lines(const TopData& data, const TrafficRates::Rates& rates,
                                              ScreenSize size);

  /// Whether the user asked to end.
  [[nodiscard]] bool quit() const noexcept { return quit_; }

 private:
  enum class Pane : std::uint8_t { table, entity, bundles, faults };
  struct Frozen {
    TopData data;
    TrafficRates::Rates rates;
  };

  void press_letter(char letter, const TopData& data);
  void press_in_filter(KeyPress press);
  void move(Key key);
  void take_filter();
  void next_sort_column();
  [[nodiscard]] std::vector<std::size_t> chosen(const TopData& data) const;
  void table(const TopData& data, ScreenSize size, std::size_t room, std::vector<ScreenLine>& out);
  void footer(ScreenSize size, std::vector<ScreenLine>& out) const;
  void pane(const TopData& data, ScreenSize size, std::vector<ScreenLine>& out) const;

  Pane pane_ = Pane::table;
  bool quit_ = false;
  std::optional<Frozen> frozen_;
  TrafficRates::Rates rates_;  // as shown last
  std::size_t sort_ = 0;       // column
  bool reverse_ = false;
  std::size_t cursor_ = 0;  // among the chosen rows
  std::size_t top_ = 0;     // the first one shown
  std::size_t shift_ = 0;   // columns that are scrolled out to the left
  std::size_t page_ = 1;    // rows shown last
  std::vector<std::size_t> widths_;
  std::uint64_t followed_ = 0;  // key of the entity in its pane
  std::uint64_t under_cursor_ = 0;
  bool has_cursor_ = false;

  bool editing_ = false;
  std::string edited_;    // the filter while it is written
  std::string accepted_;  // the filter in force
  std::optional<Filter> filter_;
  std::string error_;
  std::size_t error_column_ = 0;
};

}  // namespace reckon::tools
