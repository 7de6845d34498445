// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Octets within the length of a PDU after its last field: decode() skips them, trailing_octets()
// returns them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/tests/support/wire_samples.hpp"

namespace reckon::pdu {
namespace {

TEST(TrailingOctets, AreNoneInAnyGoldenSample) {
  std::size_t samples = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(test::sample_path("fire", ".hex").parent_path())) {
    if (entry.path().extension() != ".hex") continue;
    const auto octets = test::sample_octets(entry.path().stem().string());
    PduHeader header;
    ASSERT_EQ(decode_header(octets, header), DecodeError::none) << entry.path();
    EXPECT_EQ(visit(octets, header,
                    [&](const auto& pdu) {
                      EXPECT_TRUE(trailing_octets(octets, pdu).empty()) << entry.path();
                    }),
              DecodeError::none);
    ++samples;
  }
  EXPECT_GE(samples, 76U);
}

TEST(TrailingOctets, AreTheOctetsThatEncodeOmits) {
  const std::vector<std::byte> records(32, std::byte{0x11});
  EntityState state;
  state.variable_parameters = records;
  std::vector<std::byte> octets(300);  // the datagram continues after the PDU
  ASSERT_EQ(encode(state, octets), 176U);
  EntityState decoded;
  ASSERT_EQ(decode(octets, decoded), DecodeError::none);
  EXPECT_TRUE(trailing_octets(octets, decoded).empty());

  octets[19] = std::byte{0};  // number_of_variable_parameter_records
  ASSERT_EQ(decode(octets, decoded), DecodeError::none);
  const auto trailing = trailing_octets(octets, decoded);
  EXPECT_TRUE(std::ranges::equal(trailing, records));
  EXPECT_EQ(trailing.data(), octets.data() + 144);
  EXPECT_EQ(wire_size(decoded) + trailing.size(), 176U);
}

TEST(TrailingOctets, ExcludePaddingOfBits) {
  Signal signal;
  const std::vector<std::byte> data(4, std::byte{0x22});  // 13 bits in 2 octets, 2 of padding
  signal.data = {13, data};
  std::vector<std::byte> octets(64);
  const std::size_t size = encode(signal, octets);
  Signal decoded;
  ASSERT_EQ(decode(octets, decoded), DecodeError::none);
  EXPECT_TRUE(trailing_octets(octets, decoded).empty());
  store_big_endian(octets.data() + 8, static_cast<std::uint16_t>(size + 7));
  ASSERT_EQ(decode(octets, decoded), DecodeError::none);
  EXPECT_EQ(trailing_octets(octets, decoded).size(), 7U);
}

}  // namespace
}  // namespace reckon::pdu
