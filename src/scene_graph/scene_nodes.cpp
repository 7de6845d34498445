// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene_graph/scene_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "reckon/peer/notation/nearest_word.hpp"
#include "reckon/peer/scene_graph/scaled_shape.hpp"

namespace reckon::peer {
namespace {

/// Limit of problems with a suggestion, which searches all nodes.
constexpr std::size_t kMostLookUps = 10;
/// The root of a file's graph, the parent of nodes without one.
constexpr const char* kRoot = "";

std::string path_of_node(std::size_t node, std::string_view key) {
  return fmt::format("node[{}].{}", node, key);
}

std::string path_of_object(std::size_t table) { return fmt::format("object[{}].node", table); }

/// The declared nodes, by name, and their faults.
class WrittenNodes {
 public:
  WrittenNodes(std::span<const NodeConfig> nodes, std::span<const std::string> hung_on,
               std::vector<NodeProblem>& problems)
      : nodes_(nodes), problems_(problems), children_(nodes.size()), objects_(nodes.size()) {
    for (std::size_t node = 0; node < nodes.size(); ++node) places_.emplace(nodes[node].name, node);
    for (std::size_t node = 0; node < nodes.size(); ++node) {
      if (nodes[node].parent == kRoot)
        at_root_.push_back(node);
      else if (const auto parent = find(nodes[node].parent))
        children_[*parent].push_back(node);
    }
    for (std::size_t table = 0; table < hung_on.size(); ++table) hang(table, hung_on[table]);
  }

  /// Reports faults; original() may be called only if there are none.
  void check() {
    const std::size_t before = problems_.size();
    check_tree();
    for (std::size_t node = 0; node < nodes_.size(); ++node) check_use(node);
    if (problems_.size() == before) check_copies_end();
    if (problems_.size() == before) resolve_copies();
  }

  [[nodiscard]] const NodeConfig& operator[](std::size_t node) const { return nodes_[node]; }
  [[nodiscard]] const std::vector<std::size_t>& at_root() const { return at_root_; }
  [[nodiscard]] const std::vector<std::size_t>& children(std::size_t node) const {
    return children_[node];
  }
  [[nodiscard]] const std::vector<std::size_t>& objects(std::size_t node) const {
    return objects_[node];
  }
  /// The original of a chain of copies; else the node itself.
  [[nodiscard]] std::size_t original(std::size_t node) const { return originals_[node].node; }

  static GraphNode as_graph_node(const NodeConfig& config) {
    GraphNode node;
    node.name = config.name;
    node.parent = config.parent;
    node.kind = config.kind;
    node.pose = {config.position, config.scale, config.orientation};
    if (config.motion.moves()) node.motion = config.motion;
    node.shows = config.shows;
    node.farthest = config.farthest;
    return node;
  }

 private:
  /// The original of a node, and the number of `use` keys to it; 0: not yet known, 1: itself.
  struct Original {
    std::size_t node = 0, uses = 0;
  };

