// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/command_line/verb_program.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <new>
#include <system_error>
#include <vector>

#include "reckon/peer/notation/nearest_word.hpp"
#include "reckon/tools/command_line/version.hpp"
#include "reckon/tools/terminal/foreign_text.hpp"

namespace reckon::tools {
namespace {

int dispatch(const VerbProgram& program, Arguments arguments, const Console& console) {
  if (arguments.empty()) {
    print_overview(program, console.err);
    return exit_status(ExitCode::usage);
  }
  const std::string_view first = arguments.front();
  if (first == "--help" || first == "-h") {
    print_overview(program, console.out);
    return exit_status(ExitCode::good);
  }
  if (first == "--version") {
    fmt::print(console.out, "{} {}\n", program.name, program_version());
    return exit_status(ExitCode::good);
  }
  const Verb* verb = find_verb(program, first);
  if (verb != nullptr && program.around != nullptr)
    return program.around(*verb, arguments.subspan(1), console);
  if (verb != nullptr) return verb->run(arguments.subspan(1), console);
  if (program.run_other) {
    if (const auto status = program.run_other(arguments, console)) return *status;
  }
  return refuse_verb(program, first, console);
}

int report_error(const Console& console, Arguments arguments, const std::exception& error,
                 ExitCode code) {
  const std::string_view verb = arguments.empty() ? std::string_view{} : arguments.front();
  std::string_view text = error.what();
  while (text.ends_with('\n')) text.remove_suffix(1);
  std::fprintf(console.err, "reckon %.*s: %s%s\n", static_cast<int>(verb.size()), verb.data(),
               code == ExitCode::internal ? "internal fault: " : "", clean_lines(text).c_str());
  return exit_status(code);
}

// This function does not allocate.
int out_of_memory(const Console& console, Arguments arguments) {
  const std::string_view verb = arguments.empty() ? std::string_view{} : arguments.front();
  const auto length = static_cast<int>(verb.size());
  rlimit room{};
  const bool limited = getrlimit(RLIMIT_AS, &room) == 0 && room.rlim_cur != RLIM_INFINITY;
  if (limited) {
    std::fprintf(console.err,
                 "reckon %.*s: ulimit -v leaves only %llu KiB of address space, but tables reserve "
                 "their full size and use memory as they fill: raise it (ulimit -v unlimited) and "
                 "limit memory itself instead (MemoryMax of systemd, docker run --memory)\n",
                 length, verb.data(), static_cast<unsigned long long>(room.rlim_cur / 1024));
  } else {
    std::fprintf(console.err,
                 "reckon %.*s: out of memory (see free -m, and the container's limit in "
                 "memory.max): end other programs, or raise the container's limit\n",
                 length, verb.data());
  }
  return exit_status(ExitCode::environment);
}

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

extern "C" void request_stop(int) { stop_requested.store(true, std::memory_order_relaxed); }

// Ctrl-C, SIGTERM and a closed terminal end a verb in an orderly way; a second signal ends it at
// once. A closed pipe causes a write error.
void take_signals() {
  struct sigaction action = {};
  action.sa_handler = request_stop;
  action.sa_flags = SA_RESETHAND;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction hang_up = {};
  sigaction(SIGHUP, nullptr, &hang_up);
  if (hang_up.sa_handler != SIG_IGN)
    sigaction(SIGHUP, &action, nullptr);  // stays ignored under nohup
  std::signal(SIGPIPE, SIG_IGN);
}

bool takes_colour() {
  const char* no_colour = std::getenv("NO_COLOR");
  return (no_colour == nullptr || *no_colour == '\0') && isatty(STDOUT_FILENO) == 1;
}

}  // namespace

const Verb* find_verb(const VerbProgram& program, std::string_view name) {
  const auto found = std::ranges::find(program.verbs, name, &Verb::name);
  return found == program.verbs.end() ? nullptr : &*found;
}

void print_overview(const VerbProgram& program, std::FILE* out) {
  fmt::print(out, "{}\n\nusage: {} VERB [ARGUMENTS]\n", program.title, program.name);
  if (program.run_other)
    fmt::print(out, "       {} FILE    inspect a capture, or run the demo with a scene or a mesh\n",
               program.name);
  fmt::print(out, "\n");
  for (const Verb& verb : program.verbs) fmt::print(out, "  {:<11} {}\n", verb.name, verb.summary);
  fmt::print(out,
             "\n`{} VERB --help` shows the options of a verb, with examples.\n"
             "Data goes to stdout, everything else to stderr. Exit status:\n",
             program.name);
  for (const ExitMeaning& row : exit_meanings())
    fmt::print(out, "  {} {}\n", exit_status(row.code), row.meaning);
}

int refuse_verb(const VerbProgram& program, std::string_view name, const Console& console) {
  std::vector<std::string_view> names;
  for (const Verb& verb : program.verbs) names.push_back(verb.name);
  const bool is_flag = name.starts_with('-');
  if (is_flag) names = {"--help", "--version"};
  const std::string_view nearest = peer::nearest_word(name, names);
  const bool is_path =
      !is_flag && program.run_other && name.find_first_of("./") != std::string_view::npos;
  fmt::print(console.err, "reckon: there is no {} '{}'",
             is_flag   ? "flag"
             : is_path ? "file"
                       : "verb",
             name);
  if (!nearest.empty()) fmt::print(console.err, "; did you mean '{}'?", nearest);
  fmt::print(console.err, "\n`{} --help` lists the verbs.\n", program.name);
  return exit_status(ExitCode::usage);
}

int run_verb_program(const VerbProgram& program, Arguments arguments,
                     const Console& console) noexcept {
  try {
    const int status = dispatch(program, arguments, console);
    errno = 0;
    if (std::fflush(console.out) != 0 && errno != EPIPE)
      throw std::system_error(errno, std::generic_category(), "writing the output");
    return status;
  } catch (const UsageError& error) {
    return report_error(console, arguments, error, ExitCode::usage);
  } catch (const EnvironmentError& error) {
    return report_error(console, arguments, error, ExitCode::environment);
  } catch (const std::system_error& error) {
    // The reader has closed the pipe, as with `| head`: this is no error.
    if (error.code() == std::errc::broken_pipe) return exit_status(ExitCode::good);
    // Ctrl-C while a slow reader blocked the output.
    const bool asked = console.stop != nullptr && console.stop->load(std::memory_order_relaxed);
    if (asked && error.code() == std::errc::interrupted) return exit_status(ExitCode::good);
    if (std::ferror(console.out) != 0)
      return report_error(console, arguments, std::system_error(error.code(), "writing the output"),
                          ExitCode::environment);
    return report_error(console, arguments, error, ExitCode::environment);
  } catch (const std::bad_alloc&) {
    return out_of_memory(console, arguments);
  } catch (const std::exception& error) {
    return report_error(console, arguments, error, ExitCode::internal);
  }
}

int run_process(int argc, char** argv,
                int (*run)(Arguments arguments, const Console& console) noexcept) {
  take_signals();
  Console console;
  console.colour = takes_colour();
  console.stop = &stop_requested;
  const std::vector<std::string_view> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  return run(arguments, console);
}

}  // namespace reckon::tools
