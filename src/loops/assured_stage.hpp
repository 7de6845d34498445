// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Assured messages of a peer: sends them until each addressee has acknowledged them, and takes
// those of others once. The first transmission is the plain PDU with a mark, so that plain DIS
// tools read it; repeats hold the PDU.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/pdu/reckon/assured_record.hpp"
#include "reckon/peer/clocks/time_keeper.hpp"
#include "reckon/peer/loops/assured_counters.hpp"
#include "reckon/peer/loops/datagram_outlet.hpp"
#include "reckon/peer/loops/entity_sender.hpp"
#include "reckon/peer/loops/model_wiring.hpp"
#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/loops/peer_hooks.hpp"
#include "reckon/peer/reliable/acknowledged_set.hpp"
#include "reckon/peer/reliable/held_records.hpp"
#include "reckon/peer/reliable/received_set.hpp"
#include "reckon/peer/reliable/undelivered.hpp"
#include "reckon/peer/world/arrival.hpp"
#include "reckon/peer/world/datagram_decoder.hpp"

namespace reckon::peer {

/// A received record of a user.
struct UserRecord {
  std::uint32_t epoch = 0;  ///< of its sender, a member
  pdu::AssuredKind kind = pdu::AssuredKind::record;
  std::span<const std::byte> octets;  ///< valid until the call returns
};

/// A user of assured records that hold no PDU: of kinds from ownership_round on, and octets
/// of an application. By the thread of the model loop; must not throw.
class AssuredUser {
 public:
  virtual ~AssuredUser() = default;
  /// Takes a record; each assured one is given once. False refuses it; its sender receives that
  /// verdict.
  [[nodiscard]] virtual bool take_record(const UserRecord& record) noexcept = 0;
  /// The end of an own record for one addressee. Must not send a record.
  virtual void settle(const AssuredReport& report) noexcept = 0;
};

/// A PDU that has waited for an earlier one.
struct HeldPdu {
  std::span<const std::byte> octets;  ///< valid until the next admits()
  Arrival arrival;
};

/// One thread; allocates only at construction.
class AssuredStage final : private AssuredReports {
 public:
  /// References outlive this.
  AssuredStage(const ModelWiring& wiring, std::uint32_t epoch, aoim::AreaOfInterestManager& aoim,
               const TimeKeeper& time, const HookList& hooks, DatagramOutlet& outlet,
               haptics::SpscRing<Notice>& notices);

  /// @param user outlives the stage, or the next call; nullptr: records of users are skipped.
  void set_user(AssuredUser* user) noexcept { user_ = user; }
  /// The same for kinds shared_record to record_request.
  void set_records(AssuredUser* user) noexcept { records_ = user; }
  /// @param watch outlives the stage, or the next call; nullptr: none.
  void set_watch(DeliveryWatch* watch) noexcept { watch_ = watch; }

  /// Sends a standard PDU to all joined peers. Each that does not get it is reported to the watch,
  /// at once if the message is refused.
  /// @param pdu one standard PDU but no Entity State and no Attribute, at most pdu::kMostAssured
  /// octets  @param tag not 0  @param flags kAssuredOrdered, or 0
  void send(std::span<const std::byte> pdu, std::uint64_t tag, std::uint8_t flags,
            const Pass& pass) noexcept;
  /// Sends a record of a user. Nothing if AcknowledgedSet::add refuses it.
  std::optional<std::uint32_t> send(const AssuredContent& content,
                                    std::span<const std::uint32_t> addressees,
                                    const Pass& pass) noexcept {
    return sent_.add(content, addressees, pass.now);
  }

  /// The same to all joined peers. Nothing if there are none.
  std::optional<std::uint32_t> send_to_joined(const AssuredContent& content,
                                              const Pass& pass) noexcept;
  /// Sends a record of a user once, without acknowledgement.  @param to epoch; 0: all
  void send_once(pdu::AssuredKind kind, std::span<const std::byte> octets, std::uint32_t to,
                 const Pass& pass) noexcept;

