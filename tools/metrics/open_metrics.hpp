// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Writes counters and values of a running program as OpenMetrics text, for Prometheus and others.
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

/// MIME type of the text.
inline constexpr std::string_view kOpenMetricsType =
    "application/openmetrics-text; version=1.0.0; charset=utf-8";

/// The metric name for a counter, without "reckon_" and without "_total": "datagrams_in" becomes
/// "datagrams_received", "octets_in" "received_bytes", "power_given_uj" "power_given_joules".
struct MetricName {
  std::string text;
  double scale = 1;  ///< from the counter's unit to the metric's unit
};
[[nodiscard]] MetricName metric_name(std::string_view counter);

/// Builds one text. Metrics are in the order in which they are first named; all lines of a metric
/// are adjacent, as the format requires. Allocates.
///
///     OpenMetrics text;
///     text.counter("datagrams_in", "datagrams received", 7);
///     text.gauge("entities", "remote entities that are known", 3);
///     answer(text.end());
class OpenMetrics {
 public:
  /// Name and value of a label. The value may contain any characters.
  using Label = std::pair<std::string_view, std::string_view>;
  using Labels = std::initializer_list<Label>;

  /// @param counter name in the program, see metric_name()  @param meaning one sentence
  void counter(std::string_view counter, std::string_view meaning, std::uint64_t value,
               Labels labels = {});
  /// All counters of a peer: the counters of a group form one metric, levels are gauges.
  void counters(const peer::Counters& counters);
  /// A present value. @param name with its unit at the end: "port_energy_joules"
  void gauge(std::string_view name, std::string_view meaning, double value, Labels labels = {});
  /// Median, 99 % and 99.9 % of durations since the start, their number, and the longest as a
  /// gauge.
  /// @param name without its unit, which is seconds
  void durations(std::string_view name, std::string_view meaning,
                 const peer::DurationHistogram& histogram, Labels labels = {});
  /// The same for a distribution. @param unit of its values: "meters"
  void spread(std::string_view name, std::string_view unit, std::string_view meaning,
              const peer::Spread& spread, Labels labels = {});

  /// The whole text, including the end marker.
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
