// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Evaluates a compiled filter for a PDU.
#include <algorithm>

#include "reckon/tools/datagrams/filter.hpp"
#include "reckon/tools/datagrams/filter_fields.hpp"
#include "reckon/tools/datagrams/restored_states.hpp"

namespace reckon::tools {
namespace {

bool is_like(pdu::EntityId id, const Filter::IdPattern& pattern) {
  return pattern.site.value_or(id.site) == id.site &&
         pattern.application.value_or(id.application) == id.application &&
         pattern.entity.value_or(id.entity) == id.entity;
}

}  // namespace

bool Filter::matches(const PduRow& row, const peer::SourceDatagram& datagram) const {
  const auto holds_for = [&](const PduRow& entity) {
    return evaluate(nodes_.size() - 1, {row, datagram, entity, entity.entity_state});
  };
  if (row.restored == nullptr || row.restored->empty()) return holds_for(row);
  return std::ranges::any_of(*row.restored, holds_for, &RestoredState::row);
}

bool Filter::holds(const Comparison& comparison, const FilterSubject& subject) const {
  if (comparison.of_table) {
    const FieldComparison& table = tables_[comparison.field];
    return table.holds(subject.row) ||
           (&subject.entity != &subject.row && table.holds(subject.entity));
  }
  const FilterField& field = filter_fields()[comparison.field];
  const bool wanted = comparison.op == Operator::equal;
  if (field.kind == ValueKind::id)
    return subject.entity.id.has_value() && is_like(*subject.entity.id, comparison.id) == wanted;
  if (field.kind == ValueKind::type)
    return subject.entity_state != nullptr &&
           comparison.type.matches(subject.entity_state->entity_type) == wanted;
  if (field.kind == ValueKind::text) {
    const auto text = field.text(subject);
    return text.has_value() && is_like(lower(*text), comparison.text) == wanted;
  }
  const auto number = field.number(subject);
  return number.has_value() && tools::holds(*number, comparison.op, comparison.number);
}

bool Filter::evaluate(std::size_t index, const FilterSubject& subject) const {
  const Node& node = nodes_[index];
  switch (node.kind) {
    case Kind::comparison:
      return holds(comparisons_[node.left], subject);
    case Kind::negation:
      return !evaluate(node.left, subject);
    case Kind::conjunction:
      return evaluate(node.left, subject) && evaluate(node.right, subject);
    case Kind::disjunction:
      return evaluate(node.left, subject) || evaluate(node.right, subject);
  }
  return false;
}

}  // namespace reckon::tools
