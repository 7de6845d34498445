// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>

#include "reckon/peer/loops/notice.hpp"

namespace reckon::peer {
namespace {

constexpr NoticeFacts kFacts[]{
    {"other", Severity::info, "a notice of no other kind"},
    {"joined", Severity::info, "a peer appeared"},
    {"started-anew", Severity::info, "a peer restarted"},
    {"left", Severity::info, "a peer sent a farewell"},
    {"silent", Severity::warning, "a peer was silent for too long"},
    {"other-scene", Severity::warning, "a peer was not joined, because it runs another scene"},
    {"quiet", Severity::warning, "nothing is received from a peer at present"},
    {"unheard", Severity::warning, "a peer does not receive this one"},
    {"heard-again", Severity::info, "the end of `quiet` or `unheard`"},
    {"renamed", Severity::info, "a peer took another number"},
    {"number-taken", Severity::warning, "this peer took another number, because its own was taken"},
    {"claimed-twice", Severity::warning, "two hosts claim the number of one peer"},
    {"moved", Severity::info, "a peer has another address"},
    {"impostor", Severity::warning, "a host uses the identity of a peer"},
    {"crowd", Severity::warning, "a host announces more peers than one host may"},
    {"slept", Severity::warning, "this host was suspended"},
    {"muted", Severity::warning, "a host sends too many datagrams; the excess is dropped"},
    {"left-out", Severity::warning, "lines about one host were omitted"},
    {"interface", Severity::warning, "the network interface changed"},
    {"payload-cut", Severity::warning, "the MTU is smaller than the longest bundle"},
    {"base-unjoined", Severity::error, "the base group cannot be joined: no peer is received"},
    {"groups-unjoined", Severity::error, "groups cannot be joined"},
    {"send-fails", Severity::error, "datagrams cannot be sent"},
    {"held-back", Severity::warning, "the interface is slower than the traffic"},
    {"kernel-drops", Severity::warning, "the receive buffer of the kernel is full"},
    {"groups-capped", Severity::warning, "the radius needs more groups than are allowed"},
    {"peers-full", Severity::warning, "the table of peers is full"},
    {"numberings-full", Severity::warning, "lost datagrams are not all counted"},
    {"nothing-near", Severity::warning, "entities are received, but none within the radius"},
    {"frozen", Severity::info, "an order of Simulation Management froze or resumed this peer"},
    {"order-refused", Severity::warning, "an order of Simulation Management was refused"},
    {"name-disputed", Severity::warning, "a host sends entities of another peer"},
    {"touch-refused", Severity::warning, "an entity is not felt, by `touch`"},
    {"body-disputed", Severity::warning, "a host sends a body of the scene that it does not own"},
    {"bodies-adopted", Severity::info, "bodies have another owner, because theirs failed or left"},
    {"bodies-rest", Severity::warning,
     "too few of the peers that own bodies are received: their bodies rest"},
    {"worlds-met", Severity::warning, "owners of an older world replaced those of this one"},
    {"inside-hand", Severity::warning, "a body appeared inside a hand and is not felt"},
    {"rows-evicted", Severity::warning, "entities of one host were removed for those of others"},
    {"strangers-full", Severity::warning,
     "plain DIS programs have more entities than `strangers_memory` holds"},
    {"presses", Severity::warning, "a peer that `touch` does not name presses a hand"},
    {"body-silent", Severity::warning, "the owner of a felt body is silent"},
    {"hands-silent", Severity::warning, "the owner of a felt hand is silent"},
    {"softened", Severity::warning, "a device shows less stiffness than requested"},
    {"crowded", Severity::warning, "more bodies are near a hand than can be felt"},
    {"table-full", Severity::warning, "the table of entities is full"},
    {"write-full", Severity::warning, "the ring to the network is full"},
    {"read-waits", Severity::warning, "the ring from the network is full"},
    {"sealed", Severity::error, "the exercise is sealed and this peer has no key"},
    {"datagrams-refused", Severity::warning,
     "datagrams were refused: exercise, DIS version, header or length 0"},
    {"model-refused", Severity::warning, "a force model has impossible values"},
    {"clock-leap", Severity::warning, "the clock of this host was set"},
    {"lost", Severity::warning, "many datagrams of the other peers were lost"},
    {"stretched", Severity::warning, "distances are stretched to meet `[aoim] budget`"},
    {"budget-unmet", Severity::warning, "`[aoim] budget` cannot be met"},
    {"budget-cut", Severity::warning, "far cells were left to meet `[aoim] budget`"},
    {"leader", Severity::info, "the scene or a cell has another leader"},
    {"beacon", Severity::info, "a followed beacon is in another cell, or in none"},
    {"beacon-disputed", Severity::warning, "two peers carry one beacon"},
    {"effect", Severity::warning, "an effect of the user was cut or switched off"},
    {"number-held", Severity::info, "the application number of this peer in plain DIS"},
    {"servo-slow", Severity::warning, "a step of the servo takes longer than its period"},
    {"key", Severity::info, "changes of the key"},
    {"device", Severity::warning, "a device changed its state"},
    {"undelivered", Severity::warning, "an assured message did not reach a peer"},
    {"scene-not-offered", Severity::info, "this peer does not offer the files of its scene"},
};
constexpr std::string_view kSeverities[]{"info", "warning", "error"};

}  // namespace

const NoticeFacts& facts_of(NoticeKind kind) noexcept {
  return kFacts[static_cast<std::size_t>(kind)];
}

std::string_view name_of(Severity severity) noexcept {
  return kSeverities[static_cast<std::size_t>(severity)];
}

std::span<const NoticeFacts> all_notice_facts() noexcept { return kFacts; }

}  // namespace reckon::peer
