// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/check/check_view.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "reckon/pdu/entity/attribute.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/inspect/output/text_lines.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_end.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

constexpr std::size_t kTimestampAt = 4;  // in the header
constexpr double kLeastDegrees = 1.0;    // smallest turn reported with a jump

/// For a code of the codec without a row, so that it is reported too.
constexpr CheckRule kUnlisted{"E-UNLISTED", "The codec refused the PDU.", "inspect these octets"};

const CheckRule& rule_of(std::string_view code) {
  const CheckRule* rule = find_check_rule(code);
  return rule != nullptr ? *rule : kUnlisted;
}

bool has_force_model(const pdu::AttributeSet& set) {
  for (const pdu::AttributeRecord& record : set.records()) {
    if (record.type == pdu::HapticRecord::kType) return true;
  }
  return false;
}

void append_rules_text(std::string& out) {
  for (const CheckRule& rule : check_rules())
    fmt::format_to(end_of(out), "{:<21}  {}\n{:<21}  fix: {}\n", rule.code, rule.sentence, "",
                   rule.remedy);
}

void append_rule_json(const CheckRule& rule, std::string& out) {
  JsonObject(out)
      .text("rule", rule.code)
      .text("status", name(status_of(rule.code)))
      .text("sentence", rule.sentence)
      .text("remedy", rule.remedy)
      .end("\n");
}

void append_rule_csv(const CheckRule& rule, std::string& out) {
  fmt::format_to(end_of(out), "{},{},", rule.code, name(status_of(rule.code)));
  append_csv_cell(out, rule.sentence);
  out += ',';
  append_csv_cell(out, rule.remedy);
  out += '\n';
}

}  // namespace

void append_check_rules(Format format, std::string& out) {
  if (format == Format::text) return append_rules_text(out);
  if (format == Format::csv) out += "rule,status,sentence,remedy\n";
  for (const CheckRule& rule : check_rules())
    format == Format::json ? append_rule_json(rule, out) : append_rule_csv(rule, out);
}

void CheckView::begin(std::string& out) {
  if (format_ == Format::csv) out += "rule,frame,pdu,offset,at,time,id,reason,remedy\n";
}

void CheckView::expect(const peer::SourceDatagram& datagram) {
  survey_.look_at(datagram.bytes);
  highest_rank_ = 0;
  if (!first_time_.has_value()) first_time_ = datagram.time;
  last_time_ = std::max(last_time_, datagram.time);
}

void CheckView::pdu(const peer::SourceDatagram& datagram, const PduRow& row,
                    std::chrono::nanoseconds, std::string& out) {
  if (!row.rule.empty() && !is_reported_type(row))
    tell({rule_of(row.rule), row.frame, row.pdu, row.offset, row.fault_offset, row.time, row.id,
          row.reason},
         out);
  const bool is_finite = row.rule != pdu::rule(pdu::DecodeError::not_finite);
  if (row.decoded && row.status <= PduStatus::warning && is_finite) {
    CheckedPdu checked{row, datagram, survey_, highest_rank_, row.entity_state, nullptr};
    EntityMemory* memory = nullptr;
    if (row.entity_state != nullptr) {
      memory = memory_of(row, *row.entity_state);
      checked.memory = memory;
      if (memory == nullptr && !reported_limit_) {
        reported_limit_ = true;
        tell({rule_of(kMemoryRule), row.frame, row.pdu, row.offset, row.offset, row.time, row.id,
              fmt::format("the table is full with {} entities, without this one", most_entities_)},
             out);
      }
    }
    check_pdu(checked, out);
    if (memory != nullptr) {
      check_stamp(*memory, row, out);
      remember(*memory, checked);
    }
    if (row.header.pdu_type == pdu::PduType::attribute) look_at_attribute(row);
    jumps_.take_pdu(row, datagram, [&](const Jump& jump) { tell_jump(jump, out); });
  }
  if (row.has_header)
    highest_rank_ = std::max(highest_rank_, pdu::bundle_rank(row.header.pdu_type));
}

void CheckView::datagram(const peer::SourceDatagram& datagram, std::chrono::nanoseconds,
                         std::string&) {
  copies_.look_at(datagram);
}

bool CheckView::is_reported_type(const PduRow& row) {
  if (row.rule == kForeignRule) return std::exchange(reported_foreign_, true);
  if (row.rule != pdu::rule(pdu::DecodeError::unknown_type)) return false;
  return std::exchange(reported_types_[static_cast<std::size_t>(row.header.pdu_type)], true);
}

