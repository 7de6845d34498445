// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon tune`: its flags, the settings to try, and the recommendation.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "reckon/bench/studies/frame/study.hpp"
#include "reckon/bench/studies/frame/study_watch.hpp"
#include "reckon/bench/studies/sweep/values.hpp"
#include "reckon/bench/studies/tune/report.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/notation/nearest_word.hpp"
#include "reckon/peer/notation/units.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tools/command_line/scene_folder.hpp"
#include "reckon/tools/command_line/size_text.hpp"
#include "reckon/tools/exercise/scene_options.hpp"

namespace reckon::bench {
namespace {

constexpr std::string_view kSummary =
    "Finds the model and threshold of dead reckoning for recorded motion: the curve of bandwidth "
    "against error, its knee, and lines for a scene file.\n\n"
    "FILE is a CSV table with a header (t_s, id, x_m y_m z_m or lat_deg lon_deg, and optional "
    "rates) or a capture. Errors are those of the shown pose at the samples' times. Exit status 1 "
    "if no setting reaches --error or --budget, if the capture is damaged, or if hands never "
    "touched.";
constexpr std::string_view kExamples =
    "reckon tune scenes/truck_track.csv\n"
    "reckon tune scenes/truck_track.csv --error 0.5m --plot curve.svg\n"
    "reckon tune scenes/exercise.pcapng --budget 10kB/s\n"
    "reckon tune scenes/truck_track.csv --delay 80ms --jitter 40% --loss 10% --json\n"
    "reckon tune --force touch.csv --columns fx_N,fy_N,fz_N\n"
    "reckon tune --force scenes/two_hands.toml --for 60s --delay 20ms";

constexpr double kPi = std::numbers::pi;
constexpr double kLeastThreshold = 1e-6, kMostThreshold = 1e4;  // [m], as in scene files
constexpr double kThreeDegrees = 3 * kPi / 180;
constexpr std::size_t kMostThresholds = 100;

constexpr std::array kWebers{0.05, 0.1, 0.2};

constexpr const char* kNothingDrawn =
    "--seed: this run has no randomness; add --jitter or --loss, or remove --seed";

/// The subject, one bit of the flags each: motion, a force signal, the hands of a scene in contact.
constexpr unsigned kMotion = 1, kSignal = 2, kContact = 4;

struct TuneWords : SharedWords {
  std::string file, models, thresholds, angle, error, budget, columns, floor;
  std::chrono::nanoseconds heartbeat = std::chrono::seconds(5);
  bool force = false, all = false, as_csv = false;

