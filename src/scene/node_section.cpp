// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// [[node]]: frames for objects and other nodes.
#include "reckon/peer/scene/node_section.hpp"

#include <fmt/format.h>

#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "reckon/peer/scene_graph/scene_nodes.hpp"

namespace reckon::peer {
namespace {

constexpr double kMostTurn = 4 * std::numbers::pi;

void check_node(TomlReader& table, NodeConfig& node) {
  table.require("name");
  if (table.has("name") && node.name.empty())
    table.problem("name", "a node needs a name: give it one");
  node.orientation = read_orientation(table);
  if (table.has("use")) {
    for (const char* key :
         {"kind", "shows", "turn_axis", "turn_rate", "swing", "swing_rate", "swing_phase"}) {
      if (table.has(key))
        table.problem(key, fmt::format("'{}' comes from '{}', which this node copies: remove the "
                                       "line, or write it at a parent node",
                                       key, node.use));
    }
    return;
  }
  const bool swings = !node.motion.swing.isZero(0.0);
  if (swings && node.motion.swing_rate == 0.0)
    table.problem("swing", "'swing' needs a 'swing_rate' above 0");
  for (const char* key : {"swing_rate", "swing_phase"}) {
    if (table.has(key) && !swings)
      table.problem(key, fmt::format("'{}' needs 'swing': add it", key));
  }
  if (table.has("turn_axis") && node.motion.turn_rate == 0.0)
    table.problem("turn_axis", "'turn_axis' needs a 'turn_rate' other than 0");
}

/// Objects below a time function are carried by it. Bodies move by forces, so they cannot be
/// carried.
void carry_moved(TomlReader& file, SceneFile& out) {
  for (const HungObject& hung : out.nodes.hung) {
    if (!hung.felt || !out.nodes.graph.moves(hung.node)) continue;
    haptics::SceneObject& object = out.scene.objects[hung.object];
    object.carried = true;
    const bool is_plane = std::holds_alternative<haptics::PlaneShape>(object.shape);
    if (!(object.matter.mass > 0) && !is_plane) continue;
    file.problem_at(
        fmt::format("object[{}].node", hung.table),
        is_plane ? fmt::format("'{}' is a plane, which cannot move: use a box, or another node",
                               object.name)
                 : fmt::format("'{}' is a body (mass), which forces move, and a function of time "
                               "moves its node: remove one of them",
                               object.name));
  }
}

}  // namespace

Section<NodeConfig> node_section() {
  using Config = NodeConfig;
  const auto no_turn = [](const Config&) { return Eigen::Vector3d(0, 0, 0); };
  const auto motion = [](auto member) { return in(&Config::motion, member); };
  return {
      {
          {"name", &Config::name, "required; unique among nodes"},
          {"parent", &Config::parent, "its parent node; absent: the scene, with frame S"},
          {"kind", &Config::kind,
           "group: all its children exist; switch: only the child named by `shows` exists; "
           "level_of_detail: its children show one object from near to far, and hands feel the "
           "first"},
          {"use", &Config::use,
           "copies that node and its children, with its own pose and scale: object \"cube\" of it "
           "is \"NAME/cube\""},
          {"shows", &Config::shows, "switch: name of the child that exists; absent: the first"},
          {"farthest", &Config::farthest, declared("m", 1e-4, kWorld),
           "child of a level_of_detail: greatest distance at which it is shown; absent: unbounded"},
          {"position", &Config::position, within("m", -kWorld, kWorld),
           "of its origin in the parent"},
          {"orientation", no_turn, within("rad", -kMostTurn, kMostTurn),
           "rotations about the parent's x, then y, then z axis"},
          {"scale", &Config::scale, within("", 1e-3, 1e3),
           "factor of all lengths of its children; masses and effects stay unchanged"},
          {"turn_axis", motion(&NodeMotion::turn_axis), within("", -1e6, 1e6),
           "axis of rotation through its origin, in its own axes"},
          {"turn_rate", motion(&NodeMotion::turn_rate), within("rad/s", -1e3, 1e3),
           "rate by the right-hand rule; 0: no rotation"},
          {"swing", motion(&NodeMotion::swing), within("m", -1e3, 1e3),
           "amplitude of its oscillation about `position`, in the parent's axes"},
          {"swing_rate", motion(&NodeMotion::swing_rate), within("Hz", 0, 1e3),
           "frequency of that sine"},
          {"swing_phase", motion(&NodeMotion::swing_phase), within("rad", -kMostTurn, kMostTurn),
           "of the sine at time 0"},
      },
      check_node};
}

void hang_objects(TomlReader& file, const std::vector<std::string>& hung_on, SceneFile& out) {
  std::vector<NodeProblem> problems;
  out.nodes = make_nodes(out.node_tables, hung_on, out.scene.objects, problems);
  for (NodeProblem& problem : problems) file.problem_at(problem.path, std::move(problem.sentence));
  carry_moved(file, out);
}

}  // namespace reckon::peer