  [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const {
    const auto found = places_.find(name);
    return found == places_.end() ? std::nullopt : std::optional(found->second);
  }

  void problem(std::string path, std::string sentence) {
    problems_.push_back({std::move(path), std::move(sentence)});
  }

  [[nodiscard]] std::string unknown(std::string_view name) const {
    std::vector<std::string_view> known;
    if (problems_.size() < kMostLookUps)
      for (const NodeConfig& node : nodes_) known.push_back(node.name);
    const std::string_view nearest = nearest_word(name, known);
    if (!nearest.empty())
      return fmt::format("there is no node '{}' (did you mean '{}'?)", name, nearest);
    return fmt::format("there is no node '{}': write a [[node]] of that name, or name another",
                       name);
  }

  void hang(std::size_t table, const std::string& name) {
    if (name.empty()) return;
    const auto node = find(name);
    if (!node) return problem(path_of_object(table), unknown(name));
    const NodeConfig& on = nodes_[*node];
    if (!on.use.empty())
      return problem(path_of_object(table),
                     fmt::format("'{}' only copies '{}': use another node for the object, or '{}'",
                                 name, on.use, on.use));
    if (on.kind != NodeKind::group)
      return problem(
          path_of_object(table),
          fmt::format("'{}' chooses one of its children: use one of them for the object", name));
    objects_[*node].push_back(table);
  }

  void check_tree() {
    std::vector<GraphNode> tree(1);
    tree[0].name = kRoot;
    for (const NodeConfig& node : nodes_) tree.push_back(as_graph_node(node));
    for (GraphFault& fault : faults_of(tree)) {
      if (fault.node == 0) continue;
      const std::size_t node = fault.node - 1;
      const bool unknown_parent = fault.member == "parent" && !find(nodes_[node].parent);
      problem(path_of_node(node, fault.member == "motion" ? "turn_axis" : fault.member),
              unknown_parent ? unknown(nodes_[node].parent) : std::move(fault.sentence));
    }
  }

  void check_use(std::size_t node) {
    const NodeConfig& one = nodes_[node];
    if (one.use.empty()) return;
    if (!find(one.use)) return problem(path_of_node(node, "use"), unknown(one.use));
    for (const std::size_t child : children_[node])
      problem(path_of_node(child, "parent"),
              fmt::format("'{}' only copies '{}': give '{}' another parent", one.name, one.use,
                          nodes_[child].name));
  }

  /// A node that contains a copy of itself, at any depth, would be infinite.
  void check_copies_end() {
    enum : std::uint8_t { unseen, open, seen };
    std::vector<std::uint8_t> state(nodes_.size(), unseen);
    std::vector<std::size_t> from(nodes_.size());
    // A node stays on the stack below its content, and is finished when it is on top again.
    std::vector<std::pair<std::size_t, std::size_t>> steps;
    for (const std::size_t node : at_root_) steps.emplace_back(node, node);
    while (!steps.empty()) {
      const auto [node, before] = steps.back();
      if (state[node] != unseen) {
        state[node] = seen;
        steps.pop_back();
        continue;
      }
      state[node] = open;
      from[node] = before;
      for (const std::size_t held : held_by(node)) {
        if (state[held] == open)
          report_no_end(node, held, from);
        else
          steps.emplace_back(held, node);
      }
    }
  }

  /// Follows each chain of copies once.
  void resolve_copies() {
    originals_.resize(nodes_.size());
    std::vector<std::size_t> chain;
    for (std::size_t start = 0; start < nodes_.size(); ++start) {
      std::size_t node = start;
      for (; originals_[node].uses == 0 && !nodes_[node].use.empty();
           node = *find(nodes_[node].use))
        chain.push_back(node);
      if (originals_[node].uses == 0) originals_[node] = {node, 1};
      for (Original last = originals_[node]; !chain.empty(); chain.pop_back()) {
        ++last.uses;
        if (last.uses > kMostLevels) return report_long_chain(chain.back(), last.node);
        originals_[chain.back()] = last;
      }
    }
  }

  void report_long_chain(std::size_t node, std::size_t original) {
    problem(path_of_node(node, "use"),
            fmt::format("'{}' is a copy of a copy, more than {} times: name '{}' itself",
                        nodes_[node].name, kMostLevels, nodes_[original].name));
  }

  /// The children of a node, and the original of a copy.
  [[nodiscard]] std::vector<std::size_t> held_by(std::size_t node) const {
    std::vector<std::size_t> held = children_[node];
    if (!nodes_[node].use.empty()) held.push_back(*find(nodes_[node].use));
    return held;
  }

  /// @param node the last one of a cycle, which contains `held`; the fault is reported at the last
  /// copy in the cycle
  void report_no_end(std::size_t node, std::size_t held, const std::vector<std::size_t>& from) {
    while (nodes_[node].use != nodes_[held].name) held = std::exchange(node, from[node]);
    problem(path_of_node(node, "use"),
            fmt::format("'{}' copies its own ancestor '{}', which would not end: name another",
                        nodes_[node].name, nodes_[held].name));
  }

  std::span<const NodeConfig> nodes_;
  std::vector<NodeProblem>& problems_;
  std::map<std::string_view, std::size_t> places_;
  std::vector<std::size_t> at_root_;
  std::vector<std::vector<std::size_t>> children_, objects_;
  std::vector<Original> originals_;
};

/// A leaf whose object has no position in the scene yet.
struct Leaf {
  std::size_t in_list;             ///< in the expanded nodes
  std::size_t table;               ///< of the [[object]]
  std::optional<std::size_t> use;  ///< the outermost [[node]] with `use` that created it
  bool felt;
};

/// The nodes with copies in place of each `use`.
class Expansion {
 public:
  Expansion(const WrittenNodes& written, const std::vector<haptics::SceneObject>& objects,
            std::vector<NodeProblem>& problems)
      : written_(written), objects_(objects), problems_(problems) {
    nodes.emplace_back().name = kRoot;
    for (const std::size_t node : written.at_root()) add(node, {kRoot, "", {}, true, 2});
    report_names();
  }

