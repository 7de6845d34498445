// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The flags of one verb. They are declared once; parsing, checks, `--help` and shell completion use
// the declaration.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {

/// Flags and words of one verb. Targets must outlive parse(). An option that is not given keeps the
/// value of its target.
///
///     CommandLine line("demo", "Two peers on loopback.", "reckon demo --for 10s --json");
///     line.flag("--json", options.json, "one JSON object per line");
///     line.option("--for", options.duration, "end by itself after this time");
///     if (const auto status = line.parse(arguments, console)) return *status;
class CommandLine {
 public:
  /// @param verb as typed after `reckon` ("scene check" for a word below a verb)
  /// @param examples one command a line
  CommandLine(std::string_view verb, std::string_view summary, std::string_view examples);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// A switch: "--json" or "-j,--json".
  void flag(const std::string& name, bool& target, const std::string& help);
  /// A switch that may have a value behind "=": --view or --view=9000; "true" if it has none.
  void flag(const std::string& name, std::string& target, const std::string& help);

  /// Options with a value. Durations have a unit ("10s", "5 ms"; without one: seconds). A number
  /// must be the whole word.
  void option(const std::string& name, std::string& target, const std::string& help);
  void option(const std::string& name, std::vector<std::string>& target, const std::string& help);
  void option(const std::string& name, std::optional<std::chrono::nanoseconds>& target,
              const std::string& help);
  void option(const std::string& name, std::chrono::nanoseconds& target, const std::string& help);
  void option(const std::string& name, std::uint64_t& target, const std::string& help);
  void option(const std::string& name, std::optional<std::uint64_t>& target,
              const std::string& help);
  void option(const std::string& name, double& target, const std::string& help);
  /// An option with two values. @param values their names, as in "CERT KEY"
  void option(const std::string& name, std::pair<std::string, std::string>& target,
              const std::string& help, const std::string& values);
  /// An option with one of a few words.
  void choice(const std::string& name, std::string& target, const std::vector<std::string>& words,
              const std::string& help);

  /// Values that completion offers for an option or a word; others are accepted too.
  /// @param values names with commas or blanks between them, or kInterfaces
  void offer(const std::string& name, std::string_view values);

  /// Words without a dash, in the order of declaration.
  void word(const std::string& name, std::string& target, bool required, const std::string& help);
  void words(const std::string& name, std::vector<std::string>& target, bool required,
             const std::string& help);

  /// Flags declared from here on belong only to this word below the verb, or to these, separated by
  /// blanks; empty: to all. `--help` shows them in a group, and after the word only its own.
  void only_for(std::string_view word);
  /// After parse(): @throws UsageError for the first given flag that belongs to another word.
  void check_for(std::string_view word) const;

  /// After parse(): the flags and words that were given, as declared ("--json", "FILE").
  [[nodiscard]] std::vector<std::string> given() const;

  /// Fills the targets. Returns nothing if the verb should continue, else the exit status: 0 after
  /// `--help` (shown on out), 2 for wrong usage (reported on err, with the nearest flag or word for
  /// a mistyped one).
  [[nodiscard]] std::optional<int> parse(Arguments arguments, const Console& console);

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

/// Offers the network interfaces of the host, determined at completion, instead of fixed values.
inline constexpr std::string_view kInterfaces = "@interfaces";

/// Flag that makes a verb list its flags and words on out, one a line followed by its choices, for
/// the completion scripts.
inline constexpr std::string_view kListFlags = "--list-flags";

/// Flag that makes a verb write its section of the manual page on out.
inline constexpr std::string_view kManualSection = "--manual-section";

}  // namespace reckon::tools
