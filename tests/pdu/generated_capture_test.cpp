// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Captures from an independent generator, with a sidecar of all field values.
#include <gtest/gtest.h>

#include <array>
#include <concepts>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/finite.hpp"
#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/print.hpp"
#include "reckon/tests/pdu/support/guarded_buffer.hpp"
#include "reckon/tests/pdu/support/pcap_reader.hpp"
#include "reckon/tests/support/reference_data.hpp"
#include "reckon/tests/support/wire_samples.hpp"

namespace reckon::pdu {
namespace {

using Json = nlohmann::ordered_json;

Json sidecar(const std::string& name) {
  return Json::parse(
      std::ifstream(test::reference_data() / "dis-captures/generated-a" / (name + ".json")));
}

std::vector<std::vector<std::byte>> datagrams(const std::string& name) {
  return test::udp_payloads(test::reference_data() / "dis-captures/generated-a" / (name + ".pcap"));
}

// The values in wire order, without their names. The sidecars contain no counts and no padding.
void flatten(const Json& value, std::vector<Json>& out) {
  if (!value.is_structured()) {
    out.push_back(value);
    return;
  }
  for (const auto& [key, member] : value.items()) {
    const bool left_out =
        value.is_object() && (key == "header" || key.starts_with("padding") ||
                              key.starts_with("number_of") || key.starts_with("length_of"));
    if (!left_out) flatten(member, out);
  }
}

// Reckon prints a 32-bit float in its shortest form, the sidecar prints all digits.
bool same(const Json& ours, const Json& theirs) {
  if (!ours.is_number() || !theirs.is_number()) return ours == theirs;
  const double a = ours.get<double>();
  const double b = theirs.get<double>();
  return a == b || static_cast<double>(static_cast<float>(a)) == b;
}

void compare(const Json& ours, const Json& theirs, const std::string& where) {
  std::vector<Json> left;
  std::vector<Json> right;
  flatten(ours, left);
  flatten(theirs, right);
  ASSERT_EQ(left.size(), right.size()) << where << "\n" << ours << "\n" << theirs;
  for (std::size_t i = 0; i < left.size(); ++i)
    EXPECT_TRUE(same(left[i], right[i])) << where << ": " << left[i] << " is not " << right[i];
}

void expect_header(const PduHeader& ours, const Json& theirs) {
  EXPECT_EQ(ours.protocol_version, theirs["protocolVersion"]);
  EXPECT_EQ(ours.exercise_id, theirs["exerciseID"]);
  EXPECT_EQ(static_cast<int>(ours.pdu_type), theirs["pduType"]);
  EXPECT_EQ(static_cast<int>(ours.protocol_family), theirs["protocolFamily"]);
  EXPECT_EQ(ours.timestamp, theirs["timestamp"]);
  EXPECT_EQ(ours.length, theirs["length"]);
  EXPECT_EQ(ours.pdu_status, theirs["pduStatus"]);
}

// The JSON of Reckon, with records replaced by their octets where the sidecars contain octets.
template <typename T>
Json shown(const T& pdu) {
  std::string text;
  TextSink sink(text);
  print_json(pdu, sink);
  Json json = Json::parse(text);
  if constexpr (std::same_as<T, Transmitter>) {
    const auto put = [&json](const char* name, std::span<const std::byte> octets) {
      std::string hex;
      TextSink digits(hex);
      put_hex(digits, octets);
      json[name] = hex;
    };
    put("modulation_parameters", pdu.modulation_parameters.bytes);
    put("antenna_pattern", pdu.antenna_pattern.bytes);
  }
  return json;
}

// Returns the PDUs that have a field table here and passed.
std::size_t compare_datagram(std::span<const std::byte> datagram, const Json& expected,
                             const std::string& where) {
  std::size_t typed_pdus = 0;
  std::size_t index = 0;
  for (const BundledPdu& pdu : BundleReader(datagram)) {
    EXPECT_EQ(pdu.error, DecodeError::none) << where;
    if (index == expected["pdus"].size()) {
      ADD_FAILURE() << "more PDUs than expected in " << where;
      break;
    }
    const Json& theirs = expected["pdus"][index++];
    expect_header(pdu.header, theirs["header"]);
    const DecodeError error = visit(pdu.bytes, pdu.header, [&](const auto& typed) {
      ++typed_pdus;
      compare(shown(typed), theirs["fields"], where);
      std::vector<std::byte> out(wire_size(typed));
      EXPECT_EQ(encode(typed, out), pdu.bytes.size());
      EXPECT_TRUE(std::equal(out.begin(), out.end(), pdu.bytes.begin(), pdu.bytes.end())) << where;
    });
    EXPECT_EQ(error, is_listed(pdu.header.pdu_type) ? DecodeError::none : DecodeError::unknown_type)
        << where;
  }
  EXPECT_EQ(index, expected["pdus"].size()) << where;
  return typed_pdus;
}

struct Capture {
  const char* name;
  std::size_t typed_pdus;
};

class GeneratedCapture : public testing::TestWithParam<Capture> {};

TEST_P(GeneratedCapture, HoldsTheValuesOfItsGenerator) {
  RECKON_NEED_DATA("dis-captures/generated-a");
  const std::string name = GetParam().name;
  const Json expected = sidecar(name)["datagrams"];
  const auto payloads = datagrams(name);
  ASSERT_EQ(payloads.size(), expected.size());
  std::size_t typed_pdus = 0;
  for (std::size_t i = 0; i < payloads.size(); ++i)
    typed_pdus +=
        compare_datagram(payloads[i], expected[i], name + " frame " + std::to_string(i + 1));
  EXPECT_EQ(typed_pdus, GetParam().typed_pdus);
}
INSTANTIATE_TEST_SUITE_P(All, GeneratedCapture,
                         testing::Values(Capture{"a-entity-state", 27},
                                         Capture{"a-interaction", 18},
                                         Capture{"a-simulation-management", 19},
                                         Capture{"a-radio", 12}, Capture{"a-bundles", 41},
                                         Capture{"a-custom", 5}),
                         [](const auto& capture) {
                           std::string name = capture.param.name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

struct Verdict {
  std::size_t good_before = 0;  // PDUs before the first bad one
  bool refused = false;
  bool not_finite = false;
};

Verdict judge(std::span<const std::byte> datagram) {
  Verdict verdict;
  for (const BundledPdu& pdu : BundleReader(datagram)) {
    DecodeError error = pdu.error;
    if (error == DecodeError::none)
      error = visit(pdu.bytes, pdu.header, [&](const auto& typed) {
        verdict.not_finite = verdict.not_finite || !all_finite(typed);
      });
    verdict.refused =
        verdict.refused || (error != DecodeError::none && error != DecodeError::unknown_type);
    if (!verdict.refused) ++verdict.good_before;
  }
  return verdict;
}

TEST(MalformedDatagrams, AreRefusedOrFlaggedAsTheSidecarStates) {
  RECKON_NEED_DATA("dis-captures/generated-a");
  const Json expected = sidecar("a-malformed")["datagrams"];
  const auto payloads = datagrams("a-malformed");
  ASSERT_EQ(payloads.size(), expected.size());
  test::GuardedBuffer buffer;
  for (std::size_t i = 0; i < payloads.size(); ++i) {
    const auto datagram = buffer.hold(payloads[i]);
    const std::string expect = expected[i]["expect"];
    const Verdict verdict = judge(datagram);
    EXPECT_EQ(verdict.refused, expect != "decode-but-flag") << expected[i]["why"];
    EXPECT_EQ(verdict.not_finite, expect == "decode-but-flag") << expected[i]["why"];
    EXPECT_EQ(verdict.good_before, expected[i]["valid_pdus_before"].get<std::size_t>())
        << expected[i]["why"];
  }
}

}  // namespace
}  // namespace reckon::pdu
