// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sealed links as peers run them: a reader and a writer thread each, over sockets whose address
// changes, and a third thread that polls their state.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <string>
#include <thread>

#include "reckon/peer/sealing/sealed_link.hpp"
#include "reckon/tests/src/sealing/sealing_samples.hpp"
#include "reckon/tests/src/support/own_network.hpp"
#include "reckon/tests/src/support/udp_on_loopback.hpp"

namespace reckon::peer {
namespace {

using namespace samples;
using namespace test;

// A link that detects concurrent sends.
class OneSenderLink final : public Link {
 public:
  explicit OneSenderLink(Link& inner) : inner_(inner) {}
  bool send(const IpEndpoint& to, std::span<const std::byte> bytes) noexcept override {
    if (sending_.exchange(true, std::memory_order_relaxed)) met = true;
    std::this_thread::yield();  // gives another sender time to enter
    const bool sent = inner_.send(to, bytes);
    sending_.store(false, std::memory_order_relaxed);
    return sent;
  }
  std::size_t receive(std::span<Datagram> out) noexcept override { return inner_.receive(out); }
  std::error_code join(const GroupAddress& group) noexcept override { return inner_.join(group); }
  void leave(const GroupAddress& group) noexcept override { inner_.leave(group); }
  bool wait(nanoseconds timeout) noexcept override { return inner_.wait(timeout); }
  void wake() noexcept override { inner_.wake(); }
  IpEndpoint local_endpoint() const noexcept override { return inner_.local_endpoint(); }
  std::size_t max_payload() const noexcept override { return inner_.max_payload(); }
  LinkStatistics statistics() const noexcept override { return inner_.statistics(); }
  bool take_event(LinkEvent& event) noexcept override { return inner_.take_event(event); }

  std::atomic<bool> met{false};

 private:
  Link& inner_;
  std::atomic<bool> sending_{false};
};

// A member of the group on a0.
struct Member {
  explicit Member(std::uint16_t application)
      : udp(on("a0"), kClock),
        sealed(way, {group_key(), sealed_group(group(1)), 1, application}, kClock) {
    EXPECT_FALSE(sealed.join(sealed_group(group(1))));
  }

  UdpMulticast udp;
  OneSenderLink way{udp};
  SealedLink sealed;
};

// A member that reads and writes continuously, each in its own thread.
struct Talker : Member {
  using Member::Member;
  ~Talker() {
    stop = true;
    reader.join();
    writer.join();
  }
  void read() {
    std::array<Datagram, 16> batch;
    while (!stop) {
      heard += sealed.receive(batch);
      sealed.wait(20ms);
    }
  }
  void write() {
    while (!stop) static_cast<void>(sealed.send(sealed_group(group(1)), octets("word")));
  }

  std::atomic<bool> stop{false};
  std::atomic<std::size_t> heard{0};
  std::thread reader{[this] { read(); }}, writer{[this] { write(); }};
};

// Waits at most 10 s until the talker has the address and receives again.
bool hears_from(Talker& talker, const std::string& address) {
  LinkEvent event;
  std::size_t before = 0;
  bool is_there = false;
  for (const nanoseconds end = kClock.now() + 10s; kClock.now() < end;) {
    static_cast<void>(talker.sealed.take_news());
    static_cast<void>(talker.sealed.take_event(event));
    static_cast<void>(talker.sealed.statistics());
    if (is_there && talker.heard > before) return true;
    is_there = talker.sealed.local_endpoint().address_text() == address;
    if (!is_there) before = talker.heard;
    std::this_thread::yield();
  }
  return false;
}

TEST(SealedThreads, SendOneAtATimeDuringAddressChanges) {
  RECKON_IN_OWN_NETWORK([] {
    make_cable();
    Talker one(1), other(2);
    std::string last = "10.66.0.1";
    for (std::uint16_t i = 0; i < 5; ++i) {
      Member newcomer(static_cast<std::uint16_t>(3 + i));  // greeted by both
      std::array<Datagram, 16> batch;
      newcomer.sealed.receive(batch);
      const std::string next = "10.66.0." + std::to_string(20 + i);
      EXPECT_TRUE(test::run(
          ("ip addr delete " + last + "/24 dev a0 && ip addr add " + next + "/24 dev a0").c_str()));
      EXPECT_TRUE(hears_from(one, next)) << next;
      EXPECT_TRUE(hears_from(other, next)) << next;
      last = next;
    }
    EXPECT_FALSE(one.way.met || other.way.met);
  });
}

}  // namespace
}  // namespace reckon::peer
