// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "reckon/bench/studies/force/force_study.hpp"
#include "reckon/bench/studies/tracks/track_file.hpp"
#include "reckon/bench/studies/tune/options.hpp"
#include "reckon/bench/studies/tune/report.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tools/command_line/output_file.hpp"
#include "reckon/tools/command_line/scene_folder.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"
#include "reckon/tools/exercise/scene_options.hpp"

namespace reckon::bench {
namespace {

constexpr std::string_view kSummary =
    "Says which model and threshold of dead reckoning suit recorded motion: the curve of bandwidth "
    "against error, its knee, and lines for a scene file.\n\n"
    "FILE is a CSV table with a header (t_s, id, x_m y_m z_m or lat_deg lon_deg, and rates where "
    "it "
    "has them) or a capture. Errors are those that a peer shows at the samples' times. Exit status "
    "1 where no setting reaches --error or --budget, for a damaged capture, and where hands never "
    "touched.";
constexpr std::string_view kExamples =
    "reckon tune tracks.csv\n"
    "reckon tune tracks.csv --error 0.5m --plot curve.svg\n"
    "reckon tune exercise.pcapng --budget 10kB/s\n"
    "reckon tune tracks.csv --delay 80ms --jitter 40% --loss 10% --json\n"
    "reckon tune --force touch.csv --columns fx_N,fy_N,fz_N\n"
    "reckon tune --force two_hands.toml --for 60s --delay 20ms";

constexpr std::array kWebers{0.05, 0.1, 0.2};

constexpr const char* kNothingDrawn =
    "--seed: nothing is drawn here; give --jitter or --loss, or leave --seed out";

void write_plot(const std::string& path, const std::string& text) {
  if (path.empty()) return;
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file)
    throw tools::UsageError(fmt::format("{} could not be written whole; is the disk full?", path));
}

Advice advice_of(const TuneTable& table, const TuneGoal& goal) {
  const auto row = [&](const std::optional<std::size_t>& place) {
    return place ? &table.rows[*place] : nullptr;
  };
  if (goal.error) {
    const TuneRow* found = row(cheapest_within(table.rows, *goal.error));
    if (found != nullptr)
      return {found, fmt::format("the cheapest whose p99 error is within {:g} m", *goal.error)};
    const TuneRow* best = row(best_within(table.rows, std::numeric_limits<double>::infinity()));
    return {nullptr,
            fmt::format("No setting keeps the p99 error within {:g} m; the best is {:.3g} m. "
                        "Samples that follow each other more closely would help.",
                        *goal.error, best->error())};
  }
  if (goal.packets_per_s) {
    const TuneRow* found = row(best_within(table.rows, *goal.packets_per_s));
    if (found != nullptr)
      return {found, fmt::format("the most accurate within {:.4g} packets/s", *goal.packets_per_s)};
    return {nullptr,
            fmt::format("No setting keeps within {:.4g} packets/s; give wider --thresholds or "
                        "a longer --heartbeat.",
                        *goal.packets_per_s)};
  }
  if (table.knee) return {row(table.knee), "the knee of the curve"};
  const auto price = price_of_half(table.rows);
  return {nullptr,
          fmt::format("The curve has no knee{}. Say what you need with --error or --budget.",
                      price ? fmt::format(": all along, half the error costs some {:.2g} times the "
                                          "packets",
                                          *price)
                            : "")};
}

/// A line on stderr that counts, where a person looks on.
auto progress_on(const tools::Console& console, bool& stopped) {
  const bool shown = isatty(fileno(console.err)) == 1;
  return [&console, &stopped, shown](std::size_t done, std::size_t all) {
    if (shown) fmt::print(console.err, "\r{} of {} settings\x1b[K", done, all);
    stopped = console.stopped();
    return !stopped;
  };
}

int tune_motion(const TuneWords& words, const tools::Console& console) {
  const TuneGoal goal = goal_of(words);
  if (words.seed && words.jitter.empty() && words.loss.empty())
    throw tools::UsageError(kNothingDrawn);
  if (words.file.empty())
    throw tools::UsageError("which FILE? Name a CSV table of motion or a capture");
  const TrackFile file = read_track_file(words.file);
  const TrackSummary summary = summary_of(file.tracks);
  if (!(summary.interval > 0))
    throw tools::UsageError(
        fmt::format("{}: no entity has two samples, so nothing can be foretold", words.file));
  const TuneOptions options = options_of(words, goal, summary.step, file.has_orientation);
  tools::check_writable(words.plot);
  bool stopped = false;
  const TuneTable table = tune(file.tracks, options, progress_on(console, stopped));
  if (isatty(fileno(console.err)) == 1) fmt::print(console.err, "\r\x1b[K");
  if (stopped) {
    fmt::print(console.err, "stopped before the end: no table\n");
    return tools::exit_status(tools::ExitCode::good);
  }
  const TuneReport report{file, summary, options, table, advice_of(table, goal)};
  fmt::print(console.out, "{}",
             words.json  ? tune_json(report)
             : words.csv ? tune_csv(report)
                         : tune_text(report, words.all));
  write_plot(words.plot, tune_svg(report));
  const bool missed = report.advice.row == nullptr && (goal.error || goal.packets_per_s);
  return tools::exit_status(missed || file.damaged ? tools::ExitCode::findings
                                                   : tools::ExitCode::good);
}

/// What is tuned: motion, a signal of force, or hands of a scene in contact.
bool is_contact(const TuneWords& words) {
  return words.force && (words.file.empty() || words.file.ends_with(".toml"));
}

/// THE list of flags that not all three look at.
void check_flags(const TuneWords& words, std::span<const std::string> given) {
  struct FlagUse {
    std::string_view flag;
    bool motion, signal, contact;
  };
  static constexpr std::array kUses{
      FlagUse{"--error", true, false, false},   FlagUse{"--budget", true, false, false},
      FlagUse{"--models", true, false, false},  FlagUse{"--thresholds", true, false, false},
      FlagUse{"--angle", true, false, false},   FlagUse{"--heartbeat", true, false, false},
      FlagUse{"--plot", true, false, false},    FlagUse{"--all", true, false, false},
      FlagUse{"--delay", true, false, true},    FlagUse{"--jitter", true, false, true},
      FlagUse{"--loss", true, false, true},     FlagUse{"--seed", true, false, true},
      FlagUse{"--columns", false, true, false}, FlagUse{"--floor", false, true, false},
      FlagUse{"--for", false, false, true},
  };
  const bool contact = is_contact(words), signal = words.force && !contact;
  for (const std::string& flag : given) {
    const auto* use = std::ranges::find(kUses, std::string_view(flag), &FlagUse::flag);
    if (use == kUses.end() || (contact ? use->contact : signal ? use->signal : use->motion))
      continue;
    throw tools::UsageError(fmt::format(
        "{} is for {}", flag,
        !words.force                   ? "forces; add --force"
        : use->motion && !use->contact ? "motion; leave it out with --force"
        : contact                      ? "a recorded force; leave it out with a scene"
                  : "motion and for hands of a scene; leave it out with --force and a table"));
  }
  if (words.all && (words.json || words.csv))
    throw tools::UsageError(
        "--all is for the table; --json and --csv have every row: leave --all out");
  if (!words.jitter.empty() && (!words.delay || words.delay->count() == 0))
    throw tools::UsageError(
        "--jitter is a share of --delay, which is 0; write --delay 80ms --jitter 40%");
}

/// The scene's network, changed as asked.
void impair(const TuneWords& words, peer::ImpairmentConfig& network) {
  peer::ImpairmentLaw& law = network.law;
  const auto share = [](std::string_view flag, const std::string& text, double fallback) {
    return quantity_of(flag, text, "", 0, 1, fallback);
  };
  if (words.delay) {
    law.delay = *words.delay;
    law.jitter =
        pdu::from_seconds(share("--jitter", words.jitter, 0) * pdu::to_seconds(*words.delay));
  }
  law.loss = share("--loss", words.loss, law.loss);
  if (words.seed && !tools::draws_by_seed(law)) throw tools::UsageError(kNothingDrawn);
  network.seed = words.seed.value_or(network.seed);
}

int tune_force(const TuneWords& words, const tools::Console& console) {
  const bool contact = is_contact(words);
  std::vector<ForceRow> rows;
  if (contact) {
    tools::SceneOptions options;
    options.scene = words.file;
    const double seconds = pdu::to_seconds(words.span);
    if (!(seconds >= 1 && seconds <= 3600)) throw tools::UsageError("--for: give 1s to 1h");
    peer::SceneFile scene = tools::load_scene(options, "two_hands.toml", 2);
    impair(words, scene.impairment);
    rows = force_model_rows(scene, kForceThresholds, seconds);
  } else {
    const std::vector<std::string> columns = list_of(words.columns);
    if (columns.size() > 3)
      throw tools::UsageError("--columns: more than three; give one to three");
    const double floor =
        quantity_of("--floor", words.floor, columns.empty() ? "N" : "", 0, 1e9, 0.05);
    rows = force_signal_rows(read_force_signal(words.file, columns), kWebers, floor);
  }
  fmt::print(console.out, "{}",
             words.json  ? force_json(rows)
             : words.csv ? force_csv(rows)
                         : force_text(rows, contact));
  if (!contact || std::ranges::any_of(rows, &ForceRow::samples))
    return tools::exit_status(tools::ExitCode::good);
  fmt::print(
      console.err,
      "the hands never touched, so there is no error to tell; give a longer --for, a shorter "
      "--delay, or operators whose ways meet\n");
  return tools::exit_status(tools::ExitCode::findings);
}

int run_tune(tools::Arguments arguments, const tools::Console& console) {
  TuneWords words;
  tools::CommandLine line("tune", kSummary, kExamples);
  words.declare(line);
  if (const auto status = line.parse(arguments, console)) return *status;
  if (words.json && words.csv)
    throw tools::UsageError("--json and --csv are two formats; give one of them");
  check_flags(words, line.given());
  return words.force ? tune_force(words, console) : tune_motion(words, console);
}

}  // namespace

namespace verb {

tools::Verb tune() { return tools::verb_of(tools::verb_row("tune"), run_tune); }

}  // namespace verb

}  // namespace reckon::bench
