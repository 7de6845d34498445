// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/scene_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>
#include <tuple>
#include <type_traits>
#include <utility>

#include "reckon/haptics/effects/effect_types.hpp"
#include "reckon/peer/scene/beacon_names.hpp"
#include "reckon/peer/scene/scene_sections.hpp"
#include "reckon/peer/scene/solid_section.hpp"

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

/// The parameters of an effect, by the effect's own table.
template <class Effect>
void read_parameters(TomlReader& owner, TomlReader& table, typename Effect::Parameters& values) {
  for (const auto& row : Effect::kParameters) table.number(row.key, values.*row.field);
  try {
    const Effect checked(values);  // what one table row cannot say
  } catch (const std::invalid_argument& error) {
    owner.problem(Effect::kKey, error.what());
  }
}

/// One effect of an object.
template <class Effect>
void read_effect(TomlReader& object_table, haptics::SceneObject& object) {
  auto table = object_table.table(Effect::kKey);
  if (table) read_parameters<Effect>(object_table, *table, object.effects.declare<Effect>());
}

/// What a patch does not say is the object's.
void read_patches(TomlReader& object_table, haptics::SceneObject& object) {
  const Section<haptics::SurfacePatch> section = patch_section();
  std::set<std::string> names;
  for (TomlReader& table : object_table.tables("patch")) {
    haptics::SurfacePatch& patch = object.patches.emplace_back();
    patch.surface = object.effects.of<haptics::SpringDamper>();
    patch.friction = object.effects.of<haptics::StickSlipFriction>();
    section.read(table, patch);
    if (!patch.name.empty() && !names.insert(patch.name).second) {
      table.problem("name", fmt::format("there is another patch '{}': keep one", patch.name));
    }
  }
}

void check_shape(TomlReader& table, const haptics::Shape& shape) {
  (void)only_one(
      table, {"mesh", "plane", "sphere", "box", "cylinder", "cone", "torus", "ellipsoid", "part"},
      "the shape");
  for (const char* key : {"scale_to", "centre", "patch"}) {
    if (!table.has(key) || table.has("mesh")) continue;
    table.problem(key, fmt::format("only a mesh takes '{}'; this object has none", key));
  }
  const auto* box = std::get_if<haptics::BoxShape>(&shape);
  if (box != nullptr && box->size.minCoeff() <= 0) {
    table.problem("box", "'box' has an edge that is not longer than 0 m");
  }
  const auto* plane = std::get_if<haptics::PlaneShape>(&shape);
  if (plane != nullptr && plane->normal.norm() < 1e-6) {
    table.problem("plane", "'plane' has no direction: write its outward normal, as [0, 0, 1]");
  }
}

toml::table parse_toml(std::string_view text, const std::string& file) {
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    const auto& where = error.source().begin;
    throw SceneFileError(file, {{where.line, where.column, std::string(error.description())}});
  }
}

/// The number of the group that the last cell of the pool uses must exist.
void check_pool(const SceneFile& scene, std::vector<SceneProblem>& problems) {
  try {
    (void)GroupPool(scene.network.group, scene.aoim.all_groups());
  } catch (const std::invalid_argument& error) {
    problems.push_back({0, 0, error.what()});
  }
}

std::string read_bytes(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream) throw SceneFileError(path.string(), {{0, 0, "cannot be read"}});
  return bytes;
}

