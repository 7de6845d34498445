// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/metrics/open_metrics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "reckon/pdu/seconds.hpp"

namespace reckon::tools {
namespace {

constexpr std::string_view kPrefix = "reckon_";

/// A counter whose name is ambiguous without context, or in which "out" is not a direction.
struct Renamed {
  std::string_view counter, metric;
};
constexpr std::array<Renamed, 5> kRenamed{{{"entered", "entities_entered"},
                                           {"left", "entities_left"},
                                           {"not_interesting", "entities_not_interesting"},
                                           {"snaps", "updates_shown_at_once"},
                                           {"timed_out", "entities_timed_out"}}};

/// A word of a counter's name and its replacement in a metric.
struct Reworded {
  std::string_view word, other;
};
constexpr std::array<Reworded, 2> kReworded{{{"in", "received"}, {"out", "sent"}}};

/// A unit within a counter's name; a metric has it at its end, as the base unit.
struct Measure {
  std::string_view word, base;
  double scale;
};
constexpr std::array<Measure, 3> kMeasures{
    {{"octets", "bytes", 1}, {"bytes", "bytes", 1}, {"uj", "joules", 1e-6}}};
/// Base units, which get a UNIT line in OpenMetrics.
constexpr std::array<std::string_view, 5> kBaseUnits{"bytes", "joules", "meters", "newtons",
                                                     "seconds"};

void append_word(std::string& text, std::string_view word) {
  if (!text.empty()) text += '_';
  text += word;
}

// Escapes a text for a line, inside or outside of quotes.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char letter : text) {
    if (letter == '\\' || letter == '"') out += '\\';
    out += letter == '\n' ? "\\n" : std::string(1, letter);
  }
  return out;
}

// Formats a number; OpenMetrics and fmt differ for NaN and infinity.
std::string number(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0 ? "+Inf" : "-Inf";
  return fmt::format("{}", value);
}

std::string_view unit_of(std::string_view name) {
  const auto ends = [name](std::string_view unit) {
    return name.ends_with(unit) && name.size() > unit.size() &&
           name[name.size() - unit.size() - 1] == '_';
  };
  const auto* const unit = std::ranges::find_if(kBaseUnits, ends);
  return unit == kBaseUnits.end() ? std::string_view() : *unit;
}

}  // namespace

MetricName metric_name(std::string_view counter) {
  const auto* const renamed = std::ranges::find(kRenamed, counter, &Renamed::counter);
  if (renamed != kRenamed.end()) return {std::string(renamed->metric)};
  MetricName name;
  std::string_view unit;
  while (!counter.empty()) {
    const std::size_t end = std::min(counter.find('_'), counter.size());
    const std::string_view word = counter.substr(0, end);
    counter.remove_prefix(std::min(end + 1, counter.size()));
    const auto* const measure = std::ranges::find(kMeasures, word, &Measure::word);
    if (measure != kMeasures.end()) {
      unit = measure->base;
      name.scale = measure->scale;
      continue;
    }
    const auto* const other = std::ranges::find(kReworded, word, &Reworded::word);
    append_word(name.text, other == kReworded.end() ? word : other->other);
  }
  if (!unit.empty()) append_word(name.text, unit);
  return name;
}

void OpenMetrics::counter(std::string_view counter, std::string_view meaning, std::uint64_t value,
                          Labels labels) {
  MetricName name = metric_name(counter);
  sample(family(std::move(name.text), "counter", meaning), "_total", labels,
         name.scale * static_cast<double>(value));
}

void OpenMetrics::counters(const peer::Counters& counters) {
  counters.for_each([this](const peer::CounterReading& one) {
    if (one.group != nullptr)
      counter(one.group->name, one.group->meaning, one.value, {{one.group->label, one.member}});
    else if (one.is_level)
      gauge(metric_name(one.name).text, one.meaning, static_cast<double>(one.value));
    else
      counter(one.name, one.meaning, one.value);
  });
}

void OpenMetrics::gauge(std::string_view name, std::string_view meaning, double value,
                        Labels labels) {
  sample(family(std::string(name), "gauge", meaning), "", labels, value);
}

void OpenMetrics::durations(std::string_view name, std::string_view meaning,
                            const peer::DurationHistogram& histogram, Labels labels) {
  const peer::Percentiles of = peer::percentiles(histogram);
  spread(name, "seconds", meaning,
         {pdu::to_seconds(of.p50), pdu::to_seconds(of.p99), pdu::to_seconds(of.p999),
          pdu::to_seconds(of.max), histogram.count()},
         labels);
}

void OpenMetrics::spread(std::string_view name, std::string_view unit, std::string_view meaning,
                         const peer::Spread& spread, Labels labels) {
  Family& summary = family(fmt::format("{}_{}", name, unit), "summary", meaning);
  const std::array<std::pair<std::string_view, double>, 3> quantiles{
      {{"0.5", spread.p50}, {"0.99", spread.p99}, {"0.999", spread.p999}}};
  for (const auto& [share, value] : quantiles) {
    std::vector<Label> all(labels);
    all.emplace_back("quantile", share);
    sample(summary, "", all, value);
  }
  sample(summary, "_count", labels, static_cast<double>(spread.count));
  gauge(fmt::format("{}_max_{}", name, unit), fmt::format("{}, the greatest so far", meaning),
        spread.max, labels);
}

OpenMetrics::Family& OpenMetrics::family(std::string name, std::string_view type,
                                         std::string_view meaning) {
  name.insert(0, kPrefix);
  const auto known = std::ranges::find(families_, name, &Family::name);
  if (known != families_.end()) return *known;
  const std::string unit(unit_of(name));
  return families_.emplace_back(std::move(name), type, unit, std::string(meaning), "");
}

void OpenMetrics::sample(Family& family, std::string_view suffix, std::span<const Label> labels,
                         double value) {
  const auto out = std::back_inserter(family.samples);
  fmt::format_to(out, "{}{}", family.name, suffix);
  for (std::size_t i = 0; i < labels.size(); ++i)
    fmt::format_to(out, "{}{}=\"{}\"", i == 0 ? "{" : ",", labels[i].first,
                   escaped(labels[i].second));
  fmt::format_to(out, "{} {}\n", labels.empty() ? "" : "}", number(value));
}

std::string OpenMetrics::end() const {
  std::string text;
  const auto out = std::back_inserter(text);
  for (const Family& family : families_) {
    fmt::format_to(out, "# TYPE {} {}\n", family.name, family.type);
    if (!family.unit.empty()) fmt::format_to(out, "# UNIT {} {}\n", family.name, family.unit);
    fmt::format_to(out, "# HELP {} {}\n", family.name, escaped(family.meaning));
    text += family.samples;
  }
  return text + "# EOF\n";
}

}  // namespace reckon::tools
