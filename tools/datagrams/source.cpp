// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "reckon/peer/network/interface_choice.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/sealing/sealed_link.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/command_line/file_kind.hpp"

namespace reckon::tools {
namespace {

constexpr std::string_view kUdp = "udp://";
constexpr std::string_view kInterface = "iface:";
constexpr std::string_view kRaw = "raw:";
constexpr std::string_view kScene = ".toml";

peer::SceneFile scene_of_source(const std::string& source) {
  try {
    peer::SceneFile scene = peer::load_scene_file(source);
    if (scene.network.peers.empty()) return scene;
  } catch (const peer::SceneFileError& error) {
    throw UsageError(error.what());
  }
  throw UsageError(fmt::format(
      "{}: its 'peers' use unicast, which no group carries: inspect iface:NAME", source));
}

/// A base group and the number of groups to join after it.
struct Groups {
  peer::GroupAddress base;
  std::uint64_t size;
};

// Groups of a scene: those for cells, and for contacts if it has some.
Groups groups_of_scene(const peer::SceneFile& scene, bool sealed) {
  const bool is_sealed = sealed || !scene.network.key.empty();
  return {is_sealed ? peer::sealed_group(scene.network.group) : scene.network.group,
          scene.network.interop ? 0 : scene.aoim.all_groups()};
}

std::vector<peer::GroupAddress> addresses_of(const Groups& named) {
  std::vector<peer::GroupAddress> groups{named.base};
  if (named.size == 0) return groups;
  try {
    const peer::GroupPool pool(named.base, named.size);
    for (std::size_t i = 0; i < pool.size(); ++i) groups.push_back(pool.address(i));
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  return groups;
}

peer::GroupAddress base_group(const SourceChoice& choice) {
  const std::string& source = choice.source;
  if (source.empty()) {
    const peer::GroupAddress plain = peer::GroupPool::ipv4_default().base();
    return choice.sealed ? peer::sealed_group(plain) : plain;
  }
  const std::string_view text = std::string_view(source).substr(kUdp.size());
  const auto group = peer::IpEndpoint::parse(text, peer::GroupPool::kDefaultPort);
  if (!group.has_value())
    throw UsageError(fmt::format(
        "'{}' is not an address; write udp://239.192.1.0:3000, udp://239.192.1.0, "
        "udp://[ff15::1]:3000, a broadcast address such as udp://255.255.255.255, or an "
        "address of this host",
        source));
  return *group;
}

/// Interprets a word that is no file as an interface of this host or an address.
/// @returns what may be meant; empty if it is neither
std::string meant_by(const std::string& source) {
  std::error_code ignored;
  if (std::filesystem::exists(source, ignored)) return "";
  if (peer::IpEndpoint::parse(source)) return fmt::format("udp://{}", source);
  const auto all = peer::list_interfaces();
  const auto is_it = [&](const peer::NetworkInterface& one) { return one.name == source; };
  if (std::none_of(all.begin(), all.end(), is_it)) return "";
  return fmt::format(
      "--iface {} for the groups received there, or iface:{} for all of its UDP (needs "
      "CAP_NET_RAW)",
      source, source);
}

}  // namespace

void check_form(const std::string& source) {
  if (source == kRaw || source == kInterface)
    throw UsageError(
        fmt::format("'{}' has no name after the colon; write {}", source,
                    source == kRaw ? "raw:FILE" : "iface:NAME, for example iface:eth0"));
  if (const std::string meant = meant_by(source); !meant.empty())
    throw UsageError(fmt::format("there is no file '{}'; did you mean {}?", source, meant));
  const std::size_t scheme = source.find("://");
  if (scheme == std::string::npos || source.starts_with(kUdp) || source.find('/') < scheme) return;
  throw UsageError(
      fmt::format("there is no source '{}'; write udp://ADDRESS[:PORT], iface:NAME, raw:FILE, a "
                  "scene, a capture file, or - for one on stdin",
                  source.substr(0, scheme + 3)));
}

bool means_groups(const SourceChoice& choice) {
  return choice.source.empty() || choice.source.starts_with(kUdp) || names_scene(choice.source);
}

bool is_live(const SourceChoice& choice) {
  return means_groups(choice) || choice.source.starts_with(kInterface);
}

std::vector<peer::GroupAddress> groups_of(const SourceChoice& choice) {
  Groups named =
      names_scene(choice.source)
          ? groups_of_scene(scene_of_source(choice.source), choice.sealed)
          : Groups{base_group(choice), choice.source.empty() ? peer::GroupPool::kDefaultSize : 0};
  named.size = choice.pool.value_or(named.size);
  return addresses_of(named);
}

std::vector<peer::GroupAddress> groups_of(const peer::SceneFile& scene) {
  if (!scene.network.peers.empty())
    throw UsageError("the scene's 'peers' use unicast, which no group carries");
  return addresses_of(groups_of_scene(scene, false));
}

bool names_scene(const std::string& source) {
  return source.ends_with(kScene) && !source.starts_with(kRaw) &&
         kind_of_file(source) != FileKind::capture;
}

std::unique_ptr<peer::DatagramSource> open_chosen_source(const SourceChoice& choice) {
  check_form(choice.source);
  if (!means_groups(choice) && (choice.pool.has_value() || !choice.interface.empty()))
    throw UsageError(fmt::format(
        "--iface and --pool are for live groups, not for '{}': remove them", choice.source));
  try {
    if (!means_groups(choice)) return peer::open_source(choice.source, choice.follow);
    std::string interface = choice.interface;
    if (interface.empty() && names_scene(choice.source))
      interface = scene_of_source(choice.source).network.iface;
    return peer::open_groups({.interface = interface, .groups = groups_of(choice)});
  } catch (const UsageError&) {
    throw;
  } catch (const std::runtime_error& error) {
    if (is_live(choice)) throw EnvironmentError(error.what());
    if (choice.source.starts_with(kRaw))
      throw UsageError(fmt::format("{}; raw: needs a file of one bare datagram", error.what()));
    throw UsageError(error.what());
  }
}

}  // namespace reckon::tools
