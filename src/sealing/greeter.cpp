// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/greeter.hpp"

#include <algorithm>

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr nanoseconds kGather = milliseconds(5);  // what comes meanwhile is answered together
constexpr nanoseconds kLeastGap = milliseconds(20);
constexpr nanoseconds kFirstPatience = milliseconds(50);
constexpr nanoseconds kLongestPatience = seconds(1);
constexpr nanoseconds kHeardLately = seconds(3);

}  // namespace

void Greeter::hurry(nanoseconds now) noexcept {
  next_ = std::min(next_, std::max(now + kGather, last_ + kLeastGap));
}

// False where there is more to answer than room.
bool Greeter::answer(SealedSenders& senders, HelloWriter& writer) const noexcept {
  for (SealedSender& sender : senders.all()) {
    if (!sender.echo_due) continue;
    if (!writer.echo({sender.sealer.boot, sender.nonce})) return false;
    sender.echo_due = false;
  }
  return true;
}

void Greeter::ask(SealedSenders& senders, HelloWriter& writer, nanoseconds now) const noexcept {
  for (const SealedSender& sender : senders.all()) {
    if (sender.trusted || now - sender.heard > kHeardLately) continue;
    if (!writer.want(sender.sealer.boot)) return;
  }
}

std::span<const std::byte> Greeter::write(SealedSenders& senders, std::uint64_t sealed,
                                          std::span<std::byte> room, nanoseconds now) noexcept {
  HelloWriter writer(own_.nonce, sealed, room);
  const bool is_all = answer(senders, writer);
  ask(senders, writer, now);
  last_ = now;
  next_ = nanoseconds::max();
  if (!is_all) {
    next_ = now + kLeastGap;
  } else if (writer.is_asking()) {
    next_ = now + patience_;
    patience_ = std::min(2 * patience_, kLongestPatience);
  }
  return writer.finish();
}

void Greeter::meet(const SealedSenders& senders, nanoseconds now) noexcept {
  patience_ = kFirstPatience;
  // What was heard of one that has lost its place can be told to us again, with our nonce of then.
  // Another nonce than ever before is enough: answers are sealed.
  if (dropped_ != senders.trusted_dropped()) ++own_.nonce;
  dropped_ = senders.trusted_dropped();
  hurry(now);
}

bool Greeter::hear(std::span<const std::byte> octets, SealedSender& sender,
                   nanoseconds now) noexcept {
  Hello hello;
  if (!hello.read(octets)) return false;
  const bool is_news = !sender.has_nonce || sender.nonce != hello.nonce();
  sender.has_nonce = true;
  sender.nonce = hello.nonce();
  if (is_news || hello.wants(own_.boot)) {
    sender.echo_due = true;
    hurry(now);
  }
  if (hello.has_echo(own_) && !sender.trusted) {
    sender.trusted = true;
    ReplayWindow& window = sender.windows[static_cast<std::size_t>(SealingStream::datagrams)];
    window.raise(hello.sealed() - std::min(hello.sealed(), kTakenBefore));
  }
  return true;
}

}  // namespace reckon::peer
