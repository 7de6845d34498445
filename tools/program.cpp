// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/program.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <exception>
#include <new>
#include <system_error>
#include <vector>

#include "reckon/peer/scene/nearest_word.hpp"
#include "reckon/peer/tracks/csv_reader.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/manual_page.hpp"
#include "reckon/tools/command_line/version.hpp"
#include "reckon/tools/verbs/completion.hpp"

namespace reckon::tools {
namespace verb {

// One for each file of verbs/.
Verb demo();
Verb peer();
Verb inspect();
Verb record();
Verb replay();
Verb info();
Verb cut();
Verb scene();
Verb key();
Verb tune();
Verb doctor();
Verb bench();
Verb figures();
Verb zwidth();

}  // namespace verb

namespace {

int run_help(Arguments arguments, const Console& console);
int run_list_completion(Arguments arguments, const Console& console);

/// THE list of verbs, in the order of help. Two know the list itself, so that they stand here.
std::span<const Verb> list() {
  static const std::array kVerbs{
      verb::demo(),
      verb::peer(),
      verb::inspect(),
      verb::record(),
      verb::replay(),
      verb::info(),
      verb::cut(),
      verb::scene(),
      verb::key(),
      verb::tune(),
      verb::doctor(),
      verb::bench(),
      verb::figures(),
      verb::zwidth(),
      Verb{"completion", "print a completion script for a shell", run_list_completion},
      Verb{"help", "show the verbs, or what one verb takes", run_help},
  };
  return kVerbs;
}

const Verb* find_verb(std::string_view name) {
  const auto found = std::ranges::find(list(), name, &Verb::name);
  return found == list().end() ? nullptr : &*found;
}

void print_overview(std::FILE* out) {
  fmt::print(out,
             "Reckon: worlds that people touch together, peer to peer.\n\n"
             "usage: reckon VERB [ARGUMENTS]\n\n");
  for (const Verb& verb : list()) fmt::print(out, "  {:<11} {}\n", verb.name, verb.summary);
  fmt::print(out,
             "\n`reckon VERB --help` shows what a verb takes, with examples.\n"
             "Data goes to stdout, everything else to stderr. Exit status:\n");
  for (const ExitMeaning& row : exit_meanings())
    fmt::print(out, "  {} {}\n", exit_status(row.code), row.meaning);
}

int unknown_verb(std::string_view name, const Console& console) {
  std::vector<std::string_view> names;
  for (const Verb& verb : list()) names.push_back(verb.name);
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
    print_manual_page(list(), console.out);
    return exit_status(ExitCode::good);
  }
  if (name.empty()) {
    print_overview(console.out);
    return exit_status(ExitCode::good);
  }
  if (name == "rules")
    return verb::inspect().run(std::array<std::string_view, 1>{"--rules"}, console);
  const Verb* verb = find_verb(name);
  if (verb == nullptr) return unknown_verb(name, console);
  const std::array<std::string_view, 1> help{"--help"};
  return verb->run(help, console);
}

int run_list_completion(Arguments arguments, const Console& console) {
  return run_completion(list(), arguments, console);
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
    fmt::print(console.out, "reckon {}\n", program_version());
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

// Nothing is allocated here.
int out_of_memory(const Console& console, Arguments arguments) {
  const std::string_view verb = arguments.empty() ? std::string_view{} : arguments.front();
  const auto length = static_cast<int>(verb.size());
  rlimit room{};
  const bool limited = getrlimit(RLIMIT_AS, &room) == 0 && room.rlim_cur != RLIM_INFINITY;
  if (limited) {
    std::fprintf(
        console.err,
        "reckon %.*s: the %llu KiB of address space that ulimit -v leaves are too few, for "
        "tables are reserved whole and take memory as they fill: raise it (ulimit -v "
        "unlimited) and bound memory itself instead (MemoryMax of systemd, docker run "
        "--memory)\n",
        length, verb.data(), static_cast<unsigned long long>(room.rlim_cur / 1024));
  } else {
    std::fprintf(
        console.err,
        "reckon %.*s: there is no memory left (see free -m, and the limit of the container "
        "in memory.max): end other programs, or give the container more\n",
        length, verb.data());
  }
  return exit_status(ExitCode::environment);
}

}  // namespace

std::span<const Verb> verbs() { return list(); }

int run_program(Arguments arguments, const Console& console) noexcept {
  try {
    const int status = dispatch(arguments, console);
    errno = 0;
    if (std::fflush(console.out) != 0 && errno != EPIPE)
      throw std::system_error(errno, std::generic_category(), "writing the output");
    return status;
  } catch (const UsageError& error) {
    return told(console, arguments, error, ExitCode::usage);
  } catch (const peer::CsvError& error) {
    return told(console, arguments, error, ExitCode::usage);
  } catch (const EnvironmentError& error) {
    return told(console, arguments, error, ExitCode::environment);
  } catch (const std::system_error& error) {
    // Nobody reads on, as behind `| head`: no fault of anybody.
    if (error.code() == std::errc::broken_pipe) return exit_status(ExitCode::good);
    if (std::ferror(console.out) != 0)
      return told(console, arguments, std::system_error(error.code(), "writing the output"),
                  ExitCode::environment);
    return told(console, arguments, error, ExitCode::environment);
  } catch (const std::bad_alloc&) {
    return out_of_memory(console, arguments);
  } catch (const std::exception& error) {
    return told(console, arguments, error, ExitCode::internal);
  }
}

}  // namespace reckon::tools
