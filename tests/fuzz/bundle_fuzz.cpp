// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Any octets as a datagram: the bundle reader advances inside it, each row of the inspector refers
// to octets of the datagram, and every view writes a bounded amount of text.
#include <algorithm>
#include <array>
#include <chrono>
#include <concepts>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/zero_length.hpp"
#include "reckon/peer/emissions/emission_table.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"
#include "reckon/tests/fuzz/json_check.hpp"
#include "reckon/tests/fuzz/wire_mutator.hpp"
#include "reckon/tools/captures/pdu_map.hpp"
#include "reckon/tools/emissions/emission_text.hpp"
#include "reckon/tools/inspect/check/check_view.hpp"
#include "reckon/tools/inspect/output/json_lines.hpp"
#include "reckon/tools/inspect/output/text_lines.hpp"
#include "reckon/tools/inspect/views/bundles.hpp"
#include "reckon/tools/inspect/views/haptics.hpp"
#include "reckon/tools/inspect/views/stats.hpp"

namespace reckon::fuzz {
namespace {

using Octets = std::span<const std::byte>;
using namespace std::chrono_literals;
using peer::Portion;
using tools::PduRow;

void check_reader(Octets datagram) {
  std::size_t behind = 0;
  std::size_t index = 0;
  for (const pdu::BundledPdu& pdu : pdu::BundleReader(datagram)) {
    require(pdu.offset >= behind, "two PDUs share an octet");
    require(pdu.offset <= datagram.size() && pdu.bytes.size() <= datagram.size() - pdu.offset,
            "a PDU reaches beyond its datagram");
    require(pdu.bytes.data() == datagram.data() + pdu.offset, "a PDU is not where it is said");
    require(!pdu.bytes.empty() || datagram.empty(), "the reader stands still");
    require(pdu.index == index++, "PDUs are not counted one by one");
    behind = pdu.offset + pdu.bytes.size();
  }
  const Octets rest = datagram.subspan(behind);
  require(rest.size() < 8 && std::ranges::all_of(rest, [](auto o) { return o == std::byte{0}; }),
          "octets that are no padding were passed over");
}

void check_row(const PduRow& row, std::size_t size) {
  require(row.status == tools::status_of(row.rule), "a rule and its status disagree");
  require(row.rule.empty() == row.reason.empty(), "a fault without a reason, or the reverse");
  require(row.fault_offset <= size, "a fault lies outside its datagram");
  require(row.status == tools::PduStatus::ok || row.fault_offset >= row.offset,
          "a fault lies before its PDU");
  require(row.rule.empty() || tools::find_check_rule(row.rule) != nullptr, "a rule is not listed");
}

/// Counts the compressed states that are restored from a datagram; each becomes a plain Entity
/// State. A lenient reader gives all remaining octets to a PDU without a length.
std::size_t compressed_states(Octets received, bool lenient) {
  std::vector<std::byte> datagram(received.begin(), received.end());
  const auto without_length = lenient ? pdu::find_zero_length(datagram) : std::nullopt;
  if (without_length.has_value())
    pdu::set_length(datagram, *without_length,
                    static_cast<std::uint16_t>(datagram.size() - *without_length));
  std::size_t count = 0;
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
    pdu::CompressedStates states;
    if (decode(bundled.bytes, states) != pdu::DecodeError::none) continue;
    pdu::CompressedStateReader reader(states);
    for (pdu::CompressedState one; reader.next(one);) ++count;
  }
  return count;
}

/// Reads every row of the datagram, without text; its heap use is bounded.
void check_rows(const peer::SourceDatagram& datagram, bool lenient) {
  const std::size_t states = compressed_states(datagram.bytes, lenient);
  const HeapMeter heap;
  tools::DatagramInspector inspector(lenient);
  inspector.inspect(datagram, [&](const PduRow& row) {
    check_row(row, datagram.bytes.size());
    return true;
  });
  require(inspector.tally().all_pdus() > 0, "a datagram without a row");
  require(heap.peak() <= heap_bound(datagram.bytes.size()) + 2048 * states,
          "the inspector's rows pass their heap");
}

void check_lines(std::string_view lines, bool json) {
  require(lines.empty() || lines.back() == '\n', "a line has no end");
  while (json && !lines.empty()) {
    const std::size_t end = lines.find('\n');
    require(is_json(lines.substr(0, end)), "a line is no JSON");
    lines.remove_prefix(end + 1);
  }
}

/// Reused texts: allocating them in each run would cost more than all else.
struct Texts {
  std::string json;
  std::string tree;
  std::string tail;
  std::string views;
};
Texts& emptied_texts() {
  static Texts texts;
  for (std::string* text : {&texts.json, &texts.tree, &texts.tail, &texts.views}) text->clear();
  return texts;
}

/// Writes all texts of the inspector about one datagram, row by row.
void check_text(const peer::SourceDatagram& datagram) {
  Texts& texts = emptied_texts();
  tools::DatagramInspector inspector;
  inspector.inspect(datagram, [&](const PduRow& row) {
    tools::append_json_line(texts.json, row, true);
    tools::append_tree(texts.tree, row, true);
    tools::append_tail_line(texts.tail, row, {}, false);
    return true;
  });
  for (const std::string* text : {&texts.json, &texts.tree, &texts.tail}) {
    const std::size_t plain =
        pdu::kFixedSize<pdu::EntityState> * compressed_states(datagram.bytes, false);
    require(text->size() <= text_bound(datagram.bytes.size() + plain),
            "a datagram's text passes its bound");
    check_lines(*text, text == &texts.json);
  }
}

/// Shows a datagram four times in a view with memory: at both ends of the time range of sources,
/// and twice within a second.
void check_view(tools::View& view, peer::SourceDatagram datagram) {
  constexpr std::chrono::nanoseconds kStart{};
  std::string& out = emptied_texts().views;
  tools::DatagramInspector inspector;
  for (const auto time : {-2'147'483'648s, 0s, 1s, 6'000'000'000s}) {
    datagram.time = time;
    view.expect(datagram);
    inspector.inspect(datagram, [&](const PduRow& row) {
      view.look(row);
      view.pdu(datagram, row, kStart, out);
      return true;
    });
    view.datagram(datagram, kStart, out);
  }
  view.finish(inspector.tally(), out);
}

/// Forces are sampled over time, so the time bounds their text, not the datagram.
tools::HapticsView haptics_view() {
  tools::InspectOptions options;
  options.step = 1s;
  return {options, tools::PlotCanvas{}};
}

void check_views(const peer::SourceDatagram& datagram) {
  const std::size_t bound = 4 * text_bound(datagram.bytes.size()) + 65536;
  const std::string& out = emptied_texts().views;
  const auto check = [&](tools::View&& view) {
    check_view(view, datagram);
    require(out.size() <= bound, "a view passes its bound");
    check_lines(out, true);
  };
  check(tools::CheckView(tools::Format::json));
  check(tools::StatsView(tools::Format::json));
  check(tools::BundlesView(tools::Format::json));
  tools::HapticsView haptics = haptics_view();
  check_view(haptics, datagram);
}

/// Maps IDs and shifts the place: no octet is added or lost, and a valid PDU stays valid.
void check_map(Octets octets) {
  static const tools::IdMap ids({"*:*:*=300:2:*"});
  static const tools::PlaceShift shift(deadreckon::LocalFrame(0.8, 0.2, 500),
                                       deadreckon::LocalFrame(-0.6, 2.9, 0));
  std::vector<std::byte> copy(octets.begin(), octets.end());
  for (const pdu::BundledPdu& pdu : pdu::BundleReader(copy)) {
    if (pdu.error != pdu::DecodeError::none) continue;
    const std::span<std::byte> whole = std::span(copy).subspan(pdu.offset, pdu.bytes.size());
    const tools::MappedPdu done = tools::map_pdu(whole, pdu.header, ids, &shift, false);
    require(pdu::visit(whole, pdu.header, [](const auto&) {}) == done.error,
            "a mapped PDU is no longer what it was");
  }
}

/// The table of emitters keeps its size and writes lines of JSON.
void check_emissions(Octets octets) {
  constexpr std::size_t kRows = 24;
  peer::EmissionTable table(kRows);
  std::string& lines = emptied_texts().views;
  for (const auto time : {-2'147'483'648s, 0s, 1s, 6'000'000'000s}) {
    for (const pdu::BundledPdu& pdu : pdu::BundleReader(octets))
      table.take(pdu.bytes, {.now = time});
    require(table.rows().size() <= kRows, "the table of emitters passes its bound");
    for (const peer::Emission& emission : table.rows()) {
      tools::append_emission_json(lines, emission, 0s, time);
      lines += '\n';
    }
  }
  check_lines(lines, true);
}

}  // namespace

void check(std::span<const std::byte> octets) {
  check_reader(octets);
  check_map(octets);
  peer::SourceDatagram datagram;
  datagram.frame = 1;
  datagram.bytes = octets;
  for (const auto portion : {Portion::first_fragment, Portion::later_fragment, Portion::cut}) {
    datagram.portion = portion;
    check_rows(datagram, false);
  }
  datagram.portion = Portion::whole;
  check_rows(datagram, false);
  check_rows(datagram, true);
  check_text(datagram);
  check_views(datagram);
  check_emissions(octets);
}

}  // namespace reckon::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  size = LLVMFuzzerMutate(data, size, max_size);
  const std::span octets = std::as_writable_bytes(std::span(data, size));
  if (seed % 4 != 0) reckon::fuzz::repair_last_length(octets);
  return size;
}