EntityMemory* CheckView::memory_of(const PduRow& row, const pdu::EntityState& pdu) {
  const std::uint64_t key = entity_key(row.header.exercise_id, pdu.entity_id);
  const auto known = entities_.find(key);
  if (known != entities_.end()) return &known->second;
  return entities_.size() < most_entities_ ? &entities_[key] : nullptr;
}

void CheckView::check_pdu(const CheckedPdu& checked, std::string& out) {
  for (const CheckRule& rule : check_rules()) {
    if (rule.look == nullptr) continue;
    const auto fault = rule.look(checked);
    if (!fault.has_value()) continue;
    const PduRow& row = checked.row;
    tell({rule, row.frame, row.pdu, row.offset, row.offset + fault->offset, row.time, row.id,
          fault->reason, std::nullopt, fault->degrees},
         out);
  }
}

void CheckView::check_stamp(EntityMemory& memory, const PduRow& row, std::string& out) {
  if (memory.gone) memory.stamps = {};
  const auto found = memory.stamps.take(row.header.timestamp, row.time);
  if (!found.has_value()) return;
  tell({rule_of(found->rule), row.frame, row.pdu, row.offset, row.offset + kTimestampAt, row.time,
        row.id, found->reason},
       out);
}

void CheckView::look_at_attribute(const PduRow& row) {
  pdu::Attribute attribute;
  if (decode(row.bytes, attribute) != pdu::DecodeError::none) return;
  for (const pdu::AttributeSet& set : pdu::AttributeReader(attribute)) {
    const auto known = entities_.find(entity_key(row.header.exercise_id, set.entity_id));
    if (known != entities_.end() && has_force_model(set)) known->second.haptic = true;
  }
}

void CheckView::tell_jump(const Jump& jump, std::string& out) {
  const double at = pdu::to_seconds(jump.time - first_time_.value_or(jump.time));
  std::string_view code = jump.kind == Jump::Kind::spike ? kSpikeRule : kTeleportRule;
  std::string reason;
  if (jump.kind == Jump::Kind::by_turns) {
    code = kDuplicateRule;
    reason = fmt::format("{} alternates between two positions, {} apart, from one sender",
                         id_text(jump.id), distance_text(jump.metres));
  } else {
    reason = fmt::format("{} at {:.3f} s{}; its motion explains {} in {:.3g} s",
                         distance_text(jump.metres), at,
                         jump.kind == Jump::Kind::spike ? ", back with the next update" : "",
                         distance_text(jump.explained), jump.interval);
    if (jump.degrees >= kLeastDegrees) reason += fmt::format("; turned {:.3g} deg", jump.degrees);
  }
  const bool has_size = jump.kind != Jump::Kind::by_turns;
  const std::size_t field = jump.is_entity_state ? kLocationAt : 0;
  tell({rule_of(code), jump.frame, jump.pdu, jump.offset, jump.offset + field, jump.time, jump.id,
        reason, has_size ? std::optional(jump.metres) : std::nullopt,
        has_size ? std::optional(jump.degrees) : std::nullopt},
       out);
}

void CheckView::tell(const Finding& finding, std::string& out) {
  ++counts_[finding.rule.code];
  if (format_ == Format::text) text(finding, out);
  if (format_ == Format::json) json(finding, out);
  if (format_ == Format::csv) csv(finding, out);
}

void CheckView::text(const Finding& finding, std::string& out) const {
  const std::string_view code = finding.rule.code;
  fmt::format_to(end_of(out), FMT_COMPILE("frame {:<5} PDU {:<2} +{:<5} "), finding.frame,
                 finding.pdu, finding.at);
  if (colour_) out += colour_of(status_of(code));
  fmt::format_to(end_of(out), FMT_COMPILE("{:<21}"), code);
  if (colour_) out += "\x1b[0m";
  fmt::format_to(end_of(out), FMT_COMPILE("  {:<11}  {}\n"),
                 finding.id.has_value() ? id_text(*finding.id) : "-", finding.reason);
}

void CheckView::json(const Finding& finding, std::string& out) const {
  JsonObject line(out);
  line.text("rule", finding.rule.code)
      .text("status", name(status_of(finding.rule.code)))
      .value("frame", finding.frame)
      .value("pdu", finding.pdu)
      .value("offset", finding.offset)
      .value("at", finding.at);
  append_time(line.member("time"), finding.time);
  if (finding.id.has_value()) line.text("id", id_text(*finding.id));
  if (finding.metres.has_value()) line.decimals("metres", *finding.metres, 3);
  if (finding.degrees.has_value()) line.decimals("degrees", *finding.degrees, 3);
  line.text("reason", finding.reason)
      .text("sentence", finding.rule.sentence)
      .text("remedy", finding.rule.remedy)
      .end("\n");
}

