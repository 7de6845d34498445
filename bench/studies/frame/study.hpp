// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A study: its flags as rows, and a run that returns its output. The frame declares the flags,
// refuses those that a run does not use, checks before the run that the files can be written, and
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
  /// Of a motion, and of the study of latency.
  [[nodiscard]] std::chrono::nanoseconds span() const {
    return length.value_or(std::chrono::seconds(60));
  }
};

/// Where the value of a flag goes.
using FlagTarget =
    std::variant<bool*, std::string*, std::vector<std::string>*, std::chrono::nanoseconds*,
                 std::optional<std::chrono::nanoseconds>*, std::optional<std::uint64_t>*, double*>;

/// A row of a study's flags, or of its words where the name has no dashes.
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
  unsigned modes;  ///< a bit for each way to run that uses it
  std::string help;
  std::string offered;  ///< values that completion offers
};

/// Output of a study.
struct StudyOutput {
  std::string out = {};  ///< tables and sentences, or JSON Lines
  /// For the files of these flags; empty: nothing is written.
  std::string csv = {}, plot = {}, page = {};
  std::string note = {};  ///< for err, behind `out`
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

  /// Flags that no other study has, in the order of the help. Targets are the study's own.
  virtual std::vector<Flag> flags() = 0;
  /// Runs what the flags ask for. @throws UsageError with the word and the remedy
  virtual StudyOutput run(const StudyCall& call) = 0;

  /// What the shared flags are read into.
  virtual SharedWords& shared() { return shared_; }

  VerbText verb_text;

 protected:
  SharedWords shared_;
};

/// A row of the list of studies.
struct StudyKind {
  std::string_view name, meaning;
  std::string_view shared;  ///< flags of several studies that it has: --csv, --report, --delay
  std::string_view examples;
  std::unique_ptr<Study> (*make)();
};

void declare(tools::CommandLine& line, std::span<const Flag> flags);

/// Refuses the first given flag that has a row, but not the bit of `mode`. @throws UsageError
void check_modes(std::span<const Flag> flags, unsigned mode, std::span<const std::string> given,
                 const std::function<std::string(std::string_view flag)>& refusal);

/// Checks the files, runs the study, prints and writes what it gave. @return exit status
int run_study(Study& study, const StudyCall& call);

/// A study that is a verb by itself: its flags are all that the verb has.
[[nodiscard]] tools::Verb study_verb(const tools::VerbRow& row, std::unique_ptr<Study> (*make)());

}  // namespace reckon::bench
