// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/verb_completion.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <memory>
#include <string>

#include "tools/command_line.hpp"

namespace reckon::tools {
namespace {

/// Asks the verb itself for its flags, so that no second list can fall behind; spaces between.
std::string flags_of(const Verb& verb) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* out = open_memstream(&text, &size);
  if (out == nullptr) throw std::bad_alloc();
  Console asked;
  asked.out = out;
  const std::array<std::string_view, 1> list{kListFlags};
  (void)verb.run(list, asked);
  std::fclose(out);
  const std::unique_ptr<char, void (*)(void*)> owner(text, std::free);
  std::string flags(text, size);
  for (char& letter : flags) {
    if (letter == '\n') letter = ' ';
  }
  if (!flags.empty()) flags.pop_back();
  return flags;
}

std::string verb_names() {
  std::string names;
  for (const Verb& verb : verbs())
    names += fmt::format("{}{}", names.empty() ? "" : " ", verb.name);
  return names;
}

/// What may follow a verb, spaces between.
std::string words_of(const Verb& verb) {
  return verb.name == "help" ? verb_names() : std::string(verb.words);
}

/// The text as a shell word: within single quotes.
std::string quoted(std::string_view text) {
  std::string word = "'";
  for (const char letter : text) {
    if (letter == '\'') word += "'\\'";
    word += letter;
  }
  return word + '\'';
}

void print_bash(std::FILE* out) {
  fmt::print(out,
             "# bash completion of reckon; install: reckon completion bash > "
             "~/.local/share/bash-completion/completions/reckon\n"
             "_reckon() {{\n"
             "  local current=${{COMP_WORDS[COMP_CWORD]}} words='' flags=''\n"
             "  if (( COMP_CWORD == 1 )); then\n"
             "    COMPREPLY=($(compgen -W '{} --help --version' -- \"$current\"))\n"
             "    return\n"
             "  fi\n"
             "  case ${{COMP_WORDS[1]}} in\n",
             verb_names());
  for (const Verb& verb : verbs()) {
    fmt::print(out, "    {}) words='{}' flags='{}' ;;\n", verb.name, words_of(verb),
               flags_of(verb));
  }
  fmt::print(out,
             "  esac\n"
             "  if [[ $current == -* ]]; then\n"
             "    COMPREPLY=($(compgen -W \"$flags\" -- \"$current\"))\n"
             "  elif [[ -n $words ]] && (( COMP_CWORD == 2 )); then\n"
             "    COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
             "  fi\n"
             "}}\n"
             "complete -o default -F _reckon reckon\n");
}

void print_zsh(std::FILE* out) {
  fmt::print(out,
             "#compdef reckon\n"
             "# zsh completion of reckon; install as _reckon in a folder of $fpath\n"
             "_reckon() {{\n"
             "  local -a verbs choices flags\n"
             "  verbs=(\n");
  for (const Verb& verb : verbs())
    fmt::print(out, "    {}\n", quoted(fmt::format("{}:{}", verb.name, verb.summary)));
  fmt::print(out,
             "  )\n"
             "  if (( CURRENT == 2 )); then\n"
             "    _describe verb verbs\n"
             "    return\n"
             "  fi\n"
             "  case ${{words[2]}} in\n");
  for (const Verb& verb : verbs())
    fmt::print(out, "    {}) choices=({}) flags=({}) ;;\n", verb.name, words_of(verb),
               flags_of(verb));
  fmt::print(out,
             "  esac\n"
             "  if [[ $PREFIX == -* ]]; then\n"
             "    compadd -- $flags\n"
             "  elif (( CURRENT == 3 && $#choices )); then\n"
             "    compadd -- $choices\n"
             "  else\n"
             "    _files\n"
             "  fi\n"
             "}}\n"
             "_reckon \"$@\"\n");
}

void print_fish(std::FILE* out) {
  fmt::print(out,
             "# fish completion of reckon; install: reckon completion fish > "
             "~/.config/fish/completions/reckon.fish\n");
  for (const Verb& verb : verbs()) {
    fmt::print(out, "complete -c reckon -n __fish_use_subcommand -f -a {} -d {}\n", verb.name,
               quoted(verb.summary));
    const std::string words = words_of(verb);
    const std::string seen = fmt::format("'__fish_seen_subcommand_from {}'", verb.name);
    if (!words.empty()) fmt::print(out, "complete -c reckon -n {} -f -a {}\n", seen, quoted(words));
    std::string flags = flags_of(verb);
    while (!flags.empty()) {
      const std::size_t end = std::min(flags.find(' '), flags.size());
      fmt::print(out, "complete -c reckon -n {} -l {}\n", seen, flags.substr(2, end - 2));
      flags.erase(0, end + 1);
    }
  }
}

}  // namespace

int run_completion(Arguments arguments, const Console& console) {
  std::string shell;
  CommandLine line("completion", "Print a completion script for a shell.",
                   "source <(reckon completion bash)\nreckon completion zsh > ~/.zfunc/_reckon");
  line.choice("SHELL", shell, {"bash", "zsh", "fish"}, "the shell: bash, zsh or fish");
  if (const auto status = line.parse(arguments, console)) return *status;

  if (shell.empty()) throw UsageError("say for which shell: reckon completion bash, zsh or fish");
  if (shell == "bash") print_bash(console.out);
  if (shell == "zsh") print_zsh(console.out);
  if (shell == "fish") print_fish(console.out);
  return exit_status(ExitCode::good);
}

}  // namespace reckon::tools
