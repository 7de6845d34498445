// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Scene files: TOML in, plain structs out. Unknown keys, wrong units and values out of range are
// refused with place and remedy. docs/scene_files.md lists the keys.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/haptics/scene/scene.hpp"
#include "reckon/peer/drivers/device_config.hpp"
#include "reckon/peer/network/impairment.hpp"
#include "reckon/peer/scene_graph/scene_nodes.hpp"
#include "reckon/peer/settings/aoim_config.hpp"
#include "reckon/peer/settings/convergence_config.hpp"
#include "reckon/peer/settings/entity_config.hpp"
#include "reckon/peer/settings/hand_config.hpp"
#include "reckon/peer/settings/network_config.hpp"

namespace reckon::peer {

/// A whole scene file, checked: all numbers SI and in range, all paths absolute and readable.
struct SceneFile {
  std::string name;                          ///< [scene] name, else the file's stem
  std::filesystem::path path;                ///< as given; empty when parsed from text
  std::vector<std::filesystem::path> files;  ///< that it names, absolute, without its key
  OriginConfig origin;
  haptics::Scene scene;  ///< the objects and exactly the effects that the file declares
  std::vector<NodeConfig> node_tables;  ///< as written, copies not expanded
  SceneNodes nodes;                     ///< the resulting graph, and the objects in it
  HandModel hand;
  std::vector<OperatorConfig> operators;  ///< one per simulated hand, in the file's order
  std::vector<EntityConfig> entities;     ///< of all peers, in the file's order
  std::vector<DeviceConfig> devices;      ///< of all peers; none: see [[device]] in scene_files.md
  DeadReckoningConfig dead_reckoning;
  ConvergenceConfig convergence;
  AoimConfig aoim;
  NetworkConfig network;
  ImpairmentConfig impairment;
  /// Hash of the data that all peers must share: origin, objects with the content of their meshes,
  /// nodes, effects, cells and pool, the reading of accelerations. Comments, order of keys, units
  /// and settings of a single peer do not change it.
  std::uint64_t hash = 0;
  std::uint64_t hash_in_file = 0;  ///< hash when it was read
};

/// One finding in a scene file.
struct SceneProblem {
  std::uint32_t line = 0;    ///< from 1; 0 = the file as a whole
  std::uint32_t column = 0;  ///< from 1, in code points
  std::string sentence;      ///< error and remedy
};

/// A scene file that cannot be used; what() has one line `FILE:LINE:COLUMN: sentence` per problem.
class SceneFileError : public std::runtime_error {
 public:
  SceneFileError(const std::string& file, std::vector<SceneProblem> problems);
  /// In the file's order, at least one.
  [[nodiscard]] const std::vector<SceneProblem>& problems() const noexcept { return problems_; }

 private:
  std::vector<SceneProblem> problems_;
};

/// Reads the scene at `path`. Set-up code: allocates and throws SceneFileError with all problems.
/// @param effects of the program, see effect_custom.hpp; objects may declare them by their keys
/// @throws std::invalid_argument if the key of an effect equals a scene key, or two effects have
/// the same key
[[nodiscard]] SceneFile load_scene_file(const std::filesystem::path& path,
                                        const haptics::CustomEffects& effects = {});

/// The same for a scene that another peer sent: a file outside its folder is a problem, and its key
/// is not read.
[[nodiscard]] SceneFile load_received_scene(const std::filesystem::path& path);

/// Whether a file is in a folder or below, by name alone.  @param file absolute, without ".."
[[nodiscard]] bool is_within(const std::filesystem::path& file,
                             const std::filesystem::path& folder);

/// The same for text; `file` is its name in messages, and relative paths start at `folder`.
[[nodiscard]] SceneFile parse_scene_file(std::string_view text, const std::string& file,
                                         const std::filesystem::path& folder = ".",
                                         const haptics::CustomEffects& effects = {});

/// The hash of a scene that was changed or made in code; load_scene_file calls it.
[[nodiscard]] std::uint64_t scene_hash(const SceneFile& file);

}  // namespace reckon::peer
