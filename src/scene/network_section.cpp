// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// [network] and [impairment]: sending, and impairment of received datagrams.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "reckon/aoim/bundling/aggregator.hpp"
#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/peer/network/interface_choice.hpp"
#include "reckon/peer/notation/simulation_names.hpp"
#include "reckon/peer/scene/scene_sections.hpp"

namespace reckon::peer {
namespace {

Section<BundleClass> bundle_class_section() {
  const auto text = [](const BundleClass&) { return std::string(); };
  return {{
              {"type", text,
               "required; as in [[entity]]; missing numbers and 0 match any: \"1.1\" is all land "
               "platforms"},
              {"hold", in(&BundleClass::policy, &BundlePolicy::hold), within("s", 0, 1),
               "as in [network.bundle]"},
              {"updates", in(&BundleClass::policy, &BundlePolicy::updates),
               within("", 0, kMaxDatagram), "as in [network.bundle]"},
          },
          [](TomlReader& table, BundleClass& one) {
            table.require("type");
            read_entity_type(table, one.type);
          }};
}

Section<NetworkConfig> bundle_section() {
  return {{
      {"max", &NetworkConfig::bundle_max, within("B", aoim::kLeastPayload, kMaxDatagram),
       "payload of a datagram, headers of IP and UDP not counted"},
      {"hold", in(&NetworkConfig::bundle, &BundlePolicy::hold), within("s", 0, 1),
       "a due pose waits at most this long for others in its bundle; events and forces are sent at "
       "once"},
      {"updates", in(&NetworkConfig::bundle, &BundlePolicy::updates), within("", 0, kMaxDatagram),
       "a bundle with this many poses is sent at once; 0: as many as fit"},
      {"class", &NetworkConfig::bundle_classes, bundle_class_section(),
       "another policy for some types of entities; the first match applies"},
  }};
}

// Whether a list of simulations names the site of the scene, which no peer has.
bool names_scene(TomlReader& table, std::string_view key, const std::string& text) {
  const auto names = parse_simulations(text);
  const bool is_named =
      names && std::ranges::find(*names, aoim::kSceneSite, &aoim::PeerId::site) != names->end();
  if (is_named)
    table.problem(key, fmt::format("'{}' names site {}, which belongs to the scene's bodies: list "
                                   "the peers that own them",
                                   key, aoim::kSceneSite));
  return is_named;
}

void check_management(TomlReader& table, NetworkConfig& config) {
  std::string text = config.management.text();
  table.read("allow_management", text);
  if (names_scene(table, "allow_management", text)) return;
  if (const auto rule = ManagementRule::parse(text)) {
    config.management = *rule;
  } else {
    table.problem("allow_management",
                  fmt::format("'allow_management' is \"{}\"; write nobody, members, anyone, or "
                              "site:application such as \"1:2, 40:1\"",
                              text));
  }
}

void check_touch(TomlReader& table, NetworkConfig& config) {
  std::string text;
  table.texts("touch", [&](const std::string& one) { text += (text.empty() ? "" : ", ") + one; });
  if (!table.has("touch")) return;
  if (names_scene(table, "touch", text)) return;
  config.touch = TouchRule::parse(text);
  if (!config.touch)
    return table.problem("touch", fmt::format("'touch' is \"{}\"; write scene, all, members, or "
                                              "site:application such as \"1:2, 40:1\"",
                                              text));
  if (config.touch->wants_peers() && config.interop)
    table.problem("touch",
                  "peers do not announce themselves in an 'interop' exercise: set 'touch' to all, "
                  "or list the permitted peers as site:application");
  else if (config.touch->wants_key() && !table.has("key"))
    table.problem("touch",
                  "'touch' is \"members\", which requires a key: add 'key', or list the permitted "
                  "peers as site:application");
}

void check_peers(TomlReader& table, NetworkConfig& config) {
  table.each_text("peers",
                  [&](const std::string& text) { config.peers.push_back(parse_peer(text)); });
  try {
    check_number(config.peers);
  } catch (const std::invalid_argument& error) {
    table.problem("peers", fmt::format("'peers': {}", error.what()));
  }
}

void check_lenient(TomlReader& table, const NetworkConfig& config) {
  if (!config.lenient) return;
  if (!config.interop)
    table.problem("lenient",
                  "'lenient' is only for plain DIS: set 'interop' too, or remove 'lenient'");
  if (table.has("key"))
    table.problem("lenient", "a sealed exercise cannot be 'lenient': remove 'lenient' or 'key'");
}

void check_network(TomlReader& table, NetworkConfig& config) {
  config.exercise_named = table.has("exercise");
  check_lenient(table, config);
  check_management(table, config);
  check_touch(table, config);
  check_peers(table, config);
  std::string text = config.group.address_text();
  table.read("group", text);
  std::uint16_t port = config.group.port;
  table.read("port", port);
  const auto parsed = GroupAddress::parse(text, port);
  if (!parsed || !(parsed->is_multicast() || may_be_broadcast(*parsed))) {
    return table.problem("group",
                         fmt::format("'group' is \"{}\"; write a multicast address such as "
                                     "\"239.192.1.0\" or \"ff15::c0:100\", or \"255.255.255.255\" "
                                     "or the subnet's broadcast address with 'interop'",
                                     text));
  }
  if (!parsed->is_multicast() && !config.interop) {
    return table.problem("group",
                         "'group' is broadcast, which has no groups for cells: set 'interop', or "
                         "write a multicast address");
  }
  if (parsed->port != port) {
    return table.problem("group", "'group' contains a port: write it as 'port'");
  }
  config.group = *parsed;
}

void check_impairment(TomlReader& table, ImpairmentConfig& config) {
  const std::string problem = config.law.problem();
  if (!problem.empty()) table.problem("", problem);
}

}  // namespace

Section<NetworkConfig> network_section() {
  const auto address = [](const NetworkConfig& config) { return config.group.address_text(); };
  const auto port = [](const NetworkConfig& config) { return config.group.port; };
  const auto peers = [](const NetworkConfig&) { return std::vector<std::string>(); };
  const auto management = [](const NetworkConfig& config) { return config.management.text(); };
  const auto touch = [](const NetworkConfig& config) { return config.touch_rule().text(); };
  return {
      {
          {"group", address,
           "base group, IPv4 or IPv6; with `interop`, if multicast is disabled, also "
           "255.255.255.255 or the broadcast address of the subnet: either receives both"},
          {"port", port, within("", 1, 65535), "UDP port"},
          {"interop", &NetworkConfig::interop,
           "plain DIS to the base group, for other DIS programs"},
          {"lenient", &NetworkConfig::lenient,
           "with `interop`: a PDU whose length field is 0, as some free DIS libraries send it, is "
           "read as the rest of its datagram"},
          {"exercise", &NetworkConfig::exercise, within("", 1, 255),
           "DIS exercise; PDUs of other exercises are ignored"},
          {"ttl", &NetworkConfig::ttl, within("", 1, 255), "hops; 1 stays on this LAN"},
          {"iface", &NetworkConfig::iface,
           "interface name or address; when absent, chosen by the rule that `reckon doctor` "
           "shows"},
          {"rate", &NetworkConfig::rate, within("", 100, 1e6),
           "datagrams a second in one group from all peers; the receive buffer should hold 50 ms "
           "of them; a smaller one is reported"},
          {"offload", &NetworkConfig::offload,
           "the kernel segments and coalesces datagrams (UDP_SEGMENT, UDP_GRO) if it can"},
          {"key", &NetworkConfig::key,
           "key file beside the scene file: the exercise is sealed, on the port above `port`; "
           "when absent, plain DIS"},
          {"peers", peers,
           "for networks without multicast: the hosts that receive each datagram, for example "
           "[\"10.0.0.7\", \"host-b:3001\"]; the same list for all peers; `--to` overrides it"},
          {"allow_management", management,
           "senders whose Stop/Freeze and Start/Resume are obeyed: nobody, members (peers of this "
           "scene), anyone, or a list of site:application, for example \"1:2, 40:1\""},
          {"touch", touch,
           "owners of felt bodies: scene (peers that announced this scene), all, members (peers "
           "that proved to have the `key`), or a list of site:application, for example [\"1:2\", "
           "\"40:1\"], of peers and plain DIS programs, each at the address that used its number "
           "first. With `interop` the default is all"},
          {"entities", &NetworkConfig::entities,
           within("", 1, static_cast<double>(NetworkConfig::kMostEntities)),
           "most entities of other peers and programs; further ones are counted (`table_full`) and "
           "not shown. Memory is used as they come, some 1 kB each"},
          {"strangers_memory", &NetworkConfig::strangers_memory, within("B", 65536, 1e12),
           "memory for entities of plain DIS programs; 32 MiB hold 12,000 to 30,000 of them"},
          {"compression", &NetworkConfig::compression,
           "of Entity States, the same for all peers: compact: rounded and short, each complete; "
           "residual: differences from a prediction by the last ones"},
          {"bundle", std::identity(), bundle_section(), "many PDUs in one datagram"},
      },
      check_network};
}

Section<Outage> outage_section() {
  return {{
      {"start", &Outage::start, within("s", 0, 1e9), "after the start of the run"},
      {"duration", &Outage::duration, within("s", 0, 1e9), "how long"},
      {"period", &Outage::period, within("s", 0, 1e9), "repetition time; 0 is once"},
  }};
}

Section<ImpairmentConfig> impairment_section() {
  using Law = ImpairmentLaw;
  const auto law = [](auto member) { return in(&ImpairmentConfig::law, member); };
  return {
      {
          {"delay", law(&Law::delay), within("s", 0, 10), "one way"},
          Row<ImpairmentConfig>("jitter", law(&Law::jitter), within("s", 0, 10),
                                "the delay varies uniformly by up to this much, both ways")
              .or_share_of("delay"),
          {"loss", law(&Law::loss), within("", 0, 1),
           "share of datagrams lost, independently of each other"},
          {"burst_loss", law(&Law::burst_loss), within("", 0, 0.999),
           "share of datagrams lost in bursts"},
          {"burst_length", law(&Law::burst_length), within("", 1, Law::kMostBurstLength),
           "mean datagrams in such a burst"},
          {"reorder", law(&Law::reorder), within("", 0, 1), "share of datagrams held back"},
          {"reorder_delay", law(&Law::reorder_delay), within("s", 0, 10), "their additional delay"},
          {"duplicate", law(&Law::duplicate), within("", 0, 1),
           "share of datagrams that arrive twice"},
          {"seed", &ImpairmentConfig::seed, within("", 0, 9007199254740992.0),
           "equal seeds give equal impairment"},
          {"outage", law(&Law::outages), outage_section(), "a time in which no datagram passes"},
      },
      check_impairment};
}

}  // namespace reckon::peer
