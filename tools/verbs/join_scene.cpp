// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/join_scene.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <random>
#include <string_view>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/lan_link.hpp"
#include "reckon/peer/objects/scene_receiver.hpp"
#include "reckon/peer/sealing/key_file.hpp"
#include "reckon/peer/sealing/sealed_link.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

constexpr std::chrono::nanoseconds kLongestWait = std::chrono::milliseconds(20);

std::filesystem::path cache_folder() {
  const auto folder_of = [](const char* name) {
    const char* const value = std::getenv(name);
    return std::filesystem::path(value == nullptr ? "" : value);
  };
  if (const auto cache = folder_of("XDG_CACHE_HOME"); cache.is_absolute()) return cache / "reckon";
  if (const auto home = folder_of("HOME"); home.is_absolute()) return home / ".cache/reckon";
  throw EnvironmentError("--join: no folder for received scenes: set XDG_CACHE_HOME");
}

std::string megabytes(std::uint64_t octets) {
  return fmt::format("{:.1f} MB", static_cast<double>(octets) / 1e6);
}

std::string name_of(const pdu::ObjectOffer& offer) {
  std::string name(offer.name.data(), offer.name.size());
  name.resize(std::min(name.find('\0'), name.size()));
  const auto is_printable = [](char letter) { return letter >= ' ' && letter <= '~'; };
  std::ranges::replace_if(name, std::not_fn(is_printable), '?');
  return name;
}

std::string sender_of(const peer::SceneOffer& offer) {
  return fmt::format("peer {}:{} at {}", offer.simulation.site, offer.simulation.application,
                     offer.from.address_text());
}

peer::GroupAddress group_of(const std::string& where) {
  constexpr std::uint16_t kMostPort = 65532;  // further ports of the exercise are above
  const peer::GroupAddress base = peer::GroupPool::ipv4_default().base();
  if (where == "true") return base;
  const auto group = peer::IpEndpoint::parse(where, base.port);
  if (!group || !group->is_multicast() || group->port == 0 || group->port > kMostPort)
    throw UsageError(fmt::format(
        "--join: '{}' is no multicast group with a port up to {}: write the base group of the "
        "exercise, for example {}",
        where, kMostPort, base.text()));
  return *group;
}

bool approve(std::uint64_t octets, const Console& console) {
  if (octets <= kUnaskedOctets) return true;
  if (console.err != stderr || isatty(STDERR_FILENO) != 1 || isatty(STDIN_FILENO) != 1)
    throw UsageError(fmt::format(
        "--join: {} must be fetched; without a terminal at most {} are: start it on a terminal",
        megabytes(octets), megabytes(kUnaskedOctets)));
  fmt::print(console.err, "{} must be fetched for this scene: continue? [y/N] ", megabytes(octets));
  std::fflush(console.err);
  std::array<char, 16> answer{};
  if (std::fgets(answer.data(), answer.size(), stdin) == nullptr) return false;
  return answer[0] == 'y' || answer[0] == 'Y';
}

/// The links and the exchange of a peer that has no scene yet.
struct JoiningLink {
  JoiningLink(peer::GroupAddress base, std::uint8_t exercise, const SceneOptions& options) {
    peer::LanLinkOptions lan_options;
    lan_options.udp.interface = options.iface;
    lan_options.udp.ipv6 = base.is_v6;
    lan = std::make_unique<peer::LanLink>(lan_options, clock);
    if (!options.key.empty()) {
      base = peer::sealed_group(base);
      peer::SealedLinkOptions sealing;
      sealing.key = peer::load_group_key(options.key);
      sealing.base = peer::object_messages_group(base);
      sealing.places.exercise = exercise == 0 ? 1 : exercise;
      sealed = std::make_unique<peer::SealedLink>(lan->link(), std::move(sealing), clock);
    }
    peer::ObjectExchangeOptions exchange_options;
    exchange_options.base = base;
    exchange_options.exercise = exercise;
    exchange_options.epoch = std::random_device{}() | 1U;
    exchange_options.seed = exchange_options.epoch;
    exchange = std::make_unique<peer::ObjectExchange>(link(), clock, exchange_options);
  }
  peer::Link& link() { return sealed ? static_cast<peer::Link&>(*sealed) : lan->link(); }

