// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Numbers of a running program as OpenMetrics text, which Prometheus and others read.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/counters/duty_cycle.hpp"
#include "reckon/peer/counters/error_histogram.hpp"

namespace reckon::tools {

/// The type of the text, as HTTP names it.
inline constexpr std::string_view kOpenMetricsType =
    "application/openmetrics-text; version=1.0.0; charset=utf-8";

/// A counter's name as a metric has it, without "reckon_" and without "_total": "datagrams_in" is
/// "datagrams_received", "octets_in" is "received_bytes", "power_given_uj" "power_given_joules".
struct MetricName {
  std::string text;
  double scale = 1;  ///< from the counter's unit to that of the metric
};
[[nodiscard]] MetricName metric_name(std::string_view counter);

/// One text under construction. Metrics come in the order in which they are first named; all that
/// belongs to one stands together, as the format asks. Allocates.
///
///     OpenMetrics text;
///     text.counter("datagrams_in", "datagrams received", 7);
///     text.gauge("entities", "remote entities that are known", 3);
///     answer(text.end());
class OpenMetrics {
 public:
  /// Name and value of a label. The value may hold anything.
  using Label = std::pair<std::string_view, std::string_view>;
  using Labels = std::initializer_list<Label>;

  /// @param counter as the program names it, see metric_name()  @param meaning one sentence
  void counter(std::string_view counter, std::string_view meaning, std::uint64_t value,
               Labels labels = {});
  /// All counters of a peer: those of a group are one metric, levels are gauges.
  void counters(const peer::Counters& counters);
  /// A number of now. @param name with its unit at the end: "port_energy_joules"
  void gauge(std::string_view name, std::string_view meaning, double value, Labels labels = {});
  /// Median, 99 % and 99.9 % of durations since the start, their number, and the longest as a
  /// gauge.
  /// @param name without its unit, which is seconds
  void durations(std::string_view name, std::string_view meaning,
                 const peer::DurationHistogram& histogram, Labels labels = {});
  /// The same of a distribution. @param unit of it: "meters"
  void spread(std::string_view name, std::string_view unit, std::string_view meaning,
              const peer::Spread& spread, Labels labels = {});

  /// The whole text, with its end.
  [[nodiscard]] std::string end() const;

 private:
  struct Family {
    std::string name;  ///< with "reckon_"
    std::string_view type;
    std::string unit;  ///< "bytes"; empty: none
    std::string meaning;
    std::string samples;  ///< whole lines
  };

  [[nodiscard]] Family& family(std::string name, std::string_view type, std::string_view meaning);
  static void sample(Family& family, std::string_view suffix, std::span<const Label> labels,
                     double value);

  std::vector<Family> families_;
};

}  // namespace reckon::tools
