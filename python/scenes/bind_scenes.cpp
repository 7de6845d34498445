// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/python/scenes/bind_scenes.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/python/captures/arrays.hpp"
#include "reckon/python/scenes/program_effects.hpp"
#include "reckon/tools/exercise/exercise.hpp"
#include "reckon/tools/exercise/scene_options.hpp"
#include "reckon/tools/exercise/simulated_slice.hpp"

namespace reckon::python {
namespace py = pybind11;
namespace {

using std::chrono::nanoseconds;

/// The columns of `reckon demo --trace`; vectors have three numbers a row.
struct Trace {
  std::vector<double> time;
  std::vector<std::uint32_t> peer, device, contacts, patch;
  std::vector<double> handle, surface_point, velocity, force, mesh_force, hand_force, record_force,
      torque, orientation, turn_rate;
  std::vector<double> ledger, need, energy;

  void add(std::size_t of_peer, std::size_t of_device, const haptics::ServoSnapshot& step);
};

void add_triple(std::vector<double>& column, const Eigen::Vector3d& v) {
  column.insert(column.end(), {v.x(), v.y(), v.z()});
}

void Trace::add(std::size_t of_peer, std::size_t of_device, const haptics::ServoSnapshot& step) {
  Eigen::Vector3d hands = Eigen::Vector3d::Zero(), records = Eigen::Vector3d::Zero();
  double all_ledgers = 0.0, all_needs = 0.0;
  for (std::size_t i = 0; i < step.count; ++i) {
    hands += step.contacts[i].force;
    records += step.contacts[i].ungated_force;
    all_ledgers += step.contacts[i].ledger;
    all_needs += step.contacts[i].need;
  }
  time.push_back(pdu::to_seconds(step.time));
  peer.push_back(static_cast<std::uint32_t>(of_peer + 1));
  device.push_back(static_cast<std::uint32_t>(of_device + 1));
  contacts.push_back(static_cast<std::uint32_t>(step.count));
  patch.push_back(step.mesh_patch);
  add_triple(handle, step.device);
  add_triple(surface_point, step.scp);
  add_triple(velocity, step.velocity);
  add_triple(force, step.force);
  add_triple(mesh_force, step.mesh_force);
  add_triple(hand_force, hands);
  add_triple(record_force, records);
  add_triple(torque, step.tool.torque);
  const Eigen::Quaterniond& q = step.tool.orientation;
  orientation.insert(orientation.end(), {q.w(), q.x(), q.y(), q.z()});
  add_triple(turn_rate, step.tool.turn_rate);
  ledger.push_back(all_ledgers);
  need.push_back(all_needs);
  energy.push_back(step.port_energy);
}

py::dict columns_of_trace(Trace&& trace) {
  py::dict all;
  all["time"] = array_of(std::move(trace.time));
  all["peer"] = array_of(std::move(trace.peer));
  all["device"] = array_of(std::move(trace.device));
  all["handle"] = array_of(std::move(trace.handle), 3);
  all["surface_point"] = array_of(std::move(trace.surface_point), 3);
  all["velocity"] = array_of(std::move(trace.velocity), 3);
  all["force"] = array_of(std::move(trace.force), 3);
  all["mesh_force"] = array_of(std::move(trace.mesh_force), 3);
  all["hand_force"] = array_of(std::move(trace.hand_force), 3);
  all["record_force"] = array_of(std::move(trace.record_force), 3);
  all["torque"] = array_of(std::move(trace.torque), 3);
  all["orientation"] = array_of(std::move(trace.orientation), 4);
  all["turn_rate"] = array_of(std::move(trace.turn_rate), 3);
  all["ledger"] = array_of(std::move(trace.ledger));
  all["need"] = array_of(std::move(trace.need));
  all["energy"] = array_of(std::move(trace.energy));
  all["contacts"] = array_of(std::move(trace.contacts));
  all["patch"] = array_of(std::move(trace.patch));
  return all;
}

/// Percentiles of the measurements, by name; in SI units.
py::dict numbers_of(const tools::Exercise& exercise) {
  const tools::DemoMeasurement& measured = exercise.measurement();
  py::dict all;
  const auto spread = [&](const char* name, const peer::Spread& errors) {
    py::dict of;
    of["count"] = errors.count;
    of["p50"] = errors.p50;
    of["p99"] = errors.p99;
    of["max"] = errors.max;
    all[name] = of;
  };
  spread("pose_error", measured.pose_error());
  spread("force_error", measured.force_error());
  all["datagrams"] = exercise.total("datagrams_out");
  all["octets"] = exercise.total("octets_out");
  all["hand_contact"] = measured.touching_hands();
  all["scene_contact"] = measured.touching_scene();
  all["peak_force"] = measured.peak_force();
  all["least_energy"] = measured.energy_min();
  return all;
}

void run_for(tools::Exercise& exercise, nanoseconds end) {
  while (exercise.elapsed() < end) {
    {
      const py::gil_scoped_release others_run;
      exercise.run(std::min(tools::kSimulatedSlice, end - exercise.elapsed()));
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

py::tuple run_scene(const std::string& path, double duration, std::optional<std::uint64_t> seed,
                    std::size_t peers, const std::string& impair, const py::object& effects) {
  constexpr double kLongest = 1e6;
  if (!(duration > 0) || duration > kLongest)
    throw py::value_error("duration is " + std::to_string(duration) +
                          " s: it must be more than 0 and at most 1e6");
  tools::SceneOptions options;
  options.scene = path;
  options.seed = seed;
  options.impair = impair;
  options.effects = effects_of(effects);
  peer::SceneFile scene = tools::load_scene(options, "meeting.toml", peers);
  scene.network.peers.clear();
  tools::ExerciseOptions how;
  how.peers = peers;
  how.simulated_time = true;
  Trace trace;  // outlives the exercise, whose end adds the last steps
  tools::Exercise exercise(scene, how);
  exercise.on_step([&](std::size_t of_peer, std::size_t device,
                       const haptics::ServoSnapshot& step) { trace.add(of_peer, device, step); });
  run_for(exercise, nanoseconds(std::llround(duration * 1e9)));
  const py::dict numbers = numbers_of(exercise);
  exercise.stop();
  return py::make_tuple(columns_of_trace(std::move(trace)), numbers);
}

}  // namespace

void bind_scenes(py::module_& module) { module.def("run_scene", run_scene); }

}  // namespace reckon::python
