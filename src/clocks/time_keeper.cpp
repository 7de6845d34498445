// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/clocks/time_keeper.hpp"

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::peer {

using std::chrono::nanoseconds;

TimeKeeper::TimeKeeper(std::uint32_t epoch, std::uint8_t exercise, Counters& counters)
    : epoch_(epoch),
      exercise_(exercise),
      clock_leaps_(
          counters.make("clock_leaps", "jumps of this host's clock that were not followed")),
      exchanges_(counters.make("time_exchanges", "answers with a peer's clock")),
      exchanges_refused_(
          counters.make("time_exchanges_refused", "such answers with impossible times")) {}

void TimeKeeper::begin(nanoseconds now, nanoseconds host_utc) noexcept {
  now_ = now;
  utc_ = steady_utc_.at(now, host_utc);
  if (steady_utc_.leap()) clock_leaps_.add();
}

std::uint32_t TimeKeeper::stamp(nanoseconds utc) const noexcept {
  return pdu::to_dis_timestamp(utc, is_aligned());
}

std::optional<double> TimeKeeper::leap() const noexcept {
  const auto leap = steady_utc_.leap();
  return leap ? std::optional(pdu::to_seconds(*leap)) : std::nullopt;
}

ClockEvidence TimeKeeper::receive(const pdu::DatagramTrailer& trailer,
                                  std::span<const std::byte> datagram,
                                  nanoseconds arrival) noexcept {
  if (trailer.epoch == 0) return {is_aligned(), std::nullopt};
  const nanoseconds utc = utc_ - (now_ - arrival);
  peers_.receive(trailer, utc, arrival);
  transits_.add(pdu::trailer_age(trailer.send_time, utc));
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
    pdu::TimeExchange exchange;
    if (bundled.error == pdu::DecodeError::none &&
        bundled.header.pdu_type == pdu::PduType::time_exchange &&
        pdu::decode(bundled.bytes, exchange) == pdu::DecodeError::none) {
      peers_.take(exchange, epoch_, trailer, utc, arrival);
    }
  }
  exchanges_.set(peers_.taken());
  exchanges_refused_.set(peers_.refused());
  return evidence(trailer.epoch);
}

ClockEvidence TimeKeeper::evidence(std::uint32_t epoch) const noexcept {
  return {is_aligned(), peers_.ahead(epoch, is_aligned(), now_)};
}

bool TimeKeeper::echo(const pdu::SimulationAddress& own, pdu::TimeExchange& exchange) noexcept {
  exchange.header.exercise_id = exercise_;
  exchange.header.timestamp = stamp(utc_);
  exchange.simulation = own;
  exchange.epoch = epoch_;
  return peers_.fill(exchange, now_);
}

}  // namespace reckon::peer
