// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/pdu_stream.hpp"

#include <algorithm>
#include <span>
#include <string_view>

#include "reckon/pdu/codec/enumerations.hpp"
#include "reckon/pdu/type_names.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/datagrams/bounded_time.hpp"
#include "reckon/tools/datagrams/source.hpp"

namespace reckon::tools {
namespace {

/// Octets of a PDU with its send time.
struct TimeField {
  std::size_t at = 0;
  std::size_t size = 0;
};

constexpr TimeField kHeaderTime{4, 4};

TimeField own_time(pdu::PduType type) {
  if (type == pdu::PduType::datagram_trailer) return {20, 4};
  if (type == pdu::PduType::presence) return {32, 8};
  return {};
}

void blank(std::vector<std::byte>& octets, TimeField field) {
  if (field.at + field.size > octets.size()) return;
  std::fill_n(octets.begin() + static_cast<std::ptrdiff_t>(field.at), field.size, std::byte{0});
}

std::vector<std::byte> without_time(const HeldPdu& pdu) {
  std::vector<std::byte> octets = pdu.octets;
  if (!pdu.has_header) return octets;
  blank(octets, kHeaderTime);
  blank(octets, own_time(pdu.header.pdu_type));
  return octets;
}

std::uint64_t hash_of(std::span<const std::byte> octets) {
  return std::hash<std::string_view>{}(
      {reinterpret_cast<const char*>(octets.data()), octets.size()});
}

}  // namespace

std::string_view HeldPdu::type() const noexcept {
  return has_header ? pdu::snake_name(header.pdu_type) : "unreadable";
}

bool same_octets(const HeldPdu& a, const HeldPdu& b, bool ignore_time) {
  if (a.hash != b.hash || a.octets.size() != b.octets.size()) return false;
  return ignore_time ? without_time(a) == without_time(b) : a.octets == b.octets;
}

PduStream::PduStream(const PduStreamOptions& options)
    : ignore_time_(options.ignore_time), inspector_(options.lenient) {
  if (!options.where.empty()) filter_.emplace(options.where);
  SourceChoice choice;
  choice.source = options.path;
  if (means_groups(choice) || options.path == "-" || options.path.starts_with("iface:"))
    throw UsageError("'" + options.path +
                     "' is not a file, and diff reads it twice; record it first (reckon record)");
  source_ = open_chosen_source(choice);
}

bool PduStream::next(HeldPdu& out) {
  while (queue_.empty())
    if (!read_datagram()) return false;
  out = std::move(queue_.front());
  queue_.pop_front();
  return true;
}

bool PduStream::read_datagram() {
  peer::SourceDatagram datagram;
  peer::SourceEvent event = peer::SourceEvent::nothing_yet;
  while (event == peer::SourceEvent::nothing_yet)
    event = source_->next(datagram, std::chrono::nanoseconds::zero());
  if (event == peer::SourceEvent::end) return false;
  (void)inspector_.inspect(datagram, [&](const PduRow& row) {
    if (!filter_.has_value() || filter_->matches(row, datagram)) hold(row);
    return true;
  });
  if (!queue_.empty()) queue_.back().ends_datagram = true;
  return true;
}

void PduStream::hold(const PduRow& row) {
  HeldPdu& held = queue_.emplace_back();
  held.octets.assign(row.bytes.begin(), row.bytes.end());
  held.frame = row.frame;
  held.pdu = row.pdu;
  held.offset = row.offset;
  held.time = bounded_time(row.time);
  held.header = row.header;
  held.has_header = row.has_header;
  held.decoded = row.decoded;
  held.id = row.id;
  held.hash = ignore_time_ ? hash_of(without_time(held)) : hash_of(held.octets);
}

}  // namespace reckon::tools
