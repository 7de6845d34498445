// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/joined_peer.hpp"

#include <algorithm>
#include <random>
#include <stdexcept>
#include <thread>
#include <utility>

#include "reckon/pdu/reckon/unicast_frame.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/loops/life_proof.hpp"
#include "reckon/peer/loops/notice_text.hpp"
#include "reckon/peer/loops/roll_call.hpp"
#include "reckon/peer/network/application_hold.hpp"
#include "reckon/peer/network/site_number.hpp"
#include "reckon/peer/objects/object_service.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/step_cost/step_check.hpp"

namespace reckon::peer {
namespace {

constexpr std::chrono::milliseconds kLeavingStep{1};

LanLinkOptions lan_options(const FederateOptions& options) {
  const SceneFile& scene = *options.scene;
  LanLinkOptions lan;
  lan.udp.interface = options.interface.empty() ? scene.network.iface : options.interface;
  lan.udp.ipv6 = scene.network.group.is_v6;
  lan.udp.broadcast = may_be_broadcast(scene.network.group);
  lan.udp.ttl = scene.network.ttl;
  lan.udp.receive_buffer = receive_room(static_cast<double>(scene.network.rate), kLongestStall,
                                        scene.network.bundle_max);
  lan.udp.offload = scene.network.offload;
  lan.udp.read_first = urgent_pool_of(scene);
  if (lan.udp.read_first && !scene.network.key.empty()) {
    const GroupPool& plain = *lan.udp.read_first;
    lan.udp.read_first = GroupPool(sealed_group(plain.base()), plain.size());
  }
  lan.udp.tap = options.tap;
  const bool has_key = !scene.network.key.empty();
  lan.pool = GroupPool(has_key ? sealed_group(scene.network.group) : scene.network.group,
                       pool_of(scene).size());
  lan.peers = options.peers.empty() ? scene.network.peers : options.peers;
  lan.exercise = scene.network.exercise;
  lan.plain = scene.network.interop;
  if (!lan.peers.empty()) {
    lan.udp.framed = lan.pool;
    lan.udp.max_datagram += pdu::kUnicastFrameSize;
    lan.udp.unicast_port = lan.pool.base().port;  // the only port that others know
  }
  lan.law = scene.impairment.law;
  lan.changes = options.impairment_changes;
  lan.seed = scene.impairment.seed;
  lan.receiver = options.receiver;
  return lan;
}

}  // namespace

JoinedPeer::JoinedPeer(const FederateOptions& options, ModelGuest* guest)
    : options_(options),
      clock_(&steady_),
      lan_(std::make_unique<LanLink>(lan_options(options_), steady_)) {
  join(lan_->link(), site_of(lan_->link().local_endpoint()),
       {std::random_device{}() | 1u, draw_chain_secret()}, guest);
}

JoinedPeer::JoinedPeer(const FederateOptions& options, Link& link, const Clock& clock,
                       std::uint32_t epoch, ModelGuest* guest)
    : options_(options), clock_(&clock) {
  join(link, PeerOptions{}.site, {epoch, chain_secret_of(epoch)}, guest);
}

JoinedPeer::~JoinedPeer() { resign(); }

// Reckon peers of a scene agree on their IDs by datagrams; plain DIS has no such datagrams.
std::uint16_t JoinedPeer::application(std::uint16_t site) {
  const NetworkConfig& network = options_.scene->network;
  if (lan_ && network.interop)
    hold_ = std::make_unique<ApplicationHold>(
        ApplicationScope{network.group, network.exercise, site}, options_.application);
  return hold_ ? hold_->number() : options_.application.value_or(PeerOptions{}.application);
}

SealedLinkOptions JoinedPeer::sealing(const GroupAddress& base, std::uint16_t site) const {
  const NetworkConfig& network = options_.scene->network;
  SealedLinkOptions sealing;
  sealing.key = load_group_key(network.key);
  sealing.base = base;
  sealing.site = site;
  sealing.application = options_.application.value_or(PeerOptions{}.application);
  sealing.places.exercise = network.exercise;
  return sealing;
}

// The link that the peer uses: `link` itself, or a sealed link around it.
Link& JoinedPeer::sealed(Link& link, std::uint16_t site) {
  NetworkConfig& network = options_.scene->network;
  if (network.key.empty()) {
    if (network.touch_rule().wants_key())
      throw std::invalid_argument("'touch' of the scene is members, which requires a key");
    return link;
  }
  if (network.interop)
    throw std::invalid_argument(
        "'interop' needs plain DIS, and a key seals it: remove one of them");
  network.group = sealed_group(network.group);
  SealedLinkOptions options = sealing(network.group, site);
  const bool is_listed = lan_ && !(options_.peers.empty() && network.peers.empty());
  if (is_listed) options.places.listed = pool_of(*options_.scene);
  options.tap = options_.tap;
  sealed_ = std::make_unique<SealedLink>(link, std::move(options), *clock_);
  return *sealed_;
}

// A failure is reported; the peer itself can do without.
void JoinedPeer::offer_scene() {
  const SceneFile& scene = *options_.scene;
  const bool is_listed = !(options_.peers.empty() && scene.network.peers.empty());
  if (!lan_ || objects_ || is_listed || scene.network.interop) return;
  try {
    ObjectExchangeOptions exchange;
    exchange.base = scene.network.group;
    exchange.exercise = scene.network.exercise;
    exchange.epoch = std::random_device{}() | 1u;
    exchange.seed = exchange.epoch;
    exchange.simulation = {own_.site, own_.application};
    const GroupAddress messages = object_messages_group(exchange.base);
    LanLinkOptions lan = lan_options(options_);
    lan.udp.tap = nullptr;
    lan.udp.read_first.reset();
    objects_lan_ = std::make_unique<LanLink>(lan, steady_);
    if (sealed_)
      objects_sealed_ =
          std::make_unique<SealedLink>(objects_lan_->link(), sealing(messages, own_.site), steady_);
    objects_ = std::make_unique<ObjectService>(sealed_ ? *objects_sealed_ : objects_lan_->link(),
                                               steady_, scene, pool_of(scene).size(), exchange);
  } catch (const std::exception& error) {
    objects_sealed_.reset();
    objects_lan_.reset();
    static_cast<void>(peer_->notices().push(
        make_notice(NoticeKind::scene_not_offered, "the scene is not offered: {}", error.what())));
  }
}

void JoinedPeer::join(Link& link, std::uint16_t site, const Life& life, ModelGuest* guest) {
  PeerOptions own;
  own.name = options_.name;
  own.site = options_.site.value_or(site);
  own.application = application(own.site);
  own.epoch = life.epoch;
  own.chain_secret = life.secret;
  own.started = static_cast<std::uint32_t>(
      std::chrono::duration_cast<std::chrono::seconds>(clock_->utc_now()).count());
  own.transfer = options_.transfer;
  own.tap = options_.tap;
  own.force_stop = options_.force_stop;
  Link& way = sealed(link, own.site);
  std::unique_ptr<RollCall> roll;
  if (options_.deal) {
    if (lan_ && !options_.scene->network.interop) roll = call_roll(way, own);
    if (!roll) options_.scene_peer = 1;
    if (roll) own.application = roll->id().application;
    options_.devices = options_.deal(options_.scene_peer);
  }
  own.scene_peer = static_cast<std::uint8_t>(std::min<std::uint32_t>(options_.scene_peer, 254));
  own.entities = entities_of(*options_.scene, options_.scene_peer);
  own.record_shown = options_.record_shown;
  own.record_changes = guest != nullptr;
  own.founds = !lan_ || (roll && roll->is_first());
  peer_ = std::make_unique<Peer>(*options_.scene, own, way, options_.devices);
  if (lan_) check_step_cost();
  if (options_.body_pace && peer_->bodies() != nullptr)
    peer_->bodies()->set_pace(*options_.body_pace);
  if (sealed_) sealed_->count_in(peer_->counters());
  if (hold_ && !hold_->report().empty())
    static_cast<void>(
        peer_->notices().push(make_notice(NoticeKind::number_held, "{}", hold_->report())));
  peer_->model().set_guest(guest);
  own_ = {own.site, own.application};
  begun_ = clock_->now();
  peer_->start(begun_);
  if (roll) {
    // Keeps the number without a gap: the peer announces it before the roll call ends.
    peer_->model_step(begun_, clock_->utc_now());
    peer_->write_step();
    roll->leave();
  }
}

// Only on a LAN, where time is real. A caller's clock may show any time.
void JoinedPeer::check_step_cost() {
  if (!peer_->has_devices()) return;
  const SceneFile& scene = *options_.scene;
  auto slow = find_step_too_dear(scene.scene, *peer_->plan(), scene.hand.contact_radius,
                                 peer_->servo_period());
  if (haptics::BodyWorld* bodies = peer_->bodies()) {
    if (!options_.body_pace) bodies->set_pace(measure_body_pace());
    if (!slow)
      slow = find_bodies_too_dear(scene, peer_->devices(), peer_->servo_period(), bodies->pace());
  }
  if (!slow) return;
  if (!options_.even_if_slow) throw *slow;
  static_cast<void>(
      peer_->notices().push(make_notice(NoticeKind::servo_slow, "{}", slow->finding())));
}

std::unique_ptr<RollCall> JoinedPeer::call_roll(Link& link, const PeerOptions& own) {
  const SceneFile& scene = *options_.scene;
  const deadreckon::LocalFrame frame(scene.origin.latitude, scene.origin.longitude,
                                     scene.origin.height);
  const GroupPool pool = pool_of(scene);
  const ModelIdentity caller{
      {own.site, own.application}, own.name, std::random_device{}() | 1u, own.started, true};
  aoim::AreaOfInterestConfig config = aoim_config(scene);
  config.presence.secret = draw_chain_secret();
  auto roll = std::make_unique<RollCall>(link, *clock_, pool.base(), config,
                                         presence(scene, frame, pool, caller));
  options_.scene_peer = roll->answer();
  return roll;
}

void JoinedPeer::run() {
  if (options_.loops != FederateLoops::threads) return;
  if (options_.offers_scene) offer_scene();
  PeerThreadsOptions threads;
  threads.servo = options_.servo;
  threads_ = std::make_unique<PeerThreads>(*peer_, *clock_, threads);
  runs_ = true;
}

void JoinedPeer::pass() noexcept {
  const std::chrono::nanoseconds now = clock_->now();
  if (peer_->has_devices()) peer_->servo_step(now);
  peer_->read_step(now);
  peer_->model_step(now, clock_->utc_now());
  peer_->write_step();
}

void JoinedPeer::stop_loops() noexcept {
  if (threads_) threads_->stop();
  runs_ = false;
}

void JoinedPeer::leave_bodies() noexcept {
  const bool steps = options_.loops == FederateLoops::in_step;
  if (!lan_ || (!runs_ && !steps) || std::exchange(has_given_, true)) return;
  const std::chrono::nanoseconds end = clock_->now() + Ownership::kLeaving;
  peer_->begin_leaving();
  if (runs_) threads_->wake();
  if (steps) pass();
  while (!peer_->has_left() && clock_->now() < end) {
    if (runs_)
      std::this_thread::sleep_for(kLeavingStep);
    else
      static_cast<void>(lan_->link().wait(kLeavingStep)), pass();
  }
}

void JoinedPeer::resign() noexcept {
  if (resigned_) return;
  resigned_ = true;
  objects_.reset();
  leave_bodies();
  stop_loops();
  peer_->stop(clock_->now(), clock_->utc_now());
  peer_->model().set_guest(nullptr);
  hold_.reset();
}

std::vector<Notice> JoinedPeer::take_sealing_notices() {
  std::vector<Notice> notices;
  if (!sealed_) return notices;
  for (const std::string& line : sealed_->take_news())
    notices.push_back(make_notice(NoticeKind::key, "{}", line));
  return notices;
}

void JoinedPeer::change_impairment(const ImpairmentLaw& law) {
  if (!lan_) throw std::logic_error("the caller's link has its own impairment");
  lan_->change_law(law);
}

std::vector<std::string> JoinedPeer::link_report() const {
  return lan_ ? lan_->report() : std::vector<std::string>();
}

}  // namespace reckon::peer
