// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/ownership_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <variant>
#include <vector>

#include "reckon/pdu/reckon/assured_record.hpp"
#include "reckon/peer/ownership/message_codec.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using peer::Holding;

constexpr std::size_t kMostListed = 8;  // bodies with their number

// "3, 5, 9 and 4 more".
std::string listed(std::span<const std::string> items) {
  const auto first = items.first(std::min(items.size(), kMostListed));
  std::string text = first.empty() ? "none" : fmt::format("{}", fmt::join(first, ", "));
  if (items.size() > first.size()) text += fmt::format(" and {} more", items.size() - first.size());
  return text;
}

std::string listed(const peer::ObjectSet& bodies) {
  std::vector<std::string> items;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i]) items.push_back(std::to_string(i));
  return listed(items);
}

std::string text_of(const peer::Round& round) {
  std::string text = fmt::format("round {} of act {}{}", round.round, round.act,
                                 round.is_decided ? "" : " (not decided)");
  const std::array<std::pair<bool, std::string_view>, 5> flags{
      {{round.has_lease, "has a lease"},
       {round.is_active, "bodies move"},
       {round.follows, "only follows"},
       {round.yields_to == peer::kAnyAct, "leaves"},
       {round.yields_to != 0 && round.yields_to != peer::kAnyAct, "gives its bodies up"}}};
  for (const auto& [is_set, words] : flags)
    if (is_set) text.append(", ").append(words);
  const auto heard =
      std::ranges::count_if(round.heard, [](std::uint8_t last) { return last != 0; });
  return text + fmt::format(", receives {}", counted(static_cast<std::uint64_t>(heard), "voter"));
}

std::string text_of(const peer::Proposal& proposal) {
  constexpr std::array<std::string_view, 4> kPhases{"prepares", "promises", "proposes", "decided"};
  const peer::Act& act = proposal.act;
  std::string text = fmt::format("{} act {}, attempt {} of {:08x}",
                                 kPhases[static_cast<std::size_t>(proposal.phase)], act.number,
                                 proposal.ballot.attempt, proposal.ballot.proposer);
  if (act.roll.size() == 0) return text;
  text += fmt::format(": {}, {} removed", counted(act.roll.size(), "voter"), act.removed_count);
  if (act.given.any()) text += fmt::format(", gives {} to {:08x}", listed(act.given), act.chair);
  return text;
}

std::string text_of(const peer::Vote& vote) {
  return fmt::format("votes for act {}, attempt {} of {:08x}", vote.act, vote.ballot.attempt,
                     vote.ballot.proposer);
}

std::string text_of(const peer::TableExtract& extract) {
  std::vector<std::string> items;
  for (const Holding& holding : extract.holdings.list())
    items.push_back(fmt::format("{} of {:08x} {}", holding.object, holding.tenure.owner,
                                version_text(holding.tenure.version)));
  return fmt::format("owners{}: {}", extract.asks ? ", to be agreed on" : "", listed(items));
}

std::string text_of(const peer::Agreement& agreement) {
  return fmt::format("agrees on the owners of {}", listed(agreement.objects));
}

std::string text_of(const peer::Request& request) {
  return fmt::format("{} {}", request.withdraws ? "no longer asks for" : "asks for",
                     listed(request.objects));
}

std::string text_of(const peer::Grant& grant) {
  std::vector<std::string> items;
  for (const Holding& holding : grant.holdings())
    items.push_back(fmt::format("{} {}", holding.object, version_text(holding.tenure.version)));
  std::string text = fmt::format("gives {} to {:08x}", listed(items), grant.to);
  if (grant.objects.count() > grant.count)
    text += fmt::format(" (together: {})", listed(grant.objects));
  return grant.is_pushed ? text + ", and leaves" : text;
}

std::string text_of(const peer::GrantRefusal& refusal) {
  return fmt::format("refuses grant {}", refusal.transaction);
}

std::string text_of(pdu::AssuredKind kind, std::span<const std::byte> octets) {
  const auto message = peer::decode_message(kind, octets);
  if (!message) return {};
  return std::visit([](const auto& typed) { return text_of(typed); }, *message);
}

}  // namespace

std::string version_text(std::uint64_t version) {
  return fmt::format("{}.{}", peer::act_of(version), peer::count_of(version));
}

std::string_view cause_text(std::uint64_t version) noexcept {
  switch (peer::cause_of(version)) {
    case peer::OwnerChange::granted:
      return "granted";
    case peer::OwnerChange::adopted:
      return "adopted";
    default:
      return "founded";
  }
}

std::string ownership_text(std::span<const std::byte> pdu) {
  pdu::AssuredRecord record;
  if (decode(pdu, record) != pdu::DecodeError::none) return text_of(pdu::AssuredKind::record, pdu);
  return text_of(record.kind, record.content.bytes);
}

}  // namespace reckon::tools
