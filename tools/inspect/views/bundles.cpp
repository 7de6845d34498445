// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/views/bundles.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/reckon/compressed_states.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_end.hpp"

namespace reckon::tools {
namespace {

// Octets of the states as plain Entity States, relative to the octets of the PDUs that contain
// them.
double ratio(std::size_t states, std::size_t octets) {
  return static_cast<double>(states * pdu::kFixedSize<pdu::EntityState>) /
         static_cast<double>(octets);
}

}  // namespace

void BundlesView::begin(std::string& out) {
  if (format_ == Format::text)
    out += " FRAME       TIME s  OCTETS PDUS PADDING BROKEN  ORDER         TYPES\n";
  if (format_ == Format::csv)
    out += "frame,time,source,group,octets,pdus,pdu_octets,padding,broken_octets,order,types\n";
}

void BundlesView::look(const PduRow& row) {
  ++pdus_;
  (row.status == PduStatus::error ? broken_octets_ : pdu_octets_) += row.bytes.size();
  const std::string_view type = row.type();
  if (runs_.empty() || runs_.back().type != type)
    runs_.push_back({type, 1});
  else
    ++runs_.back().count;
  if (!row.has_header) return;
  if (row.header.pdu_type == pdu::PduType::compressed_states) count_states(row, runs_.back());
  const std::uint8_t rank = pdu::bundle_rank(row.header.pdu_type);
  if (rank < rank_ && order_broken_at_ == 0) order_broken_at_ = row.pdu;
  rank_ = std::max(rank, rank_);
}

// Counts the states that are present, independent of the number in the PDU.
void BundlesView::count_states(const PduRow& row, Run& run) {
  pdu::CompressedStates states;
  if (!row.decoded || pdu::decode(row.bytes, states) != pdu::DecodeError::none) return;
  pdu::CompressedStateReader reader(states);
  for (pdu::CompressedState state; reader.next(state);) ++run.states;
  run.octets += row.bytes.size();
}

void BundlesView::datagram(const peer::SourceDatagram& datagram, std::chrono::nanoseconds start,
                           std::string& out) {
  if (format_ == Format::text) line(datagram, start, out);
  if (format_ == Format::json) json(datagram, out);
  if (format_ == Format::csv) csv(datagram, out);
  skip();
}

void BundlesView::skip() {
  runs_.clear();
  pdus_ = pdu_octets_ = broken_octets_ = order_broken_at_ = 0;
  rank_ = 0;
}

std::size_t BundlesView::padding(const peer::SourceDatagram& datagram) const {
  const std::size_t used = pdu_octets_ + broken_octets_;
  return datagram.bytes.size() > used ? datagram.bytes.size() - used : 0;
}

std::string BundlesView::types() const {
  std::string text;
  for (const Run& run : runs_) {
    if (!text.empty()) text += " + ";
    text += run.type;
    if (run.count > 1) fmt::format_to(end_of(text), " x{}", run.count);
    if (run.states > 0) {
      fmt::format_to(end_of(text), " ({} states, {:.2f} to 1)", run.states,
                     ratio(run.states, run.octets));
    }
  }
  return text;
}

void BundlesView::line(const peer::SourceDatagram& datagram, std::chrono::nanoseconds start,
                       std::string& out) const {
  const double seconds = pdu::to_seconds(datagram.time - start);
  const std::string order =
      order_broken_at_ == 0 ? "kept" : fmt::format("broken at {}", order_broken_at_);
  fmt::format_to(end_of(out), "{:6} {:12.6f} {:7} {:4} {:7} {:6}  {:<13} {}\n", datagram.frame,
                 seconds, datagram.bytes.size(), pdus_, padding(datagram), broken_octets_, order,
                 types());
}

void BundlesView::json(const peer::SourceDatagram& datagram, std::string& out) const {
  JsonObject line(out);
  append_time(line.value("frame", datagram.frame).member("time"), datagram.time);
  line.text("source", datagram.source.text())
      .text("group", datagram.group.text())
      .value("octets", datagram.bytes.size())
      .value("pdus", pdus_)
      .value("pdu_octets", pdu_octets_)
      .value("padding", padding(datagram))
      .value("broken_octets", broken_octets_)
      .text("order", order_broken_at_ == 0 ? "kept" : "broken");
  if (order_broken_at_ != 0) line.value("order_broken_at", order_broken_at_);
  std::vector<std::string_view> types;
  for (const Run& run : runs_) types.insert(types.end(), run.count, run.type);
  line.array("types", types, append_json_string);
  std::size_t states = 0, octets = 0;
  for (const Run& run : runs_) states += run.states, octets += run.octets;
  if (states > 0) {
    line.value("compressed_states", states).decimals("compression", ratio(states, octets), 2);
  }
  line.end("\n");
}

void BundlesView::csv(const peer::SourceDatagram& datagram, std::string& out) const {
  fmt::format_to(end_of(out), "{},", datagram.frame);
  append_time(out, datagram.time);
  fmt::format_to(end_of(out), ",{},{},{},{},{},{},{},{},", datagram.source.text(),
                 datagram.group.text(), datagram.bytes.size(), pdus_, pdu_octets_,
                 padding(datagram), broken_octets_, order_broken_at_ == 0 ? "kept" : "broken");
  append_csv_cell(out, types());
  out += '\n';
}

namespace view {

InspectViewKind bundles() {
  return {"bundles", "one line per datagram", true,
          [](const InspectOptions& options, const Console&) -> std::unique_ptr<View> {
            return std::make_unique<BundlesView>(options.format());
          }};
}

}  // namespace view
}  // namespace reckon::tools
