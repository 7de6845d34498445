// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/body_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

auto awake_of(const haptics::BodyWorld& bodies) {
  return std::ranges::count_if(bodies.states(), &haptics::BodyState::awake);
}

constexpr std::size_t kMostOwners = 4;  // named; the others are counted

using OwnerCounts = std::vector<std::pair<std::string, std::size_t>>;  // the most bodies first

OwnerCounts counts_of(std::span<const peer::BodyOwnerView> bodies, bool is_alone) {
  std::map<std::string, std::size_t> counts;
  for (const peer::BodyOwnerView& body : bodies) {
    const pdu::SimulationAddress& owner = body.owner;
    if (body.is_ours && is_alone)
      ++counts["ours"];
    else if (owner == pdu::SimulationAddress{})
      ++counts["without an owner"];
    else
      ++counts[fmt::format("of {}:{}", owner.site, owner.application)];
  }
  OwnerCounts sorted(counts.begin(), counts.end());
  std::ranges::stable_sort(sorted, std::ranges::greater{}, &OwnerCounts::value_type::second);
  return sorted;
}

}  // namespace

std::string owners_text(const peer::PeerView& view, bool is_alone) {
  const auto bodies = std::span(view.body_owners).first(view.body_owner_count);
  if (bodies.empty()) return {};
  const OwnerCounts counts = counts_of(bodies, is_alone);
  std::string text = fmt::format("{}: ", bodies.size());
  std::size_t rest = bodies.size();
  for (const auto& [owner, count] : std::span(counts).first(std::min(counts.size(), kMostOwners))) {
    text += fmt::format("{}{} {}", rest == bodies.size() ? "" : ", ", count, owner);
    rest -= count;
  }
  if (rest > 0) text += fmt::format(", {} of others", rest);
  std::uint64_t changes = 0;
  for (const peer::BodyOwnerView& body : bodies) changes += body.changes;
  text += fmt::format("; {}", counted(changes, "hand-over"));
  return view.bodies_rest ? text + "; REST" : text;
}

void print_bodies(std::FILE* out, const haptics::BodyWorld* bodies) {
  if (bodies == nullptr) return;
  fmt::print(out,
             "  bodies                     {} move, {} awake at the end; {:.1e} J added by the "
             "solver and removed\n",
             bodies->states().size(), awake_of(*bodies), bodies->taken_out());
  if (bodies->approximated() > 0 || bodies->coarse() > 0)
    fmt::print(out,
               "                             {} steps by the iterative solver; {} periods of a "
               "hand with the reduced prediction\n",
               bodies->approximated(), bodies->coarse());
  if (bodies->pace() != 1.0)
    fmt::print(
        out,
        "                             pace {:.2f}: time of this host for the same work, over "
        "that of the reference host\n",
        bodies->pace());
  if (bodies->crowded() > 0)
    fmt::print(out,
               "                             in {} steps a body stayed at rest, because 64 (the "
               "most) were moving\n",
               bodies->crowded());
}

std::string bodies_json(const haptics::BodyWorld* bodies) {
  if (bodies == nullptr) return R"(,"bodies":null)";
  return fmt::format(
      R"(,"bodies":{{"moving":{},"awake":{},"taken_out_j":{:.6g},"approximated_steps":{},"coarse_periods":{},"not_woken":{},"counted_work_s":{:.6g},"pace":{:.4g}}})",
      bodies->states().size(), awake_of(*bodies), bodies->taken_out(), bodies->approximated(),
      bodies->coarse(), bodies->crowded(), bodies->work(), bodies->pace());
}

}  // namespace reckon::tools
