// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The text messages of a stage for its tabs.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numbers>
#include <utility>

#include "reckon/tools/command_line/version.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/viewer/view_stage.hpp"

namespace reckon::tools {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr int kMetreDecimals = 5;

std::string_view name(PlayState state) {
  switch (state) {
    case PlayState::live:
      return "live";
    case PlayState::playing:
      return "playing";
    case PlayState::paused:
      return "paused";
    case PlayState::end:
      return "end";
  }
  return "";
}

void append_point(std::string& out, const Eigen::Vector3d& point) {
  fmt::format_to(std::back_inserter(out), "[{:.{}f},{:.{}f},{:.{}f}]", point.x(), kMetreDecimals,
                 point.y(), kMetreDecimals, point.z(), kMetreDecimals);
}

void append_mesh(JsonObject& object, const DrawnSolid& solid) {
  object.array("vertices", solid.vertices, [](std::string& out, const Eigen::Vector3d& vertex) {
    fmt::format_to(std::back_inserter(out), "{:.{}f},{:.{}f},{:.{}f}", vertex.x(), kMetreDecimals,
                   vertex.y(), kMetreDecimals, vertex.z(), kMetreDecimals);
  });
  object.array("triangles", solid.triangles, [](std::string& out, const auto& triangle) {
    fmt::format_to(std::back_inserter(out), "{},{},{}", triangle[0], triangle[1], triangle[2]);
  });
  if (solid.first_patch == 0) return;
  object.value("first", solid.first_patch)
      .array("patches", solid.patches,
             [](std::string& out, std::uint16_t patch) { out += std::to_string(patch); })
      .array("patch_names", solid.patch_names,
             [](std::string& out, const std::string& name) { append_json_string(out, name); });
}

void append_solid(std::string& out, const DrawnSolid& solid) {
  JsonObject object(out);
  object.text("name", solid.name).text("shape", solid.shape);
  append_point(object.member("position"), solid.pose.position);
  const Eigen::Quaterniond& q = solid.pose.orientation;
  object.member("quaternion") +=
      fmt::format("[{:.7f},{:.7f},{:.7f},{:.7f}]", q.w(), q.x(), q.y(), q.z());
  if (solid.shape == "sphere") object.decimals("radius", solid.radius, kMetreDecimals);
  if (solid.shape == "box") append_point(object.member("size"), solid.size);
  if (solid.shape == "mesh") append_mesh(object, solid);
  if (solid.body) object.value("body", *solid.body);
  object.decimals("stiffness", solid.stiffness, 1).decimals("friction", solid.friction, 3).end();
}

void append_optional(JsonObject& object, std::string_view key, std::optional<double> value,
                     int decimals) {
  if (value) object.decimals(key, *value, decimals);
}

void append_span(JsonObject& object, double from, double to) {
  object.member("span") += fmt::format("[{:.3f},{:.3f}]", from, to);
}

void append_delay(JsonObject& object, std::optional<double> median, std::optional<double> p95) {
  if (!median) return;
  JsonObject(object.member("delay_ms"))
      .decimals("median", 1e3 * *median, 3)
      .decimals("p95", 1e3 * p95.value_or(0), 3)
      .end();
}

void append_twin(std::string& out, const TwinMark& twin) {
  JsonObject(out)
      .value("hand", twin.hand)
      .decimals("energy", twin.energy, 7)
      .value("resets", twin.resets)
      .end();
}

void append_network(std::string& out, const NetworkRequest& network) {
  JsonObject(out)
      .decimals("delay_ms", network.delay_ms, 1)
      .decimals("jitter_ms", network.jitter_ms, 1)
      .decimals("loss", network.loss, 3)
      .value("outage", network.outage)
      .end();
}

/// @param thresholds of the scene, or null
void append_error(std::string& out, const NumbersSample& sample, const ShownThresholds* thresholds,
                  const Roster& roster, std::uint16_t followed) {
  JsonObject error(out);
  append_optional(error, "mean_m", sample.error_mean, 6);
  append_optional(error, "worst_m", sample.error_worst, 6);
  if (thresholds != nullptr) {
    error.array("thresholds_m", thresholds->told(), [](std::string& text, double threshold) {
      fmt::format_to(std::back_inserter(text), "{:.6f}", threshold);
    });
    append_optional(error, "followed_m",
                    thresholds->of(roster.marking_at(followed), roster.is_haptic(followed)), 6);
  }
  error.end();
}

std::shared_ptr<const std::string> shared_text(std::string&& message) {
  return std::make_shared<const std::string>(std::move(message));
}

}  // namespace

