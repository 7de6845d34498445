// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The screen of `top` without a terminal: takes keys and returns lines.
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

/// The user's choices, and the lines for them. One thread.
class TopScreen {
 public:
  /// Takes a key. `data` is the present data, which space freezes.
  void press(KeyPress press, const TopData& data);

  /// The whole screen: at most `size.rows` lines of at most `size.columns` columns each.
  [[nodiscard]] std::vector<ScreenLine> lines(const TopData& data, const TrafficRates::Rates& rates,
                                              ScreenSize size);

  /// Whether the user asked to quit.
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
  TrafficRates::Rates rates_;  // as last shown
  std::size_t sort_ = 0;       // column
  bool reverse_ = false;
  std::size_t cursor_ = 0;        // among the selected rows
  std::size_t top_ = 0;           // first row shown
  std::size_t first_column_ = 0;  // those before it are scrolled out to the left
  std::size_t page_ = 1;          // number of rows last shown
  std::vector<std::size_t> widths_;
  std::uint64_t followed_ = 0;  // key of the entity in its pane
  std::uint64_t under_cursor_ = 0;
  bool has_cursor_ = false;

  bool editing_ = false;
  std::string edited_;    // the filter being edited
  std::string accepted_;  // the active filter
  std::optional<Filter> filter_;
  std::string error_;
  std::size_t error_column_ = 0;
};

}  // namespace reckon::tools
