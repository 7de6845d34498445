// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/body_report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace reckon::tools {
namespace {

auto awake_of(const haptics::BodyWorld& bodies) {
  return std::ranges::count_if(bodies.states(), &haptics::BodyState::awake);
}

}  // namespace

void print_bodies(std::FILE* out, const haptics::BodyWorld* bodies) {
  if (bodies == nullptr) return;
  fmt::print(out,
             "  bodies                     {} move, {} awake at the end; {:.1e} J added by the "
             "solver and removed\n",
             bodies->states().size(), awake_of(*bodies), bodies->taken_out());
  if (bodies->approximated() > 0 || bodies->coarse() > 0)
    fmt::print(out,
               "                             {} steps by the iterative solver; {} periods of a "
               "hand at more bodies than can be predicted\n",
               bodies->approximated(), bodies->coarse());
  if (bodies->crowded() > 0)
    fmt::print(out,
               "                             in {} steps a body stayed at rest, because 64 (the "
               "most) were moving\n",
               bodies->crowded());
}

std::string bodies_json(const haptics::BodyWorld* bodies) {
  if (bodies == nullptr) return R"(,"bodies":null)";
  return fmt::format(
      R"(,"bodies":{{"moving":{},"awake":{},"taken_out_j":{:.6g},"approximated_steps":{},"coarse_periods":{},"not_woken":{}}})",
      bodies->states().size(), awake_of(*bodies), bodies->taken_out(), bodies->approximated(),
      bodies->coarse(), bodies->crowded());
}

}  // namespace reckon::tools