  [[nodiscard]] unsigned mode() const {
    if (!force) return kMotion;
    return file.empty() || file.ends_with(".toml") ? kContact : kSignal;
  }
};

/// The goal; at most one member is set.
struct TuneGoal {
  std::optional<double> error;          ///< p99 [m]
  std::optional<double> packets_per_s;  ///< of all entities
};

/// Names separated by commas.
std::vector<std::string_view> list_of(std::string_view text) {
  std::vector<std::string_view> words = parts_between_commas(text);
  std::erase(words, std::string_view());
  return words;
}

/// `text` in `unit` between the bounds; `fallback` where it is empty.
double quantity_of(std::string_view flag, std::string_view text, std::string_view unit,
                   double least, double most, double fallback) {
  if (text.empty()) return fallback;
  const peer::Quantity quantity = peer::parse_quantity(text, unit);
  if (!quantity.good())
    throw tools::UsageError(fmt::format("{} {}: {}", flag, text, quantity.error));
  if (!(quantity.value >= least && quantity.value <= most))
    throw tools::UsageError(fmt::format("{} {}: out of range; write {} to {}", flag, text,
                                        peer::format_quantity(least, unit),
                                        peer::format_quantity(most, unit)));
  return quantity.value;
}

std::vector<PoseModel> models_of(const TuneWords& words) {
  if (words.models.empty()) return default_tune_models();
  std::vector<std::string_view> names;
  for (const PoseModel& model : tune_models()) names.push_back(model.name);
  std::vector<PoseModel> models;
  for (const std::string_view word : list_of(words.models)) {
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) {
      const std::string_view nearest = peer::nearest_word(word, names);
      throw tools::UsageError(
          fmt::format("--models {}: there is no such model{}; write some of {}", word,
                      nearest.empty() ? "" : fmt::format(", did you mean '{}'", nearest),
                      fmt::join(names, ",")));
    }
    const PoseModel& model = tune_models()[static_cast<std::size_t>(found - names.begin())];
    const auto same = [&](const PoseModel& other) { return other.name == model.name; };
    if (std::none_of(models.begin(), models.end(), same)) models.push_back(model);
  }
  return models;
}

std::vector<double> thresholds_of(const TuneWords& words, const TuneGoal& goal, double step) {
  std::vector<double> thresholds;
  for (const std::string_view word : list_of(words.thresholds))
    thresholds.push_back(
        quantity_of("--thresholds", word, "m", kLeastThreshold, kMostThreshold, 0));
  if (thresholds.empty()) {
    thresholds = threshold_ladder(step);
    // The requested goal may lie outside the thresholds that the data suggest.
    if (goal.error)
      for (const double share : {0.1, 0.2, 0.5, 0.8, 1.0})
        thresholds.push_back(std::clamp(share * *goal.error, kLeastThreshold, kMostThreshold));
  }
  std::sort(thresholds.begin(), thresholds.end());
  const auto same = [](double a, double b) { return b <= a * (1 + 1e-9); };
  thresholds.erase(std::unique(thresholds.begin(), thresholds.end(), same), thresholds.end());
  if (thresholds.size() > kMostThresholds)
    throw tools::UsageError(
        fmt::format("--thresholds: more than {}; write fewer", kMostThresholds));
  return thresholds;
}

TuneGoal goal_of(const TuneWords& words) {
  TuneGoal goal;
  if (!words.error.empty() && !words.budget.empty())
    throw tools::UsageError("--error and --budget are two goals; remove one of them");
  if (!words.error.empty()) goal.error = quantity_of("--error", words.error, "m", 1e-6, 1e5, 0);
  if (words.budget.empty()) return goal;
  constexpr std::string_view kSecond = "/s";
  std::string_view text = words.budget;
  if (text.ends_with(kSecond)) text.remove_suffix(kSecond.size());
  const peer::Quantity packets = peer::parse_quantity(text, "");
  const bool is_packets = packets.good() && text.find('%') == std::string_view::npos;
  if (is_packets && packets.value > 0) {
    goal.packets_per_s = packets.value;
  } else if (const auto octets = tools::parse_size(text)) {
    goal.packets_per_s = static_cast<double>(*octets) / kUpdateOctets;
  } else {
    throw tools::UsageError(
        fmt::format("--budget {}: not a rate; write octets a second, for example 10kB/s, or "
                    "packets, for example 40",
                    words.budget));
  }
  return goal;
}

/// @param step distance between samples [m], for the ladder @param has_orientation of the file
TuneOptions options_of(const TuneWords& words, const TuneGoal& goal, double step,
                       bool has_orientation) {
  TuneOptions options;
  options.models = models_of(words);
  options.drop_twins = words.models.empty();
  options.thresholds = thresholds_of(words, goal, step);
  options.angle = quantity_of("--angle", words.angle, "rad", kPi / 180e3, kPi,
                              has_orientation ? kThreeDegrees : kPi);
  options.heartbeat = pdu::to_seconds(words.heartbeat);
  if (!(options.heartbeat >= 0.1))
    throw tools::UsageError("--heartbeat is too short; write 100ms or more");
  options.network.law = peer::delayed_by(words.delay ? pdu::to_seconds(*words.delay) : 0,
                                         quantity_of("--jitter", words.jitter, "", 0, 1, 0),
                                         quantity_of("--loss", words.loss, "", 0, 0.99, 0));
  options.network.seed = words.seed.value_or(1);
  return options;
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
    return {nullptr, fmt::format("No setting keeps the p99 error within {:g} m; the best is {:.3g} "
                                 "m. Record more samples a second.",
                                 *goal.error, best->error())};
  }
  if (goal.packets_per_s) {
    const TuneRow* found = row(best_within(table.rows, *goal.packets_per_s));
    if (found != nullptr)
      return {found, fmt::format("the most accurate within {:.4g} packets/s", *goal.packets_per_s)};
    return {nullptr, fmt::format("No setting stays within {:.4g} packets/s; write larger "
                                 "--thresholds or a longer --heartbeat.",
                                 *goal.packets_per_s)};
  }
  if (table.knee) return {row(table.knee), "the knee of the curve"};
  const auto price = price_of_half(table.rows);
  return {
      nullptr,
      fmt::format(
          "The curve has no knee{}. Set a goal with --error or --budget.",
          price ? fmt::format(": everywhere, half the error costs about {:.2g} times the packets",
                              *price)
                : "")};
}