  peer::SteadyClock clock;
  std::unique_ptr<peer::LanLink> lan;
  std::unique_ptr<peer::SealedLink> sealed;
  std::unique_ptr<peer::ObjectExchange> exchange;
};

// The file is foreign data, and its problems quote it.
std::string refusal_of_scene(const peer::SceneFileError& error) {
  constexpr std::size_t kMost = 5;
  std::string text = "--join: the received scene is refused:";
  for (std::size_t i = 0; i < std::min(error.problems().size(), kMost); ++i) {
    const peer::SceneProblem& problem = error.problems()[i];
    text += fmt::format("\n  line {}: {}", problem.line, printable_text(problem.sentence));
  }
  return text;
}

const peer::SceneOffer& only_one(const std::vector<peer::SceneOffer>& offers,
                                 const peer::GroupAddress& base, bool has_key) {
  if (offers.empty())
    throw EnvironmentError(fmt::format(
        "--join: no peer offers a scene on {} within 3 s: start one with `reckon peer SCENE`, or "
        "give the group of the exercise (--join={}), its interface (--iface){}",
        base.text(), base.text(), has_key ? "" : " or its key (--key)"));
  if (offers.size() == 1) return offers.front();
  std::string list;
  for (const peer::SceneOffer& offer : offers)
    list += fmt::format("\n  {} of {}", name_of(offer.offer), sender_of(offer));
  throw UsageError(fmt::format(
      "--join: {} scenes are played on {}; start this peer with the scene file of one of them:{}",
      offers.size(), base.text(), list));
}

}  // namespace

void join_scene(const JoinPlace& where, SceneOptions& options, const Console& console) {
  const peer::GroupAddress base = group_of(where.group);
  try {
    JoiningLink joining(base, static_cast<std::uint8_t>(where.exercise.value_or(0)), options);
    for (const std::string& sentence : joining.lan->report())
      fmt::print(console.err, "{}\n", sentence);
    const auto pump = [&] {
      joining.exchange->step();
      const auto wait = std::min(kLongestWait, joining.exchange->next_step() - joining.clock.now());
      if (wait.count() > 0) static_cast<void>(joining.link().wait(wait));
      return !console.stopped();
    };
    peer::SceneReceiver receiver(
        *joining.exchange, joining.clock, cache_folder(),
        {pump, [&](std::uint64_t octets) { return approve(octets, console); }});
    const auto begun = joining.clock.now();
    const std::vector<peer::SceneOffer> offers = receiver.find_scenes();
    const peer::SceneOffer& chosen = only_one(offers, base, !options.key.empty());
    const peer::ReceivedScene scene = receiver.receive(chosen.offer);
    fmt::print(
        console.err, "received {} ({} files, {}; {} over the network) from {} in {:.2f} s: {}\n",
        name_of(chosen.offer), scene.files, megabytes(scene.octets), megabytes(scene.fetched),
        sender_of(chosen), pdu::to_seconds(joining.clock.now() - begun), scene.file.string());
    options.scene = scene.file.string();
    options.is_received = true;
  } catch (const UsageError&) {
    throw;
  } catch (const EnvironmentError&) {
    throw;
  } catch (const peer::KeyFileError& error) {
    throw UsageError(error.what());
  } catch (const peer::SceneFileError& error) {
    throw UsageError(refusal_of_scene(error));
  } catch (const std::runtime_error& error) {
    throw EnvironmentError(fmt::format("--join: {}", printable_text(error.what())));
  }
}

}  // namespace reckon::tools
