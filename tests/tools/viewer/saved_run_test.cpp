// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/saved_run.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reckon/tests/tools/support/driven_trucks.hpp"

namespace reckon::tools {
namespace {

using nlohmann::json;

constexpr auto kMinute = SaveOptions::kMinute;

/// A stage that has taken `count` trucks for `length` [s].
class TakenTrucks {
 public:
  TakenTrucks(std::uint16_t count, double length) : stage(options()) {
    for (const trucks::Sent& sent : trucks::drive(count, length))
      EXPECT_TRUE(stage.take(trucks::datagram_of(sent)));
  }
  static StageOptions options() {
    StageOptions options;
    options.source = "trucks";
    options.kind = "saved";
    options.is_capture = true;
    options.history.span.reset();
    return options;
  }
  ViewStage stage;
};

std::string decoded(const std::string& base64) {
  constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char letter : base64) {
    if (letter == '=') break;
    group = group << 6 | static_cast<std::uint32_t>(kLetters.find(letter));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    out += static_cast<char>(group >> bits & 255U);
  }
  return out;
}

template <typename T>
T value_at(const std::string& octets, std::size_t place) {
  T value{};
  std::memcpy(&value, octets.data() + place, sizeof value);
  return value;
}

/// The content of a run: its pictures, and its texts by type.
struct Parts {
  explicit Parts(const SavedRun& run) {
    for (const json& item : json::parse(run.items)) {
      times.push_back(item[0].get<double>());
      if (item[1] == "text")
        texts[item[2]["type"]].push_back(item[2]);
      else
        pictures.push_back(decoded(item[2]));
    }
  }
  std::vector<double> times;  // [ms]
  std::map<std::string, std::vector<json>> texts;
  std::vector<std::string> pictures;
};

TEST(SavedRun, HasAllPicturesOfATab) {
  TakenTrucks taken(3, 10);
  const SavedRun run = save_run(taken.stage, {});
  const Parts parts(run);
  EXPECT_NEAR(run.seconds, 9.5, 0.05);
  EXPECT_EQ(run.left_out, 0);
  EXPECT_EQ(run.entities, 3);
  EXPECT_EQ(run.pictures, parts.pictures.size());
  EXPECT_NEAR(static_cast<double>(run.pictures), 30 * run.seconds, 2);
  EXPECT_TRUE(std::is_sorted(parts.times.begin(), parts.times.end()));
  EXPECT_EQ(parts.times.front(), 0);
  EXPECT_NEAR(parts.times.back(), 1e3 * run.seconds, 0.001);
  for (const std::string& picture : parts.pictures) {
    EXPECT_EQ(value_at<std::uint32_t>(picture, 0), kPictureMagic);
    EXPECT_EQ(picture.size(), kPictureHead + kEntityOctets * value_at<std::uint16_t>(picture, 16));
    EXPECT_EQ(value_at<std::uint16_t>(picture, 22) & kPictureGap, 0);
  }
  EXPECT_NEAR(value_at<double>(parts.pictures.back(), 8), 9.503, 0.01);
}

TEST(SavedRun, KeepsTheTextsOfAPageWithoutRights) {
  TakenTrucks taken(3, 10);
  taken.stage.note("info", "not for others");
  const Parts parts(save_run(taken.stage, {}));
  ASSERT_EQ(parts.texts.at("hello").size(), 1U);
  EXPECT_EQ(parts.texts.at("hello")[0]["kind"], "saved");
  EXPECT_EQ(parts.texts.at("hello")[0]["may_push"], false);
  EXPECT_EQ(parts.texts.at("roster")[0]["entities"].size(), 3U);
  EXPECT_NEAR(static_cast<double>(parts.texts.at("numbers").size()), 9.5, 1.5) << "one a second";
  for (const auto& [type, texts] : parts.texts)
    EXPECT_TRUE(type == "hello" || type == "roster" || type == "numbers") << type;
}

TEST(SavedRun, IsTheEndOfALongOne) {
  TakenTrucks taken(2, 100);
  const SavedRun run = save_run(taken.stage, {});
  EXPECT_NEAR(run.seconds, 60, 0.05);
  EXPECT_NEAR(run.left_out, 39.5, 0.05);
  EXPECT_NEAR(value_at<double>(Parts(run).pictures.front(), 8), 39.5, 0.05);
  EXPECT_NEAR(save_run(taken.stage, {.span = std::chrono::seconds(90)}).seconds, 90, 0.05);
}

TEST(SavedRun, PutsPicturesApartUntilTheyFit) {
  TakenTrucks taken(100, 70);
  for (const std::size_t budget : {2'000'000U, 200'000U, 50'000U}) {
    const SavedRun run = save_run(taken.stage, {.span = kMinute, .budget = budget});
    const Parts parts(run);
    std::size_t octets = 0;
    for (const std::string& picture : parts.pictures) octets += picture.size();
    EXPECT_LE(octets, budget + 2 * parts.pictures[0].size());
    EXPECT_GE(octets, budget / 2);
    EXPECT_NEAR(run.spacing, 6432.0 * 60 / static_cast<double>(budget), 0.1 * run.spacing);
    EXPECT_NEAR(run.seconds, 60, 0.1);
    for (const std::string& picture : parts.pictures)
      EXPECT_EQ(value_at<std::uint16_t>(picture, 22) & kPictureGap, 0) << budget;
  }
}

TEST(SavedRun, OfNobodyHasAnEnd) {
  ViewStage stage(TakenTrucks::options());
  const SavedRun run = save_run(stage, {});
  EXPECT_EQ(run.entities, 0);
  EXPECT_EQ(run.seconds, 0);
  EXPECT_EQ(run.pictures, 1U);
}

}  // namespace
}  // namespace reckon::tools
