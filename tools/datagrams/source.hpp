// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Opens the datagram source that the user names.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reckon/peer/capture/datagram_source.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::tools {

/// Source of the datagrams, as typed.
struct SourceChoice {
  std::string source;  ///< empty: the default groups; else udp://..., iface:..., raw:..., -, or a
                       ///< capture file
  std::string interface;  ///< --iface for groups: name, address or index; empty: every one
  std::optional<std::uint64_t> pool;  ///< --pool: groups joined after the base group
  bool follow = false;                ///< --follow: waits at the end of a growing capture file
  bool sealed = false;                ///< use the default groups of a sealed exercise
};

/// The groups of the choice: the base group and the pool after it. The default is 239.192.1.0:3000
/// with 256 groups. A named `udp://GROUP[:PORT]` has no pool unless one is requested. It may also
/// be a broadcast address, an address of this host, or 0.0.0.0.
/// @throws UsageError.
[[nodiscard]] std::vector<peer::GroupAddress> groups_of(const SourceChoice& choice);

/// The groups of a scene's peers. @throws UsageError for a scene with unicast
[[nodiscard]] std::vector<peer::GroupAddress> groups_of(const peer::SceneFile& scene);

/// Refuses words that resemble a source but are not one, such as `lo` and `239.1.2.3:3000`.
/// @throws UsageError with a suggestion
void check_form(const std::string& source);

/// Whether the source is a scene: a file with a scene's ending that is no capture.
[[nodiscard]] bool names_scene(const std::string& source);

/// Whether the choice selects live groups.
[[nodiscard]] bool means_groups(const SourceChoice& choice);

/// Whether more datagrams may arrive at any time: live groups or an interface.
[[nodiscard]] bool is_live(const SourceChoice& choice);

/// Opens the source. @throws UsageError for a file that cannot be read, EnvironmentError for a
/// network that cannot be used.
[[nodiscard]] std::unique_ptr<peer::DatagramSource> open_chosen_source(const SourceChoice& choice);

}  // namespace reckon::tools
