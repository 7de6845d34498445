// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/sealed_link.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "reckon/peer/sealing/envelope_opener.hpp"
#include "reckon/peer/sealing/greeter.hpp"
#include "reckon/peer/sealing/held_datagrams.hpp"
#include "reckon/peer/sealing/recent_joins.hpp"
#include "reckon/peer/sealing/sealing_watch.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

// Datagrams taken from the inner link at once, and the most turns in one receive(): a refused flood
// must not delay the reader.
constexpr std::size_t kInnerBatch = 64;
constexpr int kBatchesPerReceive = 8;
constexpr nanoseconds kLookAtTime = milliseconds(100);
constexpr nanoseconds kHeldFor = std::chrono::seconds(3);
// Largest change of the difference between steady clock and UTC from one look to the next. A larger
// change means that the machine was suspended.
constexpr nanoseconds kMostLeap = std::chrono::seconds(2);

/// Counters with the names that a peer lists.
struct Counts {
  explicit Counts(Counters& c)
      : verdicts{&c.make("sealed_in", "sealed datagrams opened"),
                 &c.make_in(kRefusedDatagrams, "unsealed", "unsealed_in",
                            "datagrams refused because they are not sealed"),
                 &c.make_in(kRefusedDatagrams, "other_suite", "sealed_other_suite_in",
                            "sealed datagrams of another suite, refused"),
                 &c.make_in(kRefusedDatagrams, "unknown_epoch", "sealed_unknown_epoch_in",
                            "of an epoch that the key file lacks, refused"),
                 &c.make_in(kRefusedDatagrams, "old_epoch", "sealed_old_epoch_in",
                            "of an expired epoch, refused"),
                 &c.make_in(kRefusedDatagrams, "own_sealed", "sealed_own_in",
                            "own sealed datagrams that returned, refused"),
                 &c.make_in(kRefusedDatagrams, "no_stream", "sealed_no_stream_in",
                            "of a stream without a sender, refused"),
                 &c.make_in(kRefusedDatagrams, "replayed", "sealed_replayed_in",
                            "repeated sealed datagrams, refused"),
                 &c.make_in(kRefusedDatagrams, "forged", "sealed_forged_in",
                            "sealed datagrams with a wrong tag, or of another group, refused"),
                 &c.make_in(kRefusedDatagrams, "outdated", "sealed_outdated_in",
                            "sealed before their group was joined, or not within the last second, "
                            "refused")},
        held(c.make("sealed_held_in", "held until their sender answered")),
        held_lost(c.make_in(kRefusedDatagrams, "unanswered", "sealed_held_lost",
                            "of senders that did not answer, dropped")),
        hellos_in(c.make("sealed_hellos_in", "greetings of other sealed links")),
        hellos_out(c.make("sealed_hellos_out", "own greetings")),
        trusted(c.make("sealed_trusted", "senders that answered")),
        exhausted(c.make("sealed_exhausted_out", "not sent: the stream is at its end")) {}

  std::array<Counter*, 10> verdicts;  // in the order of SealedVerdict
  Counter &held, &held_lost, &hellos_in, &hellos_out, &trusted, &exhausted;
};

// Two streams of one boot count separately.
bool envelope_number(std::span<const std::byte> octets, DatagramEvent& out) noexcept {
  EnvelopeHeader header;
  if (!read_envelope(octets, header)) return false;
  out.epoch = header.sealer.boot;
  out.sequence = static_cast<std::uint32_t>(header.count);
  out.stream = static_cast<std::uint8_t>(std::min<unsigned>(header.stream, 254u) + 1u);
  return true;
}

}  // namespace

GroupAddress sealed_group(GroupAddress base) {
  if (base.port == std::numeric_limits<std::uint16_t>::max())
    throw std::invalid_argument(
        "a sealed exercise uses the port above 'port', and there is none above 65535: write 65534");
  ++base.port;
  return base;
}

