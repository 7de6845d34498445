// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/metrics/source_metrics.hpp"

#include <fmt/format.h>

namespace reckon::tools {

void add_source(OpenMetrics& out, const peer::SourceReport& report) {
  report.for_each([&](std::string_view name, std::string_view meaning, std::uint64_t value) {
    out.counter(fmt::format("source_{}", name), meaning, value);
  });
  for (const peer::ListenedInterface& one : report.interfaces)
    out.counter("interface_datagrams_in", "datagrams that arrived first on the interface",
                one.datagrams, {{"interface", one.name}});
}

}  // namespace reckon::tools
