// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "reckon/peer/scene/scene_keys.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"
#include "reckon/tools/exercise/native_code.hpp"
#include "reckon/tools/terminal/foreign_text.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"
#include "reckon/tools/verbs/loaded_scene.hpp"
#include "reckon/tools/verbs/scene_bodies.hpp"
#include "reckon/tools/verbs/scene_explain.hpp"
#include "reckon/tools/verbs/scene_graph_text.hpp"
#include "reckon/tools/verbs/scene_meshes.hpp"
#include "reckon/tools/verbs/scene_stiffness.hpp"
#include "reckon/tools/verbs/scene_template.hpp"

namespace reckon::tools {
namespace {

// --- check ---

/// Notes of the scene, then of each mesh with its object's name.
std::vector<std::string> all_notes(const LoadedScene& scene, const std::vector<MeshFacts>& meshes) {
  std::vector<std::string> notes = scene_notes(scene.file);
  for (const MeshFacts& mesh : meshes) {
    for (const std::string& note : mesh.notes) {
      notes.push_back(fmt::format("mesh of \"{}\": {}", mesh.object, note));
    }
  }
  return notes;
}

void print_good(const std::string& path, const LoadedScene& scene, bool json, std::FILE* out) {
  const std::vector<MeshFacts> meshes = mesh_facts(scene);
  std::vector<std::string> notes = all_notes(scene, meshes);
  const std::size_t objects = scene.file.scene.objects.size();
  const std::size_t operators = scene.file.operators.size();
  const std::size_t devices = scene.file.devices.size();
  const std::size_t entities = scene.file.entities.size();
  const std::vector<SceneDevice> there = devices_in(scene.file, scene.plan);
  const std::vector<Softened> soft = softened(scene.file, scene.plan, there);
  for (std::string& note : softened_notes(soft, there.size())) notes.push_back(std::move(note));
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
        .value("nodes", node_count(scene.file))
        .text("hash", hash_text(scene.file.hash))
        .array("native_code", native_code_of(scene.file), append_json_string)
        .array("notes", notes, append_json_string)
        .array("meshes", meshes,
               [](std::string& row, const MeshFacts& mesh) { append_mesh_json(row, mesh); })
        .array("softened", soft, append_softened)
        .end("\n");
    return fmt::print(out, "{}", text);
  }
  for (const std::string& line : native_code_of(scene.file))
    fmt::print(out, "{}: {}\n", path, line);
  std::string more;
  if (const std::size_t nodes = node_count(scene.file); nodes > 0)
    more += ", " + counted(nodes, "node");
  if (devices > 0) more += ", " + counted(devices, "device");
  if (entities > 0) more += fmt::format(", {} {}", entities, entities == 1 ? "entity" : "entities");
  fmt::print(out, "{}: good; {}, {}{}, hash {}\n", path, counted(objects, "object"),
             counted(operators, "operator"), more, hash_text(scene.file.hash));
  for (const MeshFacts& mesh : meshes) {
    fmt::print(out, "  mesh of \"{}\": {}\n", mesh.object, mesh_line(mesh));
  }
  for (const std::string& note : notes) fmt::print(out, "  note: {}\n", note);
}

void print_problems(const std::string& path, const peer::SceneFileError& error, bool json,
                    std::FILE* out) {
  if (!json) return fmt::print(out, "{}\n", clean_lines(error.what()));
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
      const LoadedScene scene = load_whole_scene(path);
      if (std::vector<peer::SceneProblem> crowded = crowded_bodies(scene.plan); !crowded.empty())
        throw peer::SceneFileError(path, std::move(crowded));
      print_good(path, scene, json, console.out);
    } catch (const peer::SceneFileError& error) {
      print_problems(path, error, json, console.out);
      worst = ExitCode::findings;
    }
  }
  return exit_status(worst);
}

// --- explain ---

int explain(const std::vector<std::string>& files, bool json, const Console& console) {
  for (const std::string& path : files) {
    try {
      const LoadedScene scene = load_whole_scene(path);
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
  CommandLine line("scene", "Check or explain scene files, or print a new one.",
                   "reckon scene check scenes/*.toml\nreckon scene explain scenes/two_hands.toml\n"
                   "reckon scene new > my_scene.toml\nreckon scene keys");
  line.choice("ACTION", action, {"check", "explain", "new", "keys"},
              "check: report problems with place and remedy; explain: the stages of each servo "
              "step, used and unused, and the work of each peer; new: print a scene file to start "
              "from; keys: list all keys");
  line.words("FILE", files, false, "scene files");
  line.flag("--json", json, "one JSON object per line");
  if (const auto status = line.parse(arguments, console)) return *status;

  const bool prints = action == "keys" || action == "new";
  if (prints && !files.empty())
    throw UsageError(
        fmt::format("unexpected argument '{}': write reckon scene {}", files.front(), action));
  if (action == "keys") return keys(json, console);
  if (action == "new") return print_template(console);
  if (action.empty()) throw UsageError("write an action: reckon scene check, explain, new or keys");
  if (files.empty())
    throw UsageError(fmt::format("name a scene file: reckon scene {} FILE", action));
  return action == "check" ? check(files, json, console) : explain(files, json, console);
}

}  // namespace

namespace verb {

Verb scene() { return verb_of(verb_row("scene"), run_scene); }

}  // namespace verb

}  // namespace reckon::tools
