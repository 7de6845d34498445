// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/captures/replay_reach.hpp"

#include <fmt/format.h>
#include <net/if.h>

#include <algorithm>

#include "reckon/tools/captures/replay_senders.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {
namespace {

/// An interface for an example.
std::string name_of_a_lan() {
  const std::vector<LocalNetwork> networks = local_networks();
  const auto lan = std::ranges::find_if(
      networks, [](const LocalNetwork& network) { return network.interface != "lo"; });
  return lan == networks.end() ? "eth0" : lan->interface;
}

}  // namespace

std::string recorded_interface(const peer::DatagramSource& source) {
  const std::string name(source.interface_name());
  if (name.empty())
    throw UsageError("--iface recorded: the capture names no interface; write --iface eth0");
  if (::if_nametoindex(name.c_str()) == 0)
    throw UsageError(fmt::format(
        "--iface recorded: {} is not on this host; `reckon doctor` lists interfaces", name));
  return name;
}

std::string ReplayReach::text(const std::string& interface) const {
  if (destinations_.empty()) return "nowhere";
  std::string text = destinations_.begin()->text();
  if (destinations_.size() > 1)
    text += fmt::format(" and {}{} more", destinations_.size() < kMost ? "" : "at least ",
                        destinations_.size() - 1);
  text += " on " + interface;
  if (interface != "lo") return text;
  return text + fmt::format(" (only this host; --iface {} for the LAN)", name_of_a_lan());
}

}  // namespace reckon::tools
