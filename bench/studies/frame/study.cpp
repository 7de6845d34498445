// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/frame/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>

#include "reckon/tools/command_line/command_text.hpp"
#include "reckon/tools/command_line/output_file.hpp"

namespace reckon::bench {

void declare(tools::CommandLine& line, std::span<const Flag> flags) {
  for (const Flag& row : flags) {
    const bool is_word = !row.name.starts_with("--");
    std::visit(
        [&]<class Target>(Target* target) {
          if constexpr (std::is_same_v<Target, bool>)
            line.flag(row.name, *target, row.help);
          else if constexpr (std::is_same_v<Target, std::string>)
            is_word ? line.word(row.name, *target, false, row.help)
                    : line.option(row.name, *target, row.help);
          else if constexpr (std::is_same_v<Target, std::vector<std::string>>)
            is_word ? line.words(row.name, *target, false, row.help)
                    : line.option(row.name, *target, row.help);
          else
            line.option(row.name, *target, row.help);
        },
        row.target);
    if (!row.offered.empty()) line.offer(row.name, row.offered);
  }
}

void check_modes(std::span<const Flag> flags, unsigned mode, std::span<const std::string> given,
                 const std::function<std::string(std::string_view flag)>& refusal) {
  for (const std::string& flag : given) {
    const auto row = std::ranges::find(flags, flag, &Flag::name);
    if (row != flags.end() && (row->modes & mode) == 0) throw tools::UsageError(refusal(flag));
  }
}

int run_study(Study& study, const StudyCall& call) {
  const SharedWords& words = study.shared();
  for (const std::string& path : {words.csv, words.plot, words.report}) tools::check_writable(path);
  const StudyOutput output = study.run(call);
  const tools::Console& console = call.console;
  fmt::print(console.out, "{}", output.out);
  fmt::print(console.err, "{}", output.note);
  const auto write = [&](const std::string& path, const std::string& text) {
    if (path.empty() || text.empty()) return;
    tools::save_output(path, text);
    if (output.reports_files) fmt::print(console.err, "wrote {}\n", path);
  };
  write(words.csv, output.csv);
  write(words.plot, output.plot);
  write(words.report, output.page);
  return tools::exit_status(output.code);
}

tools::Verb study_verb(const tools::VerbRow& row, std::unique_ptr<Study> (*make)()) {
  const auto run = [name = row.name, make](tools::Arguments arguments,
                                           const tools::Console& console) {
    const auto study = make();
    tools::CommandLine line(name, study->verb_text.summary, study->verb_text.examples);
    declare(line, study->flags());
    if (const auto status = line.parse(arguments, console)) return *status;
    return run_study(*study, {line.given(), tools::command_text(name, arguments), console});
  };
  return {row.name, row.summary, run};
}

}  // namespace reckon::bench
