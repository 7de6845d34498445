// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Recorded traffic of other programs: every PDU of every datagram, octet for octet.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <concepts>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/finite.hpp"
#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/type_names.hpp"
#include "reckon/tests/pdu/support/pcap_reader.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/reference_data.hpp"

namespace reckon::pdu {
namespace {

struct Tally {
  std::map<PduType, std::size_t> exact;  // decoded and encoded to the same octets
  std::map<PduType, std::size_t> kept;   // no field table, kept as octets
  std::map<DecodeError, std::size_t> bad;
  std::size_t allocations = 0;
};

// Decodes, encodes and compares one PDU of a bundle, all without heap.
void take(const BundledPdu& pdu, Tally& tally) {
  if (pdu.error != DecodeError::none) {
    ++tally.bad[pdu.error];
    return;
  }
  static std::array<std::byte, kMaxPduSize> out;
  bool exact = false;
  const test::AllocationGuard guard;
  const DecodeError error = visit(pdu.bytes, pdu.header, [&](const auto& typed) {
    const std::size_t size = encode(typed, out);
    exact = std::equal(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(size),
                       pdu.bytes.begin(), pdu.bytes.end());
  });
  tally.allocations += guard.count();
  if (error == DecodeError::unknown_type) {
    ++tally.kept[pdu.header.pdu_type];
  } else if (error != DecodeError::none) {
    ++tally.bad[error];
  } else {
    EXPECT_TRUE(exact) << name(pdu.header.pdu_type) << " of " << pdu.bytes.size() << " octets";
    tally.exact[pdu.header.pdu_type] += exact ? 1 : 0;
  }
}

Tally read_captures(const std::filesystem::path& folder) {
  Tally tally;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".pcap") continue;
    for (const auto& datagram : test::udp_payloads(file.path()))
      for (const BundledPdu& pdu : BundleReader(datagram)) take(pdu, tally);
  }
  return tally;
}

TEST(RecordedSessions, DecodeAndEncodeOctetForOctet) {
  RECKON_NEED_DATA("dis-captures/real-sessions");
  const Tally tally = read_captures(test::reference_data() / "dis-captures/real-sessions");
  const std::map<PduType, std::size_t> exact{
      {PduType::entity_state, 2132}, {PduType::data, 273},   {PduType::attribute, 2406},
      {PduType::transmitter, 237},   {PduType::receiver, 7}, {PduType::environmental_process, 944}};
  EXPECT_EQ(tally.exact, exact);
  EXPECT_TRUE(tally.kept.empty());
  // Only the two Data PDUs that the recorder cut at 8192 octets.
  const std::map<DecodeError, std::size_t> bad{{DecodeError::truncated, 2}};
  EXPECT_EQ(tally.bad, bad);
  EXPECT_EQ(tally.allocations, 0U);
}

TEST(RecordedSessions, CoupleEntityStatesWithTheNextAttributePdu) {
  RECKON_NEED_DATA("dis-captures/real-sessions");
  const auto folder = test::reference_data() / "dis-captures/real-sessions";
  std::size_t coupled = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    for (const auto& datagram : test::udp_payloads(file.path())) {
      EntityId extended;
      for (const BundledPdu& pdu : BundleReader(datagram)) {
        EntityState state;
        Attribute attribute;
        if (decode(pdu.bytes, state) == DecodeError::none) {
          EXPECT_TRUE(state.header.coupled_extension());
          EXPECT_TRUE(all_finite(state));
          extended = state.entity_id;
        } else if (decode(pdu.bytes, attribute) == DecodeError::none && extended != EntityId{}) {
          EXPECT_EQ((*AttributeReader(attribute).begin()).entity_id, extended);
          ++coupled;
        }
      }
    }
  }
  EXPECT_EQ(coupled, 2132U);
}

// Visitor of the records of an Environmental Process. Counts their locations at a plausible
// distance from the centre of the earth, by record type.
class Places {
 public:
  explicit Places(std::map<std::uint32_t, std::size_t>& on_earth) : on_earth_(on_earth) {}
  template <typename T>
  void operator()(std::string_view, const T& value) {
    if constexpr (std::same_as<T, WorldCoordinates>) {
      const double radius = std::hypot(value.x, value.y, value.z);
      EXPECT_NEAR(radius, 6371e3, 20e3) << "record type " << type_;
      ++on_earth_[type_];
    }
  }
  template <typename View>
  void walked(std::string_view, const View&) {}
  void look(const SizedRecord<EnvironmentRecord>& record) {
    type_ = record.head.record_type;
    parts(*this, record.head, record.body);
  }

 private:
  std::map<std::uint32_t, std::size_t>& on_earth_;
  std::uint32_t type_ = 0;
};

TEST(RecordedSessions, HaveAllEnvironmentLocationsOnTheEarth) {
  RECKON_NEED_DATA("dis-captures/real-sessions");
  std::map<std::uint32_t, std::size_t> places;
  Places look(places);
  const auto folder = test::reference_data() / "dis-captures/real-sessions";
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    for (const auto& datagram : test::udp_payloads(file.path())) {
      for (const BundledPdu& pdu : BundleReader(datagram)) {
        EnvironmentalProcess process;
        if (decode(pdu.bytes, process) != DecodeError::none) continue;
        for (const auto& record : process.environment_records.records()) look.look(record);
      }
    }
  }
  // Counted in the files by another program; a line has two ends.
  const std::map<std::uint32_t, std::size_t> counted{
      {65536, 652}, {655360, 5280}, {786432, 2 * 6109}, {1048576, 470}, {5242880, 652}};
  EXPECT_EQ(places, counted);
}

// Each file holds one PDU; one file is a whole Ethernet frame, one has octets after its PDU.
std::vector<std::byte> bare_pdu(const std::filesystem::path& path) {
  auto octets = test::file_octets(path);
  if (path.filename() == "StartResumePdu.raw") octets.erase(octets.begin(), octets.begin() + 42);
  return octets;
}

TEST(RecordedPdus, OfOtherProductsAreDecodedOrKept) {
  RECKON_NEED_DATA("dis-captures/real-pdus");
  Tally tally;
  std::size_t files = 0;
  for (const auto& file : std::filesystem::recursive_directory_iterator(test::reference_data() /
                                                                        "dis-captures/real-pdus")) {
    if (!file.is_regular_file()) continue;
    ++files;
    const auto octets = bare_pdu(file.path());
    take(*BundleReader(octets).begin(), tally);
  }
  EXPECT_EQ(files, 36U);
  std::size_t exact = 0;
  for (const auto& [type, n] : tally.exact) exact += n;
  EXPECT_EQ(exact, 35U);
  // Type 137 of JCATS is outside the standard.
  const std::map<PduType, std::size_t> kept{{PduType{137}, 1}};
  EXPECT_EQ(tally.kept, kept);
  EXPECT_TRUE(tally.bad.empty());
  EXPECT_EQ(tally.allocations, 0U);
}

}  // namespace
}  // namespace reckon::pdu
