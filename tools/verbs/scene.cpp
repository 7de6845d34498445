// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <initializer_list>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "reckon/haptics/effects/effect_types.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/network/host_limits.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/scene/scene_keys.hpp"
#include "reckon/peer/scene/scene_words.hpp"
#include "reckon/peer/scene/units.hpp"
#include "reckon/peer/tracks/hand_trace_file.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"
#include "reckon/tools/verbs/scene_peers.hpp"
#include "reckon/tools/verbs/scene_template.hpp"

namespace reckon::tools {
namespace {

using peer::format_quantity;

/// A file with the plan of what a servo runs for it.
struct LoadedScene {
  peer::SceneFile file;
  haptics::EffectPlan plan;
};

/// @throws peer::SceneFileError, also where a mesh, an effect or a hand's trace is refused.
LoadedScene load(const std::string& path) {
  LoadedScene scene{peer::load_scene_file(path), {}};
  try {
    scene.plan = haptics::EffectPlan(scene.file.scene);
    for (const peer::OperatorConfig& hand : scene.file.operators) {
      if (hand.kind == peer::OperatorKind::trace) (void)peer::read_hand_trace(hand.trace);
    }
  } catch (const std::exception& error) {
    throw peer::SceneFileError(path, {{0, 0, error.what()}});
  }
  return scene;
}

/// What a good file still wants to have said: cells that filter nothing, and groups left out.
std::vector<std::string> notes(const peer::SceneFile& file) {
  const peer::GroupNeeds needs = peer::group_needs(file);
  std::vector<std::string> notes;
  if (needs.all() && !needs.capped()) {
    notes.push_back(fmt::format(
        "the radius of {} reaches all {} groups in use: everything that is said is heard, and the "
        "cells filter nothing; larger cells or a larger pool would",
        format_quantity(file.aoim.radius, "m"), needs.in_use));
  }
  if (needs.capped()) {
    notes.push_back(fmt::format(
        "the radius of {} may need {} groups and [aoim] groups allows {}: the farthest part of it "
        "is not heard; raise groups, or take cells larger than {}",
        format_quantity(file.aoim.radius, "m"), needs.within_radius, needs.most_joined,
        format_quantity(file.aoim.cell, "m")));
  }
  return notes;
}

std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

// --- check ---

void print_good(const std::string& path, const LoadedScene& scene, bool json, std::FILE* out) {
  const std::size_t objects = scene.file.scene.objects.size();
  const std::size_t operators = scene.file.operators.size();
  const std::size_t devices = scene.file.devices.size();
  const std::size_t entities = scene.file.entities.size();
  if (json) {
    std::string text;
    JsonObject(text)
        .text("file", path)
        .text("status", "ok")
        .text("name", scene.file.name)
        .value("objects", objects)
        .value("operators", operators)
        .value("devices", devices)
        .value("entities", entities)
        .text("hash", hash_text(scene.file.hash))
        .array("notes", notes(scene.file), append_json_string)
        .end("\n");
    return fmt::print(out, "{}", text);
  }
  std::string more;
  if (devices > 0) more += ", " + counted(devices, "device");
  if (entities > 0) more += fmt::format(", {} {}", entities, entities == 1 ? "entity" : "entities");
  fmt::print(out, "{}: good; {}, {}{}, hash {}\n", path, counted(objects, "object"),
             counted(operators, "operator"), more, hash_text(scene.file.hash));
  for (const std::string& note : notes(scene.file)) fmt::print(out, "  note: {}\n", note);
}

void print_problems(const std::string& path, const peer::SceneFileError& error, bool json,
                    std::FILE* out) {
  if (!json) return fmt::print(out, "{}\n", error.what());
  std::string text;
  for (const peer::SceneProblem& problem : error.problems()) {
    JsonObject(text)
        .text("file", path)
        .text("status", "error")
        .value("line", problem.line)
        .value("column", problem.column)
        .text("problem", problem.sentence)
        .end("\n");
  }
  fmt::print(out, "{}", text);
}

int check(const std::vector<std::string>& files, bool json, const Console& console) {
  ExitCode worst = ExitCode::good;
  for (const std::string& path : files) {
    try {
      print_good(path, load(path), json, console.out);
    } catch (const peer::SceneFileError& error) {
      print_problems(path, error, json, console.out);
      worst = ExitCode::findings;
    }
  }
  return exit_status(worst);
}

// --- explain ---

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

/// What of this host keeps the groups from being joined.
std::vector<std::string> host_warnings(const peer::SceneFile& file) {
  const peer::GroupNeeds needs = peer::group_needs(file);
  const std::size_t joined = std::min(needs.within_radius, needs.most_joined) + 1;
  std::vector<std::string> warnings;
  for (const peer::Finding& finding : {peer::probe_open_files(joined), peer::probe_memberships()}) {
    if (finding.level != peer::FindingLevel::problem) continue;
    warnings.push_back(fmt::format("{}; {}", finding.what, finding.remedy));
  }
  return warnings;
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
       fmt::format("{}, {}; senses {}", peer::word_of(file.aoim.scheme),
                   format_quantity(file.aoim.cell, "m"), format_quantity(file.aoim.radius, "m"))},
      {"groups", groups_of(file)},
      {"datagrams", fmt::format("up to {} octets, a pose waits {}", file.network.bundle_max,
                                duration_of(file.network.bundle_hold))},
      {"hand", fmt::format("sphere of {}, {}, {}", format_quantity(file.hand.radius, "m"),
                           format_quantity(file.hand.k1, "N/m"),
                           format_quantity(file.hand.damping, "N s/m"))},
      {"impairment", file.impairment.law.is_perfect() ? "none" : "on: see [impairment]"},
  };
  for (std::string& note : notes(file)) rows.emplace_back("note", std::move(note));
  for (std::string& warning : host_warnings(file)) rows.emplace_back("warning", std::move(warning));
  for (const peer::OperatorConfig& hand : file.operators) {
    rows.emplace_back("operator", hand.kind == peer::OperatorKind::trace
                                      ? fmt::format("trace {}", hand.trace.string())
                                      : std::string(peer::word_of(hand.kind)));
  }
  return rows;
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

void explain_as_text(const LoadedScene& scene, std::FILE* out) {
  const auto stages = scene.plan.stages();
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

  TextTable rest({{"BETWEEN PEERS"}, {""}});
  for (const auto& [what, how] : settings(scene.file)) rest.add({what, how});
  fmt::print(out, "\n");
  rest.print(out);

  fmt::print(out, "\n");
  peers_as_table(peer_facts(scene.file, scene.plan)).print(out);
}

void explain_as_json(const LoadedScene& scene, std::FILE* out) {
  const auto stages = scene.plan.stages();
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
  for (const auto& [what, how] : settings(scene.file)) {
    JsonObject(text).text("kind", "setting").text("what", what).text("value", how).end("\n");
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

int explain(const std::vector<std::string>& files, bool json, const Console& console) {
  for (const std::string& path : files) {
    try {
      const LoadedScene scene = load(path);
      json ? explain_as_json(scene, console.out) : explain_as_text(scene, console.out);
    } catch (const peer::SceneFileError& error) {
      throw UsageError(error.what());
    }
  }
  return exit_status(ExitCode::good);
}

// --- keys ---

int keys(bool json, const Console& console) {
  if (!json) {
    fmt::print(console.out, "{}", peer::scene_keys_markdown());
    return exit_status(ExitCode::good);
  }
  std::string text;
  for (const peer::SceneKey& key : peer::scene_keys()) {
    JsonObject(text)
        .text("section", key.section)
        .text("key", key.key)
        .text("value", peer::describe_kind(key))
        .text("default", key.standard)
        .text("meaning", key.sentence)
        .end("\n");
  }
  fmt::print(console.out, "{}", text);
  return exit_status(ExitCode::good);
}

// --- new ---

int print_template(const Console& console) {
  fmt::print(console.out, "{}", scene_template());
  return exit_status(ExitCode::good);
}

int run_scene(Arguments arguments, const Console& console) {
  std::string action;
  std::vector<std::string> files;
  bool json = false;
  CommandLine line("scene", "Check scene files, explain what runs for one, or begin one.",
                   "reckon scene check scenes/*.toml\nreckon scene explain scenes/two_hands.toml\n"
                   "reckon scene new > my_scene.toml\nreckon scene keys");
  line.choice("ACTION", action, {"check", "explain", "new", "keys"},
              "check: problems with place and remedy; explain: the stages of each servo step, what "
              "is left out, what peers do and have; new: a file to begin with; keys: everything a "
              "scene file may say");
  line.words("FILE", files, false, "scene files");
  line.flag("--json", json, "one JSON object per line");
  if (const auto status = line.parse(arguments, console)) return *status;

  const bool prints = action == "keys" || action == "new";
  if (prints && !files.empty())
    throw UsageError(
        fmt::format("'{}' is a word too many: write reckon scene {}", files.front(), action));
  if (action == "keys") return keys(json, console);
  if (action == "new") return print_template(console);
  if (action.empty()) throw UsageError("say what to do: reckon scene check, explain, new or keys");
  if (files.empty())
    throw UsageError(fmt::format("name a scene file: reckon scene {} FILE", action));
  return action == "check" ? check(files, json, console) : explain(files, json, console);
}

}  // namespace

namespace verb {

Verb scene() {
  return {"scene", "check a scene file, explain what runs for it, or begin one", run_scene};
}

}  // namespace verb

}  // namespace reckon::tools
