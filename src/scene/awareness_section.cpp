// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The part of [aoim] that selects entities among the received ones.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "reckon/peer/scene/scene_sections.hpp"

namespace reckon::peer {
namespace {

constexpr unsigned kKinds = 10;  // of IEEE 1278.1

Section<NimbusClass> nimbus_section() {
  const auto text = [](const NimbusClass&) { return std::string(); };
  return {{
              {"type", text,
               "required; as in [[entity]]; missing numbers and 0 match any: \"1.1\" is all land "
               "platforms"},
              {"reach", &NimbusClass::nimbus, within("m", 0, kWorld),
               "they are received, and cells joined, this far beyond `radius`"},
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
            table.problem("to", "'to' is not beyond 'from' on one axis: give the box a volume");
          }};
}

/// The kind with this name, ignoring case; the number of kinds if there is none.
unsigned kind_of(std::string_view word) {
  const auto equal = [](char a, char b) { return std::tolower(a) == std::tolower(b); };
  unsigned kind = 0;
  while (kind < kKinds &&
         !std::ranges::equal(word, pdu::name(static_cast<pdu::EntityKind>(kind)), equal))
    ++kind;
  return kind;
}

}  // namespace

std::vector<Row<AoimConfig>> awareness_rows() {
  const auto of = [](auto member) { return in(&AoimConfig::awareness, member); };
  using Config = AwarenessConfig;
  return {
      {"budget", of(&Config::budget), within("B", 0, 1e9),
       "octets a second that this peer accepts. Above it, the peer leaves the most distant cells, "
       "except those of its own entities and those that its hands can reach; with tiers by "
       "distance, it also stretches distances and informs the other peers; 0 is no bound"},
      {"kinds", of(&Config::kinds),
       "kinds of entities that are shown, for example \"platform, life form\"; when absent, all"},
      {"aura", of(&Config::aura), within("m", 0, kWorld),
       "entities farther away than this are never shown; 0 is no bound"},
      {"nimbus", of(&Config::nimbus), nimbus_section(),
       "types of entities that are received from farther away; the first match applies"},
      {"occluder", of(&Config::occluders), occluder_section(),
       "a solid box; entities behind it are not shown"},
  };
}

void check_awareness(TomlReader& table, AwarenessConfig& config) {
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
      return table.problem("kinds", fmt::format("'kinds' has \"{}\"; use some of {}", word, names));
    }
    config.kinds_wanted |= 1U << kind;
    at = comma + 1;
  }
}

}  // namespace reckon::peer
