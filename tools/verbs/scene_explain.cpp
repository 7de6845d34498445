// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/scene_explain.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "reckon/haptics/effects/effect_hooks.hpp"
#include "reckon/haptics/effects/effect_types.hpp"
#include "reckon/peer/scene/units.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"
#include "reckon/tools/verbs/scene_meshes.hpp"
#include "reckon/tools/verbs/scene_peers.hpp"
#include "reckon/tools/verbs/scene_settings.hpp"
#include "reckon/tools/verbs/scene_stiffness.hpp"

namespace reckon::tools {
namespace {

using peer::format_quantity;

/// An effect that an object lacks, and the line that would add it.
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

/// All pairs of effect and object that are not in the plan.
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
