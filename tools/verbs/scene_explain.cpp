// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/scene_explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "reckon/haptics/effects/effect_hooks.hpp"
#include "reckon/haptics/effects/effect_types.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/network/host_limits.hpp"
#include "reckon/peer/peer.hpp"
#include "reckon/peer/scene/entity_type_text.hpp"
#include "reckon/peer/scene/scene_words.hpp"
#include "reckon/peer/scene/units.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"
#include "reckon/tools/verbs/scene_cells_text.hpp"
#include "reckon/tools/verbs/scene_meshes.hpp"
#include "reckon/tools/verbs/scene_peers.hpp"
#include "reckon/tools/verbs/scene_stiffness.hpp"

namespace reckon::tools {
namespace {

using peer::format_quantity;

/// An effect that an object does without, and what one would write to have it.
struct LeftOut {
  std::string effect;
  std::string object;
  std::string declaration;
};

template <class Effect>
std::string declaration_of() {
  std::string inside;
  for (const auto& row : Effect::kParameters) {
    const std::string value = format_quantity(row.default_value, row.unit);
    inside += fmt::format(fmt::runtime(row.unit.empty() ? "{}{} = {}" : "{}{} = \"{}\""),
                          inside.empty() ? "" : ", ", row.key, value);
  }
  return fmt::format("{} = {{ {} }}", Effect::kKey, inside);
}

/// All pairs of effect and object that the plan does not have.
std::vector<LeftOut> left_out(const LoadedScene& scene,
                              const std::vector<haptics::PlanStage>& stages) {
  std::vector<LeftOut> rows;
  const auto has = [&](std::string_view stage, const std::string& object) {
    for (const haptics::PlanStage& row : stages) {
      if (row.name == stage && row.object == object) return true;
    }
    return false;
  };
  haptics::for_each_effect([&]<class Effect>(std::type_identity<Effect>) {
    for (const haptics::SceneObject& object : scene.file.scene.objects) {
      if (has(Effect::kName, object.name)) continue;
      rows.push_back({std::string(Effect::kName), object.name, declaration_of<Effect>()});
    }
  });
  return rows;
}

std::string duration_of(std::chrono::nanoseconds duration) {
  return format_quantity(pdu::to_seconds(duration), "s");
}

/// How remote entities are shown.
std::string shown_as(const peer::ConvergenceConfig& config) {
  const auto& settings = config.settings;
  return fmt::format("{} in {}, at once from {}; follows {}", peer::word_of(settings.curve),
                     format_quantity(settings.duration, "s"),
                     format_quantity(settings.teleport_distance, "m"),
                     config.prediction == peer::Prediction::adaptive ? "the best of its history"
                                                                     : "the model as sent");
}

std::string groups_of(const peer::SceneFile& file) {
  if (file.network.interop) return fmt::format("{} alone, plain DIS", file.network.group.text());
  const peer::GroupNeeds needs = peer::group_needs(file);
  return fmt::format("{} and {} after it; the radius needs up to {} of them",
                     file.network.group.text(), file.aoim.pool, needs.within_radius);
}

/// Multicast, or a list in its place.
std::string way_of(const peer::NetworkConfig& network) {
  if (network.group.is_broadcast()) return "broadcast";
  if (network.peers.empty()) return "multicast";
  std::string text = "unicast, each datagram to";
  for (const peer::NamedPeer& peer : network.peers)
    text += (&peer == network.peers.data() ? " " : ", ") + peer.text();
  return text;
}

/// What of this host keeps the groups from being joined.
std::vector<std::string> host_warnings(const peer::SceneFile& file) {
  const peer::GroupNeeds needs = peer::group_needs(file);
  const std::size_t joined =
      std::min(needs.within_radius, needs.most_joined) + needs.within_rows + needs.within_touch + 1;
  std::vector<std::string> warnings;
  for (const peer::Finding& finding : {peer::probe_open_files(joined), peer::probe_memberships()}) {
    if (finding.level != peer::FindingLevel::problem) continue;
    warnings.push_back(fmt::format("{}; {}", finding.what, finding.remedy));
  }
  return warnings;
}

/// "5 ms", "5 ms or until 6 go together".
std::string wait_of(const peer::BundlePolicy& policy) {
  std::string text = duration_of(policy.hold);
  if (policy.updates > 0) text += fmt::format(" or until {} go together", policy.updates);
  return text;
}

/// "all that is within the radius", "platform, within 500 m; 2 boxes hide".
std::string awareness_of(const peer::AwarenessConfig& config) {
  std::string text = config.kinds.empty() ? "all that is within the radius" : config.kinds;
  if (config.aura > 0) text += fmt::format("; none beyond {}", format_quantity(config.aura, "m"));
  for (const peer::NimbusClass& one : config.nimbus)
    text += fmt::format("; {} from {} farther away", peer::entity_type_numbers(one.type),
                        format_quantity(one.nimbus, "m"));
  if (!config.occluders.empty())
    text += fmt::format("; {} boxes hide what is behind them", config.occluders.size());
  return text;
}

/// "to 1 m 1000 Hz, ..; what is held back is counted (updates_held_back)".
std::string channels_of(const peer::AoimConfig& aoim) {
  const peer::AwarenessConfig& config = aoim.awareness;
  if (!config.channels) return "one: everything to all";
  const std::span<const aoim::Channel> rows = config.table();
  std::string text;
  for (const aoim::Channel& row : rows) {
    const bool ends = std::isfinite(row.farthest);
    text += fmt::format("{}{} {} Hz {}", text.empty() ? "" : ", ",
                        ends ? "to " + format_quantity(row.farthest, "m") : "beyond", row.active_hz,
                        peer::word_of(row.body));
    if (aoim.near_groups && row.coarser > 1.0) text += fmt::format(" {} x as coarse", row.coarser);
  }
  text += aoim.near_groups ? "" : " of the nearest receiver";
  text += "; what is held back is counted (updates_held_back)";
  if (config.budget > 0)
    text += fmt::format("; takes {} a second", format_quantity(config.budget, "B"));
  return text;
}

/// Which cells are found by name, and which this peer looks for.
void add_beacons(const peer::SceneFile& file,
                 std::vector<std::pair<std::string, std::string>>& rows) {
  std::string beacons;
  for (const peer::EntityConfig& entity : file.entities) {
    if (entity.beacon.empty()) continue;
    beacons +=
        fmt::format("{}{} of peer {}", beacons.empty() ? "" : ", ", entity.beacon, entity.peer);
  }
  if (!beacons.empty())
    rows.emplace_back("beacons", beacons + ": found in the map of groups wherever they are");
  if (!file.aoim.follow.empty())
    rows.emplace_back("follows",
                      file.aoim.follow + ": listens to the cell of each and shows what is in it");
}

/// Who hands out groups, and which there are beside those of cells.
void add_groups(const peer::SceneFile& file,
                std::vector<std::pair<std::string, std::string>>& rows) {
  if (file.aoim.leaders)
    rows.emplace_back("leaders",
                      "of the scene and of each cell; a cell's tells late comers at once "
                      "what is in it, and owners say nothing");
  if (file.aoim.hand_out)
    rows.emplace_back("handed out",
                      "groups, by who leads the scene; a cell without one speaks to "
                      "the base group, which all hear");
  add_beacons(file, rows);
  if (file.aoim.contact_groups)
    rows.emplace_back(
        "felt", fmt::format("by {} more groups, which those alone listen to who can touch there; "
                            "a hand needs up to {} of them",
                            file.aoim.pool, peer::group_needs(file).within_touch));
  if (file.aoim.near_rows() > 0)
    rows.emplace_back(
        "near",
        fmt::format("{} by {} more groups, which those alone listen to who are so near; a "
                    "focus needs up to {} of them",
                    file.aoim.near_rows() == 1
                        ? "one row of the channels"
                        : fmt::format("{} rows of the channels", file.aoim.near_rows()),
                    file.aoim.near_rows() * file.aoim.pool, peer::group_needs(file).within_rows));
}

/// What the scene asks of the network, as (what, how) rows.
std::vector<std::pair<std::string, std::string>> settings(const peer::SceneFile& file) {
  const auto& thresholds = file.dead_reckoning.thresholds;
  std::vector<std::pair<std::string, std::string>> rows = {
      {"sends when off by",
       fmt::format("{}, {} or {}; else every {}", format_quantity(thresholds.position, "m"),
                   format_quantity(thresholds.angle, "rad"), format_quantity(thresholds.force, "N"),
                   duration_of(file.dead_reckoning.heartbeat))},
      {"model", fmt::format("{}; rule {}; acceleration of rvb: {}",
                            peer::word_of(file.dead_reckoning.algorithm),
                            peer::word_of(file.dead_reckoning.rule),
                            peer::word_of(file.dead_reckoning.acceleration))},
      {"shown", shown_as(file.convergence)},
      {"cells",
       fmt::format("{}; senses {}", cells_text(file.aoim), format_quantity(file.aoim.radius, "m"))},
      {"of others", awareness_of(file.aoim.awareness)},
      {"channels", channels_of(file.aoim)},
      {"groups", groups_of(file)},
      {"by", way_of(file.network)},
      {"datagrams", fmt::format("up to {} octets, a pose waits {}", file.network.bundle_max,
                                wait_of(file.network.bundle))},
      {"hand",
       fmt::format("sphere of {}, {}, {}; feels objects with {}",
                   format_quantity(file.hand.radius, "m"), format_quantity(file.hand.k1, "N/m"),
                   format_quantity(file.hand.damping, "N s/m"),
                   file.hand.contact_radius > 0
                       ? "a ball of " + format_quantity(file.hand.contact_radius, "m")
                       : "a point")},
      {"impairment", file.impairment.law.is_perfect() ? "none" : "on: see [impairment]"},
  };
  if (const std::string delivery = over_delivery_text(file.aoim); !delivery.empty())
    rows.emplace_back("heard", delivery);
  add_groups(file, rows);
  if (file.coupling.mode != haptics::CouplingMode::reckon)
    rows.emplace_back("coupling", fmt::format("{}, a baseline: `bench stability` runs it, demo and "
                                              "peer refuse the scene",
                                              haptics::name_of(file.coupling.mode)));
  for (const peer::BundleClass& one : file.network.bundle_classes) {
    rows.emplace_back(
        "", fmt::format("of type {} {}", peer::entity_type_numbers(one.type), wait_of(one.policy)));
  }
  for (std::string& note : scene_notes(file)) rows.emplace_back("note", std::move(note));
  for (std::string& warning : host_warnings(file)) rows.emplace_back("warning", std::move(warning));
  for (const peer::OperatorConfig& hand : file.operators) {
    rows.emplace_back("operator", hand.kind == peer::OperatorKind::trace
                                      ? fmt::format("trace {}", hand.trace.string())
                                      : std::string(peer::word_of(hand.kind)));
  }
  return rows;
}

bool is_spring(std::string_view stage) {
  bool is = false;
  haptics::for_each_effect([&]<class Effect>(std::type_identity<Effect>) {
    if constexpr (haptics::StoresEnergy<Effect>) is |= Effect::kName == stage;
  });
  return is;
}

/// The stages with what becomes of springs that are stiffer than the devices of the scene can show.
std::vector<haptics::PlanStage> stages_of(const LoadedScene& scene,
                                          const std::vector<SceneDevice>& devices) {
  std::vector<haptics::PlanStage> stages = scene.plan.stages();
  for (haptics::PlanStage& stage : stages) {
    if (!is_spring(stage.name)) continue;
    for (const haptics::PlannedObject& object : scene.plan.objects()) {
      if (object.name != stage.object) continue;
      const std::string felt = felt_with(object.stiffness(), devices);
      if (!felt.empty()) stage.parameters += ": " + felt;
      break;
    }
  }
  return stages;
}

/// How large things are made, and what is left out beyond, as (what, how) rows.
std::vector<std::pair<std::string, std::string>> limits(const peer::SceneFile& file) {
  const peer::PeerOptions options;
  const bool adaptive = file.convergence.prediction == peer::Prediction::adaptive;
  // A row, its sender's clock, its history, and its places in indices and columns.
  constexpr std::size_t kPlaces = 64;
  const std::size_t row = sizeof(peer::RemoteEntity) + sizeof(peer::SenderClock) + kPlaces +
                          (adaptive ? sizeof(deadreckon::AdaptiveOrder) : 0);
  constexpr double kMebi = 1024.0 * 1024.0;
  return {
      {"remote entities",
       fmt::format("{} rows of {} octets, {:.0f} MiB when full, taken as they come; further ones "
                   "are counted (table_full) and not shown",
                   options.capacity, row, static_cast<double>(options.capacity * row) / kMebi)},
      {"rings of datagrams",
       fmt::format("{:.3g} MiB each way, taken as they fill; a full one leaves what comes to the "
                   "kernel (read_waits), and drops what goes (write_overflow)",
                   static_cast<double>(options.datagram_ring) / kMebi)},
      {"felt by a hand",
       fmt::format("what is within {} of it, the {} nearest; further ones are counted "
                   "(hands_unfelt)",
                   format_quantity(peer::kContactReach, "m"), haptics::kMaxRemoteHands)},
      {"devices of a peer", fmt::format("{} at most", peer::kMaxDevices)},
      {"peers known", fmt::format("{}; further ones are counted (peers_not_joined)",
                                  aoim::PresenceConfig{}.capacity)},
      {"rows of a picture",
       fmt::format("the {} remote entities that are nearest to the first hand; all are counted",
                   peer::PeerView::kRows)},
  };
}

/// What is said of one thing stands below its name.
TextTable peers_as_table(const std::vector<PeerFact>& facts) {
  TextTable table({{"PEER", TextTable::Align::right}, {"HAS"}, {""}, {""}});
  const PeerFact* last = nullptr;
  for (const PeerFact& fact : facts) {
    const bool other_peer = last == nullptr || last->peer != fact.peer;
    const bool other = other_peer || last->has != fact.has;
    table.add({other_peer ? fmt::format("{}", fact.peer) : "", other ? fact.has : "", fact.what,
               fact.how});
    last = &fact;
  }
  return table;
}

/// Where each mesh comes from and what was found in it; a row for each thing found.
TextTable meshes_as_table(const std::vector<MeshFacts>& meshes) {
  TextTable table({{"MESH"}, {"FILE"}, {"FOUND"}});
  for (const MeshFacts& mesh : meshes) {
    table.add({mesh.object, mesh.file, mesh_line(mesh)});
    for (const std::string& note : mesh.notes) table.add({"", "", note});
  }
  return table;
}

}  // namespace

void explain_as_text(const LoadedScene& scene, std::FILE* out) {
  const std::vector<SceneDevice> devices = devices_in(scene.file, scene.plan);
  const auto stages = stages_of(scene, devices);
  fmt::print(out, "{}   hash {}\n\n", scene.file.name, hash_text(scene.file.hash));
  TextTable run({{"EACH SERVO STEP"}, {"OBJECT"}, {"WITH"}, {"COST"}});
  for (const haptics::PlanStage& stage : stages) {
    run.add({stage.name, stage.object, stage.parameters, stage.cost});
  }
  if (run.empty())
    fmt::print(out, "nothing to touch: a servo step only reads and writes the device\n");
  if (!run.empty()) run.print(out);

  TextTable absent({{"LEFT OUT: NO COST"}, {"OBJECT"}, {"TO HAVE IT, WRITE"}});
  for (const LeftOut& row : left_out(scene, stages)) {
    absent.add({row.effect, row.object, row.declaration});
  }
  fmt::print(out, "\n");
  if (!absent.empty()) absent.print(out);
  if (absent.empty() && !run.empty()) fmt::print(out, "nothing is left out\n");

  const TextTable meshes = meshes_as_table(mesh_facts(scene));
  if (!meshes.empty()) fmt::print(out, "\n");
  if (!meshes.empty()) meshes.print(out);

  TextTable rest({{"BETWEEN PEERS"}, {""}});
  for (const auto& [what, how] : settings(scene.file)) rest.add({what, how});
  for (const std::string& note :
       softened_notes(softened(scene.file, scene.plan, devices), devices.size())) {
    rest.add({"softer", note});
  }
  fmt::print(out, "\n");
  rest.print(out);

  TextTable walls({{"LIMITS"}, {""}});
  for (const auto& [what, how] : limits(scene.file)) walls.add({what, how});
  fmt::print(out, "\n");
  walls.print(out);

  fmt::print(out, "\n");
  peers_as_table(peer_facts(scene.file, scene.plan)).print(out);
}

void explain_as_json(const LoadedScene& scene, std::FILE* out) {
  const std::vector<SceneDevice> devices = devices_in(scene.file, scene.plan);
  const auto stages = stages_of(scene, devices);
  std::string text;
  JsonObject(text)
      .text("kind", "scene")
      .text("name", scene.file.name)
      .text("hash", hash_text(scene.file.hash))
      .value("stages", stages.size())
      .end("\n");
  for (const haptics::PlanStage& stage : stages) {
    JsonObject(text)
        .text("kind", "stage")
        .text("stage", stage.name)
        .text("object", stage.object)
        .text("parameters", stage.parameters)
        .text("cost", stage.cost)
        .end("\n");
  }
  for (const LeftOut& row : left_out(scene, stages)) {
    JsonObject(text)
        .text("kind", "left_out")
        .text("effect", row.effect)
        .text("object", row.object)
        .text("declaration", row.declaration)
        .end("\n");
  }
  for (const MeshFacts& mesh : mesh_facts(scene)) {
    append_mesh_json(text, mesh, "mesh");
    text += '\n';
  }
  for (const auto& [what, how] : settings(scene.file)) {
    JsonObject(text).text("kind", "setting").text("what", what).text("value", how).end("\n");
  }
  for (const Softened& row : softened(scene.file, scene.plan, devices)) {
    text += R"({"kind":"softened","row":)";
    append_softened(text, row);
    text += "}\n";
  }
  for (const auto& [what, how] : limits(scene.file)) {
    JsonObject(text).text("kind", "limit").text("what", what).text("value", how).end("\n");
  }
  for (const PeerFact& fact : peer_facts(scene.file, scene.plan)) {
    JsonObject(text)
        .text("kind", "peer")
        .value("peer", fact.peer)
        .text("has", fact.has)
        .text("what", fact.what)
        .text("value", fact.how)
        .end("\n");
  }
  fmt::print(out, "{}", text);
}

}  // namespace reckon::tools
