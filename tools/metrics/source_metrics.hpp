// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The metrics of a datagram source.
#pragma once

#include "reckon/peer/capture/datagram_source.hpp"
#include "reckon/tools/metrics/open_metrics.hpp"

namespace reckon::tools {

/// Adds the counters of a source, and for live groups the counts of each interface.
void add_source(OpenMetrics& out, const peer::SourceReport& report);

}  // namespace reckon::tools
