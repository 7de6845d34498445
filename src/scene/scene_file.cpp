// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/scene_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>
#include <tuple>
#include <type_traits>
#include <utility>

#include "reckon/haptics/effects/effect_types.hpp"
#include "reckon/peer/scene/prediction_reader.hpp"
#include "reckon/peer/scene/toml_reader.hpp"

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

/// What all sections need: the folder that relative paths start at.
struct Context {
  fs::path folder;
};

/// Reads a path; what cannot be opened is a problem, and so is a device, which may have no end.
void read_path(TomlReader& table, std::string_view key, const Context& context, fs::path& target) {
  std::string text;
  if (!table.text(key, text)) return;
  if (text.empty()) {
    return table.problem(key, fmt::format("'{}' is empty; it wants a file's name", key));
  }
  const fs::path path = fs::absolute(context.folder / text).lexically_normal();
  std::error_code error;
  if (!fs::is_regular_file(path, error) || !std::ifstream(path)) {
    return table.problem(key,
                         fmt::format("'{}': cannot read {}; relative names start at the folder "
                                     "of the scene file",
                                     key, path.string()));
  }
  target = path;
}

/// Which of `keys` the table has; anything but exactly one is a problem.
std::string only_one(TomlReader& table, std::initializer_list<std::string_view> keys,
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

void read_scene(TomlReader& table, SceneFile& out) {
  table.text("name", out.name);
  if (auto origin = table.table("origin")) {
    origin->number("latitude", out.origin.latitude);
    origin->number("longitude", out.origin.longitude);
    origin->number("height", out.origin.height);
  }
}

haptics::MeshShape read_mesh(TomlReader& table, const Context& context) {
  haptics::MeshShape mesh;
  read_path(table, "mesh", context, mesh.file);
  table.number("scale_to", mesh.scale_to);
  table.boolean("centre", mesh.centre);
  for (const char* key : {"scale_to", "centre"}) {
    if (!table.has(key) || table.has("mesh")) continue;
    table.problem(key, fmt::format("only a mesh takes '{}'; this object has none", key));
  }
  return mesh;
}

haptics::Shape read_box(TomlReader& table) {
  haptics::BoxShape box;
  table.point("box", box.size);
  if (box.size.minCoeff() <= 0)
    table.problem("box", "'box' has an edge that is not longer than 0 m");
  return box;
}

haptics::Shape read_plane(TomlReader& table) {
  haptics::PlaneShape plane;
  table.point("plane", plane.normal);
  if (plane.normal.norm() < 1e-6) {
    table.problem("plane", "'plane' has no direction: write its outward normal, as [0, 0, 1]");
  }
  return plane;
}

haptics::Shape read_shape(TomlReader& table, const Context& context) {
  const std::string kind = only_one(table, {"mesh", "plane", "sphere", "box"}, "the shape");
  const haptics::MeshShape mesh = read_mesh(table, context);
  if (kind == "mesh") return mesh;
  if (kind == "box") return read_box(table);
  if (kind == "plane") return read_plane(table);
  haptics::SphereShape sphere;
  table.number("sphere", sphere.radius);
  return sphere;
}

haptics::ObjectPose read_pose(TomlReader& table) {
  haptics::ObjectPose pose;
  table.point("position", pose.position);
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();
  table.point("orientation", angles);
  pose.orientation = Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()) *
                     Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX());
  return pose;
}

/// One effect of an object, by the effect's own table.
template <class Effect>
void read_effect(TomlReader& object_table, haptics::SceneObject& object) {
  auto table = object_table.table(Effect::kKey);
  if (!table) return;
  auto& values = object.effects.declare<Effect>();
  for (const auto& row : Effect::kParameters) table->number(row.key, values.*row.field);
  try {
    const Effect checked(values);  // what one table row cannot say
  } catch (const std::invalid_argument& error) {
    object_table.problem(Effect::kKey, error.what());
  }
}

haptics::SceneObject read_object(TomlReader& table, const Context& context) {
  haptics::SceneObject object;
  table.require("name");
  table.text("name", object.name);
  object.shape = read_shape(table, context);
  object.pose = read_pose(table);
  haptics::for_each_effect(
      [&]<class Effect>(std::type_identity<Effect>) { read_effect<Effect>(table, object); });
  return object;
}

void read_objects(TomlReader& file, const Context& context, SceneFile& out) {
  std::set<std::string> names;
  for (TomlReader& table : file.tables("object")) {
    haptics::SceneObject object = read_object(table, context);
    if (!object.name.empty() && !names.insert(object.name).second) {
      table.problem("name", fmt::format("there is another object '{}': give it a name of its own",
                                        object.name));
    }
    out.scene.objects.push_back(std::move(object));
  }
}

