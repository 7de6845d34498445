// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/datagram_intake.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>

#include "reckon/peer/loops/aoim_setup.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kMostTaken = 512;  // datagrams decoded in a step, about 1 ms
// Number of datagrams searched together for states that a later one replaces. The larger number,
// the capacity of the ring in large datagrams, is for a backlog in which most are replaced.
constexpr std::size_t kAtOnce = 512, kFarAtOnce = 1408;
constexpr std::size_t kMostSeen = 4096;  // datagrams read in a step, including replaced ones
constexpr std::size_t kBacklog = 16;     // fewer pending datagrams are no backlog

// Whether updates of this form depend on a key state sent before.
bool needs_key_states(pdu::CompressedForm form) { return form == pdu::CompressedForm::residual; }

// By aoim::IncomingVerdict.
constexpr std::array<DatagramFate, aoim::kIncomingVerdicts> kFateOfVerdict{
    DatagramFate::delivered,  DatagramFate::delivered,   DatagramFate::own,
    DatagramFate::not_joined, DatagramFate::other_scene, DatagramFate::former_life,
    DatagramFate::duplicate,  DatagramFate::too_old,     DatagramFate::other_exercise,
    DatagramFate::impostor,   DatagramFate::stranger};

class ArrivingFilter final : public PduFilter {
 public:
  ArrivingFilter(const HookList& hooks, const Arrival& arrival) noexcept
      : hooks_(hooks), arrival_(arrival) {}
  [[nodiscard]] bool passes(const pdu::BundledPdu& pdu) const noexcept override {
    return hooks_.arriving.pass({pdu, arrival_});
  }

 private:
  const HookList& hooks_;
  const Arrival& arrival_;
};

}  // namespace

DatagramIntake::DatagramIntake(const ModelWiring& wiring, aoim::AreaOfInterestManager& aoim,
                               TimeKeeper& time, RemoteEntities& remote, const HookList& hooks,
                               ModelCounters& counted)
    : scene_(wiring.scene),
      pool_(wiring.pool),
      inbound_(wiring.inbound),
      urgent_(wiring.urgent),
      tap_(wiring.tap),
      aoim_(aoim),
      time_(time),
      remote_(remote),
      hooks_(hooks),
      counted_(counted),
      decoder_(wiring.scene.network.exercise, wiring.counters, wiring.scene.network.compression,
               wiring.scene.network.entities),
      overtaken_(wiring.scene.network.exercise, kFarAtOnce,
                 has_distance_tiers(wiring.scene.aoim.tiers)),
      queued_(kFarAtOnce),
      admitted_(kFarAtOnce) {}

void DatagramIntake::read(const Pass& pass, const aoim::PeerId& own, AssuredStage& assured,
                          UpdateHandler& handler) noexcept {
  const Reading reading{pass, own, handler};
  if (urgent_ != nullptr) drain(*urgent_, reading);
  drain(inbound_, reading);
  for (HeldPdu held; assured.take_held(pass, held);) {
    for (const Inbound& update : decoder_.decode_held(held.octets, own))
      handler.take_update(update, held.arrival);
  }
  const aoim::SequenceCounts& counts = aoim_.sequences().counts();
  counted_.lost.set(counts.lost);
  counted_.doubled.set(counts.duplicated);
  counted_.leaps.set(counts.leaps);
  counted_.reordered.set(counts.reordered);
  counted_.numberings_given_up.set(counts.given_up);
}

void DatagramIntake::drain(DatagramRing& ring, const Reading& reading) noexcept {
  std::size_t taken = 0, seen = 0;
  while (taken < kMostTaken && seen < kMostSeen) {
    const bool far = looks_far_ && &ring == &inbound_;
    const std::size_t most = far ? kFarAtOnce : std::min(kAtOnce, kMostTaken - taken);
    const std::size_t count = ring.front(std::span(queued_).first(most));
    if (count == 0) break;
    const std::size_t now_taken = read_some(std::span(queued_).first(count), reading);
    ring.pop();
    if (&ring == &inbound_) looks_far_ = count >= kAtOnce && 2 * now_taken < kAtOnce;
    taken += now_taken;
    seen += count;
  }
}

// Returns the number of datagrams that were read.
std::size_t DatagramIntake::read_some(std::span<const QueuedDatagram> datagrams,
                                      const Reading& reading) noexcept {
  std::size_t count = 0, taken = datagrams.size();
  for (const QueuedDatagram& datagram : datagrams)
    count += admit(datagram, reading.pass, admitted_[count]);
  const std::span<const ArrivedDatagram> admitted = std::span(admitted_).first(count);
  // A hook may refuse the newer state, so that the older one counts.
  const bool backlog =
      count >= kBacklog && !needs_key_states(scene_.network.compression) && hooks_.arriving.empty();
  if (backlog) overtaken_.look(admitted);
  for (std::size_t i = 0; i < count; ++i) {
    hooks_.received(admitted[i].octets);
    const std::uint64_t overtaken = backlog ? overtaken_.of(i) : 0;
    if (backlog && overtaken_.is_whole(i)) {
      decoder_.leave_out(static_cast<std::size_t>(std::popcount(overtaken)),
                         admitted[i].arrival.epoch != 0);
      --taken;
      continue;
    }
    const ArrivingFilter filter(hooks_, admitted[i].arrival);
    const std::span<const Inbound> updates = decoder_.decode(
        admitted[i].octets, reading.own, overtaken, key_speaker(admitted[i].arrival),
        hooks_.arriving.empty() ? nullptr : &filter);
    remote_.prefetch(updates);
    for (const Inbound& update : updates) reading.handler.take_update(update, admitted[i].arrival);
  }
  return taken;
}

