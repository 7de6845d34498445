// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A light peer: the parts of the library that decide what goes out, without loops and tables.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "reckon/aoim/bundling/aggregator.hpp"
#include "reckon/aoim/interest/subscription.hpp"
#include "reckon/aoim/presence/heard_list_sender.hpp"
#include "reckon/aoim/presence/introduction.hpp"
#include "reckon/bench/studies/scale/mechanisms.hpp"
#include "reckon/bench/studies/scale/setting.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/reckon/compressed_states.hpp"
#include "reckon/peer/compression/state_compressor.hpp"
#include "reckon/peer/world/audiences.hpp"

namespace reckon::bench {

/// One entity at its owner.
struct LightEntity {
  deadreckon::UpdatePolicy policy;
  aoim::GroupIndex last_group;
  std::chrono::nanoseconds last_sent{};
  std::chrono::nanoseconds last_whole{};                                  ///< leaning on no key
  std::chrono::nanoseconds held_until = std::chrono::nanoseconds::min();  ///< by its channel
  std::unique_ptr<peer::StateCompressor> compressor = nullptr;  ///< null where it goes plain
  std::unique_ptr<peer::Audiences> audiences = nullptr;  ///< null where all are told the same
  double told = 0;  ///< when anything was said of it last, so to the inmost of them [s]
};

/// One peer, as far as it sends.
struct LightPeer {
  /// @param peer its number, from 0  @param near_rows that have groups
  LightPeer(const ScaleSetting& setting, const ScaleDesign& design, const OwnedRange& range,
            const aoim::CellPartition& cells, std::uint32_t peer, std::size_t near_rows);

  /// Announces itself where that is due, and says whom it hears when a peer would, with as many as
  /// it would list: with an announcement, or as a sign of life between two.
  void announce(const ScaleSetting& setting, bool is_due, std::chrono::nanoseconds now);
  /// Says that it has joined so many cells.
  void tell_membership(pdu::MembershipAction action, std::size_t cells,
                       std::chrono::nanoseconds now);

  OwnedRange owned;
  aoim::Aggregator aggregator;
  std::optional<aoim::Subscription> subscription;
  std::vector<aoim::Subscription> nears;  ///< of the near rows
  std::chrono::nanoseconds said{};        ///< when its last datagram left

 private:
  template <typename Pdu>
  void add_control(const Pdu& pdu, std::chrono::nanoseconds now);

  /// With a Time Exchange, as peers do.
  void add_presence(const ScaleSetting& setting, std::chrono::nanoseconds now);
  void add_list(const ScaleSetting& setting, std::chrono::nanoseconds now);

  pdu::SimulationAddress simulation_;
  aoim::HeardListSender lists_;
  std::optional<std::chrono::nanoseconds> announced_;
  std::uint32_t quorum_;  // of a bundle
};

[[nodiscard]] aoim::IntroductionConfig introduction_config(const ScaleSetting& setting,
                                                           std::size_t near_rows);

/// Calls visit(number of the entity, octets of its Entity State or none where it is compressed) for
/// each update of a datagram.
template <typename Visit>
void for_each_update(std::span<const std::byte> datagram, Visit&& visit) {
  constexpr std::size_t kType = 2, kLength = 8, kNumber = 16;
  const auto number_at = [&](std::size_t at) {
    return std::to_integer<std::size_t>(datagram[at]) << 8 |
           std::to_integer<std::size_t>(datagram[at + 1]);
  };
  while (datagram.size() >= pdu::kHeaderSize) {
    const std::size_t length =
        std::clamp<std::size_t>(number_at(kLength), pdu::kHeaderSize, datagram.size());
    const std::span<const std::byte> octets = datagram.first(length);
    if (static_cast<pdu::PduType>(datagram[kType]) == pdu::PduType::entity_state)
      visit(number_at(kNumber), octets);
    pdu::CompressedStates states;
    if (static_cast<pdu::PduType>(datagram[kType]) == pdu::PduType::compressed_states &&
        pdu::decode(octets, states) == pdu::DecodeError::none) {
      pdu::CompressedState state;
      for (pdu::CompressedStateReader reader(states); reader.next(state);)
        visit(std::size_t{state.entity}, std::span<const std::byte>());
    }
    datagram = datagram.subspan(length);
  }
}

}  // namespace reckon::bench
