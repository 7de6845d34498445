// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/top/screen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "reckon/tools/inspect/top/columns.hpp"
#include "reckon/tools/inspect/top/panes.hpp"

namespace reckon::tools {
namespace {

constexpr std::size_t kMostHeadLines = 3;
constexpr std::size_t kRowsForAdvice = 16;
constexpr std::string_view kGap = "  ";
// The first keys are shown at any width.
constexpr auto kKeys = std::to_array<std::string_view>(
    {"[q] quit", "[/] filter", "[s] sort", "[r] reverse", "[Enter] follow", "[b] bundles",
     "[c] check", "[space] freeze"});
constexpr auto kPaneKeys =
    std::to_array<std::string_view>({"[q] quit", "[Esc] back", "[space] freeze"});

/// The first keys that fit, without cutting one.
std::string keys_text(std::span<const std::string_view> keys, std::size_t columns) {
  std::string line;
  for (const std::string_view key : keys) {
    const std::size_t gap = line.empty() ? 0 : kGap.size();
    if (line.size() + gap + key.size() > columns) break;
    if (gap > 0) line += kGap;
    line += key;
  }
  return line;
}

/// Breaks a line between its items, which are separated by three spaces. Items beyond `most` lines
/// are left out.
std::vector<std::string> wrapped(std::string_view text, std::size_t columns, std::size_t most) {
  constexpr std::string_view kPart = "   ";
  std::vector<std::string> lines{""};
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(kPart), text.size());
    const std::string_view item = text.substr(0, end);
    text.remove_prefix(std::min(end + kPart.size(), text.size()));
    std::string& line = lines.back();
    if (line.empty())
      line = item;
    else if (line.size() + kPart.size() + item.size() <= columns)
      (line += kPart) += item;
    else if (lines.size() < most)
      lines.emplace_back(item);
    else
      break;
  }
  return lines;
}

/// Breaks a sentence between its words.
std::vector<std::string> folded(std::string_view text, std::size_t columns) {
  std::vector<std::string> lines{""};
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    if (lines.back().size() + 1 + word.size() > columns) lines.emplace_back();
    if (!lines.back().empty()) lines.back() += ' ';
    lines.back() += word;
  }
  return lines;
}

/// The items of a cell that fit; two spaces separate them.
std::string items_within(std::string cell, std::size_t room) {
  while (cell.size() > room) {
    const std::size_t gap = cell.rfind(kGap);
    cell.resize(gap == std::string::npos ? 0 : cell.find_last_not_of(' ', gap) + 1);
  }
  return cell;
}

/// The cells from column `first` on that fit as a whole; of the last column, whose items vary, the
/// items that fit.
std::string row_text(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths,
                     std::size_t first, std::size_t room) {
  const auto columns = top_columns();
  std::string line;
  for (std::size_t i = first; i < cells.size(); ++i) {
    const std::string_view gap = i == first ? std::string_view() : kGap;
    const bool is_last = i + 1 == cells.size();
    const std::size_t width = is_last ? columns[i].title.size() : widths[i];
    if (i > first && line.size() + gap.size() + width > room) break;
    line += gap;
    const std::string cell = is_last ? items_within(cells[i], room - line.size()) : cells[i];
    const std::string padding(widths[i] - std::min(widths[i], cell.size()), ' ');
    line += columns[i].align == TextTable::Align::right ? padding + cell : cell + padding;
  }
  return line;
}

/// Applies the filter to the last Entity State of an entity in a source that began at `start`.
bool passes(const Filter& filter, const ReceivedEntity& entity, const EntityRow& counts,
            std::chrono::nanoseconds start) {
  PduRow row;
  row.frame = counts.frame;
  row.time = entity.arrival;
  row.start = start;
  row.pdu = counts.pdu_index;
  row.bytes = entity.octets;
  row.has_header = row.decoded = entity.has_state;
  if (entity.has_state) (void)decode_header(entity.octets, row.header);
  const pdu::EntityState state = entity.entity_state();
  if (entity.has_state) row.entity_state = &state;
  row.header.length = counts.length;
  row.id = entity.id;
  if (counts.last_is_bad) {
    row.rule = counts.rule;
    row.status = status_of(counts.rule);
  }
  peer::SourceDatagram datagram;
  datagram.frame = counts.frame;
  datagram.time = entity.arrival;
  datagram.source = counts.sender;
  datagram.group = counts.group;
  return filter.matches(row, datagram);
}

LineStyle style_of(const TopCell& cell) {
  if (cell.entity.gone) return LineStyle::faint;
  const bool is_bad = cell.row.last_is_bad || cell.entity.is_silent(cell.now);
  return is_bad ? LineStyle::bad : LineStyle::plain;
}

}  // namespace

