// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/program.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/manual_page.hpp"
#include "reckon/tools/command_line/verb_program.hpp"
#include "reckon/tools/exercise/scene_folder.hpp"
#include "reckon/tools/verbs/completion.hpp"
#include "reckon/tools/verbs/given_file.hpp"

namespace reckon::tools {
namespace verb {

// One function for each file of verbs/.
Verb demo();
Verb peer();
Verb inspect();
Verb view();
Verb record();
Verb replay();
Verb info();
Verb cut();
Verb scene();
Verb key();
Verb tune();
Verb devices();
Verb doctor();
Verb bench();
Verb figures();
Verb zwidth();

}  // namespace verb

namespace {

int run_help(Arguments arguments, const Console& console);
int run_list_completion(Arguments arguments, const Console& console);

/// THE list of verbs, in the order of help. Two verbs need the list itself and are therefore
/// defined here.
std::span<const Verb> list() {
  static const std::array kVerbs{
      verb::demo(),
      verb::peer(),
      verb::inspect(),
      verb::view(),
      verb::record(),
      verb::replay(),
      verb::info(),
      verb::cut(),
      verb::scene(),
      verb::key(),
      verb::tune(),
      verb::devices(),
      verb::doctor(),
      verb::bench(),
      verb::figures(),
      verb::zwidth(),
      Verb{"completion", "print a completion script for a shell", run_list_completion},
      Verb{"help", "list the verbs, or explain one", run_help},
  };
  return kVerbs;
}

/// `reckon FILE`
std::optional<int> run_file(Arguments arguments, const Console& console);

VerbProgram program() {
  return {"reckon", "Reckon: worlds that people touch together, peer to peer.", list(), run_file};
}

std::optional<int> run_file(Arguments arguments, const Console& console) {
  const auto words = words_for_file(arguments, console);
  if (!words) return std::nullopt;
  const std::vector<std::string_view> views(words->begin(), words->end());
  return find_verb(program(), views.front())->run(Arguments(views).subspan(1), console);
}

int run_help(Arguments arguments, const Console& console) {
  std::string name;
  bool manual = false;
  CommandLine line("help", "List the verbs, or explain one.",
                   "reckon help\nreckon help inspect\nreckon help rules\n"
                   "reckon help --man | man -l -");
  line.word("VERB", name, false, "the verb to explain; rules: those of `inspect check`");
  line.flag("--man", manual, "write the manual page of all verbs, for man -l");
  if (const auto status = line.parse(arguments, console)) return *status;

  if (manual) {
    print_manual_page(list(), console.out);
    return exit_status(ExitCode::good);
  }
  if (name.empty()) {
    print_overview(program(), console.out);
    return exit_status(ExitCode::good);
  }
  if (name == "rules")
    return verb::inspect().run(std::array<std::string_view, 1>{"--rules"}, console);
  const Verb* verb = find_verb(program(), name);
  if (verb == nullptr) return refuse_verb(program(), name, console);
  const std::array<std::string_view, 1> help{"--help"};
  return verb->run(help, console);
}

int run_list_completion(Arguments arguments, const Console& console) {
  return run_completion(list(), arguments, console);
}

}  // namespace

std::span<const Verb> verbs() { return list(); }

int run_program(Arguments arguments, const Console& console) noexcept {
  const std::vector<std::string> words = with_shipped_scenes(arguments);
  const std::vector<std::string_view> views(words.begin(), words.end());
  return run_verb_program(program(), views, console);
}

}  // namespace reckon::tools
