// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The files of a scene as objects, and the manifest that lists them.
//
//   reckon scene 1
//   <hash, 64 digits> <octets> two_hands.toml
//   <hash, 64 digits> <octets> meshes/touchstone.obj
//
// The first file is the scene.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/peer/objects/object_layout.hpp"
#include "reckon/peer/objects/object_source.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::peer {

/// Bounds of a manifest.
inline constexpr std::size_t kMostPackageFiles = 1000, kMostManifestOctets = 512 << 10,
                             kLongestPackagePath = 255;

/// A file of a scene.
struct PackageFile {
  ObjectHash hash{};
  std::uint64_t size = 0;  ///< at most kMostObjectOctets
  std::string path;        ///< relative to the folder of the scene, with '/'
};

/// @throws std::invalid_argument with the line and the reason, for a text that is no manifest, or
/// that names a path outside the folder, a path twice, or a file as a folder of another one
[[nodiscard]] std::vector<PackageFile> parse_manifest(std::string_view text);
/// The text that parse_manifest() reads.
[[nodiscard]] std::string manifest_text(const std::vector<PackageFile>& files);

/// The objects of a scene; the first one is the manifest.
/// @throws std::runtime_error with the file and the reason if a file cannot be read, is outside the
/// folder of the scene, or if the scene differs from its file; std::invalid_argument beyond the
/// bounds of a manifest
[[nodiscard]] std::vector<std::shared_ptr<const ObjectSource>> package_of(const SceneFile& scene);

}  // namespace reckon::peer
