// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/greeter.hpp"

#include <algorithm>

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr nanoseconds kGather = milliseconds(5);  // arrivals of this time are answered together
constexpr nanoseconds kLeastGap = milliseconds(20);
constexpr nanoseconds kFirstPatience = milliseconds(50);
constexpr nanoseconds kLongestPatience = seconds(1);
constexpr nanoseconds kHeardLately = seconds(3);

}  // namespace

void Greeter::hurry(nanoseconds now) noexcept {
  next_ = std::min(next_, std::max(now + kGather, last_ + kLeastGap));
}

void Greeter::hurry_for_stranger(nanoseconds now) noexcept {
  plan_for_stranger(std::max(now + kGather, last_ + kLeastGap));
}

// Not before strangers may have one again.
void Greeter::plan_for_stranger(nanoseconds at) noexcept {
  next_ = std::min(next_, std::max(at, spent_until_ - kStrangersAtOnce * kStrangersGap));
}

void Greeter::charge(nanoseconds now) noexcept {
  spent_until_ = std::min(std::max(spent_until_, now) + kStrangersGap,
                          now + (kStrangersAtOnce + 1) * kStrangersGap);
}

// Answers the trusted senders, or the others.
Greeter::Answered Greeter::answer(SealedSenders& senders, bool trusted,
                                  HelloWriter& writer) const noexcept {
  Answered answered;
  for (SealedSender& sender : senders.all()) {
    if (!sender.echo_due || sender.trusted != trusted) continue;
    answered.is_all = writer.echo({sender.sealer.boot, sender.nonce});
    if (!answered.is_all) break;
    sender.echo_due = false;
    ++answered.count;
  }
  return answered;
}

void Greeter::ask(SealedSenders& senders, HelloWriter& writer, nanoseconds now) const noexcept {
  for (const SealedSender& sender : senders.all()) {
    if (sender.trusted || now - sender.heard > kHeardLately) continue;
    if (!writer.want(sender.sealer.boot)) return;
  }
}

std::span<const std::byte> Greeter::write(SealedSenders& senders, std::span<std::byte> room,
                                          nanoseconds now) noexcept {
  HelloWriter writer(own_.nonce, room);
  last_ = now;
  next_ = nanoseconds::max();
  if (!answer(senders, true, writer).is_all) hurry(now);
  const Answered strangers = answer(senders, false, writer);
  ask(senders, writer, now);
  if (strangers.count > 0 || writer.is_asking()) charge(now);
  if (!strangers.is_all) hurry_for_stranger(now);
  if (writer.is_asking()) {
    plan_for_stranger(now + patience_);
    patience_ = std::min(2 * patience_, kLongestPatience);
  }
  return writer.finish();
}

void Greeter::meet(const SealedSenders& senders, nanoseconds now) noexcept {
  patience_ = kFirstPatience;
  // Old datagrams of a dropped sender can be replayed to us with our nonce of that time. A new
  // nonce is enough, because answers are sealed.
  if (dropped_ != senders.trusted_dropped()) ++own_.nonce;
  dropped_ = senders.trusted_dropped();
  hurry_for_stranger(now);
}

bool Greeter::receive(const OpenedDatagram& greeting, nanoseconds received,
                      nanoseconds now) noexcept {
  Hello hello;
  if (!hello.read(greeting.plain)) return false;
  SealedSender& sender = *greeting.sender;
  bool is_news = false;
  if (!sender.has_nonce || greeting.header.count > sender.nonce_count) {
    is_news = !sender.has_nonce || sender.nonce != hello.nonce();
    sender.has_nonce = true;
    sender.nonce = hello.nonce();
    sender.nonce_count = greeting.header.count;
  }
  const std::uint32_t stamp = greeting.header.stamp;
  if (hello.has_echo(own_) && (!sender.trusted || sender.time.is_far(stamp, received))) {
    sender.trusted = true;
    sender.time.begin(stamp, received);
  }
  if (!is_news && !hello.wants(own_.boot)) return true;
  sender.echo_due = true;
  if (sender.trusted) {
    hurry(now);
  } else {
    hurry_for_stranger(now);
  }
  return true;
}

void Greeter::doubt(nanoseconds now) noexcept {
  if (now - doubted_ < kDoubtGap) return;
  doubted_ = now;
  ++own_.nonce;
  hurry(now);
}

}  // namespace reckon::peer
