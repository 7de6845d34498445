// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Shared records of federates: written, read, equal after joins, cuts and departures.
#include "reckon/peer/federation/federate_records.hpp"

#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "reckon/tests/integration/federates.hpp"

namespace reckon::test {
namespace {

using namespace std::chrono_literals;

std::span<const std::byte> octets_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

class FederateRecords : public testing::Test {
 protected:
  void join(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) federates_.join(open_country());
    run(2s);
  }
  void run(std::chrono::nanoseconds time) {
    federates_.run(
        time, 1ms, [] {}, [] {});
  }
  void set(std::size_t i, const std::string& key, const std::string& value) {
    federates_[i].records().set(key, octets_of(value));
  }
  std::string value(std::size_t i, const std::string& key) {
    const auto value = federates_[i].records().find(key);
    if (!value) return "none";
    return {reinterpret_cast<const char*>(value->data()), value->size()};
  }
  /// Nothing passes between the first and the other federates.
  void cut(bool is_cut) {
    for (std::size_t i = 1; i < federates_.size(); ++i) {
      federates_.impair(0, i, is_cut ? Federates::delayed(1ms, 1.0) : law());
      federates_.impair(i, 0, is_cut ? Federates::delayed(1ms, 1.0) : law());
    }
  }
  static peer::ImpairmentLaw law() { return Federates::delayed(2ms, 0.1, 1ms); }

  Federates federates_{5, law()};
};

TEST_F(FederateRecords, ReachOthersAndThoseWhoJoinLater) {
  join(2);
  std::vector<std::tuple<std::string, std::size_t, std::uint16_t>> changes;
  federates_[1].records().on_changed(
      [&](std::string_view key, std::span<const std::byte> value, const aoim::PeerId& writer) {
        changes.emplace_back(key, value.size(), writer.application);
      });
  bool is_told = false;
  federates_[0].records().on_changed([&](auto, auto, const auto&) { is_told = true; });
  set(0, "lights", "red");
  run(300ms);
  EXPECT_EQ(value(0, "lights"), "red");
  EXPECT_EQ(value(1, "lights"), "red");
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0], std::tuple("lights", 3u, 1));
  EXPECT_FALSE(is_told) << "of its own record";
  set(1, "lights", "green");
  run(300ms);
  join(1);
  EXPECT_EQ(value(0, "lights"), "green");
  EXPECT_EQ(value(2, "lights"), "green");
  EXPECT_EQ(federates_[2].records().size(), 1u);
}

TEST_F(FederateRecords, AreEqualTwoSecondsAfterACut) {
  join(4);
  for (int i = 0; i < 30; ++i) set(0, "key " + std::to_string(i), "before");
  run(1s);
  cut(true);
  for (int second = 0; second < 60; ++second) {
    set(static_cast<std::size_t>(second % 4), "key " + std::to_string(second % 20),
        "during " + std::to_string(second));
    run(1s);
  }
  EXPECT_NE(value(0, "key 19"), value(1, "key 19"));
  cut(false);
  run(2s);
  for (int i = 0; i < 30; ++i) {
    const std::string key = "key " + std::to_string(i);
    for (std::size_t k = 1; k < 4; ++k) EXPECT_EQ(value(k, key), value(0, key)) << key;
  }
}

TEST_F(FederateRecords, RemainWhenTheirWriterLeaves) {
  join(2);
  set(0, "lights", "red");
  run(500ms);
  federates_[0].resign();
  run(500ms);
  join(1);
  EXPECT_EQ(value(2, "lights"), "red");
}

TEST_F(FederateRecords, AreRefusedWithTheReason) {
  join(1);
  peer::FederateRecords& records = federates_[0].records();
  EXPECT_THROW(records.set("", octets_of("a")), std::invalid_argument);
  EXPECT_THROW(records.set(std::string(64, 'k'), octets_of("a")), std::invalid_argument);
  EXPECT_THROW(records.set("a\nb", octets_of("a")), std::invalid_argument);
  EXPECT_THROW(records.set("a", octets_of(std::string(1025, 'a'))), std::length_error);
  std::string refused;
  records.on_refused([&](std::string_view key) { refused = key; });
  for (int i = 0; i < 1025; ++i) set(0, std::to_string(i), "a");
  run(100ms);
  EXPECT_EQ(refused, "1024");
  EXPECT_EQ(federates_.count(0, "records_refused"), 1u);
  federates_.join(*peer::dis_exercise(1, 0.82, 0.145));
  EXPECT_THROW(federates_[1].records().set("a", octets_of("a")), std::logic_error);
}

}  // namespace
}  // namespace reckon::test