/// Rejects flags that exclude each other. @param given as CommandLine::given()
void check_words(const TuneWords& words, std::span<const Flag> flags,
                 std::span<const std::string> given) {
  if (words.json && words.as_csv)
    throw tools::UsageError("--json and --csv are two formats; remove one of them");
  check_modes(flags, words.mode(), given, [&](std::string_view flag) {
    const unsigned modes = std::ranges::find(flags, flag, &Flag::name)->modes;
    return fmt::format("{} is for {}", flag,
                       !words.force       ? "forces; add --force"
                       : modes == kMotion ? "motion; remove it with --force"
                       : words.mode() == kContact
                           ? "a recorded force; remove it with a scene"
                           : "motion and for hands of a scene; remove it with --force and a table");
  });
  if (words.all && (words.json || words.as_csv))
    throw tools::UsageError(
        "--all is for the table; --json and --csv have every row: remove --all");
  if (!words.jitter.empty() && (!words.delay || words.delay->count() == 0))
    throw tools::UsageError(
        "--jitter is a share of --delay, which is 0; write --delay 80ms --jitter 40%");
}

/// The scene's network with the requested changes.
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

std::vector<ForceRow> contact_rows(const TuneWords& words) {
  tools::SceneOptions options;
  options.scene = words.file;
  const double seconds = pdu::to_seconds(words.span());
  if (!(seconds >= 1 && seconds <= 3600)) throw tools::UsageError("--for: write 1s to 1h");
  peer::SceneFile scene = tools::load_scene(options, "two_hands.toml", 2);
  impair(words, scene.impairment);
  return force_model_rows(scene, kForceThresholds, seconds);
}

std::vector<ForceRow> signal_rows(const TuneWords& words) {
  const auto list = list_of(words.columns);
  const std::vector<std::string> columns(list.begin(), list.end());
  if (columns.size() > 3) throw tools::UsageError("--columns: more than three; write one to three");
  const double floor =
      quantity_of("--floor", words.floor, columns.empty() ? "N" : "", 0, 1e9, 0.05);
  return force_signal_rows(read_force_signal(words.file, columns), kWebers, floor);
}

class TuneStudy final : public Study {
 public:
  TuneStudy() : Study({kSummary, kExamples}) {}

