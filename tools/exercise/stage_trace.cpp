// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/stage_trace.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <iterator>

#include "reckon/pdu/seconds.hpp"

namespace reckon::tools {

StageTrace::StageTrace(const std::filesystem::path& file)
    : file_(file, "t_s,peer,pass,stage,begin_us,took_us") {}

void StageTrace::write(std::size_t peer, const peer::LoopStep& step) {
  line_.clear();
  fmt::format_to(std::back_inserter(line_), FMT_COMPILE("{:.6f},{},{},{},{:.3f},{:.3f}\n"),
                 pdu::to_seconds(step.time), peer + 1, step.pass,
                 peer::kLoopStages[static_cast<std::size_t>(step.stage)],
                 1e6 * pdu::to_seconds(step.begin), 1e6 * pdu::to_seconds(step.took));
  file_.write(line_);
}

}  // namespace reckon::tools
