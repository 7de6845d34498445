// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/demo_traces.hpp"

#include <algorithm>

namespace reckon::tools {

void add_trace_options(CommandLine& line, TraceFiles& files) {
  line.option("--trace", files.servo, "write each servo step of each device to this CSV file");
  line.option("--trace-bodies", files.bodies,
              "write each step of each awake body to this CSV file");
  line.option("--trace-loop", files.loop,
              "write each stage of each pass of the model loops to this CSV file");
}

DemoTraces::DemoTraces(const TraceFiles& files, const peer::SceneFile& scene, Exercise& exercise) {
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

void DemoTraces::close() {
  if (servo_) servo_->close();
  if (bodies_) bodies_->close();
  if (stages_) stages_->close();
}

}  // namespace reckon::tools