void TopScreen::press(KeyPress press, const TopData& data) {
  if (press.key == Key::resize) {
    widths_.clear();
    return;
  }
  if (editing_) return press_in_filter(press);
  if (press.key == Key::character) return press_letter(press.letter, data);
  if (press.key == Key::escape || press.key == Key::backspace) pane_ = Pane::table;
  if (press.key == Key::enter && pane_ == Pane::table && has_cursor_) {
    followed_ = under_cursor_;
    pane_ = Pane::entity;
  }
  move(press.key);
}

void TopScreen::press_letter(char letter, const TopData& data) {
  const auto toggle = [&](Pane pane) { pane_ = pane_ == pane ? Pane::table : pane; };
  switch (letter) {
    case 'q':
      quit_ = true;
      return;
    case '/':
      pane_ = Pane::table;
      editing_ = true;
      edited_ = accepted_;
      error_.clear();
      return;
    case 's':
      return next_sort_column();
    case 'r':
      reverse_ = !reverse_;
      return;
    case 'b':
      return toggle(Pane::bundles);
    case 'c':
      return toggle(Pane::faults);
    case ' ':
      if (frozen_.has_value())
        frozen_.reset();
      else
        frozen_ = Frozen{data, rates_};
      return;
    default:
      return;
  }
}

void TopScreen::next_sort_column() {
  const auto columns = top_columns();
  do {
    sort_ = (sort_ + 1) % columns.size();
  } while (columns[sort_].order == nullptr);
}

void TopScreen::press_in_filter(KeyPress press) {
  switch (press.key) {
    case Key::character:
      error_.clear();
      if (edited_.size() < Filter::kLongest) edited_ += press.letter;
      return;
    case Key::backspace:
      error_.clear();
      if (!edited_.empty()) edited_.pop_back();
      return;
    case Key::enter:
      return take_filter();
    case Key::escape:
      editing_ = false;
      error_.clear();
      return;
    default:
      return;
  }
}

void TopScreen::take_filter() {
  try {
    filter_.reset();
    if (edited_.find_first_not_of(' ') != std::string::npos) filter_.emplace(edited_);
    accepted_ = filter_.has_value() ? edited_ : "";
    editing_ = false;
    cursor_ = top_ = 0;
  } catch (const FilterError& error) {
    // The first line has the reason; the others mark the column, which the screen does itself.
    error_ = error.what();
    error_.resize(std::min(error_.find('\n'), error_.size()));
    error_column_ = error.column;
    if (!accepted_.empty()) filter_.emplace(accepted_);
  }
}

void TopScreen::move(Key key) {
  const auto back = [](std::size_t from, std::size_t by) { return from - std::min(from, by); };
  switch (key) {
    case Key::up:
      cursor_ = back(cursor_, 1);
      return;
    case Key::down:
      ++cursor_;
      return;
    case Key::page_up:
      cursor_ = back(cursor_, page_);
      return;
    case Key::page_down:
      cursor_ += page_;
      return;
    case Key::home:
      cursor_ = first_column_ = 0;
      return;
    case Key::end:
      cursor_ = EntityTable::kMostRows;
      return;
    case Key::left:
      first_column_ = back(first_column_, 1);
      return;
    case Key::right:
      first_column_ = std::min(first_column_ + 1, top_columns().size() - 1);
      return;
    default:
      return;
  }
}

std::vector<std::size_t> TopScreen::chosen(const TopData& data) const {
  std::vector<std::size_t> places = top_order(data.entities, data.now, sort_, reverse_);
  if (!filter_.has_value()) return places;
  std::erase_if(places, [&](std::size_t place) {
    return !passes(*filter_, data.entities.entities()[place], data.entities.rows()[place],
                   data.totals.first);
  });
  return places;
}

std::vector<ScreenLine> TopScreen::lines(const TopData& live, const TrafficRates::Rates& rates,
                                         ScreenSize size) {
  rates_ = rates;
  const TopData& data = frozen_.has_value() ? frozen_->data : live;
  const TrafficRates::Rates& shown = frozen_.has_value() ? frozen_->rates : rates;
  std::vector<ScreenLine> out;
  std::string head = top_head(data, shown);
  if (frozen_.has_value()) head.insert(0, "FROZEN   ");
  for (std::string& line : wrapped(head, size.columns, kMostHeadLines))
    out.push_back({std::move(line), LineStyle::title});
  std::vector<ScreenLine> foot;
  if (pane_ == Pane::table && !editing_ && size.rows >= kRowsForAdvice) {
    std::string advice = top_advice(data);
    if (!advice.empty()) foot.push_back({"advice: " + std::move(advice)});
  }
  footer(size, foot);
  // On the smallest screens the table is dropped first, then the head.
  const std::size_t used = out.size() + foot.size();
  const std::size_t room = size.rows > used ? size.rows - used : 0;
  if (pane_ == Pane::table)
    table(data, size, room, out);
  else
    pane(data, size, out);
  out.resize(std::max(size.rows, foot.size()) - foot.size());
  out.insert(out.end(), foot.begin(), foot.end());
  out.resize(size.rows);
  for (ScreenLine& line : out) line.text.resize(std::min(line.text.size(), size.columns));
  return out;
}

