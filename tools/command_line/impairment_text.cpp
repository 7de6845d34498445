// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/command_line/impairment_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>

#include "reckon/peer/notation/jitter_text.hpp"
#include "reckon/peer/notation/nearest_word.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/command_line/duration_text.hpp"

namespace reckon::tools {
namespace {

std::optional<double> parse_number(std::string_view text) {
  double scale = 1.0;
  if (!text.empty() && text.back() == '%') {
    text.remove_suffix(1);
    scale = 0.01;
  }
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value * scale;
}

struct Key {
  std::string_view name;
  std::chrono::nanoseconds peer::ImpairmentLaw::*time = nullptr;
  double peer::ImpairmentLaw::*number = nullptr;
};

using Law = peer::ImpairmentLaw;
constexpr std::array kKeys{
    Key{"delay", &Law::delay, nullptr},
    Key{"jitter", nullptr, nullptr},  // a time or a share of the delay: read after all others
    Key{"loss", nullptr, &Law::loss},
    Key{"burst", nullptr, &Law::burst_loss},
    Key{"burst_length", nullptr, &Law::burst_length},
    Key{"reorder", nullptr, &Law::reorder},
    Key{"reorder_delay", &Law::reorder_delay, nullptr},
    Key{"duplicate", nullptr, &Law::duplicate},
};

[[noreturn]] void refuse_key(std::string_view key) {
  std::array<std::string_view, kKeys.size()> names;
  std::transform(kKeys.begin(), kKeys.end(), names.begin(), [](const Key& k) { return k.name; });
  const std::string_view nearest = peer::nearest_word(key, names);
  throw UsageError(fmt::format("--impair: unknown word '{}'{}; known: {}", key,
                               nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest),
                               fmt::join(names, ", ")));
}

/// Reads a word into `law`, or stores the one of jitter.
void take_word(std::string_view word, Law& law, std::optional<std::string_view>& jitter) {
  const std::size_t equals = word.find('=');
  const std::string_view name = word.substr(0, equals);
  const std::string_view value = equals == word.npos ? "" : word.substr(equals + 1);
  const auto* key =
      std::find_if(kKeys.begin(), kKeys.end(), [&](const Key& k) { return k.name == name; });
  if (key == kKeys.end()) refuse_key(name);

  if (name == "jitter") {
    jitter = value;
  } else if (key->time != nullptr) {
    const auto time = parse_duration(value);
    if (!time)
      throw UsageError(
          fmt::format("--impair {}: '{}' is not a duration; write {}=20ms", name, value, name));
    law.*key->time = *time;
  } else {
    const auto number = parse_number(value);
    if (!number)
      throw UsageError(
          fmt::format("--impair {}: '{}' is not a number; write {}=20%", name, value, name));
    law.*key->number = *number;
  }
}

std::chrono::nanoseconds jitter_of(std::string_view text, std::chrono::nanoseconds delay) {
  const peer::JitterText jitter = peer::read_jitter(text, delay, "delay=80ms");
  if (!jitter.good()) throw UsageError(fmt::format("--impair jitter: {}", jitter.error));
  return jitter.jitter;
}

}  // namespace

peer::ImpairmentLaw parse_impairment(std::string_view text) {
  Law law;
  std::optional<std::string_view> jitter;
  constexpr std::string_view kGaps = " ,\t";
  for (std::size_t at = text.find_first_not_of(kGaps); at != text.npos;) {
    const std::size_t end = std::min(text.find_first_of(kGaps, at), text.size());
    take_word(text.substr(at, end - at), law, jitter);
    at = text.find_first_not_of(kGaps, end);
  }
  if (jitter) law.jitter = jitter_of(*jitter, law.delay);
  if (const std::string problem = law.problem(); !problem.empty()) {
    throw UsageError("--impair: " + problem);
  }
  return law;
}

}  // namespace reckon::tools
