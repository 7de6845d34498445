// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/program.hpp"

#include <array>
#include <memory>

#include "reckon/bench/studies/frame/study.hpp"
#include "reckon/tools/command_line/reading_program.hpp"

namespace reckon::bench {
tools::Verb bench_verb();  // verbs/bench.cpp

// Studies that are verbs, each in its folder.
std::unique_ptr<Study> figures_study();
std::unique_ptr<Study> tune_study();
std::unique_ptr<Study> zwidth_study();

std::span<const tools::Verb> verbs() {
  static const std::array kVerbs{bench_verb(),
                                 study_verb(tools::verb_row("figures"), figures_study),
                                 study_verb(tools::verb_row("tune"), tune_study),
                                 study_verb(tools::verb_row("zwidth"), zwidth_study)};
  return kVerbs;
}

int run_program(tools::Arguments arguments, const tools::Console& console) noexcept {
  return tools::run_reading_program(
      {"reckon-bench", "The studies of Reckon: `reckon bench` and its like start them.", verbs()},
      arguments, console);
}

}  // namespace reckon::bench