  std::vector<Flag> flags() override {
    constexpr unsigned kNetworked = kMotion | kContact;
    TuneWords& w = words_;
    return {
        {"FILE", &w.file,
         "CSV table of motion or capture; with --force a CSV table of a force, or a scene file "
         "(default: two_hands.toml)"},
        {"--error", &w.error, kMotion,
         "find the cheapest setting with at most this p99 error, such as 0.5m"},
        {"--budget", &w.budget, kMotion,
         "find the most accurate setting within this: 10kB/s, or packets per second, such as 40"},
        {"--models", &w.models, kMotion,
         "models to try, such as auto,rvw; default: all that differ"},
        {"--thresholds", &w.thresholds, kMotion,
         "thresholds to try, such as 0.1m,0.5m,1m; default: 1-2-5 from 0.01 to 10 times the median "
         "distance between samples, or in 0.1s"},
        {"--angle", &w.angle, kMotion,
         "threshold of orientation; default 3deg if the file has orientations, else none"},
        {"--heartbeat", &w.heartbeat, kMotion, "longest time between two updates, default 5s"},
        {"--delay", &w.delay, kNetworked,
         "mean delay of the network, default none; with --force and a scene too"},
        {"--jitter", &w.jitter, kNetworked,
         "variation of the delay, as a share of --delay, such as 40%"},
        {"--loss", &w.loss, kNetworked, "share of lost updates, such as 10%"},
        {"--seed", &w.seed, kNetworked, "of delay and loss (1; with --force the scene's)"},
        {"--plot", &w.plot, kMotion, "write the curve to this SVG file"},
        {"--all", &w.all, kMotion,
         "print every row of the table, model by model, not only the front"},
        {"--force", &w.force, "tune a recorded force with a deadband, or the contacts of a scene"},
        {"--columns", &w.columns, kSignal, "with --force: one to three columns, such as fx_N,fy_N"},
        {"--floor", &w.floor, kSignal, "with --force: least difference that is sent, default 50mN"},
        {"--for", &w.length, kContact,
         "with --force and a scene: duration of the motion, default 60s"},
        {"--json", &w.json, "one JSON object per line for each setting, then the recommendation"},
        {"--csv", &w.as_csv, "the table as CSV"},
    };
  }
  SharedWords& shared() override { return words_; }

  StudyOutput run(const StudyCall& call) override {
    check_words(words_, flags(), call.given);
    return words_.force ? tune_force() : tune_motion(call.console);
  }

 private:
  [[nodiscard]] StudyOutput tune_motion(const tools::Console& console) const {
    const TuneGoal goal = goal_of(words_);
    if (words_.seed && words_.jitter.empty() && words_.loss.empty())
      throw tools::UsageError(kNothingDrawn);
    if (words_.file.empty())
      throw tools::UsageError("name a FILE: a CSV table of motion, or a capture");
    const TrackFile file = read_track_file(words_.file);
    const TrackSummary summary = summary_of(file.tracks);
    if (!(summary.interval > 0))
      throw tools::UsageError(
          fmt::format("{}: no entity has two samples, so no motion can be predicted", words_.file));
    const TuneOptions options = options_of(words_, goal, summary.step, file.has_orientation);
    StudyWatch watch(console);
    const TuneTable table = tune(file.tracks, options, watch.of("settings"));
    if (table.stopped) return {.note = "stopped before the end: no table\n"};
    const TuneReport report{file, summary, options, table, advice_of(table, goal)};
    StudyOutput output{words_.json     ? tune_json(report)
                       : words_.as_csv ? tune_csv(report)
                                       : tune_text(report, words_.all)};
    output.plot = tune_svg(report);
    output.reports_files = false;
    const bool missed = report.advice.row == nullptr && (goal.error || goal.packets_per_s);
    if (missed || file.damaged) output.code = tools::ExitCode::findings;
    return output;
  }

  [[nodiscard]] StudyOutput tune_force() const {
    const bool contact = words_.mode() == kContact;
    const auto rows = contact ? contact_rows(words_) : signal_rows(words_);
    StudyOutput output{words_.json     ? force_json(rows)
                       : words_.as_csv ? force_csv(rows)
                                       : force_text(rows, contact)};
    if (!contact || std::ranges::any_of(rows, &ForceRow::samples)) return output;
    output.code = tools::ExitCode::findings;
    output.note =
        "the hands never touched, so there is no error; set a longer --for, a shorter --delay, "
        "or operators with crossing paths\n";
    return output;
  }

  TuneWords words_;
};

}  // namespace

std::unique_ptr<Study> tune_study() { return std::make_unique<TuneStudy>(); }

}  // namespace reckon::bench

namespace reckon::tools::verb {

Verb tune() { return reckon::bench::study_verb(verb_row("tune"), reckon::bench::tune_study); }

}  // namespace reckon::tools::verb
