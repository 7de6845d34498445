// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/program.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/manual_page.hpp"
#include "reckon/tools/command_line/scene_folder.hpp"
#include "reckon/tools/command_line/verb_program.hpp"
#include "reckon/tools/verbs/completion.hpp"
#include "reckon/tools/verbs/given_file.hpp"

namespace reckon::tools {
namespace {

/// The verbs of all programs, and the two verbs that need the list itself.
class Front {
 public:
  explicit Front(StartVerb start) : start_(std::move(start)) {
    for (const VerbRow& row : kVerbRows) {
      verbs_.push_back({row.name, row.summary,
                        [this, &row](Arguments arguments, const Console& console) {
                          return start_(row, arguments, console);
                        },
                        row.program});
    }
    verbs_.push_back({"completion", "print a completion script for a shell",
                      [this](Arguments arguments, const Console& console) {
                        return run_completion(verbs_, arguments, console);
                      }});
    verbs_.push_back({"help", "list the verbs, or explain one",
                      [this](Arguments arguments, const Console& console) {
                        return run_help(arguments, console);
                      }});
  }
  Front(const Front&) = delete;
  Front& operator=(const Front&) = delete;

  [[nodiscard]] std::span<const Verb> verbs() const { return verbs_; }

  [[nodiscard]] VerbProgram program() const {
    return {"reckon", "Reckon: worlds that people touch together, peer to peer.", verbs_,
            [this](Arguments arguments, const Console& console) {
              return run_file(arguments, console);
            }};
  }

 private:
  [[nodiscard]] int run(std::string_view verb, Arguments arguments, const Console& console) const {
    return find_verb(program(), verb)->run(arguments, console);
  }

  /// `reckon FILE`
  [[nodiscard]] std::optional<int> run_file(Arguments arguments, const Console& console) const {
    const auto words = words_for_file(arguments, console);
    if (!words) return std::nullopt;
    const std::vector<std::string_view> views(words->begin(), words->end());
    return run(views.front(), Arguments(views).subspan(1), console);
  }

  [[nodiscard]] int run_help(Arguments arguments, const Console& console) const {
    std::string name;
    bool manual = false;
    CommandLine line("help", "List the verbs, or explain one.",
                     "reckon help\nreckon help inspect\nreckon help rules\n"
                     "reckon help --man | man -l -");
    line.word("VERB", name, false, "the verb to explain; rules: the rules of `inspect check`");
    line.flag("--man", manual, "write the manual page of all verbs, for man -l");
    if (const auto status = line.parse(arguments, console)) return *status;

    if (manual) {
      print_manual_page(verbs_, console.out);
      return exit_status(ExitCode::good);
    }
    if (name.empty()) {
      print_overview(program(), console.out);
      return exit_status(ExitCode::good);
    }
    if (name == "rules") return run("inspect", std::array<std::string_view, 1>{"--rules"}, console);
    if (find_verb(program(), name) == nullptr) return refuse_verb(program(), name, console);
    return run(name, std::array<std::string_view, 1>{"--help"}, console);
  }

  StartVerb start_;
  std::vector<Verb> verbs_;
};

}  // namespace

std::span<const Verb> verbs() {
  static const Front kFront(start_program);
  return kFront.verbs();
}

int run_program(Arguments arguments, const Console& console, const StartVerb& start) noexcept {
  const std::vector<std::string> words = with_shipped_scenes(arguments);
  const std::vector<std::string_view> views(words.begin(), words.end());
  const Front front(start);
  return run_verb_program(front.program(), views, console);
}

}  // namespace reckon::tools