void CheckView::csv(const Finding& finding, std::string& out) const {
  fmt::format_to(end_of(out), FMT_COMPILE("{},{},{},{},{},"), finding.rule.code, finding.frame,
                 finding.pdu, finding.offset, finding.at);
  append_time(out, finding.time);
  fmt::format_to(end_of(out), ",{},", finding.id.has_value() ? id_text(*finding.id) : "");
  append_csv_cell(out, finding.reason);
  out += ',';
  append_csv_cell(out, finding.rule.remedy);
  out += '\n';
}

void CheckView::finish(const InspectTally& tally, std::string& out) {
  jumps_.finish([&](const Jump& jump) { tell_jump(jump, out); });
  report_entities(out);
  report_copies(out);
  if (format_ != Format::csv) summary(tally, out);
}

void CheckView::tell_last(const EntityMemory& memory, std::string_view code, std::size_t field,
                          std::string_view reason, std::string& out) {
  tell({rule_of(code), memory.frame, memory.pdu, memory.offset, memory.offset + field, memory.time,
        memory.id, reason},
       out);
}

void CheckView::report_entities(std::string& out) {
  std::vector<const EntityMemory*> all;
  for (const auto& [key, memory] : entities_) all.push_back(&memory);
  std::sort(all.begin(), all.end(), [](const EntityMemory* a, const EntityMemory* b) {
    return std::pair(a->frame, a->pdu) < std::pair(b->frame, b->pdu);
  });
  for (const EntityMemory* memory : all) {
    if (const auto found = memory->stamps.finish())
      tell_last(*memory, found->rule, kTimestampAt, found->reason, out);
    if (const auto clause = silence(*memory, last_time_))
      tell_last(*memory, kHeartbeatRule, 0, *clause + ", until the end", out);
  }
}

void CheckView::report_copies(std::string& out) {
  if (copies_.copies() == 0) return;
  const CopySearch::Copy& first = copies_.first();
  tell({rule_of(kCopiesRule), first.frame, 1, 0, 0, first.time, std::nullopt,
        fmt::format("{} of {} datagrams are copies; the first repeats frame {} after {:.3f} ms",
                    copies_.copies(), copies_.datagrams(), first.original,
                    1e3 * pdu::to_seconds(first.later))},
       out);
}

std::uint64_t CheckView::count(PduStatus status) const {
  std::uint64_t sum = 0;
  for (const auto& [code, count] : counts_) sum += status_of(code) == status ? count : 0;
  return sum;
}

void CheckView::summary(const InspectTally& tally, std::string& out) const {
  if (format_ == Format::json) {
    JsonObject line(out);
    line.text("summary", "check")
        .value("datagrams", tally.datagrams)
        .value("pdus", tally.all_pdus())
        .value("errors", count(PduStatus::error))
        .value("warnings", count(PduStatus::warning))
        .value("notes", count(PduStatus::note));
    JsonObject rules(line.member("rules"));
    for (const auto& [code, count] : counts_) rules.value(code, count);
    rules.end();
    line.end("\n");
    return;
  }
  if (!counts_.empty()) out += '\n';
  for (const CheckRule& rule : check_rules()) {
    const auto found = counts_.find(rule.code);
    if (found == counts_.end()) continue;
    fmt::format_to(end_of(out), "{:6} x {:<21}  {}\n{:32}fix: {}\n", found->second, rule.code,
                   rule.sentence, "", rule.remedy);
  }
  fmt::format_to(end_of(out), "{}{} in {}: {}, {}, {}\n", counts_.empty() ? "" : "\n",
                 counted(tally.all_pdus(), "PDU"), counted(tally.datagrams, "datagram"),
                 counted(count(PduStatus::error), "error"),
                 counted(count(PduStatus::warning), "warning"),
                 counted(count(PduStatus::note), "note"));
}

namespace view {

InspectViewKind check() {
  return {"check", "errors with remedies", true,
          [](const InspectOptions& options, const Console& console) -> std::unique_ptr<View> {
            return std::make_unique<CheckView>(options.format(), console.colour);
          }};
}

}  // namespace view
}  // namespace reckon::tools
