// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/scene_explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "reckon/haptics/effects/effect_hooks.hpp"
#include "reckon/haptics/effects/effect_types.hpp"
#include "reckon/haptics/regions/region_types.hpp"
#include "reckon/peer/notation/units.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/peer/step_cost/body_costs.hpp"
#include "reckon/peer/step_cost/stage_costs.hpp"
#include "reckon/tools/exercise/native_code.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"
#include "reckon/tools/verbs/scene_graph_text.hpp"
#include "reckon/tools/verbs/scene_meshes.hpp"
#include "reckon/tools/verbs/scene_peers.hpp"
#include "reckon/tools/verbs/scene_settings.hpp"
#include "reckon/tools/verbs/scene_stiffness.hpp"

namespace reckon::tools {
namespace {

using peer::format_quantity;

/// An effect that is missing, and the line that would add it.
struct LeftOut {
  std::string effect;
  std::vector<std::string> objects;  ///< objects without it; none: no region has it
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

/// All effects that are not everywhere in the plan.
std::vector<LeftOut> left_out(const haptics::Scene& scene) {
  std::vector<LeftOut> rows;
  haptics::for_each_effect([&]<class Effect>(std::type_identity<Effect>) {
    LeftOut row{std::string(Effect::kName), {}, declaration_of<Effect>()};
    for (const haptics::SceneObject& object : scene.objects)
      if (object.effects.find<Effect>() == nullptr) row.objects.push_back(object.name);
    if (!row.objects.empty()) rows.push_back(std::move(row));
  });
  haptics::for_each_region_effect([&]<class Effect>(std::type_identity<Effect>) {
    const bool has = std::ranges::any_of(scene.regions, [](const haptics::SceneRegion& region) {
      return region.effects.find<Effect>() != nullptr;
    });
    if (!has) rows.push_back({std::string(Effect::kName), {}, declaration_of<Effect>()});
  });
  return rows;
}

/// "table, ball and 3 more".
std::string where_of(const LeftOut& row) {
  constexpr std::size_t kNamed = 2;
  if (row.objects.empty()) return "a [[region]]";
  const std::size_t named = std::min(row.objects.size(), kNamed);
  std::string text = fmt::format("{}", fmt::join(std::span(row.objects).first(named), ", "));
  if (row.objects.size() > named) text += fmt::format(" and {} more", row.objects.size() - named);
  return text;
}

bool is_spring(std::string_view stage) {
  bool is = false;
  haptics::for_each_effect([&]<class Effect>(std::type_identity<Effect>) {
    if constexpr (haptics::StoresEnergy<Effect>) is |= Effect::kName == stage;
  });
  return is;
}

/// The stages, with the shown stiffness of springs that are stiffer than the scene's devices can
/// show.
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

/// Facts about one thing are listed below its name.
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

/// Source and findings of each mesh; a row for each finding.
TextTable meshes_as_table(const std::vector<MeshFacts>& meshes) {
  TextTable table({{"MESH"}, {"FILE"}, {"FOUND"}});
  for (const MeshFacts& mesh : meshes) {
    table.add({mesh.object, mesh.file, mesh_line(mesh)});
    for (const std::string& note : mesh.notes) table.add({"", "", note});
  }
  return table;
}

constexpr auto kRight = TextTable::Align::right;

/// "31 ns"; empty if it was not measured.
std::string time_text(double seconds) {
  if (seconds < 0) return "";
  return fmt::format("{:.0f} ns", 1e9 * seconds);
}

/// Duration of a servo step on this host, and whether the host can run it.
std::string step_text(const peer::StageCosts& costs) {
  constexpr double kStep = 1e-3, kMost = 0.5;  // [s], and the share of it that is left to the servo
  const std::string what = costs.dearest_object.empty()
                               ? std::string("a step")
                               : fmt::format("a step that touches {}", costs.dearest_object);
  const std::string text = fmt::format(
      "measured here: {} takes {:.2g} us of the 1,000 us of a period ({:.0f} ns without any stage)",
      what, 1e6 * costs.dearest, 1e9 * costs.empty);
  if (costs.dearest < kMost * kStep) return text;
  return text + "; this host is too slow for 1 kHz: remove the costliest stages above" +
         (costs.dearest < kStep ? "" : ". demo and peer refuse the scene here");
}

/// The hands of the peer that owns the bodies, and their period.
std::optional<peer::BodyCosts> body_costs_of(const LoadedScene& scene,
                                             const std::vector<SceneDevice>& devices) {
  using std::chrono::nanoseconds;
  nanoseconds period{1'000'000};
  if (!devices.empty()) period = nanoseconds(std::llround(1e9 * devices.front().period));
  const auto hands = peer::devices_of(scene.file, 1).size();
  return peer::measure_bodies(scene.file, std::max<std::size_t>(hands, 1), period,
                              {.pace = peer::measure_body_pace()});
}

std::string body_text(const peer::BodyCosts& costs) {
  return fmt::format(
      "with {} awake and hands among them, the steps of all hands take {:.3g} us in the median and "
      "{:.3g} us at p99; until the last force is written {:.3g} us at p99; {} of {} periods are "
      "late",
      costs.bodies == 1 ? "1 body" : fmt::format("{} bodies", costs.bodies), 1e6 * costs.median,
      1e6 * costs.p99, 1e6 * costs.p99_until_force, costs.late, costs.steps);
}

void append_bodies(std::string& text, const std::optional<peer::BodyCosts>& bodies) {
  if (!bodies) return;
  JsonObject(text)
      .text("kind", "bodies")
      .value("awake", bodies->bodies)
      .number("median_s", bodies->median)
      .number("p99_s", bodies->p99)
      .number("p99_until_force_s", bodies->p99_until_force)
      .value("steps", bodies->steps)
      .value("late", bodies->late)
      .end("\n");
}

}  // namespace

void explain_as_text(const LoadedScene& scene, std::FILE* out) {
  const std::vector<SceneDevice> devices = devices_in(scene.file, scene.plan);
  const auto stages = stages_of(scene, devices);
  for (const std::string& line : native_code_of(scene.file)) fmt::print(out, "{}\n", line);
  fmt::print(out, "{}   hash {}\n\n", scene.file.name, hash_text(scene.file.hash));
  const peer::StageCosts costs =
      peer::measure_stages(scene.file.scene, scene.plan, scene.file.hand.contact_radius);
  TextTable run({{"EACH SERVO STEP"}, {"OBJECT"}, {"WITH"}, {"TAKES", kRight}, {"COST"}});
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const haptics::PlanStage& stage = stages[i];
    run.add({stage.name, stage.object, stage.parameters, time_text(costs.stages[i]), stage.cost});
  }
  if (run.empty())
    fmt::print(out, "nothing to touch: a servo step only reads and writes the device\n");
  if (!run.empty()) {
    run.print(out);
    fmt::print(out, "\n{}\n", step_text(costs));
  }
  if (const auto bodies = body_costs_of(scene, devices))
    fmt::print(out, "{}\n", body_text(*bodies));

