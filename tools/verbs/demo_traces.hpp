// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Output of `demo --trace ..`.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/exercise/body_trace.hpp"
#include "reckon/tools/exercise/exercise.hpp"
#include "reckon/tools/exercise/servo_trace.hpp"
#include "reckon/tools/exercise/stage_trace.hpp"

namespace reckon::tools {

/// Requested files; empty: none.
struct TraceFiles {
  std::string servo, bodies, loop;
};

inline void add_trace_options(CommandLine& line, TraceFiles& files) {
  line.option("--trace", files.servo, "write each servo step of each device to this CSV file");
  line.option("--trace-bodies", files.bodies,
              "write each step of each awake body to this CSV file");
  line.option("--trace-loop", files.loop,
              "write each stage of each pass of the model loops to this CSV file");
}

/// The open files. Used by the thread that runs the exercise.
class DemoTraces {
 public:
  /// @param exercise has trace_bodies and trace_loops set for the requested files; outlives it
  /// @throws UsageError if a file cannot be written, or would be empty.
  DemoTraces(const TraceFiles& files, const peer::SceneFile& scene, Exercise& exercise)
      : exercise_(exercise) {
    if (!files.servo.empty()) {
      const auto turns = [](const peer::DeviceConfig& device) { return device.axes == 6; };
      servo_.emplace(files.servo, std::ranges::any_of(scene.devices, turns));
    }
    if (!files.bodies.empty()) {
      bodies_.emplace(files.bodies, scene.scene);
      exercise.on_body([this](const haptics::BodyStep& step) { bodies_->write(step); });
    }
    if (!files.loop.empty()) {
      stages_.emplace(files.loop);
      exercise.on_stage(
          [this](std::size_t peer, const peer::LoopStep& step) { stages_->write(peer, step); });
    }
  }
  DemoTraces(const DemoTraces&) = delete;
  DemoTraces& operator=(const DemoTraces&) = delete;

  /// Whether take() must be called.
  [[nodiscard]] bool takes_steps() const noexcept { return servo_.has_value(); }
  /// @param peer, device numbered from 0
  void take(std::size_t peer, std::size_t device, const haptics::ServoSnapshot& step) {
    if (!servo_) return;
    const haptics::BodyWorld* bodies = exercise_.peer(peer).bodies();
    servo_->write(peer, device, bodies == nullptr ? 1.0 : bodies->pace(), step);
  }
  /// Flushes the files; call it after the exercise has stopped. @throws EnvironmentError if the
  /// disk is full.
  void close() {
    if (servo_) servo_->close();
    if (bodies_) bodies_->close();
    if (stages_) stages_->close();
  }

 private:
  Exercise& exercise_;
  std::optional<ServoTrace> servo_;
  std::optional<BodyTrace> bodies_;
  std::optional<StageTrace> stages_;
};

}  // namespace reckon::tools
