// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/scene_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <system_error>
#include <type_traits>
#include <utility>

#include "reckon/haptics/input_files/load_budget.hpp"
#include "reckon/peer/scene/node_section.hpp"
#include "reckon/peer/scene/scene_extent.hpp"
#include "reckon/peer/scene/scene_sections.hpp"
#include "reckon/peer/scene/toml_bounds.hpp"

namespace reckon::peer {
namespace {

namespace fs = std::filesystem;

std::string join_problems(const std::string& file, const std::vector<SceneProblem>& problems) {
  std::string text;
  for (const SceneProblem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += problem.line == 0
                ? fmt::format("{}: {}", file, problem.sentence)
                : fmt::format("{}:{}:{}: {}", file, problem.line, problem.column, problem.sentence);
  }
  return text;
}

/// Sorted, so that a scene does not depend on the program's order of effects.
SceneVocabulary vocabulary_of(const haptics::CustomEffects& effects) {
  SceneVocabulary vocabulary{scene_keys(), effects};
  std::ranges::stable_sort(vocabulary.effects, {},
                           [](const auto& effect) { return effect->key(); });
  add_custom_effects(vocabulary.effects, vocabulary.keys);
  return vocabulary;
}

/// Checks that the group of the pool's last cell exists.
void check_pool(const SceneFile& scene, std::vector<SceneProblem>& problems) {
  try {
    (void)GroupPool(scene.network.group, scene.aoim.all_groups());
  } catch (const std::invalid_argument& error) {
    problems.push_back({0, 0, error.what()});
  }
}

/// Checks that a rule and the parameters used only by it appear together.
template <class Rule>
void check_rule(TomlReader& table, const DeadReckoningConfig& config) {
  const auto& values = config.thresholds.of<Rule>();
  for (const auto& row : Rule::kParameters) {
    const double value = values.*row.field;
    if (config.rule->name == Rule::kName && value == 0 && row.default_value == 0) {
      table.problem("rule", fmt::format("rule '{}' needs '{}' above 0", Rule::kName, row.key));
    }
    if (config.rule->name != Rule::kName && value != row.default_value) {
      table.problem(row.key,
                    fmt::format("'{1}' needs the rule '{0}': write rule = \"{0}\", or remove '{1}'",
                                Rule::kName, row.key));
    }
  }
}

}  // namespace

std::string only_one(TomlReader& table, const std::vector<std::string_view>& keys,
                     std::string_view what) {
  std::vector<std::string_view> found;
  std::ranges::copy_if(keys, std::back_inserter(found), [&](auto key) { return table.has(key); });
  if (found.size() == 1) return std::string(found.front());
  table.problem(
      found.empty() ? std::string_view() : found.back(),
      found.empty()
          ? fmt::format("{} is missing: give one of {}", what, fmt::join(keys, ", "))
          : fmt::format("{} is given twice, by {}: keep one", what, fmt::join(found, " and ")));
  return {};
}

Eigen::Quaterniond read_orientation(TomlReader& table) {
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();
  table.read("orientation", angles);
  return Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX());
}

namespace {

// Any peer may own the bodies and move them by its hands.
void check_bodies(TomlReader& file, const SceneFile& scene) {
  const auto moves = [](const haptics::SceneObject& object) { return object.matter.mass > 0; };
  const auto body = std::ranges::find_if(scene.scene.objects, moves);
  if (body == scene.scene.objects.end()) return;
  if (std::ranges::find(scene.devices, 1, &DeviceConfig::peer) == scene.devices.end()) {
    file.problem_at(fmt::format("object[{}].mass", body - scene.scene.objects.begin()),
                    "a scene with bodies (mass) needs a hand that moves them: add a [[device]] of "
                    "peer 1");
    return;
  }
  const auto differs = [](const DeviceConfig& one, const DeviceConfig& other) {
    return one.peer == other.peer && one.period != other.period;
  };
  for (const DeviceConfig& device : scene.devices) {
    const auto same = [&](const DeviceConfig& other) { return !differs(device, other); };
    if (std::ranges::all_of(scene.devices, same)) continue;
    file.problem("device",
                 "devices of different rates cannot push the same bodies: give all devices of a "
                 "peer the same rate");
    return;
  }
}

}  // namespace

