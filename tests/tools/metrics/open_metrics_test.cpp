// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The text for monitoring systems, octet by octet; metrics.py compares it with external parsers.
#include "reckon/tools/metrics/open_metrics.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>

namespace reckon::tools {
namespace {

using peer::Counters;

TEST(MetricName, NamesTheDirectionAndEndsWithBaseUnits) {
  EXPECT_EQ(metric_name("datagrams_in").text, "datagrams_received");
  EXPECT_EQ(metric_name("updates_out").text, "updates_sent");
  EXPECT_EQ(metric_name("octets_in").text, "received_bytes");
  EXPECT_EQ(metric_name("link_sent_bytes").text, "link_sent_bytes");
  EXPECT_EQ(metric_name("write_overflow").text, "write_overflow");
  EXPECT_EQ(metric_name("timed_out").text, "entities_timed_out");
  const MetricName power = metric_name("power_given_uj");
  EXPECT_EQ(power.text, "power_given_joules");
  EXPECT_DOUBLE_EQ(power.scale, 1e-6);
}

TEST(OpenMetrics, EndsEvenWhereNothingIsCounted) { EXPECT_EQ(OpenMetrics().end(), "# EOF\n"); }

TEST(OpenMetrics, HasEachCounterOnceWithMeaningAndUnit) {
  static constexpr peer::CounterGroup kGroup{"datagrams_refused", "cause", "not taken"};
  Counters counters;
  counters.make("datagrams_in", "datagrams received").add(7);
  counters.make_in(kGroup, "version", "refused_version_in", "no version of DIS").add(2);
  counters.make("octets_in", "octets of UDP payload").add(99);
  counters.make_in(kGroup, "flood", "muted_in", "of flooding senders").add(3);
  counters.make_level("cells_led", "cells that this peer leads").set(4);
  OpenMetrics text;
  text.counters(counters);
  EXPECT_EQ(text.end(),
            "# TYPE reckon_datagrams_received counter\n"
            "# HELP reckon_datagrams_received datagrams received\n"
            "reckon_datagrams_received_total 7\n"
            "# TYPE reckon_datagrams_refused counter\n"
            "# HELP reckon_datagrams_refused not taken\n"
            "reckon_datagrams_refused_total{cause=\"version\"} 2\n"
            "reckon_datagrams_refused_total{cause=\"flood\"} 3\n"
            "# TYPE reckon_received_bytes counter\n"
            "# UNIT reckon_received_bytes bytes\n"
            "# HELP reckon_received_bytes octets of UDP payload\n"
            "reckon_received_bytes_total 99\n"
            "# TYPE reckon_cells_led gauge\n"
            "# HELP reckon_cells_led cells that this peer leads\n"
            "reckon_cells_led 4\n"
            "# EOF\n");
}

TEST(OpenMetrics, EscapesQuotesAndLineEnds) {
  OpenMetrics text;
  text.gauge("entities", "a \"word\"", -0.5, {{"interface", "a\"b\\c\nd"}});
  EXPECT_EQ(text.end(),
            "# TYPE reckon_entities gauge\n"
            "# HELP reckon_entities a \\\"word\\\"\n"
            "reckon_entities{interface=\"a\\\"b\\\\c\\nd\"} -0.5\n"
            "# EOF\n");
}

TEST(OpenMetrics, WritesNonFiniteNumbersAsInTheFormat) {
  OpenMetrics text;
  text.gauge("a", "b", std::nan(""));
  text.gauge("a", "b", std::numeric_limits<double>::infinity(), {{"c", "d"}});
  EXPECT_EQ(text.end(),
            "# TYPE reckon_a gauge\n# HELP reckon_a b\nreckon_a NaN\n"
            "reckon_a{c=\"d\"} +Inf\n# EOF\n");
}

TEST(OpenMetrics, GivesDurationsInSecondsWithTheirQuantiles) {
  peer::DurationHistogram histogram;
  for (int i = 0; i < 10; ++i) histogram.add(std::chrono::nanoseconds(16));
  OpenMetrics text;
  text.durations("servo_lateness", "how late", histogram, {{"loop", "servo"}});
  EXPECT_EQ(text.end(),
            "# TYPE reckon_servo_lateness_seconds summary\n"
            "# UNIT reckon_servo_lateness_seconds seconds\n"
            "# HELP reckon_servo_lateness_seconds how late\n"
            "reckon_servo_lateness_seconds{loop=\"servo\",quantile=\"0.5\"} 1.6e-08\n"
            "reckon_servo_lateness_seconds{loop=\"servo\",quantile=\"0.99\"} 1.6e-08\n"
            "reckon_servo_lateness_seconds{loop=\"servo\",quantile=\"0.999\"} 1.6e-08\n"
            "reckon_servo_lateness_seconds_count{loop=\"servo\"} 10\n"
            "# TYPE reckon_servo_lateness_max_seconds gauge\n"
            "# UNIT reckon_servo_lateness_max_seconds seconds\n"
            "# HELP reckon_servo_lateness_max_seconds how late, the greatest so far\n"
            "reckon_servo_lateness_max_seconds{loop=\"servo\"} 1.6e-08\n"
            "# EOF\n");
}

}  // namespace
}  // namespace reckon::tools