void read_hand(TomlReader& table, HandModel& hand) {
  table.number("radius", hand.radius);
  table.number("k1", hand.k1);
  table.number("k3", hand.k3);
  table.number("damping", hand.damping);
  table.number("static_friction", hand.static_friction);
  table.number("kinetic_friction", hand.kinetic_friction);
  table.duration("validity", hand.validity);
  if (hand.kinetic_friction > hand.static_friction) {
    table.problem("kinetic_friction",
                  fmt::format("'kinetic_friction' ({}) is above 'static_friction' ({}): lower it",
                              hand.kinetic_friction, hand.static_friction));
  }
}

void read_sweep(TomlReader& table, OperatorConfig& out) {
  table.point("from", out.from);
  table.point("to", out.to);
  table.duration("period", out.period);
}

OperatorConfig read_operator(TomlReader& table, const Context& context) {
  OperatorConfig out;
  const std::string kind = only_one(table, {"trace", "passive", "sweep"}, "what moves the hand");
  if (kind == "trace") out.kind = OperatorKind::trace;
  if (kind == "sweep") out.kind = OperatorKind::sweep;
  read_path(table, "trace", context, out.trace);
  if (auto sweep = table.table("sweep")) read_sweep(*sweep, out);
  bool passive = true;
  table.boolean("passive", passive);
  if (!passive) table.problem("passive", "'passive' is false: take the line out, or say true");
  table.point("position", out.position);
  table.number("speed", out.speed);
  table.duration("start", out.start);
  table.number("stiffness", out.stiffness);
  table.number("damping", out.damping);
  return out;
}

void read_aoim(TomlReader& table, AoimConfig& out) {
  if (const auto word = table.choice("scheme")) {
    out.scheme = *word == "square" ? CellScheme::square : CellScheme::hexagonal;
  }
  table.number("cell", out.cell);
  table.number("radius", out.radius);
  table.integer("pool", out.pool);
}

void read_group(TomlReader& table, GroupAddress& group) {
  std::string text = group.address_text();
  table.text("group", text);
  std::uint16_t port = group.port;
  table.integer("port", port);
  const auto parsed = GroupAddress::parse(text, port);
  if (!parsed || !parsed->is_multicast()) {
    return table.problem("group",
                         fmt::format("'group' is \"{}\"; it wants a multicast address such "
                                     "as \"239.192.1.0\" or \"ff15::c0:100\"",
                                     text));
  }
  if (parsed->port != port) {
    return table.problem("group", "'group' has a port in it: write it as 'port'");
  }
  group = *parsed;
}

void read_network(TomlReader& table, NetworkConfig& out) {
  read_group(table, out.group);
  table.boolean("interop", out.interop);
  table.integer("exercise", out.exercise);
  table.integer("ttl", out.ttl);
  table.text("iface", out.iface);
  if (auto bundle = table.table("bundle")) {
    double octets = static_cast<double>(out.bundle_max);
    bundle->number("max", octets);
    out.bundle_max = static_cast<std::size_t>(octets);
    bundle->duration("hold", out.bundle_hold);
  }
}

void read_impairment(TomlReader& table, ImpairmentConfig& out) {
  table.duration("delay", out.law.delay);
  table.duration("jitter", out.law.jitter);
  table.number("loss", out.law.loss);
  table.number("burst_loss", out.law.burst_loss);
  table.number("burst_length", out.law.burst_length);
  table.number("reorder", out.law.reorder);
  table.duration("reorder_delay", out.law.reorder_delay);
  table.number("duplicate", out.law.duplicate);
  table.integer("seed", out.seed);
  for (TomlReader& row : table.tables("outage")) {
    Outage& outage = out.law.outages.emplace_back();
    row.duration("start", outage.start);
    row.duration("duration", outage.duration);
    row.duration("period", outage.period);
  }
  if (const std::string problem = out.law.problem(); !problem.empty()) table.problem("", problem);
}

void read_file(TomlReader& file, const Context& context, SceneFile& out) {
  if (auto table = file.table("scene")) read_scene(*table, out);
  read_objects(file, context, out);
  if (auto table = file.table("hand")) read_hand(*table, out.hand);
  for (TomlReader& table : file.tables("operator")) {
    out.operators.push_back(read_operator(table, context));
  }
  if (auto table = file.table("dead_reckoning")) read_dead_reckoning(*table, out.dead_reckoning);
  if (auto table = file.table("convergence")) read_convergence(*table, out.convergence);
  if (auto table = file.table("aoim")) read_aoim(*table, out.aoim);
  if (auto table = file.table("network")) read_network(*table, out.network);
  if (auto table = file.table("impairment")) read_impairment(*table, out.impairment);
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
    (void)GroupPool(scene.network.group, scene.aoim.pool);
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

}  // namespace

SceneFileError::SceneFileError(const std::string& file, std::vector<SceneProblem> problems)
    : std::runtime_error(join_problems(file, problems)), problems_(std::move(problems)) {}

SceneFile parse_scene_file(std::string_view text, const std::string& file,
                           const std::filesystem::path& folder) {
  const toml::table document = parse_toml(text, file);
  std::vector<SceneProblem> problems;
  SceneFile scene;
  TomlReader reader(document, "", problems);
  read_file(reader, {folder}, scene);
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
