// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A study: its flags as rows, and a function that returns its output. The frame declares the flags,
// rejects flags that a run does not use, checks before the run that the files can be written, and
// writes them after it. The list of the studies of `reckon bench` is in verbs/bench.cpp.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"

namespace reckon::bench {

/// The words of the flags that several studies have, as typed.
struct SharedWords {
  std::vector<std::string> files;
  std::optional<std::chrono::nanoseconds> length, delay;
  std::string jitter, loss;  ///< shares
  std::optional<std::uint64_t> seed;
  std::string csv, plot, report;  ///< files to write
  bool json = false;

  [[nodiscard]] std::uint64_t first_seed() const { return seed.value_or(1); }
  /// Length of a motion, and of the study of latency.
  [[nodiscard]] std::chrono::nanoseconds span() const {
    return length.value_or(std::chrono::seconds(60));
  }
};

/// Destination of the value of a flag.
using FlagTarget =
    std::variant<bool*, std::string*, std::vector<std::string>*, std::chrono::nanoseconds*,
                 std::optional<std::chrono::nanoseconds>*, std::optional<std::uint64_t>*, double*>;

/// A row of a study's flags, or of its positional words if the name has no dashes.
struct Flag {
  Flag(std::string_view name_, FlagTarget target_, std::string help_, std::string offered_ = {})
      : Flag(name_, target_, ~0U, std::move(help_), std::move(offered_)) {}
  Flag(std::string_view name_, FlagTarget target_, unsigned modes_, std::string help_,
       std::string offered_ = {})
      : name(name_),
        target(target_),
        modes(modes_),
        help(std::move(help_)),
        offered(std::move(offered_)) {}

  std::string name;
  FlagTarget target;
  unsigned modes;  ///< one bit for each mode that uses it
  std::string help;
  std::string offered;  ///< values for shell completion
};

/// Output of a study.
struct StudyOutput {
  std::string out = {};  ///< tables and sentences, or JSON Lines
  /// Contents of the files for these flags; empty: no file is written.
  std::string csv = {}, plot = {}, page = {};
  std::string note = {};  ///< for err, after `out`
  tools::ExitCode code = tools::ExitCode::good;
  bool reports_files = true;  ///< on err
};

/// A call of a study.
struct StudyCall {
  std::vector<std::string> given;  ///< as CommandLine::given()
  std::string command;             ///< as typed
  const tools::Console& console;
};

/// Help of a study that is a verb by itself.
struct VerbText {
  std::string_view summary = {};
  std::string_view examples = {};  ///< one command a line
};

class Study {
 public:
  Study() = default;
  explicit Study(VerbText text) : verb_text(text) {}
  virtual ~Study() = default;
  Study(const Study&) = delete;
  Study& operator=(const Study&) = delete;

  /// Flags that only this study has, in the order of the help. The study owns their targets.
  virtual std::vector<Flag> flags() = 0;
  /// Runs the study with the given flags. @throws UsageError with the word and the remedy
  virtual StudyOutput run(const StudyCall& call) = 0;

  /// Destination of the shared flags.
  virtual SharedWords& shared() { return shared_; }

  VerbText verb_text;

 protected:
  SharedWords shared_;
};

/// A row of the list of studies.
struct StudyKind {
  std::string_view name, meaning;
  std::string_view shared;  ///< its flags that several studies have: --csv, --report, --delay
  std::string_view examples;
  std::unique_ptr<Study> (*make)();
};

void declare(tools::CommandLine& line, std::span<const Flag> flags);

/// Rejects the first given flag that has a row without the bit of `mode`. @throws UsageError
void check_modes(std::span<const Flag> flags, unsigned mode, std::span<const std::string> given,
                 const std::function<std::string(std::string_view flag)>& refusal);

/// Checks the files, runs the study, prints and writes its output. @return exit status
int run_study(Study& study, const StudyCall& call);

/// A verb for a single study: the study has all flags of the verb.
[[nodiscard]] tools::Verb study_verb(const tools::VerbRow& row, std::unique_ptr<Study> (*make)());

}  // namespace reckon::bench
