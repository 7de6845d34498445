// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/stability/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/scene/nearest_word.hpp"
#include "reckon/peer/scene/units.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

using Setting = StabilitySetting;

constexpr std::array<std::string_view, 4> kEnvironments{"linear", "hardening", "moving",
                                                        "switching"};
constexpr std::array<std::string_view, 4> kOperators{"push", "soft", "tracking", "trace"};
constexpr std::array<std::string_view, 2> kCounterparts{"server", "hand"};

constexpr std::array<StabilityParameter, 15> kParameters{{
    {"hand.k1",
     "stiffness of what is touched",
     {"N/m", 0, 1e5, true},
     {},
     [](const Setting& s) { return s.stiffness; },
     [](Setting& s, double value) { s.stiffness = value; }},
    {"impairment.delay",
     "one way",
     {"s", 0, 10, false},
     {},
     [](const Setting& s) { return pdu::to_seconds(s.run.network.delay); },
     [](Setting& s, double value) { s.run.network.delay = pdu::from_seconds(value); }},
    {"impairment.loss",
     "share of the samples",
     {"", 0, 0.99, false},
     {},
     [](const Setting& s) { return s.run.network.loss; },
     [](Setting& s, double value) { s.run.network.loss = value; }},
    {"impairment.jitter",
     "delay +- so long, never below 0 in sum",
     {"s", 0, 10, false},
     {},
     [](const Setting& s) { return pdu::to_seconds(s.run.network.jitter); },
     [](Setting& s, double value) { s.run.network.jitter = pdu::from_seconds(value); }},
    {"jitter_share",
     "delay +- this share of it",
     {"", 0, 1, false},
     {},
     [](const Setting& s) { return s.jitter_share.value_or(0); },
     [](Setting& s, double value) { s.jitter_share = value; }},
    {"impairment.reorder",
     "share held back",
     {"", 0, 1, false},
     {},
     [](const Setting& s) { return s.run.network.reorder; },
     [](Setting& s, double value) { s.run.network.reorder = value; }},
    {"impairment.reorder_delay",
     "for so long",
     {"s", 0, 10, false},
     {},
     [](const Setting& s) { return pdu::to_seconds(s.run.network.reorder_delay); },
     [](Setting& s, double value) { s.run.network.reorder_delay = pdu::from_seconds(value); }},
    {"environment",
     "what is touched",
     {},
     kEnvironments,
     [](const Setting& s) { return static_cast<double>(s.environment); },
     [](Setting& s, double value) {
       s.environment = static_cast<EnvironmentKind>(static_cast<int>(value));
     }},
    {"operator",
     "the hand at the device",
     {},
     kOperators,
     [](const Setting& s) { return static_cast<double>(s.operator_number); },
     [](Setting& s, double value) { s.operator_number = static_cast<std::size_t>(value); }},
    {"counterpart",
     "what is at the other end",
     {},
     kCounterparts,
     [](const Setting& s) { return static_cast<double>(s.run.counterpart); },
     [](Setting& s, double value) {
       s.run.counterpart = static_cast<Counterpart>(static_cast<int>(value));
     }},
    {"device.damping",
     "of the device, sure",
     {"N s/m", 0, 1000, true},
     {},
     [](const Setting& s) { return s.run.device.damping; },
     [](Setting& s, double value) { s.run.device.damping = value; }},
    {"device.rate",
     "of the servo",
     {"Hz", 250, 10'000, false},
     {},
     [](const Setting& s) { return 1 / s.run.device.period; },
     [](Setting& s, double value) { s.run.device.period = 1 / value; }},
    {"device.mass",
     "of the handle",
     {"kg", 1e-3, 100, false},
     {},
     [](const Setting& s) { return s.run.device.mass; },
     [](Setting& s, double value) { s.run.device.mass = value; }},
    {"update_rate",
     "samples to the hand",
     {"Hz", 1, 10'000, false},
     {},
     [](const Setting& s) { return s.run.update_hz; },
     [](Setting& s, double value) { s.run.update_hz = value; }},
    {"uplink_rate",
     "samples to a server",
     {"Hz", 1, 10'000, false},
     {},
     [](const Setting& s) { return s.run.uplink_hz; },
     [](Setting& s, double value) { s.run.uplink_hz = value; }},
}};

std::string_view last_part(std::string_view name) { return name.substr(name.rfind('.') + 1); }

double word_value(const StabilityParameter& parameter, std::string_view word) {
  const auto found = std::ranges::find(parameter.words, word);
  if (found != parameter.words.end()) return static_cast<double>(found - parameter.words.begin());
  const std::string_view nearest = peer::nearest_word(word, parameter.words);
  throw tools::UsageError(
      fmt::format("--sweep {}: there is no '{}'{}; known: {}, all", parameter.name, word,
                  nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest),
                  fmt::join(parameter.words, ", ")));
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
          fmt::format("--sweep {}: '{}' is given twice; give each once", parameter.name, word));
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
  // A mistyped end is as likely as a mistyped name.
  std::vector<std::string_view> candidates = names;
  for (const std::string_view known : names) candidates.push_back(last_part(known));
  const std::string_view nearest = peer::nearest_word(name, candidates);
  throw tools::UsageError(
      fmt::format("--sweep: nothing is called '{}'{}; known: {}", name,
                  nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest),
                  fmt::join(names, ", ")));
}

StabilityAxis read_stability_axis(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == text.npos)
    throw tools::UsageError(fmt::format(
        "--sweep: '{}' says no values; write NAME=A..B/N or NAME=A,B,C, as delay=0..200ms/5",
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