void TopScreen::table(const TopData& data, ScreenSize size, std::size_t room,
                      std::vector<ScreenLine>& out) {
  const std::vector<std::size_t> places = chosen(data);
  page_ = std::max<std::size_t>(room, 2) - 1;  // a row for the titles
  has_cursor_ = !places.empty();
  cursor_ = std::min(cursor_, places.empty() ? 0 : places.size() - 1);
  if (cursor_ < top_) top_ = cursor_;
  if (cursor_ >= top_ + page_) top_ = cursor_ - page_ + 1;
  top_ = std::min(top_, places.size() - std::min(places.size(), page_));
  if (has_cursor_) under_cursor_ = data.entities.entities()[places[cursor_]].key;

  const auto columns = top_columns();
  std::vector<std::string> titles;
  for (std::size_t i = 0; i < columns.size(); ++i)
    titles.push_back(std::string(columns[i].title) + (i == sort_ ? (reverse_ ? "^" : "v") : ""));
  std::vector<std::vector<std::string>> rows{titles};
  const std::size_t end = std::min(places.size(), top_ + page_);
  for (std::size_t i = top_; i < end; ++i)
    rows.push_back(top_cells({data.entities, places[i], data.now}));
  // Columns only grow, so that the table does not move.
  widths_.resize(columns.size());
  for (const auto& cells : rows)
    for (std::size_t i = 0; i < cells.size(); ++i)
      widths_[i] = std::max(widths_[i], cells[i].size());

  const auto fitted = [&](const std::vector<std::string>& cells) {
    return row_text(cells, widths_, first_column_, size.columns);
  };
  out.push_back({fitted(titles), LineStyle::title});
  for (std::size_t i = top_; i < end; ++i) {
    const TopCell cell(data.entities, places[i], data.now);
    const LineStyle style = i == cursor_ ? LineStyle::selected : style_of(cell);
    out.push_back({fitted(rows[i - top_ + 1]), style});
  }
  if (!places.empty()) return;
  out.push_back({filter_.has_value() ? "no entity passes the filter" : "no entity received yet"});
  if (data.totals.datagrams > 0) return;
  for (const std::string& notice : data.notices)
    for (std::string& line : folded(notice, size.columns)) out.push_back({std::move(line)});
}

void TopScreen::pane(const TopData& data, ScreenSize size, std::vector<ScreenLine>& out) const {
  std::vector<ScreenLine> lines;
  if (pane_ == Pane::bundles) lines = bundles_pane(data);
  if (pane_ == Pane::faults) lines = faults_pane(data);
  if (pane_ == Pane::entity) {
    const std::size_t place = data.entities.listener().place_of_key(followed_);
    if (place == Listener::kNone)
      lines.push_back({"the entity is gone"});
    else
      lines = entity_pane({data.entities, place, data.now}, size.columns);
  }
  out.push_back({});
  out.insert(out.end(), lines.begin(), lines.end());
}

void TopScreen::footer(ScreenSize size, std::vector<ScreenLine>& out) const {
  if (editing_) {
    constexpr std::string_view kPrompt = "filter: ";
    // Shows the end of a long filter, where the user types.
    const std::size_t room = size.columns - std::min(size.columns, kPrompt.size() + 1);
    const std::size_t cut = edited_.size() - std::min(edited_.size(), room);
    out.push_back({std::string(kPrompt) + edited_.substr(cut) + "_", LineStyle::title});
    if (error_.empty()) {
      out.push_back({"[Enter] apply  [Esc] cancel  empty: everything", LineStyle::faint});
      return;
    }
    const std::size_t column = std::max(error_column_, cut + 1) - cut - 1;
    out.push_back({std::string(kPrompt.size() + column, ' ') + "^", LineStyle::bad});
    out.push_back({error_, LineStyle::bad});
    return;
  }
  if (!accepted_.empty()) out.push_back({"filter: " + accepted_, LineStyle::title});
  out.push_back(
      {pane_ == Pane::table ? keys_text(kKeys, size.columns) : keys_text(kPaneKeys, size.columns),
       LineStyle::faint});
}

}  // namespace reckon::tools
