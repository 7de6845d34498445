// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A sealer that was copied unnoticed, as by a snapshot of its machine.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <functional>
#include <set>
#include <tuple>
#include <vector>

#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/sealing/sealed_link.hpp"
#include "reckon/tests/src/sealing/sealing_samples.hpp"

namespace reckon::peer {
namespace {

using namespace samples;

constexpr std::size_t kSaid = 300;
using Head = std::array<std::byte, kEnvelopeHeader>;

// Headers of kSaid datagrams sealed from `now` on at intervals of `gap`, some in each stream.
std::vector<Head> heads_of(EnvelopeSealer& sealer, nanoseconds now, nanoseconds gap) {
  std::vector<Head> heads(kSaid);
  for (std::size_t i = 0; i < kSaid; ++i, now += gap) {
    const auto stream = i % 3 == 0 ? SealingStream::control : SealingStream::datagrams;
    const Octets one = sealed(sealer, Octets(20), stream, 0, group_of(), now);
    std::copy_n(one.begin(), kEnvelopeHeader, heads[i].begin());
  }
  return heads;
}

// The headers of a forked copy that continues by itself.
std::vector<Head> heads_of_copy(const std::function<std::vector<Head>()>& seal) {
  std::array<int, 2> pipe{};
  EXPECT_EQ(::pipe(pipe.data()), 0);
  const pid_t copy = ::fork();
  if (copy == 0) {
    const std::vector<Head> heads = seal();
    const auto size = static_cast<ssize_t>(heads.size() * sizeof(Head));
    ::_exit(::write(pipe[1], heads.data(), static_cast<std::size_t>(size)) == size ? 0 : 1);
  }
  ::close(pipe[1]);
  std::vector<Head> heads(kSaid);
  std::size_t got = 0;
  const std::span<std::byte> room = std::as_writable_bytes(std::span(heads));
  for (ssize_t more = 1; more > 0 && got < room.size(); got += static_cast<std::size_t>(more))
    more = ::read(pipe[0], room.data() + got, room.size() - got);
  ::close(pipe[0]);
  int status = 1;
  EXPECT_EQ(::waitpid(copy, &status, 0), copy);
  EXPECT_EQ(status, 0);
  return heads;
}

// Counts the headers that both have: the whole header names key and nonce.
std::size_t shared(const std::vector<Head>& one, const std::vector<Head>& other) {
  const std::set<Head> all(one.begin(), one.end());
  return static_cast<std::size_t>(
      std::ranges::count_if(other, [&](const Head& head) { return all.contains(head); }));
}

TEST(ClonedSealer, SharesNoKeyAndNonceWithItsCopy) {
  for (const SealingSuite suite : {SealingSuite::xchacha20_poly1305, fast_suite()}) {
    EnvelopeSealer sealer(group_key(1, suite), 1, 1);
    static_cast<void>(heads_of(sealer, 1s, 100us));
    const auto go_on = [&] { return heads_of(sealer, 1s + 500ms, 100us); };
    const std::vector<Head> copy = heads_of_copy(go_on);
    EXPECT_EQ(shared(go_on(), copy), 0U);
  }
}

// All datagrams are sealed in one microsecond, the same as before the copy.
TEST(ClonedSealer, SharesNoNonceAtAllWithXchacha) {
  EnvelopeSealer sealer(group_key(), 1, 1);
  const auto go_on = [&] { return heads_of(sealer, 1s, 0us); };
  static_cast<void>(go_on());
  const std::vector<Head> copy = heads_of_copy(go_on);
  EXPECT_EQ(shared(go_on(), copy), 0U);
}

// The nonce of AES-GCM has no room for random octets. A copy can therefore reuse the rest of the
// old salt in the same microsecond.
TEST(ClonedSealer, SharesAtMostOneRestOfAesSalt) {
  if (!can_seal(SealingSuite::aes_256_gcm)) GTEST_SKIP() << "this CPU has no AES instructions";
  EnvelopeSealer sealer(group_key(1, SealingSuite::aes_256_gcm), 1, 1);
  static_cast<void>(heads_of(sealer, 1s, 0us));
  const auto go_on = [&] { return heads_of(sealer, 1s, 0us); };
  const std::vector<Head> copy = heads_of_copy(go_on);
  EXPECT_LE(shared(go_on(), copy), 2 * EnvelopeSealer::kMostOfSalt);
}

std::uint64_t instance_now = 1;
std::uint64_t instance() noexcept { return instance_now; }

struct Clone : testing::Test {
  SealedLinkOptions options(std::uint16_t application) {
    SealedLinkOptions out;
    out.key = group_key();
    out.base = group_of();
    out.application = application;
    if (application == 0) out.instance = instance;
    return out;
  }
  Clone() {
    EXPECT_FALSE(one.join(group_of()) || other.join(group_of()));
    run(200ms);
  }
  // Runs for `span`; returns the boot of the last datagram that `other` received.
  std::uint64_t run(nanoseconds span) {
    std::uint64_t boot = 0;
    std::array<Datagram, 16> batch;
    for (nanoseconds passed{0}; passed < span; passed += 1ms, clock.advance(1ms)) {
      if (passed % 10ms == 0ns) {
        one.send(group_of(), Octets(20));
        other.send(group_of(), Octets(20));
      }
      heard_by_one += one.receive(batch);
      if (const std::size_t count = other.receive(batch)) boot = batch[count - 1].boot;
    }
    return boot;
  }
  ManualClock clock{1s};
  SimulatedNetwork hub{{.links = 2}, clock};
  SealedLink one{hub.link(0), options(0), clock}, other{hub.link(1), options(1), clock};
  std::size_t heard_by_one = 0;
};

TEST_F(Clone, ContinuesUnderAnotherBootOnANewInstance) {
  const std::uint64_t before = run(100ms);
  ASSERT_NE(before, 0U);
  EXPECT_EQ(run(300ms), before);
  ++instance_now;
  const std::uint64_t after = run(300ms);
  EXPECT_NE(after, 0U);
  EXPECT_NE(after, before);
  heard_by_one = 0;
  run(100ms);
  EXPECT_GE(heard_by_one, 9U) << "all have proved anew that they are alive";
}

TEST(SystemInstance, DiffersInAForkOnly) {
  const std::uint64_t own = system_instance();
  EXPECT_EQ(system_instance(), own);
  const pid_t copy = ::fork();
  if (copy == 0) ::_exit(system_instance() != own ? 0 : 1);
  int status = 1;
  EXPECT_EQ(::waitpid(copy, &status, 0), copy);
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace reckon::peer
