// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Any text as a filter of --where: it compiles or throws FilterError with a column inside the text,
// in bounded memory. A compiled filter matches every kind of row without fault, the same each time,
// and its negation matches the other rows.
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/pdu_types.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"
#include "reckon/tools/datagrams/filter.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"

namespace reckon::fuzz {
namespace {

using tools::Filter;
using tools::PduRow;

/// The rows to filter, made once; rows refer to the octets of their datagrams.
class Subjects {
 public:
  Subjects() {
    // One PDU of every type, and four datagrams without a PDU.
    octets_ = {{}, {std::byte{7}}, std::vector<std::byte>(40), std::vector<std::byte>(9)};
    add_all(pdu::PduTypes{});
    for (std::size_t i = 0; i < octets_.size(); ++i) look_at(i);
  }

  [[nodiscard]] std::vector<bool> matches(const Filter& filter) const {
    std::vector<bool> answers;
    for (const auto& [row, datagram] : rows_) answers.push_back(filter.matches(row, datagram));
    return answers;
  }

 private:
  struct Subject {
    PduRow row;
    peer::SourceDatagram datagram;
  };

  template <typename... T>
  void add_all(pdu::TypeList<T...>) {
    const auto add = [&](const auto& pdu) {
      auto& octets = octets_.emplace_back(wire_size(pdu));
      require(encode(pdu, octets) == octets.size(), "a PDU as newly made cannot be encoded");
    };
    (add(T{}), ...);
  }
  void look_at(std::size_t i) {
    peer::SourceDatagram datagram;
    datagram.frame = i + 1;
    datagram.bytes = octets_[i];
    if (i == 3) datagram.portion = peer::Portion::later_fragment;
    inspectors_.emplace_back().inspect(datagram, [&](const PduRow& row) {
      rows_.push_back({row, datagram});
      return true;
    });
  }

  std::vector<std::vector<std::byte>> octets_;
  std::deque<tools::DatagramInspector> inspectors_;  // one per datagram: its row points into it
  std::vector<Subject> rows_;
};

std::vector<bool> matches(const Filter& filter) {
  static const Subjects kSubjects;
  return kSubjects.matches(filter);
}

std::optional<Filter> compile(std::string_view text) {
  const HeapMeter heap;
  std::optional<Filter> filter;
  try {
    filter.emplace(text);
  } catch (const tools::FilterError& error) {
    require(error.column >= 1 && error.column <= text.size() + 1, "a column outside the text");
    require(std::string_view(error.what()).size() <= 3 * text.size() + 1024, "a long sentence");
  }
  require(heap.peak() <= 128 * text.size() + 16384, "a filter passes its heap");
  return filter;
}

}  // namespace

void check(std::span<const std::byte> input) {
  const std::string_view text = text_of(input);
  const auto filter = compile(text);
  if (!filter) return;
  require(text.size() <= Filter::kLongest, "a filter longer than the limit was taken");
  std::vector<bool> answers = matches(*filter);
  require(answers == matches(*filter), "a filter changed its mind");

  // The negation is longer and deeper by one, so it may exceed those limits.
  const auto negation = compile("not (" + std::string(text) + ")");
  if (!negation) return;
  answers.flip();
  require(answers == matches(*negation), "a filter and its negation agree");
}

}  // namespace reckon::fuzz