// Peers may send key states, for their own entities.
KeySpeaker DatagramIntake::key_speaker(const Arrival& arrival) const noexcept {
  if (arrival.epoch == 0 || !needs_key_states(scene_.network.compression)) return {};
  const auto id = aoim_.presence().id_of(arrival.epoch);
  return id ? KeySpeaker{*id, arrival.epoch, arrival.from} : KeySpeaker{};
}

// False if the datagram is dropped.
bool DatagramIntake::admit(const QueuedDatagram& datagram, const Pass& pass,
                           ArrivedDatagram& admitted) noexcept {
  const auto index = pool_.index(datagram.group);
  if (!index && datagram.group != pool_.base()) return admit_unicast(datagram, pass, admitted);
  const aoim::GroupIndex group =
      index ? aoim::GroupIndex{static_cast<std::uint16_t>(*index + 1)} : aoim::kBaseGroup;
  const std::span<const std::byte> octets = datagram.octets;
  const aoim::SourceAddress from = source_of(datagram.sender, datagram.boot);
  const std::uint64_t lost_before = aoim_.sequences().counts().lost;
  const nanoseconds came = std::min(datagram.arrival, pass.now);
  const aoim::Incoming incoming = aoim_.receive(group, octets, pass.now, from, came);
  if (tap_ != nullptr) report_judged(datagram, incoming, lost_before);
  if (!aoim::is_usable(incoming.verdict)) return counted_.datagrams_refused.add(), false;

  const ClockEvidence clock =
      time_.receive(incoming.trailer, index ? octets.first(0) : octets, came);
  const bool of_cell = group.value <= scene_.aoim.pool;
  admitted = {octets,
              {pass.now, pass.utc, came, incoming.trailer.epoch, clock, from,
               of_cell ? aoim::kBaseGroup : group}};
  remote_.heard(from, pass.now);
  return true;
}

bool DatagramIntake::admit_unicast(const QueuedDatagram& datagram, const Pass& pass,
                                   ArrivedDatagram& admitted) noexcept {
  const aoim::SourceAddress from = source_of(datagram.sender, datagram.boot);
  const std::uint32_t epoch = assured_sender(datagram.octets, from);
  const DatagramFate fate = epoch == 0 ? DatagramFate::unicast : DatagramFate::delivered;
  if (tap_ != nullptr) tap_->note(DatagramTap::Loop::model, fate, datagram.group, datagram.octets);
  if (epoch == 0) return counted_.unicast_refused.add(), false;
  admitted = {datagram.octets,
              {pass.now, pass.utc, std::min(datagram.arrival, pass.now), epoch,
               time_.evidence(epoch), from, aoim::kBaseGroup, true}};
  remote_.heard(from, pass.now);
  return true;
}

// The epoch of the datagram's Assured Records; 0 if it holds anything else, or if that peer is not
// a member bound to this very source. With a key the link has opened it as sealed for this host.
std::uint32_t DatagramIntake::assured_sender(std::span<const std::byte> octets,
                                             const aoim::SourceAddress& from) const noexcept {
  std::uint32_t epoch = 0;
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(octets)) {
    pdu::AssuredRecord record;
    const bool is_record = bundled.error == pdu::DecodeError::none &&
                           bundled.header.exercise_id == scene_.network.exercise &&
                           pdu::decode(bundled.bytes, record) == pdu::DecodeError::none;
    if (!is_record || record.epoch == 0 || (epoch != 0 && record.epoch != epoch)) return 0;
    epoch = record.epoch;
  }
  const auto bound = aoim_.presence().source_of(epoch);
  const bool is_bound = bound && bound->port != 0;
  return is_bound && aoim_.presence().standing(epoch, &from) == aoim::Standing::member ? epoch : 0;
}

void DatagramIntake::report_judged(const QueuedDatagram& datagram, const aoim::Incoming& incoming,
                                   std::uint64_t lost_before) noexcept {
  const DatagramFate fate = kFateOfVerdict[static_cast<std::size_t>(incoming.verdict)];
  DatagramEvent event = tap_->event_of(fate, datagram.group, datagram.octets);
  event.verdict = incoming.sequence;
  event.lost = static_cast<std::int32_t>(aoim_.sequences().counts().lost - lost_before);
  tap_->push(DatagramTap::Loop::model, event);
}

void DatagramIntake::report_unread() noexcept {
  if (tap_ == nullptr) return;
  for (DatagramRing* ring : {urgent_, &inbound_}) {
    while (const QueuedDatagram* datagram = ring == nullptr ? nullptr : ring->front()) {
      tap_->note(DatagramTap::Loop::model, DatagramFate::unread, datagram->group, datagram->octets);
      ring->pop();
    }
  }
}

}  // namespace reckon::peer
