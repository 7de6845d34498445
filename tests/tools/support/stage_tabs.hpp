// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Viewer tabs on a live exercise of trucks.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/tools/support/driven_trucks.hpp"
#include "reckon/tests/tools/support/picture_reader.hpp"
#include "reckon/tools/viewer/view_stage.hpp"

namespace reckon::tools::tabs {

using nlohmann::json;
using trucks::kStart;
using trucks::milliseconds;
using trucks::nanoseconds;
using trucks::Sent;

inline constexpr nanoseconds kTick = milliseconds(33);

/// The header of a picture.
struct Head {
  std::uint32_t number;
  double time;
  std::uint16_t entities, hands, flags;
  std::uint32_t epoch;
};

inline Head head_of(const std::string& octets) {
  const auto at = [&octets](std::size_t place, auto value) {
    std::memcpy(&value, octets.data() + place, sizeof value);
    return value;
  };
  return {at(4, std::uint32_t{}),  at(8, double{}),         at(16, std::uint16_t{}),
          at(18, std::uint16_t{}), at(22, std::uint16_t{}), at(24, std::uint32_t{})};
}

/// A tab that draws what it receives, unless a test disables that.
class Tab {
 public:
  Tab(ViewStage& stage, bool knows_word) : stage_(stage), watcher_(stage.admit(knows_word)) {}

  /// Takes everything that is pending for it.
  void take() {
    while (auto message = stage_.next_message(*watcher_)) {
      if (message->opcode == WebSocketOpcode::text) {
        texts.push_back(json::parse(*message->payload));
        continue;
      }
      pictures.push_back(reader.take(*message->payload));
      if (draws) draw(head().number);
    }
  }
  void draw(std::uint32_t number) { ask(1, number); }
  template <typename... Values>
  void ask(std::uint8_t kind, const Values&... values) {
    std::vector<std::byte> message{std::byte{kind}};
    [[maybe_unused]] const auto add = [&message](const auto& value) {
      const std::size_t size = message.size();
      message.resize(size + sizeof value);
      std::memcpy(message.data() + size, &value, sizeof value);
    };
    (add(values), ...);
    EXPECT_TRUE(stage_.answer(*watcher_, message));
  }
  [[nodiscard]] Head head() const { return head_of(pictures.back()); }
  [[nodiscard]] json last(std::string_view type) const {
    for (auto text = texts.rbegin(); text != texts.rend(); ++text)
      if ((*text)["type"] == type) return *text;
    return {};
  }
  [[nodiscard]] Watcher& watcher() { return *watcher_; }

  bool draws = true;
  std::vector<json> texts;
  std::vector<std::string> pictures;  ///< whole
  reading::PictureReader reader;

 private:
  ViewStage& stage_;
  std::unique_ptr<Watcher> watcher_;
};

/// A live exercise of trucks that continues while it is run.
class LiveTrucks {
 public:
  explicit LiveTrucks(StageOptions options = {}) : stage(options), all_(trucks::drive(3, 200)) {
    stage.pass(now);
  }
  void run(nanoseconds span, std::vector<Tab*> tabs) {
    for (const nanoseconds end = now + span; now < end;) {
      now += kTick;
      for (; next_ < all_.size() && all_[next_].time <= now; ++next_)
        (void)stage.take(trucks::datagram_of(all_[next_]));
      stage.pass(now);
      for (Tab* tab : tabs) tab->take();
    }
  }

  nanoseconds now = kStart;
  ViewStage stage;

 private:
  std::vector<Sent> all_;
  std::size_t next_ = 0;
};

}  // namespace reckon::tools::tabs
