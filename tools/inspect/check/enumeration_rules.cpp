// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/check/enumeration_rules.hpp"

#include <fmt/format.h>

#include <concepts>
#include <type_traits>

#include "reckon/pdu/field_names.hpp"
#include "reckon/pdu/pdu_types.hpp"

namespace reckon::tools {
namespace {

using Fault = std::optional<RuleFault>;

// Offsets of fields in an Entity State.
constexpr std::size_t kForceAt = 18;
constexpr std::size_t kKindAt = 20;
constexpr std::size_t kDomainAt = 21;
constexpr std::size_t kAlgorithmAt = 88;

Fault unknown_number(std::size_t offset, std::string_view field, pdu::SisoTable table,
                     unsigned value) {
  if (!pdu::siso_name(table, value).empty()) return std::nullopt;
  const pdu::SisoEntry last = pdu::siso_entry(table, pdu::siso_size(table) - 1);
  return RuleFault{offset,
                   fmt::format("{} is {}, but 0 to {} have names", field, value, last.value)};
}

/// Visitor of the fixed fields of a PDU: finds the first value without a name in its list.
class UnnamedValue {
 public:
  explicit UnnamedValue(const auto& record, std::size_t offset = 0)
      : meanings_(record), offset_(offset) {}

  template <typename T>
  void operator()(std::string_view name, const T& value) {
    if (fault_.has_value() || variable_) return;
    if constexpr (std::is_integral_v<T> && sizeof(T) <= sizeof(std::uint32_t)) {
      look(name, static_cast<std::uint32_t>(value));
    } else if constexpr (!pdu::Scalar<T> && !pdu::kIsStdArray<T>) {
      UnnamedValue inner(value, offset_);
      fields(inner, value);
      fault_ = std::move(inner.fault_);
      if (fault_.has_value()) fault_->reason.insert(0, fmt::format("{}.", name));
    }
    offset_ += octets<T>();
  }
  template <typename View, typename Record, typename Count>
  void count(std::string_view, const View&, pdu::Records<Record, Count>) {
    offset_ += sizeof(Count);
  }
  template <typename... Any>
  void records(Any&&...) {
    variable_ = true;
  }
  template <typename... Any>
  void walked(Any&&...) {
    variable_ = true;
  }

  [[nodiscard]] const Fault& fault() const { return fault_; }

 private:
  template <typename T>
  static consteval std::size_t octets() {
    if constexpr (pdu::Scalar<T> || pdu::kIsStdArray<T>)
      return sizeof(T);
    else
      return pdu::kFixedSize<T>;
  }
  void look(std::string_view name, std::uint32_t value) {
    const pdu::SisoTable table = meanings_.of(name).values;
    if (table == pdu::SisoTable::none || !pdu::siso_name(table, value).empty()) return;
    fault_ = RuleFault{offset_, fmt::format("{} is {}, which has no name", name, value)};
  }

  pdu::FieldMeanings meanings_;
  std::size_t offset_;
  bool variable_ = false;
  Fault fault_;
};

}  // namespace

Fault unknown_drm(const CheckedPdu& checked) {
  if (checked.entity_state == nullptr) return std::nullopt;
  return unknown_number(kAlgorithmAt, "dead_reckoning_algorithm",
                        pdu::SisoTable::dead_reckoning_algorithm,
                        static_cast<unsigned>(checked.entity_state->dead_reckoning.algorithm));
}

Fault unknown_force(const CheckedPdu& checked) {
  if (checked.entity_state == nullptr) return std::nullopt;
  return unknown_number(kForceAt, "force_id", pdu::SisoTable::force_id,
                        static_cast<unsigned>(checked.entity_state->force_id));
}

Fault unknown_kind(const CheckedPdu& checked) {
  if (checked.entity_state == nullptr) return std::nullopt;
  return unknown_number(kKindAt, "entity_type.kind", pdu::SisoTable::entity_kind,
                        static_cast<unsigned>(checked.entity_state->entity_type.kind));
}

Fault unknown_domain(const CheckedPdu& checked) {
  if (checked.entity_state == nullptr) return std::nullopt;
  const pdu::EntityType& type = checked.entity_state->entity_type;
  const std::string_view kind = pdu::name(type.kind);
  if (kind.empty()) return std::nullopt;
  return unknown_number(kDomainAt, fmt::format("entity_type.domain of kind {}", kind),
                        pdu::domain_table(type.kind), static_cast<unsigned>(type.domain));
}

Fault unnamed_value(const CheckedPdu& checked) {
  if (!checked.row.decoded) return std::nullopt;
  if (checked.memory != nullptr && checked.memory->updates > 0) return std::nullopt;
  Fault fault;
  (void)pdu::visit(checked.row.bytes, checked.row.header, [&](const auto& pdu) {
    UnnamedValue values(pdu);
    fields(values, pdu);
    fault = values.fault();
  });
  return fault;
}

}  // namespace reckon::tools
