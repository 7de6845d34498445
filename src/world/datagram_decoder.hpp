// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Decodes a datagram into updates of entities. It splits a bundle, refuses damaged PDUs and PDUs of
// other exercises, and combines an Entity State with its force model.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/entity/attribute.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/reckon/assured_record.hpp"
#include "reckon/pdu/reckon/compressed_states.hpp"
#include "reckon/pdu/reckon/energy_account_record.hpp"
#include "reckon/pdu/reckon/haptic_record.hpp"
#include "reckon/pdu/reckon/ownership_record.hpp"
#include "reckon/peer/compression/state_restorer.hpp"
#include "reckon/peer/counters/counters.hpp"

namespace reckon::peer {

/// A decoded and bounded PDU of another peer.
struct Inbound {
  enum class Kind : std::uint8_t {
    entity,
    stop_freeze,
    start_resume,
    other,
    claim,    ///< a state from a sender that cannot own its entity; only `entity` is set
    assured,  ///< an Assured Record without a PDU that can be used; only `record` is set
  };
  /// Most entities of ours that a remote one can touch at a time; further ones are counted.
  static constexpr std::size_t kAccounts = 8;

  Kind kind = Kind::entity;
  pdu::EntityId entity;          ///< updated entity; receiver of a stop or start
  pdu::EntityId originator;      ///< of a stop or start
  std::uint32_t request_id = 0;  ///< of a stop or start
  bool has_state = false, has_model = false;
  pdu::EntityState state;  ///< its variable parameters are a view of the datagram's octets
  pdu::HapticRecord model;
  std::optional<pdu::OwnershipRecord> ownership;               ///< of a body of the scene
  std::array<pdu::EnergyAccountRecord, kAccounts> accounts{};  ///< the accounts that name us
  std::size_t account_count = 0;
  double body_energy = 0.0;           ///< [J], of a hand, in all bodies
  std::uint8_t accounts_told = 0;     ///< number of accounts that exchange energy, also with others
  pdu::BundledPdu pdu;                ///< the whole PDU, for all kinds but entity and claim
  std::span<const std::byte> record;  ///< the Assured Record that holds or marks the PDU, if any
};

/// Selects PDUs to decode.
class PduFilter {
 public:
  virtual ~PduFilter() = default;
  /// @param pdu undamaged and of this exercise, except that its body was not checked
  [[nodiscard]] virtual bool passes(const pdu::BundledPdu& pdu) const noexcept = 0;
};

/// The decoder. One thread, never throws; allocates for a new entity with compressed states.
class DatagramDecoder {
 public:
  /// @param exercise PDUs of other exercises are dropped.  @param counters outlives the decoder.
  /// @param form compression of the scene's states.
  /// @param capacity entities whose key states are kept
  DatagramDecoder(std::uint8_t exercise, Counters& counters,
                  pdu::CompressedForm form = pdu::CompressedForm::none, std::size_t capacity = 1);

  /// Decodes a datagram. The result is valid until the next call and as long as the octets are.
  /// @param own whose entities' accounts are selected.
  /// @param overtaken bit i: PDU i is an overtaken state (OvertakenStates), which is only counted.
  /// @param speaker whose states may be key states, and whose compressed states may depend on them;
  /// by default of no entity
  /// @param filter other PDUs are only counted; null: all are decoded
  [[nodiscard]] std::span<const Inbound> decode(std::span<const std::byte> datagram,
                                                const pdu::SimulationAddress& own,
                                                std::uint64_t overtaken = 0,
                                                const KeySpeaker& speaker = {},
                                                const PduFilter* filter = nullptr) noexcept;
  /// Decodes a held PDU. It is not counted again.
  [[nodiscard]] std::span<const Inbound> decode_held(std::span<const std::byte> octets,
                                                     const pdu::SimulationAddress& own) noexcept;
  /// Forgets the key states of a peer whose epoch has ended.
  void forget_keys(std::uint32_t epoch) noexcept { restorer_.forget(epoch); }
  /// Counts this many overtaken states of a datagram that has nothing else but perhaps a trailer.
  void leave_out(std::size_t overtaken, bool trailer) noexcept;

 private:
  static constexpr std::size_t kMaxUpdates = 128;  // a bundle below the MTU has 9 to 40 PDUs

  void take_pdu(const pdu::BundledPdu& pdu, const pdu::SimulationAddress& own) noexcept;
  void take_plain(std::span<const std::byte> bytes) noexcept;
  void take_state(const pdu::EntityState& state) noexcept;
  void take_compressed(std::span<const std::byte> bytes) noexcept;
  void take_attribute(std::span<const std::byte> bytes, const pdu::SimulationAddress& own) noexcept;
  void take_record(const pdu::EntityId& entity, const pdu::AttributeRecord& record,
                   const pdu::SimulationAddress& own) noexcept;
  void take_account(const pdu::EntityId& entity, const pdu::EnergyAccountRecord& account,
                    const pdu::SimulationAddress& own) noexcept;
  void take_control(const pdu::BundledPdu& pdu) noexcept;
  [[nodiscard]] Inbound* find_staged(const pdu::EntityId& entity) noexcept;
  void take_other(const pdu::BundledPdu& pdu) noexcept;
  void take_assured(const pdu::BundledPdu& pdu, const pdu::SimulationAddress& own) noexcept;
  void take_nested(std::span<const std::byte> octets, const pdu::SimulationAddress& own) noexcept;
  void take_mark(const pdu::AssuredRecord& mark, std::span<const std::byte> octets) noexcept;
  Inbound* stage(Inbound::Kind kind, const pdu::EntityId& entity) noexcept;
  void add_staged(Inbound::Kind kind, const pdu::EntityId& entity) noexcept;

  static constexpr std::uint64_t kNoEntity = ~std::uint64_t{0};

  std::uint8_t exercise_;
  std::array<Inbound, kMaxUpdates + 1> staged_{};      // the last is room to decode into
  std::array<std::uint64_t, kMaxUpdates> entities_{};  // keys of those staged, or kNoEntity
  std::size_t count_ = 0;

  StateRestorer restorer_;
  KeySpeaker speaker_;                 // of the present datagram
  const PduFilter* filter_ = nullptr;  // likewise
  Counter& pdus_;
  Counter& malformed_;
  Counter& foreign_;
  Counter& unknown_;
  Counter& overflow_;
  Counter& restored_;
  Counter& keys_awaited_;
  Counter& keys_of_others_;
  Counter& overtaken_;
};

}  // namespace reckon::peer
