// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Any text as a scene file: it gives a scene of finite numbers within their limits, or throws
// SceneFileError with places inside the text. Its relative paths start at our own scenes.
#include <algorithm>
#include <cmath>
#include <string>

#include "reckon/peer/scene/belongings.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"

namespace reckon::fuzz {
namespace {

void check_problems(const peer::SceneFileError& error, std::string_view text) {
  require(!error.problems().empty(), "an error without a problem");
  const auto lines = static_cast<std::size_t>(std::ranges::count(text, '\n')) + 1;
  for (const peer::SceneProblem& problem : error.problems()) {
    require(!problem.sentence.empty(), "a problem without a sentence");
    require(problem.line <= lines, "a problem behind the last line");
  }
}

void check_belongings(const peer::SceneFile& file) {
  for (const peer::DeviceConfig& device : file.devices) {
    require(device.peer >= 1 && device.peer <= peer::kMostPeers, "a device of no peer");
    require(device.position.allFinite() && std::abs(device.orientation.norm() - 1) < 1e-9,
            "a device that stands nowhere");
    require(device.operator_number >= 1 && device.operator_number <= file.operators.size(),
            "a device that nobody holds");
    require(device.period.count() > 0 && device.delay_samples >= 0, "a servo out of time");
  }
  for (const peer::EntityConfig& entity : file.entities) {
    require(entity.peer >= 1 && entity.peer <= peer::kMostPeers, "an entity of no peer");
    require(entity.marking.size() <= 11, "a marking that does not fit");
    require(entity.position.allFinite() && std::abs(entity.orientation.norm() - 1) < 1e-9,
            "an entity that stands nowhere");
    require(!entity.model || entity.model->normal.allFinite(), "a force model without normal");
  }
  auto tracks = peer::tracks_of(file.entities);
  for (peer::EntityTrack& track : tracks) {
    require(deadreckon::is_finite(track.at(12.3)), "a track that leads nowhere");
  }
}

void check_scene(const peer::SceneFile& file) {
  require(std::isfinite(file.origin.latitude) && std::isfinite(file.origin.longitude) &&
              std::isfinite(file.origin.height),
          "an origin that is not finite");
  for (const haptics::SceneObject& object : file.scene.objects) {
    require(!object.name.empty(), "an object without a name");
    require(object.pose.position.allFinite() && object.pose.orientation.coeffs().allFinite(),
            "a pose that is not finite");
  }
  for (const peer::HungObject& hung : file.nodes.hung)
    require(hung.object < (hung.felt ? file.scene.objects : file.nodes.unfelt).size(),
            "a leaf without an object");
  check_belongings(file);
  require(file.network.group.is_multicast(), "a group that is none");
  require(scene_hash(file) == file.hash, "a scene hashes differently the second time");
}

}  // namespace

void check(std::span<const std::byte> input) {
  const std::string_view text = text_of(input);
  try {
    check_scene(peer::parse_scene_file(text, "fuzz.toml", RECKON_SCENES));
  } catch (const peer::SceneFileError& error) {
    check_problems(error, text);
  }
}

}  // namespace reckon::fuzz
