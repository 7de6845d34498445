// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/force/force_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <future>
#include <optional>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/notation/units.hpp"
#include "reckon/peer/tracks/csv_reader.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/exercise/exercise.hpp"

namespace reckon::bench {
namespace {

using deadreckon::Deadband;
using deadreckon::SignalModel;
using deadreckon::SignalUpdate;
using Eigen::Vector3d;

// A peer without dead reckoning would send this in every servo step: an Entity State and an
// Attribute PDU with one force model.
constexpr double kRawStepsPerSecond = 1000;
constexpr std::size_t kMostSamples = 4'000'000;

using Send = std::function<std::optional<SignalUpdate>(double, const Vector3d&)>;

ForceRow run_signal(const ForceSignal& signal, const Deadband& deadband, const Send& send) {
  ForceRow row;
  row.name = signal.name;
  row.unit = signal.unit;
  row.samples = signal.values.size();
  std::vector<double> errors;
  errors.reserve(row.samples);
  std::uint64_t updates = 0;
  SignalUpdate last;
  for (std::size_t i = 0; i < signal.values.size(); ++i) {
    const Vector3d& value = signal.values[i];
    if (const auto update = send(signal.times[i], value)) {
      last = *update;
      ++updates;
    }
    errors.push_back((deadreckon::predict(last, signal.times[i]) - value).norm());
    row.outside += !(errors.back() <= deadreckon::deadband_width(deadband, value) * (1 + 1e-12));
  }
  row.error = size_of(errors);
  const double span = row.samples > 1 ? signal.times.back() - signal.times.front() : 0;
  if (span > 0) {
    row.packets_per_s = static_cast<double>(updates) / span;
    row.raw_packets_per_s = static_cast<double>(row.samples) / span;
    row.octets_per_s = kSignalOctets * row.packets_per_s;
  }
  return row;
}

ForceRow run_contact(const peer::SceneFile& scene, double seconds) {
  tools::ExerciseOptions options;
  options.simulated_time = true;
  options.epoch = 1;
  tools::Exercise exercise(scene, options);
  exercise.run(pdu::from_seconds(seconds));
  const peer::Spread error = exercise.measurement().force_error();
  ForceRow row;
  row.name = scene.name;
  row.setting = fmt::format("force model, {}",
                            peer::format_quantity(scene.dead_reckoning.thresholds.force, "N"));
  row.packets_per_s = static_cast<double>(exercise.total("datagrams_out")) / seconds;
  row.octets_per_s = static_cast<double>(exercise.total("octets_out")) / seconds +
                     peer::kUdpIpv4Headers * row.packets_per_s;
  row.raw_packets_per_s = kRawStepsPerSecond * static_cast<double>(exercise.size());
  row.for_force_per_s = static_cast<double>(exercise.total("sent_force")) / seconds;
  row.samples = error.count;
  row.error = {exercise.measurement().force_error_rms(), error.p99, error.max};
  exercise.stop();
  return row;
}

std::vector<std::size_t> find_columns(const peer::CsvReader& csv,
                                      std::span<const std::string> asked) {
  std::vector<std::size_t> places;
  const auto take = [&](std::string_view name) {
    const auto place = csv.find(name);
    if (place) places.push_back(*place);
    return place.has_value();
  };
  for (std::string name : asked) {
    for (char& letter : name)
      letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    if (!take(name))
      csv.fail(
          0, fmt::format("no column {}; the columns are {}", name, fmt::join(csv.columns(), ", ")));
  }
  if (!asked.empty()) return places;
  if (take("f_n")) return places;
  for (const std::string_view name : {"fx_n", "fy_n", "fz_n"}) take(name);
  if (places.empty())
    csv.fail(
        0, fmt::format("no column f_n or fx_n,fy_n,fz_n; choose one to three with --columns, of {}",
                       fmt::join(csv.columns(), ", ")));
  return places;
}

}  // namespace

ForceSignal read_force_signal(const std::filesystem::path& path,
                              std::span<const std::string> columns) {
  peer::CsvReader csv(path);
  const auto time = csv.find("t_s");
  if (!time) csv.fail(0, "the first line has no column t_s; add the time in seconds");
  const std::vector<std::size_t> places = find_columns(csv, columns);
  ForceSignal signal;
  signal.name = path.stem().string();
  if (!columns.empty()) signal.unit = "";
  while (csv.next()) {
    const double now = csv.required(*time);
    Vector3d value = Vector3d::Zero();
    for (std::size_t i = 0; i < places.size(); ++i)
      value[static_cast<Eigen::Index>(i)] = csv.required(places[i]);
    if (!signal.times.empty() && !(now > signal.times.back())) continue;
    if (signal.times.size() == kMostSamples)
      csv.fail(0, fmt::format("more than {} samples; cut the file into parts", kMostSamples));
    signal.times.push_back(now);
    signal.values.push_back(value);
  }
  if (signal.times.size() < 2)
    throw tools::UsageError(
        fmt::format("{}: fewer than two samples; a rate needs more", path.string()));
  return signal;
}

std::vector<ForceRow> force_signal_rows(const ForceSignal& signal, std::span<const double> webers,
                                        double floor) {
  std::vector<ForceRow> rows;
  for (const double weber : webers) {
    const Deadband deadband{weber, floor};
    deadreckon::DeadbandSender hold(deadband, SignalModel::hold);
    deadreckon::DeadbandSender line(deadband, SignalModel::line);
    deadreckon::DeadbandSender choice(deadband);
    const auto add = [&](std::string_view name, auto& sender) {
      rows.push_back(run_signal(signal, deadband, [&](double time, const Vector3d& value) {
        return sender.sample(time, value);
      }));
      rows.back().setting = fmt::format("{}, {:g} % Weber", name, 100 * weber);
    };
    add("hold", hold);
    add("line", line);
    add("auto", choice);
  }
  return rows;
}

std::vector<ForceRow> force_model_rows(const peer::SceneFile& scene,
                                       std::span<const double> thresholds, double seconds) {
  std::vector<std::future<ForceRow>> runs;
  for (const double threshold : thresholds)
    runs.push_back(std::async(std::launch::async, [&scene, threshold, seconds] {
      peer::SceneFile tried = scene;
      tried.dead_reckoning.thresholds.force = threshold;
      return run_contact(tried, seconds);
    }));
  std::vector<ForceRow> rows;
  for (auto& run : runs) rows.push_back(run.get());
  return rows;
}

}  // namespace reckon::bench
