// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Of [aoim], what a peer is aware of among all that it hears, and what it sends to whom.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <exception>
#include <limits>

#include "reckon/aoim/interest/receiver_channels.hpp"
#include "reckon/peer/scene/scene_sections.hpp"

namespace reckon::peer {
namespace {

constexpr unsigned kKinds = 10;  // of IEEE 1278.1

/// One row of the table of channels.
Section<aoim::Channel> channel_section() {
  using aoim::Channel;
  return {{
              {"farthest", &Channel::farthest, within("m", 0, kWorld),
               "to receivers up to here; when absent, to all beyond the row before"},
              {"body", &Channel::body,
               "rigid: position and orientation; approximate: articulated parts, too; full: what "
               "hands feel, too. Of what is new or abrupt and at heartbeats all is sent"},
              {"active", &Channel::active_hz, within("Hz", 0, 1000),
               "most updates a second of one that moves"},
              {"passive", &Channel::passive_hz, within("Hz", 0, 1000), "of one that stands"},
              {"octets", &Channel::octets, within("B", 1, kMaxDatagram),
               "that an update counts against `budget`"},
              {"kept", &Channel::kept, "whatever the budget"},
              {"coarser", &Channel::coarser, within("", 1, 1e6),
               "with `near_groups`: how many times as wide the thresholds of place and turn are to "
               "receivers so far away; no less than in the row before"},
          },
          [](TomlReader& table, Channel& channel) {
            if (!table.has("farthest")) channel.farthest = std::numeric_limits<double>::infinity();
            table.require("active");
            table.require("octets");
          }};
}

Section<NimbusClass> nimbus_section() {
  const auto text = [](const NimbusClass&) { return std::string(); };
  return {{
              {"type", text,
               "required; as in [[entity]], where missing ones and 0 are any: \"1.1\" is all that "
               "is on land"},
              {"reach", &NimbusClass::nimbus, within("m", 0, kWorld),
               "so far beyond `radius` they are sensed; cells are joined as far"},
          },
          [](TomlReader& table, NimbusClass& one) {
            table.require("type");
            read_entity_type(table, one.type);
          }};
}

Section<OccluderConfig> occluder_section() {
  return {{
              {"from", &OccluderConfig::from, within("m", -kWorld, kWorld), "one corner, in S"},
              {"to", &OccluderConfig::to, within("m", -kWorld, kWorld), "the opposite one"},
          },
          [](TomlReader& table, OccluderConfig& box) {
            const Eigen::Vector3d from = box.from.cwiseMin(box.to), to = box.from.cwiseMax(box.to);
            box = {from, to};
            if ((to - from).minCoeff() > 0) return;
            table.problem("to", "'to' is no farther than 'from' on one axis: a box has a volume");
          }};
}

/// The kind of this name, in any case of letters; as many as there are where it is none.
unsigned kind_of(std::string_view word) {
  const auto equal = [](char a, char b) { return std::tolower(a) == std::tolower(b); };
  unsigned kind = 0;
  while (kind < kKinds &&
         !std::ranges::equal(word, pdu::name(static_cast<pdu::EntityKind>(kind)), equal))
    ++kind;
  return kind;
}

void check_kinds(TomlReader& table, AwarenessConfig& config) {
  if (config.kinds.empty()) return;
  config.kinds_wanted = 0;
  for (std::size_t at = 0; at <= config.kinds.size();) {
    const std::size_t comma = std::min(config.kinds.find(',', at), config.kinds.size());
    std::string word = config.kinds.substr(at, comma - at);
    word.erase(0, word.find_first_not_of(' '));
    word.erase(word.find_last_not_of(' ') + 1);
    const unsigned kind = kind_of(word);
    if (kind == kKinds) {
      std::string names;
      for (unsigned k = 0; k < kKinds; ++k)
        names += fmt::format("{}{}", k > 0 ? ", " : "", pdu::name(static_cast<pdu::EntityKind>(k)));
      return table.problem("kinds",
                           fmt::format("'kinds' has \"{}\"; it wants some of {}", word, names));
    }
    config.kinds_wanted |= 1U << kind;
    at = comma + 1;
  }
}

void check_channels(TomlReader& table, AwarenessConfig& config) {
  try {
    if (!config.rows.empty()) aoim::ReceiverChannels{config.rows};
  } catch (const std::exception& error) {
    table.problem("channel", fmt::format("'channel': {}", error.what()));
    config.rows.clear();  // none of the other checks is to trip over them
  }
  if (table.has("channel") && !config.channels)
    table.problem("channel", "'channel' is of use with 'channels' alone: set it, too");
}

}  // namespace

std::vector<Row<AoimConfig>> awareness_rows() {
  const auto of = [](auto member) { return in(&AoimConfig::awareness, member); };
  using Config = AwarenessConfig;
  return {
      {"channels", of(&Config::channels),
       "updates are thinned out by how far the nearest receiver known is; the same for all peers"},
      {"channel", of(&Config::rows), channel_section(),
       "what is sent to receivers so far away, nearest first; when absent, " +
           std::string(
               "1 m: 1000 Hz, 50 m: 30 Hz, 200 m: 10 Hz, 4 x as coarse, beyond: 1 Hz, 16 x")},
      {"budget", of(&Config::budget), within("B", 0, 1e9),
       "with `channels`: octets of updates a second that this peer can take: distances count as "
       "longer until that "
       "is met, and the others are informed; 0 is no bound"},
      {"kinds", of(&Config::kinds),
       "of entities that are shown, as in \"platform, life form\"; when absent, all"},
      {"aura", of(&Config::aura), within("m", 0, kWorld),
       "nothing farther from ours is shown, whatever its reach; 0 is no bound"},
      {"nimbus", of(&Config::nimbus), nimbus_section(),
       "some types of entities are sensed from farther away; the first that fits holds"},
      {"occluder", of(&Config::occluders), occluder_section(),
       "a solid box: what is behind it is not shown"},
  };
}

void check_awareness(TomlReader& table, AwarenessConfig& config) {
  check_kinds(table, config);
  check_channels(table, config);
}

}  // namespace reckon::peer
