// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Output of `demo --trace ..`.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

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

void add_trace_options(CommandLine& line, TraceFiles& files);

/// The open files. Used by the thread that runs the exercise.
class DemoTraces {
 public:
  /// @param exercise has trace_bodies and trace_loops set for the requested files; outlives it
  /// @throws UsageError if a file cannot be written, or would be empty.
  DemoTraces(const TraceFiles& files, const peer::SceneFile& scene, Exercise& exercise);
  DemoTraces(const DemoTraces&) = delete;
  DemoTraces& operator=(const DemoTraces&) = delete;

  /// Whether take() must be called.
  [[nodiscard]] bool takes_steps() const noexcept { return servo_.has_value(); }
  /// @param peer, device numbered from 0
  void take(std::size_t peer, std::size_t device, const haptics::ServoSnapshot& step) {
    if (servo_) servo_->write(peer, device, step);
  }
  /// Flushes the files; call it after the exercise has stopped. @throws EnvironmentError if the
  /// disk is full.
  void close();

 private:
  std::optional<ServoTrace> servo_;
  std::optional<BodyTrace> bodies_;
  std::optional<StageTrace> stages_;
};

}  // namespace reckon::tools
