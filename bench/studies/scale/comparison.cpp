// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>

#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/bench/studies/scale/mechanisms.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

constexpr double kNotable = 0.02, kNotableCpu = 0.1;

/// The value of a key in a JSON line of this study. Its strings hold neither quotes nor commas.
std::optional<std::string_view> member(std::string_view line, std::string_view key) {
  const std::string wanted = fmt::format("\"{}\":", key);
  const auto at = line.find(wanted);
  if (at == line.npos) return std::nullopt;
  std::string_view rest = line.substr(at + wanted.size());
  rest = rest.substr(0, rest.find_first_of(",}"));
  if (rest.starts_with('"') && rest.ends_with('"') && rest.size() > 1)
    rest = rest.substr(1, rest.size() - 2);
  return rest;
}

double number(std::string_view line, std::string_view key, std::string_view where) {
  const auto text = member(line, key);
  double value = 0;
  if (!text || std::from_chars(text->data(), text->data() + text->size(), value).ec != std::errc())
    throw tools::UsageError(fmt::format(
        "{}: has no number '{}'; use a file that bench scale --json of this version wrote", where,
        key));
  return value;
}

bool is_cpu(std::string_view measure) { return measure.find("cpu") != measure.npos; }

double notable(std::string_view measure) { return is_cpu(measure) ? kNotableCpu : kNotable; }

/// The kernel's cost on this host is measured at each start. It is no change between builds.
bool is_of_host(std::string_view measure) {
  return measure == "live_cpu_share" || measure == "cpu_share";
}

bool is_of(const BaseRow& base, const ScaleRow& row) {
  return base.mechanism == kMechanisms[row.mechanism].name && base.peers == row.peers() &&
         base.entities == row.entities();
}

bool has_base(const ScaleRow& row, std::span<const BaseRow> base) {
  return std::ranges::any_of(base, [&](const BaseRow& other) { return is_of(other, row); });
}

/// The value nearest to `now` in the range of the base: `now` itself inside the range. None if the
/// base lacks the row or has too few runs of it.
std::optional<double> nearest_of_base(const ScaleRow& row, std::string_view measure, double now,
                                      std::span<const BaseRow> base) {
  std::optional<double> least, most;
  std::size_t runs = 0;
  for (const BaseRow& other : base) {
    if (!is_of(other, row)) continue;
    ++runs;
    const double value = other.values.find(measure)->second;
    least = std::min(least.value_or(value), value);
    most = std::max(most.value_or(value), value);
  }
  // One run does not show how much the CPU time varies.
  if (!least || (is_cpu(measure) && runs < 2)) return std::nullopt;
  return std::clamp(now, *least, *most);
}

}  // namespace

double ScaleChange::ratio() const {
  if (before == now) return 1;
  return before != 0 ? now / before : std::numeric_limits<double>::infinity();
}

std::vector<BaseRow> read_scale_rows(const std::string& path) {
  std::ifstream in(path);
  if (!in)
    throw tools::UsageError(fmt::format("{}: cannot be read; use a file that --json wrote", path));
  std::vector<BaseRow> rows;
  std::string line;
  for (int number_of_line = 1; std::getline(in, line); ++number_of_line) {
    if (member(line, "kind") != "row") continue;
    const std::string where = fmt::format("{}:{}", path, number_of_line);
    BaseRow row;
    row.mechanism = member(line, "mechanism").value_or("");
    row.peers = static_cast<std::size_t>(number(line, "peers", where));
    row.entities = static_cast<std::size_t>(number(line, "entities", where));
    for (const ScaleMeasure& measure : scale_measures())
      row.values.emplace(measure.name, number(line, measure.name, where));
    rows.push_back(std::move(row));
  }
  if (rows.empty())
    throw tools::UsageError(
        fmt::format("{}: has no line of bench scale; use a file that --json wrote", path));
  return rows;
}

std::vector<ScaleChange> changes_of(std::span<const ScaleRow> rows, std::span<const BaseRow> base) {
  std::vector<ScaleChange> changes;
  for (const ScaleRow& row : rows) {
    for (const ScaleMeasure& measure : scale_measures()) {
      if (is_of_host(measure.name)) continue;
      const double now = measure.of(row);
      const auto before = nearest_of_base(row, measure.name, now, base);
      if (!before) continue;
      const ScaleChange change{
          kMechanisms[row.mechanism].name, measure.name, row.peers(), row.entities(), *before, now};
      if (std::abs(change.ratio() - 1) > notable(measure.name)) changes.push_back(change);
    }
  }
  const auto size = [](const ScaleChange& change) { return std::abs(std::log(change.ratio())); };
  std::ranges::stable_sort(changes,
                           [&](const auto& a, const auto& b) { return size(a) > size(b); });
  return changes;
}

void check_same_exercises(std::span<const ScaleSetting> settings, std::span<const BaseRow> base,
                          std::string_view file) {
  const auto name = [](std::size_t peers, std::size_t entities) {
    return fmt::format("{} peers with {} entities", peers, entities);
  };
  std::vector<std::string> known;
  for (const BaseRow& row : base) {
    const std::string one = name(row.peers, row.entities);
    if (std::ranges::find(known, one) == known.end()) known.push_back(one);
  }
  for (const ScaleSetting& setting : settings) {
    const std::string one = name(setting.peers, setting.crowd.entities);
    if (std::ranges::find(known, one) == known.end())
      throw tools::UsageError(fmt::format(
          "--compare: {} has no exercise of {}, only {}; use its --peers and --entities", file, one,
          fmt::join(known, "; ")));
  }
}

std::string comparison_text(std::span<const ScaleRow> rows, std::span<const BaseRow> base) {
  const auto matched =
      std::ranges::count_if(rows, [&](const ScaleRow& row) { return has_base(row, base); });
  std::string out = fmt::format("{} of {} rows are also in the base", matched, rows.size());
  const auto changes = changes_of(rows, base);
  if (changes.empty())
    return out + fmt::format(": no number differs by more than {:g} %, CPU by {:g} %\n",
                             100 * kNotable, 100 * kNotableCpu);
  constexpr auto kRight = tools::TextTable::Align::right;
  tools::TextTable table({{"PEERS", kRight},
                          {"ENTITIES", kRight},
                          {"MECHANISM"},
                          {"NUMBER"},
                          {"BEFORE", kRight},
                          {"NOW", kRight},
                          {"RATIO", kRight}});
  for (const ScaleChange& change : changes)
    table.add({fmt::format("{}", change.peers), fmt::format("{}", change.entities),
               std::string(change.mechanism), std::string(change.measure),
               number_text(change.before), number_text(change.now),
               std::isfinite(change.ratio()) ? number_text(change.ratio()) : "-"});
  return out + ":\n" + table.text();
}

std::string comparison_json(std::span<const ScaleRow> rows, std::span<const BaseRow> base) {
  std::string out;
  for (const ScaleChange& change : changes_of(rows, base))
    tools::JsonObject(out)
        .text("kind", "change")
        .text("mechanism", change.mechanism)
        .value("peers", change.peers)
        .value("entities", change.entities)
        .text("measure", change.measure)
        .value("before", change.before)
        .value("now", change.now)
        .end("\n");
  return out;
}

}  // namespace reckon::bench
