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
    {{SealingSuite::aes_256_gcm,
      1,
      {0x0123456789ABCDEF, 1, 1},
      0,
      1,
      0x01020304,
      0x1122334455667788},
     "e7110001000100010123456789abcdef0000000000000001010203041122334455667788fc5a27e154c520d5c5"
     "60e92c2072aa6d0a44c3010f83347ca4bd9dd6104831f2172334c691bcd96c0a638d68b4759c107c9e51eddae5"
     "9bf0062a21a28c"},
    {{SealingSuite::aes_256_gcm,
      65534,
      {0xFEDCBA9876543210, 700, 65535},
      1,
      (1ULL << 40) - 1,
      0xFFFFFFFF,
      0x8877665544332211},
     "e711fffe02bcfffffedcba9876543210000100ffffffffffffffffff88776655443322110a889898627a21dbc5"
     "904a8bc2df7742f01d3b2ec4a60e68853813301455ed6e78df628a321a52e8adc7564005faa33cc4f649a7492e"
     "ca362196218b65"},
    {{SealingSuite::xchacha20_poly1305,
      1,
      {0x0123456789ABCDEF, 1, 1},
      0,
      1,
      0x01020304,
      0x1122334455667788},
     "e7120001000100010123456789abcdef0000000000000001010203041122334455667788586b3f184b43a6eda1"
     "d9631642cb8493a32b5bcfb0cb36a8bd3468b1d3e665faabd5ce96084cb60456bfbbd160d42d787185cc6362fb"
     "2775eb077646cc"},
    {{SealingSuite::xchacha20_poly1305,
      65534,
      {0xFEDCBA9876543210, 700, 65535},
      1,
      (1ULL << 40) - 1,
      0xFFFFFFFF,
      0x8877665544332211},
     "e712fffe02bcfffffedcba9876543210000100ffffffffffffffffff887766554433221156949209a043314700"
     "6733b079afd4a2bb4cb007ff501b53dde846e2ce5f26d4b990515926303df3eeea215296b8433dd204a9a293d6"
     "ddbfdb8a2e7a40"}};

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

const Destination kTo = destination_of(*IpEndpoint::parse("239.192.1.7:3001"), 9);

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
  key_of(vector.header).seal(vector.header, kTo, plain(), out);
  EXPECT_EQ(out, samples::from_hex(vector.datagram));
}

TEST_P(SealingVectors, OpensWhatOthersSealed) {
  const Octets datagram = samples::from_hex(GetParam().datagram);
  EXPECT_EQ(read_envelope(datagram), GetParam().header);
  Octets out(plain().size());
  EXPECT_TRUE(key_of(GetParam().header).open(datagram, kTo, out));
  EXPECT_EQ(out, plain());
}

TEST_P(SealingVectors, RefusesEachFlippedBit) {
  const Octets datagram = samples::from_hex(GetParam().datagram);
  Octets out(plain().size());
  for (std::size_t bit = 0; bit < 8 * datagram.size(); ++bit) {
    Octets forged = datagram;
    forged[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
    const SealingKey key = key_of(read_envelope(forged).value_or(GetParam().header));
    EXPECT_FALSE(key.open(forged, kTo, out)) << "bit " << bit;
  }
}

TEST_P(SealingVectors, RefusesEachFlippedBitOfThePlace) {
  const Octets datagram = samples::from_hex(GetParam().datagram);
  const SealingKey key = key_of(GetParam().header);
  Octets out(plain().size());
  for (std::size_t bit = 0; bit < 8 * kTo.size(); ++bit) {
    Destination other = kTo;
    other[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
    EXPECT_FALSE(key.open(datagram, other, out)) << "bit " << bit;
  }
}

INSTANTIATE_TEST_SUITE_P(Suites, SealingVectors, testing::ValuesIn(kVectors));

TEST(DeriveKey, DiffersInEachThingThatItNames) {
  const EnvelopeHeader header{SealingSuite::aes_256_gcm, 1, {7, 2, 3}, 0, 1, 0, 0};
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
  later.stamp = 7;
  EXPECT_EQ(derive_key(secret(), header), derive_key(secret(), later));
  later.salt = 1;
  EXPECT_NE(derive_key(secret(), header), derive_key(secret(), later));
  EnvelopeHeader salted = others[0];
  salted.salt = 1;
  EXPECT_EQ(derive_key(secret(), others[0]), derive_key(secret(), salted)) << "it is in the nonce";
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