void check_file(TomlReader& file, SceneFile& out) {
  const Section<haptics::SceneObject> section = object_section();
  std::set<std::string> names;
  std::vector<std::string> hung_on;
  for (TomlReader& table : file.tables("object")) {
    haptics::SceneObject& object = out.scene.objects.emplace_back();
    section.read(table, object);
    table.read("node", hung_on.emplace_back());
    if (!object.name.empty() && !names.insert(object.name).second) {
      table.problem("name", fmt::format("there is another object '{}': rename one", object.name));
    }
  }
  hang_objects(file, hung_on, out);
  read_regions(file, out);
  read_devices(file, out);
  read_entities(file, out);
  check_bodies(file, out);
  set_reach_by_extent(out, {file.has("aoim", "cell"), file.has("aoim", "radius")});
  check_aoim_of(file, out);
}

void check_hand(TomlReader& table, HandModel& hand) {
  if (hand.kinetic_friction > hand.static_friction) {
    table.problem("kinetic_friction",
                  fmt::format("'kinetic_friction' ({}) is above 'static_friction' ({}): lower it",
                              hand.kinetic_friction, hand.static_friction));
  }
}

void check_dead_reckoning(TomlReader& table, DeadReckoningConfig& config) {
  deadreckon::for_each_send_rule(
      [&]<class Rule>(std::type_identity<Rule>) { check_rule<Rule>(table, config); });
}

void check_operator(TomlReader& table, OperatorConfig& config) {
  const std::string kind = only_one(table, words_of<OperatorKind>(), "what moves the hand");
  config.kind = value_of<OperatorKind>(kind).value_or(config.kind);
  bool passive = true;
  table.read("passive", passive);
  if (!passive) table.problem("passive", "'passive' is false: remove the line, or write true");
}

SceneFileError::SceneFileError(const std::string& file, std::vector<SceneProblem> problems)
    : std::runtime_error(join_problems(file, problems)), problems_(std::move(problems)) {}

namespace {

SceneFile parse(std::string_view text, const std::string& file, const fs::path& folder,
                SceneVocabulary vocabulary) {
  const haptics::LoadBudget budget;
  const toml::table document = parse_toml(text, file);
  std::vector<SceneProblem> problems;
  SceneFile scene;
  vocabulary.files = &scene.files;
  TomlReader reader(document, "", folder, vocabulary, problems);
  file_section().read(reader, scene);
  if (problems.empty()) check_pool(scene, problems);
  throw_problems(file, std::move(problems));
  if (scene.name.empty()) scene.name = fs::path(file).stem().string();
  scene.scene.name = scene.name;
  scene.hash = scene.hash_in_file = scene_hash(scene);
  return scene;
}

SceneFile load(const fs::path& path, SceneVocabulary vocabulary) {
  std::error_code error;
  if (!fs::exists(path, error))
    throw SceneFileError(
        path.string(),
        {{0, 0, "there is no such file; name a scene file, for example scenes/two_hands.toml"}});
  if (fs::is_directory(path, error)) throw SceneFileError(path.string(), {{0, 0, "is a folder"}});
  SceneFile scene = parse(read_bytes(path, kMostTomlOctets), path.string(), path.parent_path(),
                          std::move(vocabulary));
  scene.path = path;
  return scene;
}

}  // namespace

SceneFile parse_scene_file(std::string_view text, const std::string& file,
                           const std::filesystem::path& folder,
                           const haptics::CustomEffects& effects) {
  return parse(text, file, folder, vocabulary_of(effects));
}

SceneFile load_scene_file(const std::filesystem::path& path,
                          const haptics::CustomEffects& effects) {
  return load(path, vocabulary_of(effects));
}

SceneFile load_received_scene(const std::filesystem::path& path) {
  SceneVocabulary vocabulary = vocabulary_of({});
  vocabulary.is_confined = true;
  return load(path, std::move(vocabulary));
}

}  // namespace reckon::peer
