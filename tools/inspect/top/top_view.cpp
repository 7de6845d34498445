// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/top/top_view.hpp"

#include <algorithm>

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

constexpr nanoseconds kWriteEvery = std::chrono::seconds(1);
constexpr nanoseconds kDrawEvery = std::chrono::milliseconds(250);
constexpr nanoseconds kLookForKeysEvery = std::chrono::milliseconds(50);

std::string source_text(const SourceChoice& choice) {
  if (!means_groups(choice)) return choice.source == "-" ? "stdin" : choice.source;
  const auto groups = groups_of(choice);
  std::string text = groups.front().text();
  if (!choice.interface.empty()) text.insert(0, choice.interface + " ");
  return groups.size() == 1 ? text : text + " +" + std::to_string(groups.size() - 1) + " groups";
}

}  // namespace

TopView::TopView(const InspectOptions& options, const Console& console)
    : format_(options.format()),
      follow_(options.source.follow),
      grows_(is_live(options.source) || options.source.follow),
      console_(console) {
  data_.source = source_text(options.source);
}

void TopView::begin(std::string&) {
  if (grows_ && format_ == Format::text)
    terminal_ = TerminalScreen::open(console_.out, console_.colour);
}

void TopView::datagram(const peer::SourceDatagram& datagram, nanoseconds, std::string&) {
  data_.totals.count(datagram);
  data_.loss.datagram(datagram);
  data_.now = std::max(data_.now, datagram.time);
  ++data_.bundle_sizes[std::min(pdus_, data_.bundle_sizes.size() - 1)];
  pdus_ = 0;
}

void TopView::tick(nanoseconds now, const peer::SourceReport& report, std::string& out) {
  if (terminal_ != nullptr && now >= next_keys_) show(now);
  if (now < next_write_) return;
  next_write_ = now + (terminal_ != nullptr ? kDrawEvery : kWriteEvery);
  data_.now = now;
  data_.dropped = report.dropped;
  data_.interfaces.clear();
  for (const peer::ListenedInterface& one : report.interfaces)
    if (one.datagrams > 0) data_.interfaces += (data_.interfaces.empty() ? "" : ", ") + one.name;
  data_.entities.drop_gone(now);
  const TrafficRates::Rates rates = rates_.at(data_.totals, now);
  if (terminal_ != nullptr) {
    terminal_->show(screen_.lines(data_, rates, terminal_->size()));
    return;
  }
  if (!follow_ || format_ == Format::csv) return;
  write(rates, out);
  if (format_ == Format::text) out += '\n';
}

bool TopView::show_notice(const std::string& sentence) {
  if (terminal_ == nullptr) return false;
  data_.notices.push_back(sentence);
  next_write_ = {};
  return true;
}

// Handles the pressed keys, and schedules a redraw if there were any.
void TopView::show(nanoseconds now) {
  next_keys_ = now + kLookForKeysEvery;
  while (const auto key = terminal_->key()) {
    screen_.press(*key, data_);
    next_write_ = now;
  }
}

void TopView::finish(const InspectTally&, std::string& out) {
  if (terminal_ != nullptr)
    terminal_.reset();
  else
    write(mean_rates(data_.totals), out);
}

void TopView::write(const TrafficRates::Rates& rates, std::string& out) const {
  switch (format_) {
    case Format::text:
      return append_top_text(out, data_, rates);
    case Format::json:
      return append_top_json(out, data_, rates);
    case Format::csv:
      return append_top_csv(out, data_);
  }
}

namespace view {

InspectViewKind top() {
  return {
      "top",
      "one line per entity: rate, reason and jump of its updates (the default, live on a terminal)",
      true, [](const InspectOptions& options, const Console& console) -> std::unique_ptr<View> {
        return std::make_unique<TopView>(options, console);
      }};
}

}  // namespace view
}  // namespace reckon::tools