/// A rule and the quantities that it alone looks at belong together.
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
                    fmt::format("only the rule '{0}' takes '{1}': write rule = \"{0}\", or "
                                "take '{1}' out",
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

void check_object(TomlReader& table, haptics::SceneObject& object) {
  table.require("name");
  check_shape(table, object.shape);
  check_solid(table, object);
  object.pose.orientation = read_orientation(table);
  haptics::for_each_effect(
      [&]<class Effect>(std::type_identity<Effect>) { read_effect<Effect>(table, object); });
  read_patches(table, object);
}

void check_patch(TomlReader& table, haptics::SurfacePatch& patch) {
  using haptics::SpringDamper;
  using haptics::StickSlipFriction;
  table.require("name");
  if (auto surface = table.table(SpringDamper::kKey)) {
    read_parameters<SpringDamper>(table, *surface, patch.surface);
  }
  if (auto friction = table.table(StickSlipFriction::kKey)) {
    if (!patch.friction) patch.friction.emplace();
    read_parameters<StickSlipFriction>(table, *friction, *patch.friction);
  }
}

/// What leaders cannot be had with.
void check_leaders(TomlReader& file, const SceneFile& scene) {
  if (scene.aoim.hand_out && !scene.aoim.leaders)
    file.problem("aoim", "'hand_out' wants somebody who hands out: set 'leaders', or take it out");
  if (!scene.aoim.follow.empty() && !scene.aoim.hand_out) {
    file.problem("aoim",
                 "'follow' finds beacons in the map of groups that are handed out: set 'leaders' "
                 "and 'hand_out', or take it out");
  }
  if (!scene.aoim.leaders) return;
  if (scene.network.interop)
    file.problem("aoim",
                 "'leaders' of cells say what 'interop' wants unsaid: take one of them out");
  if (scene.network.compression != pdu::CompressedForm::none) {
    file.problem(
        "aoim",
        "'leaders' tell late comers plain states, which 'compression' leaves out: take one "
        "of them out");
  }
  if (scene.aoim.awareness.channels) {
    file.problem("aoim",
                 "'leaders' tell late comers the last state heard, which 'channels' may have left "
                 "parts out of: take one of them out");
  }
}

/// What groups for what is felt and for near rows of the channels cannot be had with.
void check_more_groups(TomlReader& file, const SceneFile& scene) {
  const AoimConfig& aoim = scene.aoim;
  const std::string_view which = aoim.contact_groups ? "contact_groups" : "near_groups";
  const auto refuse = [&](std::string_view what) {
    file.problem("aoim", fmt::format("'{}' {}", which, what));
  };
  if (!aoim.contact_groups && !aoim.near_groups) return;
  if (scene.network.interop)
    refuse("are more than the one group of 'interop': take one of them out");
  if (aoim.hand_out) refuse("are those of the fixed tile, 'hand_out' has none: take one out");
  const std::size_t most = aoim::kMaximumPool / (aoim.all_groups() / aoim.pool);
  if (aoim.pool == 1)
    refuse(fmt::format("are told apart by cells, and a 'pool' of 1 has none: take 4 to {}", most));
  if (aoim.pool > most)
    refuse(fmt::format("are as many again as the 'pool': take one of 4 to {}", most));
}

/// What near groups want of the channels.
void check_near_groups(TomlReader& file, const SceneFile& scene) {
  const AoimConfig& aoim = scene.aoim;
  const auto refuse = [&](const char* what) { file.problem("aoim", what); };
  if (!aoim.near_groups) return;
  if (!aoim.awareness.channels)
    return refuse("'near_groups' are of use with 'channels' alone: set it, too");
  const aoim::ChannelTable table(aoim.awareness.table());
  if (table.near_rows() == 0)
    return refuse("'near_groups' want a row of 'channel' that is not 'kept', before the last");
  if (scene.network.compression == pdu::CompressedForm::residual)
    refuse(
        "'near_groups' are heard by some alone, and the residual form leans on what all have "
        "heard: take another 'compression'");
  if (table.channel(table.kept_rows()).coarser > 1.0)
    refuse("'near_groups' want thresholds of the scene in the nearest row: a 'coarser' of 1");
}

/// Walls are heard by groups.
void check_locales(TomlReader& file, const SceneFile& scene) {
  if (scene.network.interop && scene.aoim.scheme == aoim::CellScheme::locales)
    file.problem("aoim",
                 "'locales' are told apart by groups, and 'interop' has one: take one of them out");
}

void check_file(TomlReader& file, SceneFile& out) {
  const Section<haptics::SceneObject> section = object_section();
  std::set<std::string> names;
  for (TomlReader& table : file.tables("object")) {
    haptics::SceneObject& object = out.scene.objects.emplace_back();
    section.read(table, object);
    if (!object.name.empty() && !names.insert(object.name).second) {
      table.problem("name", fmt::format("there is another object '{}': give it a name of its own",
                                        object.name));
    }
  }
  read_devices(file, out);
  read_entities(file, out);
  check_leaders(file, out);
  check_more_groups(file, out);
  check_near_groups(file, out);
  check_locales(file, out);
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
  if (!passive) table.problem("passive", "'passive' is false: take the line out, or say true");
}

void check_aoim(TomlReader& table, AoimConfig& config) {
  check_awareness(table, config.awareness);
  check_cells(table, config);
  try {
    static_cast<void>(beacon_names(config.follow));
  } catch (const std::invalid_argument& error) {
    table.problem("follow", fmt::format("'follow': {}", error.what()));
  }
  if (aoim::is_pool(config.pool)) return;
  table.problem("pool", fmt::format("'pool' is {}: {}", config.pool, aoim::kPoolRemedy));
}

namespace {

void check_management(TomlReader& table, NetworkConfig& config) {
  std::string text = config.management.text();
  table.read("allow_management", text);
  if (const auto rule = ManagementRule::parse(text)) {
    config.management = *rule;
  } else {
    table.problem("allow_management",
                  fmt::format("'allow_management' is \"{}\"; it wants nobody, members, anyone, or "
                              "site:application such as \"1:2, 40:1\"",
                              text));
  }
}

void check_peers(TomlReader& table, NetworkConfig& config) {
  table.each_text("peers",
                  [&](const std::string& text) { config.peers.push_back(parse_peer(text)); });
  try {
    check_number(config.peers);
  } catch (const std::invalid_argument& error) {
    table.problem("peers", fmt::format("'peers': {}", error.what()));
  }
}

}  // namespace

void check_network(TomlReader& table, NetworkConfig& config) {
  config.exercise_named = table.has("exercise");
  check_management(table, config);
  check_peers(table, config);
  std::string text = config.group.address_text();
  table.read("group", text);
  std::uint16_t port = config.group.port;
  table.read("port", port);
  const auto parsed = GroupAddress::parse(text, port);
  if (!parsed || !(parsed->is_multicast() || parsed->is_broadcast())) {
    return table.problem("group",
                         fmt::format("'group' is \"{}\"; it wants a multicast address such "
                                     "as \"239.192.1.0\" or \"ff15::c0:100\", or "
                                     "\"255.255.255.255\" with 'interop'",
                                     text));
  }
  if (parsed->is_broadcast() && !config.interop) {
    return table.problem("group",
                         "'group' is broadcast, which has no groups for cells: set 'interop', or "
                         "take a multicast address");
  }
  if (parsed->port != port) {
    return table.problem("group", "'group' has a port in it: write it as 'port'");
  }
  config.group = *parsed;
  if (config.compression != pdu::CompressedForm::none && config.interop) {
    table.problem("compression",
                  "'compression' makes what 'interop' wants plain: take one of them out");
  }
  if (!config.key.empty() && config.interop) {
    table.problem("key", "'key' seals what 'interop' wants plain: take one of them out");
  }
}

void check_impairment(TomlReader& table, ImpairmentConfig& config) {
  const std::string problem = config.law.problem();
  if (!problem.empty()) table.problem("", problem);
}

void refuse_baseline(const SceneFile& scene) {
  if (scene.coupling.mode == haptics::CouplingMode::reckon) return;
  throw SceneFileError(
      scene.path.empty() ? scene.name : scene.path.string(),
      {{0, 0,
        fmt::format("[coupling] mode = \"{}\" is a baseline for studies of simulated devices; what "
                    "renders to hands runs \"reckon\" alone: take the key out, or run the scene "
                    "with `reckon bench stability`",
                    haptics::name_of(scene.coupling.mode))}});
}

SceneFileError::SceneFileError(const std::string& file, std::vector<SceneProblem> problems)
    : std::runtime_error(join_problems(file, problems)), problems_(std::move(problems)) {}

SceneFile parse_scene_file(std::string_view text, const std::string& file,
                           const std::filesystem::path& folder) {
  const toml::table document = parse_toml(text, file);
  std::vector<SceneProblem> problems;
  SceneFile scene;
  TomlReader reader(document, "", folder, problems);
  file_section().read(reader, scene);
  if (problems.empty()) check_pool(scene, problems);
  if (!problems.empty()) {
    std::ranges::stable_sort(problems, {}, [](const SceneProblem& problem) {
      return std::tuple(problem.line, problem.column);
    });
    throw SceneFileError(file, std::move(problems));
  }
  if (scene.name.empty()) scene.name = fs::path(file).stem().string();
  scene.scene.name = scene.name;
  scene.hash = scene_hash(scene);
  return scene;
}

SceneFile load_scene_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!fs::exists(path, error))
    throw SceneFileError(
        path.string(),
        {{0, 0, "there is no such file; name a scene file, as in scenes/two_hands.toml"}});
  if (fs::is_directory(path, error)) throw SceneFileError(path.string(), {{0, 0, "is a folder"}});
  SceneFile scene = parse_scene_file(read_bytes(path), path.string(), path.parent_path());
  scene.path = path;
  return scene;
}

}  // namespace reckon::peer
