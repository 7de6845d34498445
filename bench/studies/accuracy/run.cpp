// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/accuracy/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <string>
#include <vector>

#include "reckon/bench/studies/accuracy/circle_study.hpp"
#include "reckon/bench/studies/accuracy/equal_error.hpp"
#include "reckon/bench/studies/accuracy/modes.hpp"
#include "reckon/bench/studies/accuracy/page.hpp"
#include "reckon/bench/studies/accuracy/pose_trace.hpp"
#include "reckon/bench/studies/accuracy/text.hpp"
#include "reckon/bench/studies/contact/contact_report.hpp"
#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/bench/studies/tracks/motions.hpp"
#include "reckon/bench/studies/tracks/track_file.hpp"
#include "reckon/bench/studies/tune/report.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/command_line/output_file.hpp"
#include "reckon/tools/command_line/status_line.hpp"

namespace reckon::bench {
namespace {

/// Tells how far a study is and ends it when the user asks.
class Watch {
 public:
  explicit Watch(const tools::Console& console) : console_(console), line_(console.err, now()) {}
  ~Watch() { line_.clear(); }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  [[nodiscard]] StudyProgress of(std::string_view subject) {
    return [this, subject](std::size_t done, std::size_t all) {
      if (line_.due(now()))
        line_.show(fmt::format("{}: {} of {} settings", subject, done, all), now());
      return !console_.stopped();
    };
  }

 private:
  static std::chrono::nanoseconds now() {
    return std::chrono::steady_clock::now().time_since_epoch();
  }