void ViewStage::set_touch(const std::vector<TouchHand>& hands) {
  std::string out;
  std::size_t index = 0;
  JsonObject(out)
      .text("type", "touch")
      .array("solids", solids_, append_solid)
      .array("regions", regions_, append_solid)
      .array("hands", hands,
             [&index](std::string& text, const TouchHand& hand) {
               JsonObject(text)
                   .value("index", index++)
                   .text("name", hand.name)
                   .decimals("radius", hand.radius, kMetreDecimals)
                   .text("device", hand.device)
                   .decimals("limit", hand.limit, 3)
                   .end();
             })
      .end();
  touch_ = std::make_shared<const std::string>(std::move(out));
}

void ViewStage::append_origin(std::string& out) const {
  JsonObject(out)
      .decimals("lat", origin_.latitude * kDegrees, 9)
      .decimals("lon", origin_.longitude * kDegrees, 9)
      .decimals("height", origin_.height, 3)
      .end();
}

std::string ViewStage::hello(const Watcher& watcher) const {
  std::string out;
  JsonObject object(out);
  object.text("type", "hello")
      .value("version", 4)
      .text("program", fmt::format("reckon {}", program_version()))
      .text("source", options_.source)
      .text("kind", options_.kind)
      .value("may_push", watcher.may_push)
      .decimals("first_entity", seconds(history_.peopled(history_.begin())), 3);
  if (watcher.may_push) append_network(object.member("network"), options_.controls->network());
  append_span(object, seconds(history_.begin()), seconds(live_end()));
  if (frame_)
    append_origin(object.member("origin"));
  else
    object.value("origin", "null");
  object.text("help", options_.help).end();
  return out;
}

std::string ViewStage::origin_message() const {
  std::string out;
  JsonObject object(out);
  object.text("type", "origin");
  append_origin(object.member("origin"));
  object.end();
  return out;
}

std::string ViewStage::play_message(const Watcher& watcher) const {
  std::string out;
  JsonObject(out)
      .text("type", "play")
      .text("state", name(watcher.state))
      .decimals("speed", watcher.state == PlayState::paused ? 0.0 : watcher.speed, 2)
      .decimals("time", seconds(shown_time(watcher)), 3)
      .end();
  return out;
}

const ReceptionSample* ViewStage::reception_at(Time time) const {
  const auto after =
      std::upper_bound(receptions_.begin(), receptions_.end(), time,
                       [](Time at, const ReceptionSample& sample) { return at < sample.time; });
  return after == receptions_.begin() ? nullptr : &*std::prev(after);
}

