// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/stability/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reckon/bench/studies/sweep/values.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/notation/nearest_word.hpp"
#include "reckon/peer/notation/units.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

using Setting = StabilitySetting;

constexpr std::array<std::string_view, 4> kEnvironments{"linear", "hardening", "moving",
                                                        "switching"};
constexpr std::array<std::string_view, 4> kOperators{"push", "soft", "tracking", "trace"};
constexpr std::array<std::string_view, 2> kCounterparts{"server", "hand"};

double number_in(double value) { return value; }
double number_in(const std::optional<double>& value) { return value.value_or(0); }
double number_in(std::chrono::nanoseconds time) { return pdu::to_seconds(time); }
template <class Kind>
double number_in(Kind kind) {
  return static_cast<double>(kind);
}

void put(double value, double& to) { to = value; }
void put(double value, std::optional<double>& to) { to = value; }
void put(double value, std::chrono::nanoseconds& to) { to = pdu::from_seconds(value); }
template <class Kind>
void put(double value, Kind& to) {
  to = static_cast<Kind>(static_cast<int>(value));
}

/// @param at returns the member of a setting
template <class At>
constexpr StabilityParameter row(std::string_view name, std::string_view meaning, ValueRule rule,
                                 At /*at*/, std::span<const std::string_view> words = {}) {
  return {name,
          meaning,
          rule,
          words,
          [](const Setting& s) { return number_in(At{}(s)); },
          [](Setting& s, double value) { put(value, At{}(s)); }};
}

constexpr std::array kParameters{
    row(
        "hand.k1", "stiffness of the environment", {"N/m", 0, 1e5, true},
        [](auto& s) -> auto& { return s.stiffness; }),
    row(
        "impairment.delay", "one way", {"s", 0, 10, false},
        [](auto& s) -> auto& { return s.run.network.delay; }),
    row(
        "impairment.loss", "share of the samples", {"", 0, 0.99, false},
        [](auto& s) -> auto& { return s.run.network.loss; }),
    row(
        "impairment.jitter", "delay +- this time, at least 0 in sum", {"s", 0, 10, false},
        [](auto& s) -> auto& { return s.run.network.jitter; }),
    row(
        "jitter_share", "delay +- this share of it", {"", 0, 1, false},
        [](auto& s) -> auto& { return s.jitter_share; }),
    row(
        "impairment.reorder", "delayed share", {"", 0, 1, false},
        [](auto& s) -> auto& { return s.run.network.reorder; }),
    row(
        "impairment.reorder_delay", "their additional delay", {"s", 0, 10, false},
        [](auto& s) -> auto& { return s.run.network.reorder_delay; }),
    row(
        "environment", "the environment", {}, [](auto& s) -> auto& { return s.environment; },
        kEnvironments),
    row(
        "operator", "the hand at the device", {},
        [](auto& s) -> auto& { return s.operator_number; }, kOperators),
    row(
        "counterpart", "the other end", {}, [](auto& s) -> auto& { return s.run.counterpart; },
        kCounterparts),
    row(
        "device.damping", "of the device, guaranteed", {"N s/m", 0, 1000, true},
        [](auto& s) -> auto& { return s.run.device.damping; }),
    StabilityParameter{"device.rate",
                       "of the servo",
                       {"Hz", 250, 10'000, false},
                       {},
                       [](const Setting& s) { return 1 / s.run.device.period; },
                       [](Setting& s, double value) { s.run.device.period = 1 / value; }},
    row(
        "device.mass", "of the handle", {"kg", 1e-3, 100, false},
        [](auto& s) -> auto& { return s.run.device.mass; }),
    row(
        "update_rate", "samples to the hand", {"Hz", 1, 10'000, false},
        [](auto& s) -> auto& { return s.run.update_hz; }),
    row(
        "uplink_rate", "samples to a server", {"Hz", 1, 10'000, false},
        [](auto& s) -> auto& { return s.run.uplink_hz; }),
};

std::string_view last_part(std::string_view name) { return name.substr(name.rfind('.') + 1); }

double word_value(const StabilityParameter& parameter, std::string_view word) {
  const auto found = std::ranges::find(parameter.words, word);
  if (found != parameter.words.end()) return static_cast<double>(found - parameter.words.begin());
  refuse_name(fmt::format("--sweep {}", parameter.name), word, parameter.words, ", all");
}

std::vector<double> word_values(const StabilityParameter& parameter, std::string_view text) {
  std::vector<double> values;
  for (const std::string_view word : parts_between_commas(text)) {
    if (word == "all" && values.empty()) {
      for (std::size_t i = 0; i < parameter.words.size(); ++i)
        if (parameter.words[i] != "trace") values.push_back(static_cast<double>(i));
      continue;
    }
    const double value = word_value(parameter, word);
    if (std::ranges::count(values, value) > 0)
      throw tools::UsageError(
          fmt::format("--sweep {}: '{}' is given twice; write each once", parameter.name, word));
    values.push_back(value);
  }
  return values;
}

}  // namespace

std::span<const StabilityParameter> stability_parameters() { return kParameters; }

const StabilityParameter& stability_parameter(std::string_view name) {
  std::vector<std::string_view> names;
  for (const StabilityParameter& parameter : kParameters) {
    if (parameter.name == name || last_part(parameter.name) == name) return parameter;
    names.push_back(parameter.name);
  }
  // The end of a name is mistyped as often as a whole name.
  std::vector<std::string_view> candidates = names;
  for (const std::string_view known : names) candidates.push_back(last_part(known));
  const std::string_view nearest = peer::nearest_word(name, candidates);
  throw tools::UsageError(
      fmt::format("--sweep: there is no '{}'{}; known: {}", name,
                  nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest),
                  fmt::join(names, ", ")));
}

StabilityAxis read_stability_axis(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == text.npos)
    throw tools::UsageError(
        fmt::format("--sweep: '{}' has no values; write NAME=A..B/N or NAME=A,B,C, for example "
                    "delay=0..200ms/5",
                    text));
  const StabilityParameter& parameter = stability_parameter(text.substr(0, equals));
  const std::string_view values = text.substr(equals + 1);
  if (!parameter.words.empty()) return {&parameter, word_values(parameter, values)};
  return {&parameter,
          read_values(values, parameter.rule, fmt::format("--sweep {}", parameter.name))};
}

std::string value_text(const StabilityParameter& parameter, double value) {
  if (!parameter.words.empty())
    return std::string(parameter.words[static_cast<std::size_t>(value)]);
  if (parameter.rule.unit.empty()) return fmt::format("{:g} %", 100 * value);
  return peer::format_quantity(value, parameter.rule.unit);
}

}  // namespace reckon::bench