  TextTable absent({{"LEFT OUT: NO COST"}, {"OBJECT"}, {"TO HAVE IT, WRITE"}});
  for (const LeftOut& row : left_out(scene.file.scene)) {
    absent.add({row.effect, where_of(row), row.declaration});
  }
  fmt::print(out, "\n");
  if (!absent.empty()) absent.print(out);
  if (absent.empty()) fmt::print(out, "nothing is left out\n");

  const TextTable meshes = meshes_as_table(mesh_facts(scene));
  if (!meshes.empty()) fmt::print(out, "\n");
  if (!meshes.empty()) meshes.print(out);

  TextTable graph({{"SCENE GRAPH"}, {""}});
  for (const auto& [what, how] : scene_graph_rows(scene.file)) graph.add({what, how});
  if (!graph.empty()) fmt::print(out, "\n");
  if (!graph.empty()) graph.print(out);

  TextTable rest({{"BETWEEN PEERS"}, {""}});
  for (const auto& [what, how] : scene_settings(scene.file)) rest.add({what, how});
  for (const std::string& note :
       softened_notes(softened(scene.file, scene.plan, devices), devices.size())) {
    rest.add({"softer", note});
  }
  fmt::print(out, "\n");
  rest.print(out);

  TextTable walls({{"LIMITS"}, {""}});
  for (const auto& [what, how] : scene_limits(scene.file)) walls.add({what, how});
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
      .array("native_code", native_code_of(scene.file), append_json_string)
      .value("stages", stages.size())
      .end("\n");
  const peer::StageCosts costs =
      peer::measure_stages(scene.file.scene, scene.plan, scene.file.hand.contact_radius);
  for (std::size_t i = 0; i < stages.size(); ++i) {
    JsonObject(text)
        .text("kind", "stage")
        .text("stage", stages[i].name)
        .text("object", stages[i].object)
        .text("parameters", stages[i].parameters)
        .text("cost", stages[i].cost)
        .number("takes_s", costs.stages[i] >= 0 ? std::optional(costs.stages[i]) : std::nullopt)
        .end("\n");
  }
  append_bodies(text, body_costs_of(scene, devices));
  for (const LeftOut& row : left_out(scene.file.scene)) {
    JsonObject(text)
        .text("kind", "left_out")
        .text("effect", row.effect)
        .array("objects", row.objects, append_json_string)
        .text("declaration", row.declaration)
        .end("\n");
  }
  for (const MeshFacts& mesh : mesh_facts(scene)) {
    append_mesh_json(text, mesh, "mesh");
    text += '\n';
  }
  for (const auto& [what, how] : scene_graph_rows(scene.file))
    JsonObject(text).text("kind", "graph").text("what", what).text("value", how).end("\n");
  for (const auto& [what, how] : scene_settings(scene.file)) {
    JsonObject(text).text("kind", "setting").text("what", what).text("value", how).end("\n");
  }
  for (const Softened& row : softened(scene.file, scene.plan, devices)) {
    text += R"({"kind":"softened","row":)";
    append_softened(text, row);
    text += "}\n";
  }
  for (const auto& [what, how] : scene_limits(scene.file)) {
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
