// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/scene_graph_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "reckon/peer/notation/units.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using peer::format_quantity;
using peer::NodeIndex;
using peer::NodeKind;
using peer::SceneGraph;

std::string vector_text(const Eigen::Vector3d& v) {
  return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", v.x(), v.y(), v.z());
}

/// "shut of open, shut".
std::string switch_text(const SceneGraph& graph, NodeIndex node) {
  std::vector<std::string> children;
  for (NodeIndex child = node + 1; child < graph.end(node); child = graph.end(child))
    children.push_back(graph.name(child));
  const NodeIndex chosen = graph.chosen(node);
  return fmt::format("{} shows {} of {}", graph.name(node),
                     chosen == peer::kNoNode ? "none" : graph.name(chosen),
                     children.empty() ? "none" : fmt::format("{}", fmt::join(children, ", ")));
}

/// "stone: fine to 1 m, coarse at any distance; hands feel fine".
std::string levels_text(const SceneGraph& graph, NodeIndex node) {
  std::string text = graph.name(node) + ":";
  for (NodeIndex child = node + 1; child < graph.end(node); child = graph.end(child)) {
    const double farthest = graph.farthest(child);
    text += fmt::format(
        " {} {},", graph.name(child),
        std::isfinite(farthest) ? "to " + format_quantity(farthest, "m") : "at any distance");
  }
  if (text.back() == ':') return text + " no level";
  text.back() = ';';
  return text + " hands feel " + graph.name(node + 1);
}

std::string motion_text(const SceneGraph& graph, NodeIndex node, const peer::NodeMotion& motion) {
  std::string text = graph.name(node);
  if (motion.turn_rate != 0.0)
    text += fmt::format(" turns by {}/s about {}", format_quantity(motion.turn_rate, "rad"),
                        vector_text(motion.turn_axis));
  if (motion.swing_rate != 0.0 && !motion.swing.isZero(0.0))
    text += fmt::format("{} swings by {} m at {}, from {}", motion.turn_rate != 0.0 ? "," : "",
                        vector_text(motion.swing), format_quantity(motion.swing_rate, "Hz"),
                        format_quantity(motion.swing_phase, "rad"));
  return text;
}

void add_procedures(const SceneGraph& graph, SettingRows& rows) {
  for (NodeIndex node = 0; node < graph.size(); ++node) {
    if (graph.kind(node) == NodeKind::switch_)
      rows.emplace_back("switch", switch_text(graph, node));
    if (graph.kind(node) == NodeKind::level_of_detail)
      rows.emplace_back("level of detail", levels_text(graph, node));
    if (const peer::NodeMotion* const motion = graph.motion(node))
      rows.emplace_back("time function", motion_text(graph, node, *motion));
  }
}

}  // namespace

std::size_t node_count(const peer::SceneFile& file) {
  const auto all = static_cast<std::size_t>(file.nodes.graph.size());
  return all == 0 ? 0 : all - 1 - file.nodes.hung.size();
}

SettingRows scene_graph_rows(const peer::SceneFile& file) {
  SettingRows rows;
  const peer::SceneNodes& nodes = file.nodes;
  if (nodes.graph.empty()) return rows;
  std::set<std::uint32_t> tables;
  for (const peer::HungObject& hung : nodes.hung) tables.insert(hung.table);
  rows.emplace_back("nodes", fmt::format("{}, {} levels with the scene and its objects",
                                         node_count(file), nodes.graph.depth()));
  rows.emplace_back("hang on them",
                    fmt::format("{}, {} of them from copies", counted(nodes.hung.size(), "object"),
                                nodes.hung.size() - tables.size()));
  for (const peer::NodeConfig& node : file.node_tables)
    if (!node.use.empty()) rows.emplace_back("copy", fmt::format("{} of {}", node.name, node.use));
  add_procedures(nodes.graph, rows);
  std::vector<std::string> unfelt;
  for (const haptics::SceneObject& object : nodes.unfelt) unfelt.push_back(object.name);
  if (!unfelt.empty())
    rows.emplace_back("not felt", fmt::format("{}: hidden by a switch, or a coarser level",
                                              fmt::join(unfelt, ", ")));
  return rows;
}

}  // namespace reckon::tools