  std::vector<GraphNode> nodes;
  std::vector<Leaf> leaves;

 private:
  /// Position of a new node.
  struct Place {
    std::string parent;
    std::string prefix;              ///< of names, from the copy that contains it
    std::optional<std::size_t> use;  ///< of that copy, the outermost
    bool felt;
    std::size_t level;
  };

  void add(std::size_t node, Place place) {
    const std::size_t original = written_.original(node);
    const bool is_copy = original != node;
    if (is_copy && !place.use) place.use = node;
    if (!has_room(path_of_node(node, "parent"), place)) return;
    const std::string name = place.prefix + written_[node].name;
    const std::string prefix = is_copy ? name + "/" : place.prefix;
    const NodeKind kind = written_[original].kind;
    const std::string shows = written_[original].shows;
    GraphNode made = WrittenNodes::as_graph_node(written_[original]);
    made.name = name;
    made.parent = place.parent;
    made.farthest = written_[node].farthest;
    if (!shows.empty()) made.shows = prefix + shows;
    if (is_copy) made.pose = WrittenNodes::as_graph_node(written_[node]).pose;
    sources_.emplace_back(node, place.use);
    nodes.push_back(std::move(made));
    for (const std::size_t table : written_.objects(original))
      add_leaf(table, {name, prefix, place.use, place.felt, place.level + 1});
    bool first = true;
    for (const std::size_t child : written_.children(original)) {
      const bool chosen =
          kind == NodeKind::group || (shows.empty() ? first : written_[child].name == shows);
      add(child, {name, prefix, place.use, place.felt && chosen, place.level + 1});
      first = false;
    }
  }

  void add_leaf(std::size_t table, const Place& place) {
    if (!has_room(path_of_object(table), place)) return;
    leaves.push_back({nodes.size(), table, place.use, place.felt});
    GraphNode& made = nodes.emplace_back();
    made.name = place.prefix + objects_[table].name;
    made.parent = place.parent;
    made.kind = NodeKind::content;
    made.pose = {objects_[table].pose.position, 1.0, objects_[table].pose.orientation};
    made.content.geometry = static_cast<std::uint32_t>(table);
    sources_.emplace_back(0, place.use);
  }

  /// Reports only the first node without room.
  bool has_room(std::string path, const Place& place) {
    if (is_full_) return false;
    const bool too_deep = place.level > kMostLevels;
    is_full_ = too_deep || nodes.size() >= kMostNodes;
    if (!is_full_) return true;
    problems_.push_back(
        {place.use ? path_of_node(*place.use, "use") : std::move(path),
         too_deep
             ? fmt::format("nodes are nested more than {} deep: give some a higher parent",
                           kMostLevels)
             : fmt::format(
                   "the scene has more than {} nodes and objects, including copies: copy fewer",
                   kMostNodes)});
    return false;
  }