// One boot in a sealed exercise: its sealer, its trusted senders, and datagrams that wait for
// trust.
struct SealedLink::Session {
  Session(Link& wrapped, SealedLinkOptions asked, const Clock& steady)
      : inner(wrapped),
        clock(steady),
        options(std::move(asked)),
        sealer(options.key, options.site, options.application, options.places, options.random),
        opener(options.key, sealer.own(), options.places),
        greeter(sealer.own().boot, draw(options.random)),
        counts(std::make_unique<Counts>(own_counters)),
        sealed(std::make_unique_for_overwrite<std::byte[]>(kSealedRoom)),
        hello(std::make_unique_for_overwrite<std::byte[]>(kSealedRoom)),
        plain(std::make_unique_for_overwrite<std::byte[]>(kInnerBatch * kMaxDatagram)),
        instance(options.instance()),
        utc_ahead(clock.utc_now() - clock.now()) {
    if (options.tap != nullptr) options.tap->read_envelopes_by(envelope_number);
    follow_time(clock.now());
  }

  void follow_time(nanoseconds now) noexcept;
  void look_at_self(nanoseconds now) noexcept;
  void begin_anew(nanoseconds now) noexcept;
  void tend(nanoseconds now) noexcept;
  void greet(nanoseconds now) noexcept;
  /// Seals and sends. The reports of the inner link about its sends are under the lock too, because
  /// two threads send.
  [[nodiscard]] bool send(SealingStream stream, const IpEndpoint& to,
                          std::span<const std::byte> bytes, std::span<std::byte> room,
                          nanoseconds now) noexcept;
  void note(DatagramTap::Loop loop, DatagramFate fate, const GroupAddress& group,
            std::span<const std::byte> octets) noexcept {
    if (options.tap != nullptr) options.tap->note(loop, fate, group, octets);
  }
  [[nodiscard]] std::span<std::byte> room(std::size_t index) noexcept {
    return {plain.get() + index * kMaxDatagram, kMaxDatagram};
  }
  std::size_t take_released(std::span<Datagram> out, std::size_t at) noexcept;
  void meet(nanoseconds now) noexcept;
  [[nodiscard]] bool take_in(const Datagram& datagram, nanoseconds now, std::size_t index,
                             Datagram& out) noexcept;
  void take_hello(const OpenedDatagram& opened, nanoseconds received, nanoseconds now) noexcept;
  void hold(const OpenedDatagram& opened, const Datagram& datagram, nanoseconds since,
            nanoseconds now) noexcept;

  static constexpr std::size_t kSealedRoom = kMaxDatagram + kEnvelope;

  Link& inner;
  const Clock& clock;
  SealedLinkOptions options;
  EnvelopeSealer sealer;
  EnvelopeOpener opener;
  Greeter greeter;
  HeldDatagrams held;
  RecentJoins joins;  // of the reader
  SealingWatch watch;
  Counters own_counters;
  std::unique_ptr<Counts> counts;
  std::unique_ptr<std::byte[]> sealed, hello, plain;
  std::array<Datagram, kInnerBatch> batch{};
  std::mutex sending;                 // greetings are sent by the reader, all else by the writer
  std::atomic<std::size_t> epoch{0};  // set by the reader, used by the writer
  nanoseconds next_look{0};
  std::uint64_t instance;                  // of the process that has the boot
  nanoseconds utc_ahead;                   // of UTC, relative to the steady clock
  nanoseconds begun = nanoseconds::min();  // nothing from before is accepted
  std::uint64_t dropped = 0;               // trusted senders dropped so far
};

void SealedLink::Session::follow_time(nanoseconds now) noexcept {
  if (options.key.epochs.size() > 1) opener.follow_time(now, clock.utc_now());
  epoch.store(opener.epoch(), std::memory_order_relaxed);
  next_look = now + kLookAtTime;
}