  /// Judges an update if it is a record or an acknowledgement, and consumes all but PDUs.
  /// @return whether it is to be delivered; then call conclude(), for a PDU
  [[nodiscard]] bool admits(const Inbound& update, const Arrival& arrival) noexcept {
    return update.record.empty() || admits_record(update, arrival);
  }
  /// Sets whether the PDU that was admitted last was accepted.
  void conclude(const Inbound& update, bool accepted) noexcept {
    if (!accepted && (!update.record.empty() || is_held_))
      received_.refuse(admitted_.epoch, admitted_.sequence);
  }
  /// Removes a held PDU whose predecessor was delivered or has failed. Then deliver it, as an
  /// update without a record, and call conclude(). @return false if there is none; call it until
  /// then
  [[nodiscard]] bool take_held(const Pass& pass, HeldPdu& held) noexcept;
  /// Forgets a peer that has gone.
  void drop(const aoim::PresenceEvent::Dropped& life) noexcept;

  /// Queues what is due: first transmissions, repeats, acknowledgements.
  void step(const Pass& pass) noexcept;
  /// Whether a record is in flight, or one of others came within kActive.
  [[nodiscard]] bool is_active(std::chrono::nanoseconds now) const noexcept {
    return next_step() != Nanoseconds::max() || now < active_until_;
  }
  /// Time of the next step(); nanoseconds::max() if nothing is in flight.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept { return sent_.next_step(); }

 private:
  using Nanoseconds = std::chrono::nanoseconds;
  static constexpr std::size_t kMostOctets = 1352;  ///< of a PDU
  static constexpr Nanoseconds kActive = std::chrono::seconds(1);

  [[nodiscard]] AssuredUser* user_of(pdu::AssuredKind kind) const noexcept;
  void find_joined() noexcept;
  void settle(const AssuredReport& report) noexcept override;
  void note_undelivered(const Undelivered& undelivered) noexcept;
  void transmit(const DueRecord& due) noexcept;
  void transmit_marked(const DueRecord& due, const pdu::AssuredRecord& record) noexcept;
  void acknowledge(const DueReceipt& due) noexcept;
  [[nodiscard]] pdu::AssuredRecord record_of(pdu::AssuredKind kind,
                                             std::uint32_t sequence) const noexcept;
  [[nodiscard]] std::span<const std::byte> store_addressees(
      std::span<const std::uint32_t> epochs) noexcept;
  void send_to_all(const pdu::AssuredRecord& record) noexcept;
  void send_to_host(std::uint32_t epoch, pdu::AssuredRecord record) noexcept;
  [[nodiscard]] bool admits_record(const Inbound& update, const Arrival& arrival) noexcept;
  void take_receipt(const pdu::AssuredRecord& record) noexcept;
  [[nodiscard]] bool is_late(const pdu::AssuredRecord& record) const noexcept;
  [[nodiscard]] bool hold_if_early(const pdu::AssuredRecord& record, const Inbound& update,
                                   const Arrival& arrival) noexcept;
  [[nodiscard]] bool is_from_member(const pdu::AssuredRecord& record,
                                    const Arrival& arrival) const noexcept;
  [[nodiscard]] bool names_us(const pdu::AssuredRecord& record) const noexcept;

  std::uint32_t epoch_;
  std::uint8_t exercise_;
  aoim::AreaOfInterestManager& aoim_;
  const TimeKeeper& time_;
  const HookList& hooks_;
  DatagramOutlet& outlet_;
  haptics::SpscRing<Notice>& notices_;
  AssuredCounters counted_;
  Nanoseconds active_until_{0};
  AcknowledgedSet sent_;
  ReceivedSet received_;
  HeldRecords held_;
  bool is_held_ = false;                // the PDU under judgement comes from held_
  std::vector<Arrival> held_arrivals_;  // by place of held_
  Pass pass_;
  AssuredUser* user_ = nullptr;
  AssuredUser* records_ = nullptr;
  DeliveryWatch* watch_ = nullptr;
  struct Admitted {
    std::uint32_t epoch = 0, sequence = 0;
  };
  Admitted admitted_;                  // the last record
  aoim::PresenceEvent::Dropped gone_;  // during drop()
  Nanoseconds noticed_ = Nanoseconds::min() / 2;
  std::vector<std::uint32_t> joined_;
  std::vector<std::byte> addressees_;
  std::array<std::byte, kMostOctets> octets_{};
};

}  // namespace reckon::peer
