// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <exception>
#include <system_error>
#include <vector>

#include "reckon/peer/scene/nearest_word.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/manual_page.hpp"
#include "reckon/tools/verbs/bench.hpp"
#include "reckon/tools/verbs/completion.hpp"
#include "reckon/tools/verbs/cut.hpp"
#include "reckon/tools/verbs/demo.hpp"
#include "reckon/tools/verbs/doctor.hpp"
#include "reckon/tools/verbs/info.hpp"
#include "reckon/tools/verbs/inspect.hpp"
#include "reckon/tools/verbs/peer.hpp"
#include "reckon/tools/verbs/record.hpp"
#include "reckon/tools/verbs/replay.hpp"
#include "reckon/tools/verbs/scene.hpp"
#include "reckon/tools/verbs/tune.hpp"

namespace reckon::tools {
namespace {

int run_help(Arguments arguments, const Console& console);

/// THE list of verbs, in the order of help.
constexpr std::array kVerbs{
    Verb{"demo", "two peers on loopback whose hands touch; prints what it cost", run_demo},
    Verb{"peer", "one peer on a LAN", run_peer},
    Verb{"inspect", "show every PDU of every datagram, from a capture or live", run_inspect},
    Verb{"record", "write live datagrams to a capture", run_record},
    Verb{"replay", "send a capture again, at its own speed or another", run_replay},
    Verb{"info", "say what a capture holds", run_info},
    Verb{"cut", "write a part of a capture as a new one", run_cut},
    Verb{"scene", "check a scene file, or explain what runs for it", run_scene},
    Verb{"tune", "say which model and threshold suit recorded motion", run_tune},
    Verb{"doctor", "say what is wrong with this host and how to mend it", run_doctor},
    Verb{"bench", "the studies: what accuracy costs", run_bench},
    Verb{"completion", "print a completion script for a shell", run_completion},
    Verb{"help", "show the verbs, or what one verb takes", run_help},
};

constexpr std::array kExitMeanings{
    ExitMeaning{ExitCode::good, "good, also after Ctrl-C"},
    ExitMeaning{ExitCode::findings, "findings, or damaged input"},
    ExitMeaning{ExitCode::usage, "wrong usage, or a file that cannot be read"},
    ExitMeaning{ExitCode::environment, "network or device not usable"},
    ExitMeaning{ExitCode::internal, "a fault of the program"},
};

const Verb* find_verb(std::string_view name) {
  const auto* found =
      std::find_if(kVerbs.begin(), kVerbs.end(), [&](const Verb& v) { return v.name == name; });
  return found == kVerbs.end() ? nullptr : found;
}

void print_overview(std::FILE* out) {
  fmt::print(out,
             "Reckon: worlds that people touch together, peer to peer.\n\n"
             "usage: reckon VERB [ARGUMENTS]\n\n");
  for (const Verb& verb : kVerbs) fmt::print(out, "  {:<11} {}\n", verb.name, verb.summary);
  fmt::print(out,
             "\n`reckon VERB --help` shows what a verb takes, with examples.\n"
             "Data goes to stdout, everything else to stderr. Exit status:\n");
  for (const ExitMeaning& row : kExitMeanings)
    fmt::print(out, "  {} {}\n", exit_status(row.code), row.meaning);
}

int unknown_verb(std::string_view name, const Console& console) {
  std::vector<std::string_view> names;
  for (const Verb& verb : kVerbs) names.push_back(verb.name);
  const bool is_flag = name.starts_with('-');
  if (is_flag) names = {"--help", "--version"};
  const std::string_view nearest = peer::nearest_word(name, names);
  fmt::print(console.err, "reckon: there is no {} '{}'", is_flag ? "flag" : "verb", name);
  if (!nearest.empty()) fmt::print(console.err, "; did you mean '{}'?", nearest);
  fmt::print(console.err, "\n`reckon help` lists the verbs.\n");
  return exit_status(ExitCode::usage);
}

int run_help(Arguments arguments, const Console& console) {
  std::string name;
  bool manual = false;
  CommandLine line("help", "Show the verbs, or what one verb takes.",
                   "reckon help\nreckon help inspect\nreckon help rules\n"
                   "reckon help --man | man -l -");
  line.word("VERB", name, false, "the verb to explain; rules: those of `inspect check`");
  line.flag("--man", manual, "write the manual page of all verbs, for man -l");
  if (const auto status = line.parse(arguments, console)) return *status;

  if (manual) {
    print_manual_page(kVerbs, console.out);
    return exit_status(ExitCode::good);
  }
  if (name.empty()) {
    print_overview(console.out);
    return exit_status(ExitCode::good);
  }
  if (name == "rules") return run_inspect(std::array<std::string_view, 1>{"--rules"}, console);
  const Verb* verb = find_verb(name);
  if (verb == nullptr) return unknown_verb(name, console);
  const std::array<std::string_view, 1> help{"--help"};
  return verb->run(help, console);
}

int dispatch(Arguments arguments, const Console& console) {
  if (arguments.empty()) {
    print_overview(console.err);
    return exit_status(ExitCode::usage);
  }
  const std::string_view first = arguments.front();
  if (first == "--help" || first == "-h") {
    print_overview(console.out);
    return exit_status(ExitCode::good);
  }
  if (first == "--version") {
    fmt::print(console.out, "reckon {}\n", RECKON_VERSION);
    return exit_status(ExitCode::good);
  }
  const Verb* verb = find_verb(first);
  return verb != nullptr ? verb->run(arguments.subspan(1), console) : unknown_verb(first, console);
}

int told(const Console& console, Arguments arguments, const std::exception& error, ExitCode code) {
  const std::string_view verb = arguments.empty() ? std::string_view{} : arguments.front();
  std::string_view text = error.what();
  while (text.ends_with('\n')) text.remove_suffix(1);
  std::fprintf(console.err, "reckon %.*s: %s%.*s\n", static_cast<int>(verb.size()), verb.data(),
               code == ExitCode::internal ? "internal fault: " : "", static_cast<int>(text.size()),
               text.data());
  return exit_status(code);
}

}  // namespace

std::span<const Verb> verbs() { return kVerbs; }

std::span<const ExitMeaning> exit_meanings() { return kExitMeanings; }

int run_program(Arguments arguments, const Console& console) noexcept {
  try {
    const int status = dispatch(arguments, console);
    errno = 0;
    if (std::fflush(console.out) != 0 && errno != EPIPE)
      throw std::system_error(errno, std::generic_category(), "writing the output");
    return status;
  } catch (const UsageError& error) {
    return told(console, arguments, error, ExitCode::usage);
  } catch (const EnvironmentError& error) {
    return told(console, arguments, error, ExitCode::environment);
  } catch (const std::system_error& error) {
    // Nobody reads on, as behind `| head`: no fault of anybody.
    if (error.code() == std::errc::broken_pipe) return exit_status(ExitCode::good);
    return told(console, arguments, error, ExitCode::environment);
  } catch (const std::exception& error) {
    return told(console, arguments, error, ExitCode::internal);
  }
}

}  // namespace reckon::tools
