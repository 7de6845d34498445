// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/scene_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/peer/sealing/sealed_link.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/command_line/file_kind.hpp"
#include "reckon/tools/command_line/impairment_text.hpp"
#include "reckon/tools/command_line/scene_folder.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"

namespace reckon::tools {

void add_scene_options(CommandLine& line, SceneOptions& options) {
  line.option("--mesh", options.mesh, "touch this mesh (OBJ, PLY, STL, OFF) instead");
  line.option("--hand", options.hand,
              "recorded hand trace (CSV) that the hands follow, fitted to the object");
  line.option("--impair", options.impair,
              "network impairment, for example 'delay=200ms jitter=100ms loss=20% reorder=5% "
              "duplicate=5%'; jitter is a time or a share of the delay, for example 40%");
  line.option("--seed", options.seed, "seed of the impairment");
  line.option("--iface", options.iface, "network interface by name, address or index");
  line.offer("--iface", kInterfaces);
  line.option("--key", options.key, "key file: seal the exercise (see reckon key new)");
  line.flag("--even-if-slow", options.even_if_slow,
            "run the scene even if servo steps exceed their period on this host");
  line.option(
      "--pace", options.pace,
      "time of this host for the work of bodies, over that of the reference host, 0.25 to 8; "
      "default: measured, or 1 with --simulated-time");
}

namespace {

void check_given(std::string_view flag, const std::string& file, std::string_view kinds,
                 std::string_view example) {
  std::error_code ignored;
  if (file.empty() || std::filesystem::exists(file, ignored)) return;
  throw UsageError(fmt::format("{}: there is no file '{}': write the path of {}, for example {}",
                               flag, file, kinds, example));
}

// Files of flags, before anything is read.
void check_files_given(const SceneOptions& options) {
  check_given("--mesh", options.mesh, "an OBJ, PLY, STL or OFF file", "scenes/touchstone.obj");
  check_given("--hand", options.hand, "a CSV file", "scenes/hand_trace.csv");
  if (const std::string remedy = no_scene_remedy(options.scene); !remedy.empty())
    throw UsageError(options.scene + ": " + remedy);
}

// Reports problems of the key before anything starts.
void check_key(const peer::SceneFile& scene) {
  if (scene.network.key.empty()) return;
  static_cast<void>(peer::load_group_key(scene.network.key));
  static_cast<void>(peer::sealed_group(scene.network.group));
  if (scene.network.interop)
    throw UsageError(
        "--key seals datagrams, but the scene's 'interop' needs plain ones: remove one of them");
}

void check_pace(double pace, const peer::SceneFile& scene) {
  using haptics::BodyWorld;
  if (pace == 0.0) return;
  if (!(pace >= BodyWorld::kLeastPace && pace <= BodyWorld::kMostPace))
    throw UsageError(fmt::format("--pace: {} is not from {} to {}", pace, BodyWorld::kLeastPace,
                                 BodyWorld::kMostPace));
  const auto moves = [](const haptics::SceneObject& object) { return object.matter.mass > 0; };
  if (std::ranges::none_of(scene.scene.objects, moves))
    throw UsageError("--pace: no object of the scene has a mass; remove the flag");
}

}  // namespace

std::optional<double> pace_of(const SceneOptions& options) noexcept {
  return options.pace > 0.0 ? std::optional(options.pace) : std::nullopt;
}

std::string refusal_of(const peer::StepTooDear& slow) {
  return slow.finding() +
         "; remove the costliest (`reckon scene explain` lists them), or add --even-if-slow";
}

bool draws_by_seed(const peer::ImpairmentLaw& law) noexcept {
  return law.jitter.count() > 0 || law.loss > 0 || law.burst_loss > 0 || law.reorder > 0 ||
         law.duplicate > 0;
}

peer::SceneFile load_scene(const SceneOptions& options, std::string_view shipped,
                           std::size_t hands) {
  check_files_given(options);
  peer::SceneFile scene;
  try {
    scene = options.is_received
                ? peer::load_received_scene(options.scene)
                : peer::load_scene_file(scene_path(options.scene, shipped), options.effects);
    if (!options.mesh.empty()) put_mesh(scene, options.mesh);
    if (!options.hand.empty()) put_trace(scene, options.hand);
    check_files(scene, hands);
    if (!options.key.empty()) scene.network.key = options.key;
    check_key(scene);
  } catch (const std::exception& error) {
    throw UsageError(error.what());
  }
  check_pace(options.pace, scene);
  if (!options.impair.empty()) scene.impairment.law = parse_impairment(options.impair);
  if (options.seed && !draws_by_seed(scene.impairment.law))
    throw UsageError("--seed needs a random impairment; add one, for example --impair 'loss=20%'");
  if (options.seed) scene.impairment.seed = *options.seed;
  if (!options.iface.empty()) scene.network.iface = options.iface;
  return scene;
}

}  // namespace reckon::tools
