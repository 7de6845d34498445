// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "reckon/pdu/codec/enumerations.hpp"
#include "reckon/pdu/type_names.hpp"
#include "reckon/peer/notation/nearest_word.hpp"
#include "reckon/tools/datagrams/source.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

peer::GroupAddress parse_group(std::string_view text) {
  constexpr std::string_view kUdp = "udp://";
  std::string_view address = text;
  if (address.starts_with(kUdp)) address.remove_prefix(kUdp.size());
  const auto group = peer::IpEndpoint::parse(address);
  if (!group.has_value())
    throw UsageError(
        fmt::format("--group {}: not an address; write 239.192.1.0 or 239.192.1.0:3000, as `reckon "
                    "info` lists it",
                    text));
  return *group;
}

std::string checked_type(const std::string& text) {
  std::vector<std::string_view> names;
  for (unsigned number = 0; number < 256; ++number) {
    const std::string_view name = pdu::snake_name(static_cast<pdu::PduType>(number));
    if (!name.empty()) names.push_back(name);
  }
  if (std::find(names.begin(), names.end(), text) != names.end() || text.starts_with("unknown_"))
    return text;
  const std::string_view nearest = peer::nearest_word(text, names);
  throw UsageError(
      fmt::format("--type {}: not a PDU type{}; `reckon info` lists the types in a capture", text,
                  nearest.empty() ? std::string() : fmt::format(", did you mean '{}'?", nearest)));
}

}  // namespace

void SelectionOptions::declare(CommandLine& line) {
  line.option("--from", from, "start this long after the first datagram, for example 90s");
  line.option("--group", groups, "only datagrams sent to this address; repeatable");
  line.option("--type", types,
              "only datagrams with a PDU of this type, for example entity_state; repeatable");
  line.option("--entity", entities,
              "only datagrams with a PDU of this entity, for example 1:2:3 or 1:*:*; repeatable");
  declare_filter(line);
}

void SelectionOptions::declare_filter(CommandLine& line) {
  line.option("--where", where,
              "only datagrams with a PDU that matches, for example 'kind == platform and side == "
              "opposing'; `reckon inspect --help` lists the fields");
  line.flag(
      "--lenient", lenient,
      "read a PDU whose length field is 0 as the rest of its datagram; output stays unchanged");
}

void declare_lenient(CommandLine& line, bool& lenient) {
  line.flag("--lenient", lenient,
            "read a length field of 0 as the rest of the datagram; keep and note octets after the "
            "last PDU or its last field");
}

CaptureSelection::CaptureSelection(const SelectionOptions& options)
    : from_(options.from), to_(options.to), inspector_(options.lenient) {
  if (to_.has_value() && *to_ <= from_.value_or(nanoseconds(0)))
    throw UsageError("the range is empty: it ends before it begins; give a later end than --from");
  for (const std::string& text : options.groups) groups_.push_back(parse_group(text));
  for (const std::string& text : options.types) types_.push_back(checked_type(text));
  for (const std::string& text : options.entities) entities_.push_back(parse_entity(text));
  if (!options.where.empty()) filter_.emplace(options.where);
}

CaptureSelection::EntityPattern CaptureSelection::parse_entity(const std::string& text) {
  EntityPattern pattern;
  std::string_view rest = text;
  bool good = std::count(text.begin(), text.end(), ':') == 2;
  for (auto& part : pattern) {
    const std::string_view word = rest.substr(0, rest.find(':'));
    rest.remove_prefix(std::min(word.size() + 1, rest.size()));
    if (word == "*") continue;
    std::uint16_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    good = good && error == std::errc{} && end == word.data() + word.size();
    part = number;
  }
  if (!good)
    throw UsageError(fmt::format(
        "--entity {}: write site:application:entity, each 0 to 65535 or *, for example 1:2:*",
        text));
  return pattern;
}

bool CaptureSelection::takes(const peer::SourceDatagram& datagram) {
  return in_range(datagram.time) && in_groups(datagram.group) && has_wanted_pdu(datagram);
}

bool CaptureSelection::in_range(nanoseconds time) {
  if (!origin_.has_value()) {
    origin_ = time;
    inspector_.start_at(time);
  }
  const nanoseconds since = time - *origin_;
  return (!from_.has_value() || since >= *from_) && (!to_.has_value() || since < *to_);
}

bool CaptureSelection::in_groups(const peer::GroupAddress& group) const {
  const auto matches = [&](peer::GroupAddress wanted) {
    if (wanted.port == 0) wanted.port = group.port;
    return wanted == group;
  };
  return groups_.empty() || std::any_of(groups_.begin(), groups_.end(), matches);
}

bool CaptureSelection::has_wanted_pdu(const peer::SourceDatagram& datagram) {
  if (types_.empty() && entities_.empty() && !filter_.has_value()) return true;
  return !inspector_.inspect(datagram,
                             [&](const PduRow& row) { return !is_wanted(row, datagram); });
}

bool CaptureSelection::is_wanted(const PduRow& row, const peer::SourceDatagram& datagram) const {
  const auto is_entity = [&](const EntityPattern& pattern) {
    if (!row.id.has_value()) return false;
    return pattern[0].value_or(row.id->site) == row.id->site &&
           pattern[1].value_or(row.id->application) == row.id->application &&
           pattern[2].value_or(row.id->entity) == row.id->entity;
  };
  const bool type =
      types_.empty() || std::find(types_.begin(), types_.end(), row.type()) != types_.end();
  return type &&
         (entities_.empty() || std::any_of(entities_.begin(), entities_.end(), is_entity)) &&
         (!filter_.has_value() || filter_->matches(row, datagram));
}

std::unique_ptr<peer::DatagramSource> open_recording(const std::string& name) {
  const SourceChoice choice{name, {}, {}};
  if (means_groups(choice) || name.starts_with("iface:"))
    throw UsageError(fmt::format(
        "'{}' is live, and this needs a file; `reckon record FILE {}` makes one", name, name));
  return open_chosen_source(choice);
}

void settle_compression(peer::CaptureWriterOptions& options) {
  constexpr std::string_view kZstd = ".zst";
  if (options.path.ends_with(kZstd))
    options.compress = true;
  else if (options.compress)
    options.path += kZstd;
}

std::unique_ptr<peer::CaptureWriter> create_recording(const peer::CaptureWriterOptions& options) {
  try {
    return std::make_unique<peer::CaptureWriter>(options);
  } catch (const peer::CaptureWriteError& error) {
    throw UsageError(error.what());
  }
}

std::string damage_text(const peer::SourceReport& report) {
  std::string text;
  const auto add = [&](std::uint64_t count, std::string_view noun, std::string_view rest) {
    if (count == 0) return;
    text += fmt::format("{}{}{}", text.empty() ? "" : "; ", counted(count, noun), rest);
  };
  add(report.fragments.lost, "datagram", " with missing IP fragments");
  add(report.fragments.overlapping, "datagram", " refused, its IP fragments overlap");
  add(report.fragments.late, "IP fragment", " too late");
  add(report.cut, "frame", " cut by the capture");
  add(report.malformed, "frame", " with a broken IP or UDP header");
  if (!report.problem.empty()) text += (text.empty() ? "" : "; ") + report.problem;
  return text;
}

}  // namespace reckon::tools
