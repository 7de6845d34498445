// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Options of `reckon inspect`: filled from the command line, read by the views.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "reckon/tools/datagrams/source.hpp"
#include "reckon/tools/inspect/output/format.hpp"

namespace reckon::tools {

struct InspectOptions {
  SourceChoice source;
  std::string view;      ///< empty: the default of the source
  std::string by;        ///< stats: a single table; empty: all
  std::string where;     ///< filter; empty: all PDUs
  std::string from;      ///< of a recording: first instant; empty: the beginning
  std::string to;        ///< of a recording: instant after the last; empty: the end
  std::string fields;    ///< PDU type whose fields are listed instead of a run; empty: a run
  std::string key;       ///< key file; empty: sealed datagrams are only counted
  std::string svg;       ///< haptics: file for a plot; empty: none
  bool lenient = false;  ///< lengths of 0 and trailing octets are noted, not refused
  bool json = false;
  bool csv = false;
  bool rules = false;
  bool full = false;
  bool tree = false;
  std::optional<std::chrono::nanoseconds> duration;
  std::optional<std::uint64_t> count;
  std::optional<std::chrono::nanoseconds> step;  ///< haptics: between two samples

  [[nodiscard]] Format format() const {
    if (json) return Format::json;
    return csv ? Format::csv : Format::text;
  }
};

}  // namespace reckon::tools
