// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/interaction_issuers.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "reckon/pdu/codec/byte_order.hpp"
#include "reckon/pdu/pdu_types.hpp"

namespace reckon::peer {
namespace {

using pdu::PduType;

// Layout of an ID on the wire.
enum class Form : std::uint8_t { none, entity, simulation, live_entity };

constexpr std::size_t size_of(Form form) noexcept {
  switch (form) {
    case Form::entity:
      return pdu::kFixedSize<pdu::EntityId>;
    case Form::simulation:
      return pdu::kFixedSize<pdu::SimulationAddress>;
    case Form::live_entity:
      return pdu::kFixedSize<pdu::LiveEntityId>;
    case Form::none:
      break;
  }
  return 0;
}

struct IdPlace {
  std::size_t offset = 0;
  Form form = Form::none;
};

struct IssuerPlaces {
  std::array<IdPlace, InteractionIssuers::kMost> ids{};
  std::size_t count = 0;
};

// Types whose issuer is not always the first ID, with the fields that may contain it.
struct OtherIssuers {
  PduType type;
  std::array<std::string_view, InteractionIssuers::kMost> fields;
};
constexpr std::array kOtherIssuers{
    OtherIssuers{PduType::resupply_offer, {"supplying_entity_id"}},
    OtherIssuers{PduType::resupply_cancel, {"receiving_entity_id", "supplying_entity_id"}},
    OtherIssuers{PduType::repair_complete, {"repairing_entity_id"}},
    OtherIssuers{PduType::minefield_query, {"requesting_entity_id"}},
    OtherIssuers{PduType::minefield_response_nack, {"requesting_entity_id"}},
    OtherIssuers{PduType::point_object_state, {"object_id", "requester_simulation_address"}},
    OtherIssuers{PduType::linear_object_state, {"object_id", "requester_simulation_address"}},
    OtherIssuers{PduType::areal_object_state, {"object_id", "requester_simulation_address"}},
};

// Visitor that finds the IDs of the fixed part that may be the issuer's.
class IssuerFinder {
 public:
  constexpr explicit IssuerFinder(PduType type) {
    for (const OtherIssuers& other : kOtherIssuers)
      if (other.type == type) wanted_ = other.fields, by_name_ = true;
  }

  template <typename T>
  constexpr void operator()(std::string_view name, const T& value) {
    if constexpr (std::is_same_v<T, pdu::EntityId>) {
      add(name, Form::entity);
    } else if constexpr (std::is_same_v<T, pdu::SimulationAddress>) {
      add(name, Form::simulation);
    } else if constexpr (std::is_same_v<T, pdu::LiveEntityId>) {
      add(name, Form::live_entity);
    }
    pdu::FixedSize size;
    size(name, value);
    offset_ += size.size();
  }
  template <typename Span, typename Record, typename Count>
  constexpr void count(std::string_view, const Span&, pdu::Records<Record, Count>) {
    offset_ += sizeof(Count);
  }
  // Behind the fixed part, the position of an ID varies.
  template <typename Span, typename Record, typename Count>
  constexpr void records(std::string_view, const Span&, pdu::Records<Record, Count>) {}
  template <typename View>
  constexpr void walked(std::string_view, const View&) {}
  template <typename T>
  constexpr void when(bool, std::string_view, const T&) {}

  [[nodiscard]] constexpr const IssuerPlaces& found() const { return found_; }

 private:
  constexpr void add(std::string_view name, Form form) {
    const bool wanted = by_name_ ? std::find(wanted_.begin(), wanted_.end(), name) != wanted_.end()
                                 : found_.count == 0;
    if (wanted) found_.ids[found_.count++] = {offset_, form};
  }

  std::array<std::string_view, InteractionIssuers::kMost> wanted_{};
  bool by_name_ = false;
  std::size_t offset_ = 0;
  IssuerPlaces found_;
};

template <typename T>
consteval IssuerPlaces issuer_places() {
  IssuerFinder finder(T::kPduType);
  T pdu{};  // not const: nothing behind the fixed part is read
  fields(finder, pdu);
  return finder.found();
}

template <typename... T>
consteval std::array<IssuerPlaces, 256> all_places(pdu::TypeList<T...>) {
  std::array<IssuerPlaces, 256> places{};
  ((places[static_cast<std::uint8_t>(T::kPduType)] = issuer_places<T>()), ...);
  return places;
}
constexpr std::array<IssuerPlaces, 256> kPlaces = all_places(pdu::PduTypes{});

pdu::EntityId id_at(const std::byte* at, Form form) noexcept {
  const auto number = [at](std::size_t i) {
    return pdu::load_big_endian<std::uint16_t>(at + 2 * i);
  };
  const auto octet = [at](std::size_t i) { return std::to_integer<std::uint16_t>(at[i]); };
  if (form == Form::live_entity) return {octet(0), octet(1), number(1)};
  return {number(0), number(1), form == Form::entity ? number(2) : std::uint16_t{0}};
}

}  // namespace

InteractionIssuers issuers_of(const pdu::PduHeader& header,
                              std::span<const std::byte> pdu) noexcept {
  InteractionIssuers issuers;
  const IssuerPlaces& places = kPlaces[static_cast<std::uint8_t>(header.pdu_type)];
  for (std::size_t i = 0; i < places.count; ++i) {
    const IdPlace& place = places.ids[i];
    if (place.offset + size_of(place.form) <= pdu.size())
      issuers.add(id_at(pdu.data() + place.offset, place.form));
  }
  return issuers;
}

}  // namespace reckon::peer