std::string ViewStage::numbers_message(const Watcher& watcher) const {
  const Time time = shown_time(watcher);
  std::string out;
  JsonObject object(out);
  object.text("type", "numbers").decimals("time", seconds(time), 3);
  append_span(object, seconds(history_.begin()), seconds(live_end()));
  if (const NumbersSample* sample = history_.numbers().at(time)) {
    object.decimals("pdu_per_s", sample->pdu_per_s, 1).decimals("bit_per_s", sample->bit_per_s, 0);
    append_optional(object, "lost_share", sample->lost_share, 5);
    append_delay(object, sample->delay_median, sample->delay_p95);
    if (sample->error_mean || thresholds_)
      append_error(object.member("error"), *sample, thresholds_ ? &*thresholds_ : nullptr,
                   history_.roster(), watcher.follow);
  }
  if (const ReceptionSample* sample = reception_at(time)) {
    JsonObject peers(object.member("peers"));
    append_delay(peers, sample->delay_median, sample->delay_p95);
    append_optional(peers, "lost_share", sample->lost_share, 5);
    peers.end();
  }
  if (const HandFrame* frame = hands_at(time); frame != nullptr && !frame->twins.empty())
    object.array("twin", frame->twins, append_twin);
  if (watcher.may_push) append_network(object.member("network"), options_.controls->network());
  if (options_.raw_bit_per_s > 0) object.decimals("raw_bit_per_s", options_.raw_bit_per_s, 0);
  object.value("watchers", watchers_).end();
  return out;
}

// Text for every tab, even a slow one: sent once, or as the answer to a request.
ViewStage::Text ViewStage::next_text(Watcher& watcher) {
  if (!std::exchange(watcher.greeted, true)) {
    watcher.knows_origin = frame_.has_value();
    return shared_text(hello(watcher));
  }
  if (!watcher.knows_touch && touch_) {
    watcher.knows_touch = true;
    return touch_;
  }
  if (!std::exchange(watcher.knows_state, true)) return shared_text(play_message(watcher));
  if (!watcher.answer.empty()) return shared_text(std::exchange(watcher.answer, {}));
  if (watcher.under_way.size() >= watcher.credit) return nullptr;
  return next_regular_text(watcher);
}

// Regular text: only for a tab that draws its pictures.
ViewStage::Text ViewStage::next_regular_text(Watcher& watcher) {
  if (!watcher.knows_origin && frame_) {
    watcher.knows_origin = true;
    return shared_text(origin_message());
  }
  if (watcher.epoch != history_.roster().epoch()) {
    watcher.epoch = history_.roster().epoch();
    watcher.needs_picture = true;
    return std::make_shared<const std::string>(history_.roster().message());
  }
  watcher.notes = std::max(watcher.notes, first_note_);
  if (watcher.notes < first_note_ + notes_.size()) return notes_[watcher.notes++ - first_note_];
  if (std::exchange(watcher.numbers_tick, numbers_tick_) != numbers_tick_)
    return shared_text(numbers_message(watcher));
  const HandFrame* frame = hands_at(shown_time(watcher));
  const bool looks = std::exchange(watcher.owners_tick, numbers_tick_) != numbers_tick_;
  if (looks && frame != nullptr && frame->owners != watcher.owners && frame->owners)
    return watcher.owners = frame->owners;
  return next_scenery(watcher);
}

// Text about cells and groups of the scene, if it has changed.
ViewStage::Text ViewStage::next_scenery(Watcher& watcher) {
  const auto renew = [](std::string& known, std::string&& message) -> Text {
    if (message == known) return nullptr;
    known = std::move(message);
    return std::make_shared<const std::string>(known);
  };
  const bool tells_cells = cells_ && std::exchange(watcher.cells_tick, cells_tick_) != cells_tick_;
  const bool tells_groups =
      groups_ && !tells_cells && std::exchange(watcher.groups_tick, cells_tick_) != cells_tick_;
  if (!tells_cells && !tells_groups) return nullptr;
  const Time time = shown_time(watcher);
  const auto& entities = picture_for(watcher, time).rows.entities;
  if (tells_groups) {
    const ReceivedGroups& heard = world_for(watcher, time).groups();
    return renew(watcher.groups,
                 groups_->message(heard, history_.roster(), entities, time, history_.start()));
  }
  if (Text text = renew(watcher.cells, cells_->message(entities, watcher.follow))) return text;
  return groups_ ? next_scenery(watcher) : nullptr;
}

}  // namespace reckon::tools
