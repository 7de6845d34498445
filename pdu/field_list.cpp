// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/field_list.hpp"

#include <string>

#include "reckon/pdu/field_variants.hpp"

namespace reckon::pdu {
namespace {

template <typename... T>
void list_tables(FieldList& list, std::optional<PduType> only, TypeList<T...>) {
  const auto show = [&]<typename Pdu>(std::type_identity<Pdu>) {
    if (only.has_value() && *only != Pdu::kPduType) return;
    list.begin(Pdu::kPduType);
    each_variant<Pdu>([&](const Pdu& pdu) {
      FieldWalk walk(list, pdu);
      fields(walk, pdu);
    });
  };
  (show(std::type_identity<T>{}), ...);
}

/// Reports the fields of a PDU without a field table.
void list_header(FieldList& list, PduType type) {
  list.begin(type);
  FieldWalk walk(list);
  walk("header", PduHeader{});
}

}  // namespace

void list_fields(FieldList& list, std::optional<PduType> only) {
  list_tables(list, only, PduTypes{});
  for (unsigned number = 0; number < 256; ++number) {
    const auto type = static_cast<PduType>(number);
    if (!is_listed(type) && only.value_or(type) == type) list_header(list, type);
  }
}

void each_field_path(PduType type, const std::function<void(std::string_view)>& f) {
  struct Names {
    const std::function<void(std::string_view)>& f;
    std::string path;
  } names{f, {}};
  const auto report = [](void* context, const FieldPlace&, const FieldList::Field& field) {
    Names& to = *static_cast<Names*>(context);
    to.path.clear();
    for (const FieldPath::Part& part : field.around) to.path.append(part.name).append(".");
    to.path += field.part.name;
    to.f(to.path);
  };
  FieldList list(&names, report);
  list_fields(list, type);
}

}  // namespace reckon::pdu
