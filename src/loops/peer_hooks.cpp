// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/peer_hooks.hpp"

#include <memory>

#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/loops/budget_keeper.hpp"
#include "reckon/peer/loops/channel_keeper.hpp"
#include "reckon/peer/loops/custom_effect_watch.hpp"
#include "reckon/peer/loops/known_sources_publisher.hpp"
#include "reckon/peer/loops/limit_watch.hpp"
#include "reckon/peer/loops/link_watch.hpp"
#include "reckon/peer/loops/loss_watch.hpp"
#include "reckon/peer/loops/model_wiring.hpp"

namespace reckon::peer {
namespace {

bool always(const SceneFile&) { return true; }
bool has_budget(const SceneFile& scene) { return scene.aoim.awareness.budget > 0.0; }

PeerHooks channels(const ModelWiring&) {
  const auto keeper = std::make_shared<ChannelKeeper>();
  return {.look = [keeper](const WatchedPeer& peer) {
    keeper->look(peer.remote, peer.aoim, peer.now);
  }};
}

PeerHooks budget(const ModelWiring& wiring) {
  const auto keeper = std::make_shared<BudgetKeeper>(wiring.scene);
  return {
      .look =
          [keeper](const WatchedPeer& peer) {
            keeper->look(peer.remote, peer.aoim, peer.now, peer.notices);
          },
      .received =
          [keeper](std::span<const std::byte> datagram) { keeper->note_heard(datagram.size()); }};
}

PeerHooks known_sources(const ModelWiring& wiring) {
  const auto known = std::make_shared<KnownSourcesPublisher>(wiring.known);
  return {.look = [known](const WatchedPeer& peer) { known->publish(peer.aoim.presence()); }};
}

PeerHooks custom_effects(const ModelWiring& wiring) {
  if (wiring.custom_effects.empty()) return {};
  const auto watch = std::make_shared<CustomEffectWatch>(wiring.custom_effects);
  return {.look = [watch](const WatchedPeer& peer) { watch->look(peer.notices); }};
}

PeerHooks limits(const ModelWiring& wiring) {
  const auto watch = std::make_shared<LimitWatch>(wiring.scene.network.entities, wiring.counters);
  return {.look = [watch](const WatchedPeer& peer) {
    watch->look(peer.unfelt, peer.unpressed, peer.crowder, peer.remote.last_refused(), peer.now,
                peer.notices);
  }};
}

PeerHooks losses(const ModelWiring&) {
  const auto watch = std::make_shared<LossWatch>();
  return {.look = [watch](const WatchedPeer& peer) {
    watch->look(peer.aoim.sequences().counts(), peer.now, peer.notices);
  }};
}

PeerHooks link(const ModelWiring& wiring) {
  const auto watch = std::make_shared<LinkWatch>(wiring.link, wiring.pool.base(),
                                                 wiring.scene.network.bundle_max, wiring.counters);
  return {.look = [watch](const WatchedPeer& peer) {
    watch->look(peer.now, peer.notices);
    peer.aoim.note_own_source(source_of(watch->own_endpoint(), 0), peer.now);
  }};
}

struct HookRow {
  std::string_view name;
  bool (*is_on)(const SceneFile& scene);
  PeerHooks (*make)(const ModelWiring& wiring);
};

// THE list, in the order of the calls.
// clang-format off
constexpr HookRow kHookRows[]{
    {"channels", always, channels},
    {"budget", has_budget, budget},
    {"known_sources", always, known_sources},
    {"custom_effects", always, custom_effects},
    {"limits", always, limits},
    {"losses", always, losses},
    {"link", always, link}};
// clang-format on

constexpr CounterGroup kActs{"acts", "mechanism", "what mechanisms refused, held or changed"};

}  // namespace

HookList::HookList(const ModelWiring& wiring) {
  for (const HookRow& row : kHookRows) {
    if (row.is_on(wiring.scene)) add(row.name, row.make(wiring), wiring.counters);
  }
  for (const NamedHooks& program : wiring.mechanisms)
    add(program.name, program.hooks, wiring.counters);
}

bool HookList::all_arrive(std::span<const std::byte> datagram, const Arrival& arrival) const {
  for (const pdu::BundledPdu& pdu : pdu::BundleReader(datagram)) {
    if (!arriving.pass({pdu, arrival})) return false;
  }
  return true;
}

void HookList::add(std::string_view name, const PeerHooks& hooks, Counters& counters) {
  const auto watch = [](auto& list, const auto& hook) {
    if (hook) list.push_back(hook);
  };
  watch(look_, hooks.look);
  watch(sent_, hooks.sent);
  watch(received_, hooks.received);
  const auto act = [&](auto& list, const auto& hook) {
    if (!hook) return;
    list.add(hook, counters.make_in(kActs, name, "acts_" + std::string(name),
                                    "PDUs, updates or datagrams that this mechanism refused, held "
                                    "or changed"));
  };
  act(arriving, hooks.arriving);
  act(deciding, hooks.deciding);
  act(routing, hooks.routing);
  act(leaving, hooks.leaving);
}

}  // namespace reckon::peer