// A failure of the random source has no remedy; the next look tries it again.
void SealedLink::Session::begin_anew(nanoseconds now) noexcept {
  std::uint64_t nonce = 0;
  if (!options.random(std::as_writable_bytes(std::span(&nonce, 1)))) return;
  const std::uint64_t seen = options.instance();
  if (seen != instance) {
    const std::lock_guard lock(sending);
    if (!sealer.begin_anew()) return;
  }
  instance = seen;
  utc_ahead = clock.utc_now() - now;
  opener.begin_anew(sealer.own());
  greeter.begin_anew(sealer.own().boot, nonce);
  begun = now;
}

void SealedLink::Session::look_at_self(nanoseconds now) noexcept {
  const nanoseconds leap = clock.utc_now() - now - utc_ahead;
  if (options.instance() != instance || std::chrono::abs(leap) > kMostLeap) return begin_anew(now);
  utc_ahead += leap;
}

void SealedLink::Session::tend(nanoseconds now) noexcept {
  if (now >= next_look) {
    look_at_self(now);
    follow_time(now);
    watch.tick(now);
    joins.forget_old(now);
  }
  if (now >= greeter.next()) greet(now);
}

bool SealedLink::Session::send(SealingStream stream, const IpEndpoint& to,
                               std::span<const std::byte> bytes, std::span<std::byte> room,
                               nanoseconds now) noexcept {
  const bool is_said = stream == SealingStream::datagrams;
  const std::lock_guard lock(sending);
  const auto datagram =
      sealer.seal(stream, epoch.load(std::memory_order_relaxed), to, now, bytes, room);
  if (datagram.empty()) {
    counts->exhausted.add();
    if (is_said) note(DatagramTap::Loop::write, DatagramFate::unsealable, to, bytes);
    return false;
  }
  if (is_said) note(DatagramTap::Loop::write, DatagramFate::sealed, to, bytes);
  note(DatagramTap::Loop::write, DatagramFate::numbered, to, datagram);
  return inner.send(to, datagram);
}

void SealedLink::Session::greet(nanoseconds now) noexcept {
  std::array<std::byte, Greeter::kLongest> octets;
  const std::size_t most = std::min(octets.size(), inner.max_payload() - kEnvelope);
  const auto said = greeter.write(opener.senders(), std::span(octets).first(most), now);
  static_cast<void>(
      send(SealingStream::control, options.base, said, std::span(hello.get(), kSealedRoom), now));
  counts->hellos_out.add();
}

std::size_t SealedLink::Session::take_released(std::span<Datagram> out, std::size_t at) noexcept {
  for (; at < out.size() && at < kInnerBatch && held.take(out[at], room(at)); ++at)
    note(DatagramTap::Loop::read, DatagramFate::arrived, out[at].group, out[at].bytes);
  return at;
}

// The newcomer may have replaced a trusted sender; then the replay windows of that one are lost.
void SealedLink::Session::meet(nanoseconds now) noexcept {
  if (opener.senders().trusted_dropped() != dropped) begun = now;
  dropped = opener.senders().trusted_dropped();
  greeter.meet(opener.senders(), now);
}

// Whether `out` is to be returned.
bool SealedLink::Session::take_in(const Datagram& datagram, nanoseconds now, std::size_t index,
                                  Datagram& out) noexcept {
  const auto tell = [&](DatagramFate fate) {
    note(DatagramTap::Loop::read, fate, datagram.group, datagram.bytes);
  };
  if (datagram.bytes.size() > kMaxDatagram) return tell(DatagramFate::not_opened), false;
  const nanoseconds since = std::max(begun, joins.since(datagram.group));
  const OpenedDatagram opened = opener.open(datagram, since, now, room(index));
  counts->verdicts[static_cast<std::size_t>(opened.verdict)]->add();
  watch.look(opened, datagram.sender, now);
  if (opened.verdict == SealedVerdict::outdated && opened.is_newest) greeter.doubt(now);
  if (opened.verdict != SealedVerdict::opened) return tell(DatagramFate::not_opened), false;

  const SealedSender& sender = *opened.sender;
  if (opened.is_new) meet(now);
  if (opened.header.stream == static_cast<std::uint16_t>(SealingStream::control)) {
    tell(DatagramFate::greeting);
    take_hello(opened, datagram.received, now);
    return false;
  }
  out = datagram;
  out.bytes = opened.plain;
  out.boot = sender.sealer.boot;
  tell(sender.trusted ? DatagramFate::opened : DatagramFate::held);
  if (!sender.trusted) return hold(opened, out, since, now), false;
  note(DatagramTap::Loop::read, DatagramFate::arrived, out.group, out.bytes);
  return true;
}

