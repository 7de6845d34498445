// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/host_lines.hpp"

#include <fmt/format.h>

#include <charconv>
#include <span>
#include <vector>

#include "reckon/tools/terminal/json_text.hpp"

namespace reckon::bench {
namespace {

constexpr std::string_view kBegin = "begin ";

/// The rest of a JSON line of this study after a key.
std::optional<std::string_view> behind(std::string_view line, std::string_view key) {
  const std::string wanted = fmt::format("\"{}\":", key);
  const auto at = line.find(wanted);
  if (at == line.npos) return std::nullopt;
  return line.substr(at + wanted.size());
}

/// Removes a number from the front.
template <typename Number>
bool take_number(std::string_view& text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

template <typename Number>
bool number_behind(std::string_view line, std::string_view key, Number& value) {
  std::optional<std::string_view> rest = behind(line, key);
  return rest && take_number(*rest, value);
}

bool numbers_behind(std::string_view line, std::string_view key, std::vector<float>& values) {
  std::optional<std::string_view> rest = behind(line, key);
  if (!rest || !rest->starts_with('[')) return false;
  rest->remove_prefix(1);
  values.clear();
  while (!rest->starts_with(']')) {
    if (!values.empty()) {
      if (!rest->starts_with(',')) return false;
      rest->remove_prefix(1);
    }
    if (!take_number(*rest, values.emplace_back())) return false;
  }
  return true;
}

bool is_of_kind(std::string_view line, std::string_view kind) {
  return line.starts_with(fmt::format("{{\"kind\":\"{}\"", kind)) && line.ends_with('}');
}

}  // namespace

std::string begin_word(std::chrono::nanoseconds after) {
  return fmt::format("{}{}", kBegin, after.count());
}

std::optional<std::chrono::nanoseconds> read_begin_word(std::string_view word) {
  if (!word.starts_with(kBegin)) return std::nullopt;
  word.remove_prefix(kBegin.size());
  std::int64_t after = 0;
  if (!take_number(word, after) || !word.empty()) return std::nullopt;
  return std::chrono::nanoseconds(after);
}

std::string ready_line(std::uint64_t scene) {
  std::string line;
  tools::JsonObject(line).text("kind", "ready").value("scene", scene).end();
  return line;
}

std::optional<std::uint64_t> read_ready_line(std::string_view line) {
  std::uint64_t scene = 0;
  if (!is_of_kind(line, "ready") || !number_behind(line, "scene", scene)) return std::nullopt;
  return scene;
}

std::string peer_line(std::size_t peer, const PeerProcess& process) {
  const WholeCounts& counts = process.outcome.counts;
  std::string line;
  tools::JsonObject object(line);
  object.text("kind", "peer").value("peer", peer);
  for (const WholeSum& sum : kWholeSums) object.value(sum.name, counts.*sum.of);
  const auto append = [](std::string& out, float value) { out += fmt::format("{:.5g}", value); };
  object.value("seconds", counts.seconds)
      .value("cpu_s", counts.cpu)
      .value("latest_s", process.outcome.latest)
      .value("resident_octets", process.resident)
      .array("pose_m", process.outcome.samples.pose, append)
      .array("discovery_s", process.outcome.samples.discovery, append)
      .end();
  return line;
}

bool read_peer_line(std::string_view line, std::size_t& peer, PeerProcess& process) {
  WholeCounts& counts = process.outcome.counts;
  bool is_good = is_of_kind(line, "peer") && number_behind(line, "peer", peer);
  for (const WholeSum& sum : kWholeSums)
    is_good = is_good && number_behind(line, sum.name, counts.*sum.of);
  return is_good && number_behind(line, "seconds", counts.seconds) &&
         number_behind(line, "cpu_s", counts.cpu) &&
         number_behind(line, "latest_s", process.outcome.latest) &&
         number_behind(line, "resident_octets", process.resident) &&
         numbers_behind(line, "pose_m", process.outcome.samples.pose) &&
         numbers_behind(line, "discovery_s", process.outcome.samples.discovery);
}

}  // namespace reckon::bench
