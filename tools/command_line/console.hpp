// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Interface of a verb of the program `reckon`, its streams and exit codes, and the errors that end
// it. The base of tools/: all rooms may include it, and it includes none of them.
#pragma once

#include <atomic>
#include <cstdio>
#include <functional>
#include <span>
#include <stdexcept>
#include <string_view>

namespace reckon::tools {

/// Exit status of the program, for scripts.
enum class ExitCode : int {
  good = 0,         ///< Done; also after Ctrl-C or SIGTERM.
  findings = 1,     ///< A check has findings, or the input was damaged and the result is partial.
  usage = 2,        ///< Wrong usage, or a file that cannot be read.
  environment = 3,  ///< Network or device cannot be used.
  internal = 4,     ///< An internal fault.
};

/// Meaning of an exit status, for help and manual page.
struct ExitMeaning {
  ExitCode code;
  std::string_view meaning;
};
[[nodiscard]] std::span<const ExitMeaning> exit_meanings();

/// The streams of one call and its stop signal; tests pass their own.
struct Console {
  std::FILE* out = stdout;  ///< Data only.
  std::FILE* err = stderr;  ///< Everything else: progress, warnings, errors.
  bool colour = false;      ///< Whether `out` accepts colour: a terminal, and NO_COLOR is not set.
  const std::atomic<bool>* stop = nullptr;  ///< True once the user asked to end (Ctrl-C, SIGTERM).

  /// Whether the verb should end: the user asked for it, or `out` has no reader any more.
  [[nodiscard]] bool stopped() const {
    return (stop != nullptr && stop->load(std::memory_order_relaxed)) || std::ferror(out) != 0;
  }
};

/// The words after the verb.
using Arguments = std::span<const std::string_view>;

/// One verb of the program.
struct Verb {
  std::string_view name;
  std::string_view summary;  ///< One line, shown by `reckon help`.
  /// Runs the verb and returns the exit status (an ExitCode). May throw UsageError,
  /// EnvironmentError, std::system_error (reported as an environment fault); anything else is
  /// reported as internal.
  std::function<int(Arguments arguments, const Console& console)> run;
  std::string_view program = {};  ///< Program of the verb, which `run` starts; empty: this one.
};

/// Wrong usage or an unreadable file: reported on stderr, exit 2. The text names the value and the
/// remedy.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Network or device cannot be used: reported on stderr, exit 3. The text names the remedy.
struct EnvironmentError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Number of an exit code, for `return` in a run function.
[[nodiscard]] constexpr int exit_status(ExitCode code) { return static_cast<int>(code); }

}  // namespace reckon::tools