void SealedLink::Session::take_hello(const OpenedDatagram& opened, nanoseconds received,
                                     nanoseconds now) noexcept {
  const SealedSender& sender = *opened.sender;
  const bool before = sender.trusted;
  if (!greeter.receive(opened, received, now)) return;
  counts->hellos_in.add();
  if (!sender.trusted || before) return;
  counts->trusted.add();
  held.release(sender);
}

// Keeps nothing of a sender that has not answered for a long time, because a recording never
// answers.
void SealedLink::Session::hold(const OpenedDatagram& opened, const Datagram& datagram,
                               nanoseconds since, nanoseconds now) noexcept {
  SealedSender& sender = *opened.sender;
  const bool is_held =
      now - sender.since <= kHeldFor && held.push(sender, opened.header, datagram, since);
  (is_held ? counts->held : counts->held_lost).add();
}

SealedLink::SealedLink(Link& inner, SealedLinkOptions options, const Clock& clock)
    : LinkAround(inner) {
  if (inner.max_payload() < kEnvelope + Greeter::kShortest)
    throw std::invalid_argument("the network's payload has no room for an envelope");
  session_ = std::make_unique<Session>(inner, std::move(options), clock);
}

SealedLink::~SealedLink() = default;

void SealedLink::count_in(Counters& counters) {
  session_->counts = std::make_unique<Counts>(counters);
}

std::vector<std::string> SealedLink::take_news() {
  std::vector<std::string> lines;
  SealingNews news;
  while (session_->watch.news().pop(news)) lines.push_back(news.text());
  return lines;
}

bool SealedLink::send(const IpEndpoint& to, std::span<const std::byte> bytes) noexcept {
  Session& s = *session_;
  return s.send(SealingStream::datagrams, to, bytes,
                std::span(s.sealed.get(), Session::kSealedRoom), s.clock.now());
}

std::size_t SealedLink::receive(std::span<Datagram> out) noexcept {
  Session& s = *session_;
  const nanoseconds now = s.clock.now();
  s.tend(now);
  out = out.first(std::min(out.size(), kInnerBatch));
  std::size_t delivered = s.take_released(out, 0);
  for (int i = 0; i < kBatchesPerReceive && delivered < out.size(); ++i) {
    const std::size_t wanted = out.size() - delivered;
    const std::size_t got = s.inner.receive(std::span(s.batch).first(wanted));
    for (std::size_t k = 0; k < got; ++k)
      if (s.take_in(s.batch[k], now, delivered, out[delivered])) ++delivered;
    if (got < wanted) break;
  }
  return s.take_released(out, delivered);
}

std::error_code SealedLink::join(const GroupAddress& group) noexcept {
  session_->joins.note(group, session_->clock.now());
  return session_->inner.join(group);
}

// Waits at most until the next greeting is due.
bool SealedLink::wait(nanoseconds timeout) noexcept {
  Session& s = *session_;
  if (s.held.has_released()) return true;
  const nanoseconds next = s.greeter.next();
  const nanoseconds now = s.clock.now();
  const nanoseconds until = next > now ? next - now : nanoseconds(0);
  return s.inner.wait(std::min(timeout, until)) || next <= s.clock.now();
}

std::size_t SealedLink::max_payload() const noexcept {
  return session_->inner.max_payload() - kEnvelope;
}

}  // namespace reckon::peer