  const tools::Console& console_;
  tools::StatusLine line_;
};

/// What one subject is and the thresholds that suit it.
struct Subject {
  StudySubject study;
  std::vector<double> thresholds;
  bool turns_send = true;  ///< not where a file's orientations are made up and no --angle is given
  bool damaged = false;    ///< a file of which a part could not be read
};

constexpr std::array<double, 6> kFileThresholds{0.1, 0.2, 0.5, 1, 2, 5};

Subject read_subject(const std::string& path, bool angle_given) {
  TrackFile file = read_track_file(path);
  const bool turns_send = file.has_orientation || angle_given;
  if (!turns_send) {
    file.note += file.note.empty() ? "" : " ";
    file.note += "No orientations: position alone sends.";
  }
  return {{file.name, file.note, std::move(file.tracks)},
          {kFileThresholds.begin(), kFileThresholds.end()},
          turns_send,
          file.damaged};
}

/// Files where some are named, else motions.
std::vector<Subject> subjects_of(const BenchOptions& options) {
  std::vector<Subject> subjects;
  for (const std::string& path : options.files)
    subjects.push_back(read_subject(path, !options.angle.empty()));
  if (!subjects.empty() && options.motions.empty()) return subjects;
  const double seconds = pdu::to_seconds(options.length);
  if (!(seconds > 0 && seconds <= 3600))
    throw tools::UsageError("--for: a motion lasts more than 0 s and at most 1 h");
  const auto chosen = options.motions.empty() ? read_motions(std::vector<std::string>{"all"})
                                              : read_motions(options.motions);
  for (const Motion& motion : chosen) {
    subjects.push_back({{std::string(motion.name), std::string(motion.meaning), {}},
                        {motion.thresholds.begin(), motion.thresholds.end()}});
    subjects.back().study.tracks.push_back(motion.generate(seconds, options.seed));
  }
  return subjects;
}

/// Those asked for, else all. Files hold a sample a second or a minute, too few to see a curve:
/// what is looked at there is the prediction alone.
std::vector<deadreckon::ConvergenceCurve> curves_of(const BenchOptions& options) {
  if (!options.curves.empty()) return read_curves(options.curves);
  return read_curves(std::vector<std::string>{options.files.empty() ? "all" : "snap"});
}

/// Findings where the answer is partial.
int status_of(const std::vector<Subject>& subjects) {
  const bool damaged = std::any_of(subjects.begin(), subjects.end(),
                                   [](const Subject& subject) { return subject.damaged; });
  return tools::exit_status(damaged ? tools::ExitCode::findings : tools::ExitCode::good);
}

// --- the grid ---

void print_tables(const AccuracyReport& report, bool front_only, std::FILE* out) {
  if (!report.contacts.empty())
    fmt::print(out, "{}", contact_text(report.contacts, report.grid.network));
  if (report.results.empty()) return;
  if (!report.contacts.empty()) fmt::print(out, "\n");
  for (const AccuracyResult& result : report.results)
    fmt::print(out, "{}\n", accuracy_table(result, front_only));
  fmt::print(out, "{}\n", wrapped(conditions_text(report.grid), kColumns));
  fmt::print(out,
             "OCT/S: 172 octets an update (Entity State, UDP, IPv4), one entity. ANGLE: p99 [deg]. "
             "STEP:\nlargest change of the drawn velocity between samples [m/s]. NS: one shown "
             "pose, measured.\n{}",
             front_only ? "Front: nothing is better in OCT/S, P99 and STEP together; --all shows "
                          "the rest.\n"
                        : "<: dominated in OCT/S, P99 and STEP; =: the same as another.\n");
}

std::vector<ContactRow> study_contacts(const BenchOptions& options, const AccuracyGrid& grid,
                                       Watch& watch) {
  if (!options.force) return {};
  const double seconds = pdu::to_seconds(options.length);
  if (!(seconds >= 1 && seconds <= 3600))
    throw tools::UsageError("--for: hands touch for at least 1 s and at most 1 h");
  const auto scenes =
      read_contacts(options.contacts.empty() ? std::vector<std::string>{"all"} : options.contacts);
  const auto sendings =
      options.sendings.empty()
          ? std::vector<ContactSending>(kContactSendings.begin(), kContactSendings.end())
          : read_sendings(options.sendings);
  return run_contact_study(scenes, sendings, grid.network, seconds, watch.of("contacts"));
}

int study_grid(const BenchOptions& options, AccuracyGrid grid, const tools::Console& console,
               const std::string& command) {
  tools::check_writable(options.csv);
  tools::check_writable(options.report);
  const bool poses = options.pose || !options.force;
  const std::vector<Subject> subjects = poses ? subjects_of(options) : std::vector<Subject>{};
  if (!options.models.empty()) grid.models = read_models(options.models);
  const std::vector<double> thresholds = read_thresholds(options.thresholds);
  grid.curves = curves_of(options);

  Watch watch(console);
  const double angle = grid.angle;
  const QueryCosts costs = measure_query_costs();
  AccuracyReport report{command, processor_name(), grid, {}, study_contacts(options, grid, watch)};
  for (const Subject& subject : subjects) {
    grid.thresholds = thresholds.empty() ? subject.thresholds : thresholds;
    grid.angle = subject.turns_send ? angle : kAnyAngle;
    report.results.push_back(run_accuracy_study(subject.study, grid, watch.of(subject.study.name)));
    note_query_costs(report.results.back(), costs);
    if (console.stopped()) break;
  }
  if (options.json)
    fmt::print(console.out, "{}{}", accuracy_json(report, options.front),
               contact_json(report.contacts, report.grid.network));
  else
    print_tables(report, !options.all, console.out);
  tools::write_output(options.csv,
                      poses ? accuracy_csv(report, options.front)
                            : contact_csv(report.contacts, report.grid.network),
                      console);
  tools::write_output(options.report, accuracy_page(report), console);
  return status_of(subjects);
}

// --- one model against another ---

int study_against(const BenchOptions& options, AccuracyGrid grid, const tools::Console& console) {
  const Baseline baseline = read_baseline(options.against);
  if (options.files.empty() && options.motions.empty())
    throw tools::UsageError("--against: name files, or motions by --motion");
  if (!options.curves.empty() || !options.files.empty()) grid.curves = curves_of(options);
  if (grid.curves.size() > 1)
    throw tools::UsageError("--against looks through one curve; name one by --curves, as in cubic");
  const std::vector<PoseModel> rivals = options.models.empty()
                                            ? std::vector<PoseModel>{kPoseModels.front()}
                                            : read_models(options.models);
  Watch watch(console);
  const double angle = grid.angle;
  std::vector<NamedEqualError> found;
  std::string without;
  const std::vector<Subject> subjects = subjects_of(options);
  for (const Subject& subject : subjects) {
    grid.angle = subject.turns_send ? angle : kAnyAngle;
    if (!subject.turns_send)
      without += fmt::format("no orientations, position alone sends: {}\n", subject.study.name);
    for (const PoseModel& rival : rivals) {
      if (console.stopped()) break;
      found.push_back({subject.study.name,
                       find_equal_error(subject.study.tracks, grid, baseline.model,
                                        baseline.threshold, rival, watch.of(subject.study.name))});
    }
  }
  grid.angle = angle;
  if (options.json) {
    fmt::print(console.out, "{}", equal_error_json(found));
    return status_of(subjects);
  }
  fmt::print(console.out,
             "{}{}\n{}First line of each: what is compared against; then the fewest updates at no "
             "more p99.\n",
             equal_error_table(found), wrapped(conditions_text(grid), kColumns), without);
  return status_of(subjects);
}

// --- the circle ---

int study_circle(const BenchOptions& options, const tools::Console& console) {
  CircleCase circle;
  circle.network.seed = options.seed;
  circle.seeds = options.seeds.value_or(circle.seeds);
  const std::vector<std::string> standard{"auto,rvw,rvw+adaptive,rvb"}, every{"all"};
  const auto models = read_models(options.models.empty() ? standard : options.models);
  const auto curves = read_curves(options.curves.empty() ? every : options.curves);
  const std::vector<CircleRow> rows = run_circle_study(models, curves, circle);
  const bool missed = std::any_of(rows.begin(), rows.end(), [](const CircleRow& row) {
    return row.model.name == kPoseModels.front().name &&
           row.curve == deadreckon::ConvergenceSettings{}.curve && !row.clears();
  });
  if (options.json) {
    fmt::print(console.out, "{}", circle_json(rows));
  } else {
    fmt::print(console.out,
               "circle of 100 m radius at 20 m/s; an update every 0.2 s, 80 ms +-40 % under way, "
               "10 % lost;\nseen at 60 Hz for 60 s; medians of {} seeds from {}\n{}",
               circle.seeds, circle.network.seed, circle_table(rows));
    fmt::print(console.out,
               "bar: RMS at most 5 mm, steps at most 0.1 m/s; the circle's own velocity steps by "
               "0.067 m/s\n");
  }
  return tools::exit_status(missed ? tools::ExitCode::findings : tools::ExitCode::good);
}

// --- one run, sample by sample ---

void check_period(const BenchOptions& options) {
  if (options.period && (options.period->count() <= 0 || !options.thresholds.empty()))
    throw tools::UsageError(
        "--period: has to be above 0, as in 1s, and takes the place of --thresholds");
}

/// The only row of the grid.
AccuracyRow row_traced(const std::vector<Subject>& subjects, const AccuracyGrid& grid) {
  if (subjects.size() == 1 && grid.models.size() == 1 && grid.thresholds.size() == 1 &&
      grid.curves.size() == 1)
    return {grid.models.front(), grid.thresholds.front(), grid.curves.front(), {}, 0, {}};
  throw tools::UsageError(fmt::format(
      "--trace is one run, these are {} subjects x {} models x {} thresholds x {} curves; write "
      "--motion weave --models auto --thresholds 0.5m --curves cubic, or --period 1s in place of "
      "--thresholds",
      subjects.size(), grid.models.size(), grid.thresholds.size(), grid.curves.size()));
}

int study_trace(const BenchOptions& options, AccuracyGrid grid, const tools::Console& console) {
  check_period(options);
  const std::vector<Subject> subjects = subjects_of(options);
  if (!options.models.empty()) grid.models = read_models(options.models);
  if (!options.thresholds.empty())
    grid.thresholds = read_thresholds(options.thresholds);
  else if (!options.period)
    grid.thresholds = subjects.front().thresholds;
  grid.curves = curves_of(options);
  if (!subjects.front().turns_send) grid.angle = kAnyAngle;
  PoseSetting setting = setting_of(grid, row_traced(subjects, grid));
  if (options.period) setting.period = pdu::to_seconds(*options.period);

  const std::vector<Track>& tracks = subjects.front().study.tracks;
  PoseTrace trace(options.trace, tracks);
  const PoseResult result = run_pose_study(tracks, setting, grid.network,
                                           [&](const PoseSample& sample) { trace.write(sample); });
  trace.close();
  fmt::print(console.err, "wrote {}\n", options.trace);
  fmt::print(console.out, "{} updates, {} samples drawn; error RMS {}, p99 {}, max {}\n",
             result.updates, result.samples, length_text(result.position.rms),
             length_text(result.position.p99), length_text(result.position.max));
  return status_of(subjects);
}

}  // namespace

int bench_accuracy(const BenchOptions& options, const std::string& command,
                   const tools::Console& console) {
  const AccuracyGrid grid = read_conditions(options);
  switch (mode_of(options)) {
    case AccuracyMode::trace:
      return study_trace(options, grid, console);
    case AccuracyMode::circle:
      return study_circle(options, console);
    case AccuracyMode::against:
      return study_against(options, grid, console);
    default:
      return study_grid(options, grid, console, command);
  }
}

}  // namespace reckon::bench
