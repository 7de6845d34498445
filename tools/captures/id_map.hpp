// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Other IDs for the entities and simulations of a recorded exercise.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reckon/pdu/codec/records.hpp"

namespace reckon::tools {

/// A list of rules such as 1:2:*=9:2:*; the first rule that matches an ID applies.
class IdMap {
 public:
  /// @param rules site:application:entity on both sides, each a number or *. @throws UsageError.
  explicit IdMap(const std::vector<std::string>& rules);

  [[nodiscard]] bool empty() const { return rules_.empty(); }
  /// The new ID, or the same. A * matches any number except 65535 (all sites or applications);
  /// 0:0:0, the ID of no entity, is never mapped.
  [[nodiscard]] pdu::EntityId operator()(const pdu::EntityId& id) const;
  /// The same for a simulation, by the rules that cover all of its entities.
  [[nodiscard]] pdu::SimulationAddress operator()(const pdu::SimulationAddress& address) const;

 private:
  using Pattern = std::array<std::optional<std::uint16_t>, 3>;  // no value: *
  struct Rule {
    Pattern from;
    Pattern to;
  };

  static Rule parse(const std::string& text);
  static std::optional<Pattern> pattern_of(std::string_view text);
  [[nodiscard]] static bool matches(const Rule& rule, const pdu::EntityId& id);

  std::vector<Rule> rules_;
};

}  // namespace reckon::tools
