// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/running_peer.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "reckon/peer/scene/belongings.hpp"
#include "reckon/tools/exercise/native_code.hpp"
#include "reckon/tools/verbs/demo_page.hpp"

namespace reckon::tools {

bool asks_for_number(const peer::SceneFile& scene, const PeerVerbOptions& options) {
  return !options.operator_number && peer::peers_of(scene) > 1 && !scene.network.interop;
}

RunningPeer::RunningPeer(const peer::SceneFile& scene, const PeerVerbOptions& options,
                         const Console& console, EntityEvents& events, peer::DatagramTap* tap)
    : real_(plugins_of(options.device)),
      joined_(federate_options(scene, options, hands_, real_, tap, stop_.stop()),
              options.events ? &events : nullptr) {
  if (joined_.options().deal) {
    fmt::print(console.err,
               "this is peer {} of the scene, the first free number; --operator sets it\n",
               joined_.options().scene_peer);
  }
  for (const std::string& sentence : joined_.link_report()) {
    fmt::print(console.err, "{}\n", sentence);
  }
  joined_.run();
}

std::vector<std::string> RunningPeer::link_warnings() const {
  std::vector<std::string> warnings = joined_.link_report();
  std::erase_if(warnings, [](const std::string& one) { return !one.starts_with("WARNING"); });
  return warnings;
}

std::vector<std::string> RunningPeer::device_notices() {
  std::vector<std::string> all = real_.take_notices();
  for (std::string& sentence : hands_.take_notices()) all.push_back(std::move(sentence));
  for (std::string& sentence : stop_.take_notices()) all.push_back(std::move(sentence));
  return all;
}

peer::FederateOptions RunningPeer::federate_options(const peer::SceneFile& scene,
                                                    const PeerVerbOptions& options,
                                                    SimulatedHands& hands, RealDevices& real,
                                                    peer::DatagramTap* tap,
                                                    haptics::ForceStop& stop) {
  peer::FederateOptions own;
  own.tap = tap;
  own.force_stop = &stop;
  own.name = options.name;
  own.scene = scene;
  own.loops = peer::FederateLoops::threads;
  own.offers_scene = true;
  own.even_if_slow = options.scene.even_if_slow;
  own.body_pace = pace_of(options.scene);
  if (options.application) own.application = static_cast<std::uint16_t>(*options.application);
  const bool lends = flags_of_switch(options.view).has_value();
  const auto make_hands = [&scene, &options, &hands, &real, lends](std::uint32_t number) {
    peer::SceneFile held = scene;
    choose_device(options.device, held, number, peer::kMostPeers);
    if (lends) let_pages_move_hands(held, number);
    hands = make_simulated_hands(held, number);
    real.plug_in(held, number, hands.wired);
    return hands.wired;
  };
  if (asks_for_number(scene, options)) {
    own.deal = make_hands;
  } else {
    own.scene_peer = static_cast<std::uint32_t>(options.operator_number.value_or(1));
    own.devices = make_hands(own.scene_peer);
  }
  return own;
}

std::unique_ptr<RunningPeer> joined_peer(const peer::SceneFile& scene,
                                         const PeerVerbOptions& options, const Console& console,
                                         EntityEvents& events, peer::DatagramTap* tap) {
  try {
    return std::make_unique<RunningPeer>(scene, options, console, events, tap);
  } catch (const UsageError&) {
    throw;
  } catch (const peer::StepTooDear& slow) {
    throw EnvironmentError(refusal_of(slow));
  } catch (const std::runtime_error& error) {
    throw EnvironmentError(error.what());
  }
}

}  // namespace reckon::tools
