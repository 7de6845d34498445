// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/completion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "reckon/tools/command_line/command_line.hpp"

namespace reckon::tools {
namespace {

using Verbs = std::span<const Verb>;

/// Flags and words of a verb.
struct Taken {
  std::vector<std::string> flags;             ///< "--json"
  std::map<std::string, std::string> values;  ///< of flags with few values, separated by spaces
  std::vector<std::string> words;  ///< choices of each word after the verb; empty: a file
};

/// The verb's list of its flags.
std::string asked(const Verb& verb) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* out = open_memstream(&text, &size);
  if (out == nullptr) throw std::bad_alloc();
  Console console;
  console.out = out;
  const std::array<std::string_view, 1> list{kListFlags};
  (void)verb.run(list, console);
  std::fclose(out);
  const std::unique_ptr<char, void (*)(void*)> owner(text, std::free);
  return {text, size};
}

std::string verb_names(Verbs verbs) {
  std::string names;
  for (const Verb& verb : verbs) names += fmt::format("{}{}", names.empty() ? "" : " ", verb.name);
  return names;
}

/// Gets the flags from the verb itself, so that there is no second list to maintain.
Taken taken_by(const Verb& verb, Verbs verbs) {
  Taken taken;
  std::istringstream lines(asked(verb));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t end = std::min(line.find(' '), line.size());
    const std::string name = line.substr(0, end);
    const std::string choices = line.substr(std::min(end + 1, line.size()));
    if (!name.starts_with('-')) {
      taken.words.push_back(choices);
      continue;
    }
    taken.flags.push_back(name);
    if (!choices.empty()) taken.values[name] = choices;
  }
  if (verb.name == "help") taken.words = {verb_names(verbs) + " rules"};
  return taken;
}

/// Values as the shell expands them when it completes.
std::string expanded(const std::string& values, std::string_view interfaces) {
  return values == kInterfaces ? std::string(interfaces) : values;
}

/// The text as a shell word in single quotes.
std::string in_quotes(std::string_view text) {
  std::string word = "'";
  for (const char letter : text) {
    if (letter == '\'') word += "'\\'";
    word += letter;
  }
  return word + '\'';
}

/// The words of each position as elements of a shell array.
std::string quoted_words(const Taken& taken) {
  std::string elements;
  for (const std::string& words : taken.words)
    elements += fmt::format("{}{}", elements.empty() ? "" : " ", in_quotes(words));
  return elements;
}

void print_bash(Verbs verbs, std::FILE* out) {
  fmt::print(out,
             "# bash completion of reckon; install: reckon completion bash > "
             "~/.local/share/bash-completion/completions/reckon\n"
             "_reckon() {{\n"
             "  local current=${{COMP_WORDS[COMP_CWORD]}} flags='' place=0 i before=''\n"
             "  [[ $current == *,* ]] && before=${{current%,*}},  # of a list\n"
             "  local -a words=()\n"
             "  if (( COMP_CWORD == 1 )); then\n"
             "    COMPREPLY=($(compgen -W '{} --help --version' -- \"$current\"))\n"
             "    return\n"
             "  fi\n"
             "  case ${{COMP_WORDS[1]}}:${{COMP_WORDS[COMP_CWORD-1]}} in\n",
             verb_names(verbs));
  for (const Verb& verb : verbs) {
    for (const auto& [flag, values] : taken_by(verb, verbs).values)
      fmt::print(out,
                 "    {}:{}) COMPREPLY=($(compgen -P \"$before\" -W '{}' -- "
                 "\"${{current##*,}}\")); return ;;\n",
                 verb.name, flag, expanded(values, "$(ls /sys/class/net)"));
  }
  fmt::print(out, "  esac\n  case ${{COMP_WORDS[1]}} in\n");
  for (const Verb& verb : verbs) {
    const Taken taken = taken_by(verb, verbs);
    fmt::print(out, "    {}) words=({}) flags='{}' ;;\n", verb.name, quoted_words(taken),
               fmt::join(taken.flags, " "));
  }
  fmt::print(out,
             "  esac\n"
             "  for (( i = 2; i < COMP_CWORD; i++ )); do\n"
             "    [[ ${{COMP_WORDS[i]}} == -* ]] || (( place += 1 ))\n"
             "  done\n"
             "  if [[ $current == -* ]]; then\n"
             "    COMPREPLY=($(compgen -W \"$flags\" -- \"$current\"))\n"
             "  else\n"
             "    COMPREPLY=($(compgen -W \"${{words[place]-}}\" -- \"$current\"))\n"
             "  fi\n"
             "}}\n"
             "complete -o default -F _reckon reckon\n");
}

