// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "reckon/bench/studies/accuracy/circle_study.hpp"
#include "reckon/bench/studies/accuracy/equal_error.hpp"
#include "reckon/bench/studies/accuracy/options.hpp"
#include "reckon/bench/studies/accuracy/pose_trace.hpp"
#include "reckon/bench/studies/accuracy/text.hpp"
#include "reckon/bench/studies/contact/contact_report.hpp"
#include "reckon/bench/studies/frame/study_watch.hpp"
#include "reckon/bench/studies/frame/text_lines.hpp"
#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/bench/studies/touch/touch_study.hpp"
#include "reckon/bench/studies/tracks/motions.hpp"
#include "reckon/bench/studies/tracks/track_file.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::bench {
namespace {

/// A subject, and the thresholds that suit it.
struct Subject {
  StudySubject study;
  std::vector<double> thresholds;
  bool turns_send = true;  ///< false if a file's orientations are derived and no --angle is given
  bool damaged = false;    ///< a file with a part that could not be read
};

constexpr std::array<double, 6> kFileThresholds{0.1, 0.2, 0.5, 1, 2, 5};

Subject read_subject(const std::string& path, bool angle_given) {
  TrackFile file = read_track_file(path);
  const bool turns_send = file.has_orientation || angle_given;
  if (!turns_send) {
    file.note += file.note.empty() ? "" : " ";
    file.note += "No orientations: only the position causes updates.";
  }
  return {{file.name, file.note, std::move(file.tracks)},
          {kFileThresholds.begin(), kFileThresholds.end()},
          turns_send,
          file.damaged};
}

/// The files, and the motions unless only files are named.
std::vector<Subject> subjects_of(const BenchOptions& options) {
  std::vector<Subject> subjects;
  for (const std::string& path : options.files)
    subjects.push_back(read_subject(path, !options.angle.empty()));
  if (!subjects.empty() && options.motions.empty()) return subjects;
  const double seconds = pdu::to_seconds(options.span());
  if (!(seconds > 0 && seconds <= 3600))
    throw tools::UsageError("--for: write more than 0 s and at most 1 h");
  for (const Motion& motion : read_motions(options.motions)) {
    subjects.push_back({{std::string(motion.name), std::string(motion.meaning), {}},
                        {motion.thresholds.begin(), motion.thresholds.end()}});
    subjects.back().study.tracks.push_back(motion.generate(seconds, options.first_seed()));
  }
  return subjects;
}

/// ExitCode::findings if the result is partial.
tools::ExitCode code_of(const std::vector<Subject>& subjects) {
  return std::ranges::any_of(subjects, &Subject::damaged) ? tools::ExitCode::findings
                                                          : tools::ExitCode::good;
}

// --- the grid ---

std::vector<ContactRow> study_contacts(const BenchOptions& options, const AccuracyGrid& grid,
                                       StudyWatch& watch) {
  if (!options.force) return {};
  const double seconds = pdu::to_seconds(options.span());
  if (!(seconds >= 1 && seconds <= 3600))
    throw tools::UsageError("--for: write 1 s to 1 h for hands");
  return run_contact_study(read_contacts(options.contacts), read_sendings(options.sendings),
                           grid.network, seconds, watch.of("settings", "contacts"));
}

StudyOutput study_grid(const BenchOptions& options, AccuracyGrid grid, const StudyCall& call) {
  const bool poses = options.pose || !options.force;
  const std::vector<Subject> subjects = poses ? subjects_of(options) : std::vector<Subject>{};
  const std::vector<double> thresholds = read_thresholds(options.thresholds);

  StudyWatch watch(call.console);
  const double angle = grid.angle;
  const QueryCosts costs = measure_query_costs();
  AccuracyReport report{
      call.command, processor_name(), grid, {}, study_contacts(options, grid, watch)};
  for (const Subject& subject : subjects) {
    grid.thresholds = thresholds.empty() ? subject.thresholds : thresholds;
    grid.angle = subject.turns_send ? angle : kAnyAngle;
    report.results.push_back(
        run_accuracy_study(subject.study, grid, watch.of("settings", subject.study.name)));
    note_query_costs(report.results.back(), costs);
    if (call.console.stopped()) break;
  }
  return {options.json ? accuracy_json(report, options.front) : accuracy_text(report, !options.all),
          poses ? accuracy_csv(report, options.front)
                : contact_csv(report.contacts, report.grid.network),
          "",
          accuracy_page(report),
          "",
          code_of(subjects)};
}

// --- one model against another ---

StudyOutput study_against(const BenchOptions& options, AccuracyGrid grid, const StudyCall& call) {
  const Baseline baseline = read_baseline(options.against);
  if (options.files.empty() && options.motions.empty())
    throw tools::UsageError("--against: write files, or motions with --motion");
  if (options.curves.empty() && options.files.empty())
    grid.curves = {deadreckon::ConvergenceCurve::cubic};
  if (grid.curves.size() > 1)
    throw tools::UsageError("--against uses one curve; write for example --curves cubic");
  const std::vector<PoseModel> rivals =
      options.models.empty() ? std::vector<PoseModel>{kPoseModels.front()} : grid.models;
  StudyWatch watch(call.console);
  const double angle = grid.angle;
  std::vector<NamedEqualError> found;
  std::string without;
  const std::vector<Subject> subjects = subjects_of(options);
  for (const Subject& subject : subjects) {
    grid.angle = subject.turns_send ? angle : kAnyAngle;
    if (!subject.turns_send)
      without += fmt::format("no orientations, only the position causes updates: {}\n",
                             subject.study.name);
    for (const PoseModel& rival : rivals) {
      if (call.console.stopped()) break;
      found.push_back(
          {subject.study.name,
           find_equal_error(subject.study.tracks, grid, baseline.model, baseline.threshold, rival,
                            watch.of("settings", subject.study.name))});
    }
  }
  grid.angle = angle;
  StudyOutput output{options.json ? equal_error_json(found) : equal_error_table(found)};
  output.code = code_of(subjects);
  if (!options.json)
    output.out += fmt::format(
        "{}\n{}First line of each: the reference; then the fewest updates at no more p99.\n",
        wrapped(conditions_text(grid), kTextColumns), without);
  return output;
}

// --- the circle ---

StudyOutput study_circle(const BenchOptions& options, const AccuracyGrid& grid) {
  CircleCase circle;
  circle.network.seed = options.first_seed();
  circle.seeds = options.seeds.value_or(circle.seeds);
  const std::vector<std::string> standard{"auto,rvw,rvw+adaptive,rvb"};
  const auto models = options.models.empty() ? read_models(standard) : grid.models;
  const std::vector<CircleRow> rows = run_circle_study(models, grid.curves, circle);
  const bool missed = std::any_of(rows.begin(), rows.end(), [](const CircleRow& row) {
    return row.model.name == kPoseModels.front().name &&
           row.curve == deadreckon::ConvergenceSettings{}.curve && !row.clears();
  });
  StudyOutput output{circle_lines(rows, options.json)};
  if (missed) output.code = tools::ExitCode::findings;
  if (!options.json)
    output.out = fmt::format(
        "circle of 100 m radius at 20 m/s; an update every 0.2 s, 80 ms +-40 % under way, 10 % "
        "lost;\nseen at 60 Hz for 60 s; medians of {} seeds from {}\n{}bar: RMS at most 5 mm, "
        "steps at most 0.1 m/s; the circle's own velocity steps by 0.067 m/s\n",
        circle.seeds, circle.network.seed, output.out);
  return output;
}

// --- one run, sample by sample ---

void check_period(const BenchOptions& options) {
  if (options.period && (options.period->count() <= 0 || !options.thresholds.empty()))
    throw tools::UsageError("--period: must be above 0, for example 1s; it replaces --thresholds");
}

/// The only row of the grid.
AccuracyRow row_traced(const std::vector<Subject>& subjects, const AccuracyGrid& grid) {
  if (subjects.size() == 1 && grid.models.size() == 1 && grid.thresholds.size() == 1 &&
      grid.curves.size() == 1)
    return {grid.models.front(), grid.thresholds.front(), grid.curves.front(), {}, 0, {}};
  throw tools::UsageError(
      fmt::format("--trace needs one run, but these are {} subjects x {} models x {} thresholds x "
                  "{} curves; write --motion weave --models auto --thresholds 0.5m --curves cubic, "
                  "or --period 1s instead of --thresholds",
                  subjects.size(), grid.models.size(), grid.thresholds.size(), grid.curves.size()));
}

StudyOutput study_trace(const BenchOptions& options, AccuracyGrid grid, const StudyCall& call) {
  check_period(options);
  const std::vector<Subject> subjects = subjects_of(options);
  if (!options.thresholds.empty())
    grid.thresholds = read_thresholds(options.thresholds);
  else if (!options.period)
    grid.thresholds = subjects.front().thresholds;
  if (!subjects.front().turns_send) grid.angle = kAnyAngle;
  PoseSetting setting = setting_of(grid, row_traced(subjects, grid));
  if (options.period) setting.period = pdu::to_seconds(*options.period);

  const std::vector<Track>& tracks = subjects.front().study.tracks;
  PoseTrace trace(options.trace, tracks);
  const PoseResult result = run_pose_study(tracks, setting, grid.network,
                                           [&](const PoseSample& sample) { trace.write(sample); });
  trace.close();
  fmt::print(call.console.err, "wrote {}\n", options.trace);
  StudyOutput output{fmt::format("{} updates, {} samples drawn; error RMS {}, p99 {}, max {}\n",
                                 result.updates, result.samples, length_text(result.position.rms),
                                 length_text(result.position.p99),
                                 length_text(result.position.max))};
  output.code = code_of(subjects);
  return output;
}

class AccuracyStudy final : public Study {
 public:
  std::vector<Flag> flags() override { return options_.flags(); }
  SharedWords& shared() override { return options_; }

  StudyOutput run(const StudyCall& call) override {
    const AccuracyMode mode = options_.checked_mode(call.given);
    if (mode == AccuracyMode::touch)
      return run_touch_study(options_.axes, read_touch_conditions(options_), options_.json, call);
    const AccuracyGrid grid = read_conditions(options_);
    switch (mode) {
      case AccuracyMode::trace:
        return study_trace(options_, grid, call);
      case AccuracyMode::circle:
        return study_circle(options_, grid);
      case AccuracyMode::against:
        return study_against(options_, grid, call);
      default:
        return study_grid(options_, grid, call);
    }
  }

 private:
  BenchOptions options_;
};

}  // namespace

std::unique_ptr<Study> accuracy_study() { return std::make_unique<AccuracyStudy>(); }

}  // namespace reckon::bench
