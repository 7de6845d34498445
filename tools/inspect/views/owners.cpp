// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The view `owners`: one line for each change of a body's owner, as its states name them.
#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/datagrams/ownership_text.hpp"
#include "reckon/tools/datagrams/survey.hpp"
#include "reckon/tools/inspect/output/format.hpp"
#include "reckon/tools/inspect/output/view.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_end.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

/// A state of an older version is late, and changes nothing.
class OwnersView final : public View {
 public:
  explicit OwnersView(Format format) : format_(format) {}

  void begin(std::string& out) override {
    if (format_ == Format::text)
      out += " FRAME       TIME s  BODY              FROM         TO           VERSION  CAUSE\n";
    if (format_ == Format::csv) out += "frame,time,body,from,to,version,cause\n";
  }
  // Peers state their addresses with their epochs.
  void look(const PduRow& row) override {
    if (!row.decoded) return;
    (void)pdu::visit(row.bytes, row.header, [&](const auto& pdu) {
      if constexpr (requires {
                      pdu.simulation;
                      pdu.epoch;
                    })
        if (addresses_.size() < kMostPeers) addresses_[pdu.epoch] = pdu.simulation;
    });
  }
  void pdu(const peer::SourceDatagram&, const PduRow& row, std::chrono::nanoseconds start,
           std::string& out) override {
    pdu::Attribute attribute;
    if (!row.decoded || row.header.pdu_type != pdu::PduType::attribute ||
        decode(row.bytes, attribute) != pdu::DecodeError::none)
      return;
    for (const pdu::AttributeSet& set : pdu::AttributeReader(attribute)) {
      for (const pdu::AttributeRecord& record : set.records()) {
        pdu::OwnershipRecord owner;
        if (decode(record, owner) == pdu::DecodeError::none)
          take(row, set.entity_id, owner, row.time - start, out);
      }
    }
  }
  void finish(const InspectTally&, std::string& out) override {
    if (format_ == Format::text) out += fmt::format("{} of owner\n", counted(changes_, "change"));
  }

 private:
  static constexpr std::size_t kMostPeers = 65'536, kMostBodies = 65'536;

  void take(const PduRow& row, pdu::EntityId body, const pdu::OwnershipRecord& owner,
            std::chrono::nanoseconds time, std::string& out) {
    const std::uint64_t key = entity_key(row.header.exercise_id, body);
    if (bodies_.size() >= kMostBodies && !bodies_.contains(key)) return;
    const auto [known, is_first] = bodies_.try_emplace(key, owner);
    const pdu::OwnershipRecord last = known->second;
    if (!is_first && owner.version <= last.version) return;
    known->second = owner;
    if (!is_first && owner.owner == last.owner) return;
    ++changes_;
    write(row, body, is_first ? "-" : name_of(last.owner), owner, time, out);
  }
  void write(const PduRow& row, pdu::EntityId body, const std::string& from,
             const pdu::OwnershipRecord& owner, std::chrono::nanoseconds time, std::string& out) {
    const std::string to = name_of(owner.owner), version = version_text(owner.version);
    const std::string_view cause = cause_text(owner.version);
    if (format_ == Format::text) {
      fmt::format_to(end_of(out), "{:6} {:12.6f}  {:<16}  {:<12} {:<12} {:<8} {}\n", row.frame,
                     pdu::to_seconds(time), id_text(body), from, to, version, cause);
    } else if (format_ == Format::json) {
      JsonObject line(out);
      append_time(line.value("frame", row.frame).member("time"), row.time);
      line.text("body", id_text(body)).text("from", from).text("to", to);
      line.text("version", version).text("cause", cause).end("\n");
    } else {
      fmt::format_to(end_of(out), "{},", row.frame);
      append_time(out, row.time);
      fmt::format_to(end_of(out), ",{},{},{},{},{}\n", id_text(body), from, to, version, cause);
    }
  }
  /// Its address, if it has stated it; else its epoch.
  [[nodiscard]] std::string name_of(std::uint32_t epoch) const {
    const auto found = addresses_.find(epoch);
    if (found == addresses_.end()) return fmt::format("{:08x}", epoch);
    return fmt::format("{}:{}", found->second.site, found->second.application);
  }

  Format format_;
  std::unordered_map<std::uint32_t, pdu::SimulationAddress> addresses_;  // by epoch
  std::unordered_map<std::uint64_t, pdu::OwnershipRecord> bodies_;       // by entity_key
  std::uint64_t changes_ = 0;
};

}  // namespace

namespace view {

InspectViewKind owners() {
  return {"owners", "one line per change of a body's owner: who had it, who has it, and why", true,
          [](const InspectOptions& options, const Console&) -> std::unique_ptr<View> {
            return std::make_unique<OwnersView>(options.format());
          }};
}

}  // namespace view
}  // namespace reckon::tools