  // Declared names are unique; so of two equal names one belongs to a copy.
  void report_names() {
    std::set<std::string_view> names, object_names;
    for (const haptics::SceneObject& object : objects_) object_names.insert(object.name);
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      const auto& [node, use] = sources_[i - 1];
      const bool leaf = nodes[i].kind == NodeKind::content;
      if (leaf && !use) continue;
      if ((leaf ? object_names : names).insert(nodes[i].name).second) continue;
      problems_.push_back(
          {use ? path_of_node(*use, "use") : path_of_node(node, "name"),
           fmt::format("there are two {} '{}', one of them in a copy: rename the other",
                       leaf ? "objects" : "nodes", nodes[i].name)});
    }
  }

  const WrittenNodes& written_;
  const std::vector<haptics::SceneObject>& objects_;
  std::vector<NodeProblem>& problems_;
  /// Per node except the root: the [[node]], and the outermost one with `use`.
  std::vector<std::pair<std::size_t, std::optional<std::size_t>>> sources_;
  bool is_full_ = false;
};

/// Final positions of the objects: felt objects of the file first, in its order.
std::vector<std::uint32_t> places_of(const std::vector<Leaf>& leaves, std::size_t objects) {
  std::vector<bool> taken_out(objects, false);
  for (const Leaf& leaf : leaves)
    if (!leaf.use && !leaf.felt) taken_out[leaf.table] = true;
  std::vector<std::uint32_t> of_table(objects, 0);
  std::uint32_t felt = 0, unfelt = 0;
  for (std::size_t table = 0; table < objects; ++table)
    of_table[table] = taken_out[table] ? 0 : felt++;
  std::vector<std::uint32_t> places;
  for (const Leaf& leaf : leaves)
    places.push_back(!leaf.felt ? unfelt++ : leaf.use ? felt++ : of_table[leaf.table]);
  return places;
}

}  // namespace

SceneNodes make_nodes(std::span<const NodeConfig> nodes, std::span<const std::string> hung_on,
                      std::vector<haptics::SceneObject>& objects,
                      std::vector<NodeProblem>& problems) {
  const std::size_t before = problems.size();
  WrittenNodes written(nodes, hung_on, problems);
  written.check();
  if (nodes.empty() || problems.size() > before) return {};
  Expansion expanded(written, objects, problems);
  if (problems.size() > before) return {};

  const std::vector<std::uint32_t> places = places_of(expanded.leaves, objects.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    expanded.nodes[expanded.leaves[i].in_list].content.index = places[i];
  SceneNodes made;
  made.graph = SceneGraph(expanded.nodes);
  std::vector<haptics::SceneObject> copies;
  std::vector<bool> taken_out(objects.size(), false);
  std::vector<haptics::SceneObject> hung = objects;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Leaf& leaf = expanded.leaves[i];
    const NodeIndex node = made.graph.place_of(leaf.in_list);
    haptics::SceneObject object = objects[leaf.table];
    object.name = made.graph.name(node);
    if (auto fault = put_at(made.graph.world(node), object))
      problems.push_back({path_of_object(leaf.table), std::move(*fault)});
    made.hung.push_back({node, places[i], static_cast<std::uint32_t>(leaf.table), leaf.felt});
    if (leaf.felt && made.graph.moves(node)) made.moved.push_back({places[i], node});
    if (!leaf.use) taken_out[leaf.table] = !leaf.felt;
    if (!leaf.felt)
      made.unfelt.push_back(std::move(object));
    else if (leaf.use)
      copies.push_back(std::move(object));
    else
      hung[leaf.table] = std::move(object);
  }
  if (problems.size() > before) return {};
  objects.clear();
  for (std::size_t table = 0; table < hung.size(); ++table)
    if (!taken_out[table]) objects.push_back(std::move(hung[table]));
  std::ranges::move(copies, std::back_inserter(objects));
  return made;
}

}  // namespace reckon::peer
