// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/sealing_key.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "reckon/tests/src/sealing/sealing_samples.hpp"

namespace reckon::peer {
namespace {

using samples::Octets;

// By make_vectors.py, which knows nothing of libsodium.
struct Vector {
  EnvelopeHeader header;
  const char* datagram;
};
const Vector kVectors[] = {
    {{SealingSuite::aes_256_gcm, 1, {0x0123456789ABCDEF, 1, 1}, 0, 1},
     "e7110001000100010123456789abcdef0000000000000001f58881e9864aabea65ee0ed9c317f0b1437f2a1995276"
     "a"
     "d86b0f7cd90cb37ad213ed2c102c4f523c059ea84791f04bd931d3fac767015078cb2a2caa8a"},
    {{SealingSuite::aes_256_gcm, 65534, {0xFEDCBA9876543210, 700, 65535}, 1, (1ULL << 40) - 1},
     "e711fffe02bcfffffedcba9876543210000100ffffffffff0508a6f3599af0f143529f6a2c1d8065bf4f82932ce60"
     "c"
     "739fa85dc767080457ed437bfe08adf823eea0e1bafe3cada12a2ac99802c34df3a0824b4678"},
    {{SealingSuite::xchacha20_poly1305, 1, {0x0123456789ABCDEF, 1, 1}, 0, 1},
     "e7120001000100010123456789abcdef00000000000000019b248b55f9de78c57210d80b9c367e686b915dc86e271"
     "9"
     "165b9418ecc441eceaf39e9efddf1548364dcde1b93acad8e84441e66167dbb52a3dc4b6eeaf"},
    {{SealingSuite::xchacha20_poly1305,
      65534,
      {0xFEDCBA9876543210, 700, 65535},
      1,
      (1ULL << 40) - 1},
     "e712fffe02bcfffffedcba9876543210000100ffffffffff9a6bf8e82bae61c9989a7c1ca9f0e8fb1732cae83e6b3"
     "9"
     "b1d62dec577388f307c1dba1e01571af4920b0ea7d8df271505402fc6cc5e643f6b5cca59057"}};

KeyOctets secret() {
  KeyOctets octets;
  for (std::size_t i = 0; i < octets.size(); ++i) octets[i] = static_cast<std::byte>(i);
  return octets;
}

Octets plain() {
  Octets octets(45);
  for (std::size_t i = 0; i < octets.size(); ++i) octets[i] = static_cast<std::byte>(7 * i + 3);
  return octets;
}

SealingKey key_of(const EnvelopeHeader& header) {
  SealingKey key;
  key.set_key(header.suite, derive_key(secret(), header));
  return key;
}

class SealingVectors : public testing::TestWithParam<Vector> {
 protected:
  void SetUp() override {
    if (!can_seal(GetParam().header.suite)) GTEST_SKIP() << "this CPU has no AES instructions";
  }
};

TEST_P(SealingVectors, SealsAsOtherImplementationsOfThePrimitivesDo) {
  const Vector& vector = GetParam();
  Octets out(plain().size() + kEnvelope);
  key_of(vector.header).seal(vector.header, plain(), out);
  EXPECT_EQ(out, samples::from_hex(vector.datagram));
}

TEST_P(SealingVectors, OpensWhatOthersSealed) {
  const Octets datagram = samples::from_hex(GetParam().datagram);
  EXPECT_EQ(read_envelope(datagram), GetParam().header);
  Octets out(plain().size());
  EXPECT_TRUE(key_of(GetParam().header).open(datagram, out));
  EXPECT_EQ(out, plain());
}

TEST_P(SealingVectors, RefusesEachFlippedBit) {
  const Octets datagram = samples::from_hex(GetParam().datagram);
  const SealingKey key = key_of(GetParam().header);
  Octets out(plain().size());
  for (std::size_t bit = 0; bit < 8 * datagram.size(); ++bit) {
    Octets forged = datagram;
    forged[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
    EXPECT_FALSE(key.open(forged, out)) << "bit " << bit;
  }
}

INSTANTIATE_TEST_SUITE_P(Suites, SealingVectors, testing::ValuesIn(kVectors));

TEST(DeriveKey, DiffersInEachThingThatItNames) {
  const EnvelopeHeader header{SealingSuite::aes_256_gcm, 1, {7, 2, 3}, 0, 1};
  std::vector<EnvelopeHeader> others(5, header);
  others[0].suite = SealingSuite::xchacha20_poly1305;
  others[1].epoch = 2;
  others[2].sealer.boot = 8;
  others[3].sealer.site = 3;
  others[4].sealer.application = 2;
  for (const EnvelopeHeader& other : others)
    EXPECT_NE(derive_key(secret(), header), derive_key(secret(), other));
  EnvelopeHeader later = header;
  later.stream = 1;
  later.count = 900;
  EXPECT_EQ(derive_key(secret(), header), derive_key(secret(), later));
}

TEST(Envelope, IsNoneWhereTooShortPlainOrOfAnUnknownSuite) {
  const Octets datagram = samples::from_hex(kVectors[0].datagram);
  for (std::size_t size = 0; size < kEnvelope; ++size)
    EXPECT_FALSE(read_envelope(std::span(datagram).first(size))) << size;
  Octets other = datagram;
  other[0] = std::byte{7};
  EXPECT_FALSE(read_envelope(other));
  other = datagram;
  other[1] = std::byte{0x13};
  EXPECT_FALSE(read_envelope(other));
}

}  // namespace
}  // namespace reckon::peer