void print_zsh(Verbs verbs, std::FILE* out) {
  fmt::print(out,
             "#compdef reckon\n"
             "# zsh completion of reckon; install as _reckon in a folder of $fpath\n"
             "_reckon() {{\n"
             "  local -a verbs choices flags\n"
             "  verbs=(\n");
  for (const Verb& verb : verbs)
    fmt::print(out, "    {}\n", in_quotes(fmt::format("{}:{}", verb.name, verb.summary)));
  fmt::print(out,
             "  )\n"
             "  if (( CURRENT == 2 )); then\n"
             "    _describe verb verbs\n"
             "    return\n"
             "  fi\n"
             "  case ${{words[2]}} in\n");
  for (const Verb& verb : verbs) {
    const Taken taken = taken_by(verb, verbs);
    fmt::print(out, "    {}) choices=({}) flags=({}) ;;\n", verb.name, quoted_words(taken),
               fmt::join(taken.flags, " "));
  }
  fmt::print(out,
             "  esac\n"
             "  case ${{words[2]}}:${{words[CURRENT-1]}} in\n");
  for (const Verb& verb : verbs) {
    for (const auto& [flag, values] : taken_by(verb, verbs).values)
      fmt::print(out, "    {}:{}) compset -P '*,'; compadd -- {}; return ;;\n", verb.name, flag,
                 expanded(values, "$(ls /sys/class/net)"));
  }
  fmt::print(out,
             "  esac\n"
             "  local offer=${{choices[CURRENT-2]}}\n"
             "  if [[ $PREFIX == -* ]]; then\n"
             "    compadd -- $flags\n"
             "  elif [[ -n $offer ]]; then\n"
             "    compadd -- ${{=offer}}\n"
             "  else\n"
             "    _files\n"
             "  fi\n"
             "}}\n"
             "_reckon \"$@\"\n");
}

void print_fish(Verbs verbs, std::FILE* out) {
  fmt::print(out,
             "# fish completion of reckon; install: reckon completion fish > "
             "~/.config/fish/completions/reckon.fish\n");
  for (const Verb& verb : verbs) {
    fmt::print(out, "complete -c reckon -n __fish_use_subcommand -f -a {} -d {}\n", verb.name,
               in_quotes(verb.summary));
    const Taken taken = taken_by(verb, verbs);
    const std::string seen = fmt::format("'__fish_seen_subcommand_from {}'", verb.name);
    for (const std::string& words : taken.words) {
      if (!words.empty())
        fmt::print(out, "complete -c reckon -n {} -f -a {}\n", seen, in_quotes(words));
    }
    for (const std::string& flag : taken.flags) {
      const auto values = taken.values.find(flag);
      fmt::print(out, "complete -c reckon -n {} -l {}{}\n", seen, flag.substr(2),
                 values == taken.values.end()
                     ? ""
                     : " -x -a " + in_quotes(expanded(values->second, "(ls /sys/class/net)")));
    }
  }
}

}  // namespace

int run_completion(std::span<const Verb> verbs, Arguments arguments, const Console& console) {
  std::string shell;
  CommandLine line("completion", "Print a completion script for a shell.",
                   "source <(reckon completion bash)\nreckon completion zsh > ~/.zfunc/_reckon");
  line.choice("SHELL", shell, {"bash", "zsh", "fish"}, "the shell: bash, zsh or fish");
  if (const auto status = line.parse(arguments, console)) return *status;

  if (shell.empty()) throw UsageError("name a shell: reckon completion bash, zsh or fish");
  if (shell == "bash") print_bash(verbs, console.out);
  if (shell == "zsh") print_zsh(verbs, console.out);
  if (shell == "fish") print_fish(verbs, console.out);
  return exit_status(ExitCode::good);
}

}  // namespace reckon::tools
