// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/whole_peer.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <set>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/federate.hpp"
#include "reckon/peer/joined_peer.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/threads/cpu_time.hpp"
#include "reckon/peer/world/tracked_entities.hpp"

namespace reckon::bench {
namespace {

using std::chrono::nanoseconds;

constexpr std::uint16_t kSite = 7;
constexpr int kMostPasses = 32;  // of one step, while datagrams are pending
constexpr double kOutside = std::numeric_limits<double>::infinity();

/// Sends for any error.
constexpr deadreckon::SendRule kEveryTick{
    "every tick", "each entity at each tick",
    [](const deadreckon::PoseError&, const deadreckon::Thresholds&) noexcept { return kOutside; }};

/// Records which groups are joined. Counts datagrams of other groups, or from the wrong interface.
class WatchedLink final : public peer::Link {
 public:
  explicit WatchedLink(peer::Link& link) : link_(link) {}

  bool send(const peer::IpEndpoint& to, std::span<const std::byte> bytes) noexcept override {
    sent_.store(true, std::memory_order_relaxed);
    return link_.send(to, bytes);
  }
  peer::SentBatch send_batch(std::span<const peer::OutgoingDatagram> batch) noexcept override {
    sent_.store(true, std::memory_order_relaxed);
    return link_.send_batch(batch);
  }
  std::size_t receive(std::span<peer::Datagram> out) noexcept override {
    const std::size_t count = link_.receive(out);
    const bool loops_back = link_.local_endpoint().is_loopback();
    for (const peer::Datagram& datagram : out.first(count))
      foreign_ += datagram.group.is_multicast() && (!joined_.contains(datagram.group) ||
                                                    datagram.sender.is_loopback() != loops_back);
    return count;
  }
  std::error_code join(const peer::GroupAddress& group) noexcept override {
    const std::error_code error = link_.join(group);
    if (!error) joined_.insert(group);
    return error;
  }
  void leave(const peer::GroupAddress& group) noexcept override {
    joined_.erase(group);
    link_.leave(group);
  }
  bool wait(nanoseconds timeout) noexcept override { return link_.wait(timeout); }
  void wake() noexcept override { link_.wake(); }
  [[nodiscard]] peer::IpEndpoint local_endpoint() const noexcept override {
    return link_.local_endpoint();
  }
  [[nodiscard]] std::size_t max_payload() const noexcept override { return link_.max_payload(); }
  [[nodiscard]] peer::LinkStatistics statistics() const noexcept override {
    return link_.statistics();
  }
  bool take_event(peer::LinkEvent& event) noexcept override { return link_.take_event(event); }

  [[nodiscard]] std::uint64_t foreign() const noexcept { return foreign_; }
  /// Whether a datagram was sent since the last call. A real link delivers it to its sender too,
  /// which ignores it, but wakes.
  bool take_sent() noexcept { return sent_.exchange(false, std::memory_order_relaxed); }

 private:
  peer::Link& link_;
  std::set<peer::GroupAddress> joined_;
  std::uint64_t foreign_ = 0;
  std::atomic<bool> sent_{false};
};

peer::FederateOptions options_of(const ScaleSetting& setting, std::size_t peer,
                                 peer::FederateLoops loops) {
  peer::FederateOptions options;
  options.name = "whole";
  options.scene = scale_scene(setting);
  options.scene->network.entities = setting.crowd.entities;  // room is reserved for all
  options.loops = loops;
  options.site = kSite;
  options.application = static_cast<std::uint16_t>(peer + 1);
  return options;
}

}  // namespace

peer::SceneFile scale_scene(const ScaleSetting& setting) {
  const ScaleDesign& design = setting.design;
  peer::SceneFile scene;
  scene.name = "scale";
  scene.origin = {kScaleOrigin[0], kScaleOrigin[1], kScaleOrigin[2]};
  scene.aoim = scale_cells(setting);
  scene.network.group.port = setting.port;
  if (!setting.converges) scene.convergence.settings.curve = deadreckon::ConvergenceCurve::snap;
  if (!design.areas) {
    scene.aoim.scheme = aoim::CellScheme::square;  // a tree has a group for each cell
    scene.aoim.pool = 1;
  }
  scene.network.bundle.hold = pdu::from_seconds(setting.hold);
  if (!design.bundling) scene.network.bundle.updates = 1;
  if (design.channels) {
    const ScaleChannels channels = scale_channels(setting);
    scene.aoim.tiers = peer::distance_tiers(channels.rows, channels.near_rows > 0);
  }
  if (design.compression) scene.network.compression = scale_compression(setting);
  scene.hash = peer::scene_hash(scene);
  return scene;
}

void WholeCounts::add(const WholeCounts& other) noexcept {
  seconds = std::max(seconds, other.seconds);
  for (const WholeSum& sum : kWholeSums) this->*sum.of += other.*sum.of;
  cpu += other.cpu;
}

void WholeSamples::add(const WholeSamples& other) {
  pose.insert(pose.end(), other.pose.begin(), other.pose.end());
  discovery.insert(discovery.end(), other.discovery.begin(), other.discovery.end());
}

// The federate, its own entities and the measurements of the study.
struct WholePeer::MeasuredFederate {
  MeasuredFederate(const ScaleSetting& given, std::size_t number, peer::Link& link,
                   const peer::Clock& clock, nanoseconds start, std::uint32_t epoch,
                   peer::FederateLoops loops, AttendanceLaw law)
      : setting(given),
        begin(start),
        owned(owned_by(given, number)),
        attendance(std::move(law)),
        entered(given.crowd.entities, kOutside),
        watched(link),
        federate(options_of(given, number, loops), watched, clock, epoch) {
    federate.publish(peer::EntityClass{});
    federate.subscribe(peer::EntityClass{});
    for (std::size_t p = 0; p < given.peers; ++p) {
      const OwnedRange range = owned_by(given, p);
      for (std::uint32_t e = range.first; e < range.end; ++e)
        owners.push_back(static_cast<std::uint32_t>(p));
    }
  }

  [[nodiscard]] std::uint64_t counted(const char* name) {
    const peer::Counter* counter = federate.peer().counters().find(name);
    return counter != nullptr ? counter->value() : 0;
  }
  [[nodiscard]] pdu::EntityId id_of(std::uint32_t e) const noexcept {
    const std::uint32_t owner = owners[e];
    return {kSite, static_cast<std::uint16_t>(owner + 1),
            static_cast<std::uint16_t>(e - owned_by(setting, owner).first + 1)};
  }
  [[nodiscard]] peer::EntityTruth truth(std::uint32_t e, double time, Crowd& crowd) const {
    constexpr auto kAllTerms = pdu::DeadReckoningAlgorithm::rvw;
    return peer::truth_of(kinematic_state(crowd.motion(e), kAllTerms), instant(time));
  }
  [[nodiscard]] nanoseconds instant(double time) const { return begin + pdu::from_seconds(time); }

  void register_all(double time, Crowd& crowd) {
    for (std::uint32_t e = owned.first; e < owned.end; ++e) {
      peer::EntityDescription description;
      description.type.kind = pdu::EntityKind::platform;
      description.dead_reckoning.thresholds = setting.thresholds;
      if (!setting.design.dead_reckoning) description.dead_reckoning.rule = &kEveryTick;
      description.dead_reckoning.heartbeat = pdu::from_seconds(setting.heartbeat);
      description.dead_reckoning.algorithm =
          crowd.moves(e) ? pdu::DeadReckoningAlgorithm::rvw : pdu::DeadReckoningAlgorithm::static_;
      handles.push_back(federate.register_object(description, truth(e, time, crowd)));
    }
  }

  /// Without threads: steps until no datagram is pending, at most kMostPasses times.
  void pass() {
    if (federate.joined().threads() != nullptr) return federate.step();
    const nanoseconds begun = federate.now();
    const std::uint64_t heard = counted("datagrams_in");
    ++passes;
    for (int step = 0; step < kMostPasses; ++step) {
      federate.step();
      if (!federate.peer().has_inbound() && !watched.wait(nanoseconds(0))) break;
    }
    const peer::Peer& peer = federate.peer();
    collects = counted("datagrams_in") > heard + 1;
    hears_itself = watched.take_sent();
    until = peer.next_step();
    together = begun + (peer.is_prompt(begun) ? peer::kPrompt : peer::kTogether);
  }
  /// Whether the model loop of PeerThreads would pass now.
  [[nodiscard]] bool is_due() {
    const nanoseconds now = federate.now();
    return now >= until ||
           (now >= together && (collects || hears_itself || watched.wait(nanoseconds(0))));
  }

  /// Box around the own entities, enlarged by the radius of interest.
  [[nodiscard]] Eigen::AlignedBox2d reach(const Crowd& crowd) const {
    Eigen::AlignedBox2d box;
    for (std::uint32_t own = owned.first; own < owned.end; ++own)
      box.extend(Eigen::Vector2d(crowd.position(own).x, crowd.position(own).y));
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(setting.radius);
    return {box.min() - margin, box.max() + margin};
  }

  /// Compares an entity of another peer with the truth. @param reach of reach(), at `time`
  void look_at(std::uint32_t e, double time, Crowd& crowd, const Eigen::AlignedBox2d& reach) {
    const Attendance there = attendance ? attendance(owners[e], time) : Attendance::present;
    const aoim::Position& place = crowd.position(e);
    bool inside = false;
    if (reach.contains(Eigen::Vector2d(place.x, place.y)))
      for (std::uint32_t own = owned.first; own < owned.end && !inside; ++own)
        inside = distance(place, crowd.position(own)) <= setting.radius;
    if (there == Attendance::absent) counts.ghosts += federate.find(id_of(e)).has_value();
    if (there != Attendance::present || !inside) {
      entered[e] = kOutside;
      return;
    }
    const auto shown = federate.find(id_of(e));
    const bool is_new = entered[e] == kOutside;
    if (is_new) entered[e] = time;
    ++counts.looks;
    if (!shown) {
      ++counts.unseen;
      counts.overdue += time - entered[e] > kShownWithin;
      return;
    }
    const deadreckon::Pose pose = shown->shown(instant(time));
    samples.pose.push_back(
        static_cast<float>((pose.position - Eigen::Vector3d(place.x, place.y, place.z)).norm()));
    if (entered[e] >= 0 && !is_new)
      samples.discovery.push_back(static_cast<float>(time - entered[e]));
    entered[e] = -kOutside;  // counted as shown
  }

  /// Totals since construction.
  [[nodiscard]] WholeCounts sums() {
    WholeCounts sums;
    sums.updates = counted("updates_out");
    sums.datagrams = counted("datagrams_out");
    sums.octets = counted("octets_out") + peer::kUdpIpv4Headers * sums.datagrams;
    sums.wanted = counted("updates_in");
    for (const char* name : {"updates_in", "not_interesting", "repeats_in", "stale_in"})
      sums.heard_updates += counted(name);
    sums.heard_datagrams = counted("datagrams_in");
    sums.heard_octets = counted("octets_in") + peer::kUdpIpv4Headers * sums.heard_datagrams;
    sums.lost = counted("datagrams_lost");
    const peer::PeerThreads* threads = federate.joined().threads();
    sums.passes = threads != nullptr ? threads->model_times().times().count() : passes;
    const peer::LinkStatistics link = watched.statistics();
    sums.joins = link.joins;
    sums.dropped = link.kernel_drops;
    return sums;
  }

  ScaleSetting setting;
  nanoseconds begin;
  OwnedRange owned;
  AttendanceLaw attendance;
  std::vector<std::uint32_t> owners;  // by entity
  std::vector<double> entered;        // by entity [s]: within the radius since
  WatchedLink watched;
  peer::Federate federate;
  std::vector<peer::ObjectHandle> handles;
  WholeCounts counts, before;
  WholeSamples samples;
  double counting_since = 0, cpu = 0, cpu_before = 0;
  // Of pass() without threads.
  std::uint64_t passes = 0;
  nanoseconds until{0}, together{0};
  bool collects = false, hears_itself = false;
};

WholePeer::WholePeer(const ScaleSetting& setting, std::size_t peer, peer::Link& link,
                     const peer::Clock& clock, nanoseconds begin, std::uint32_t epoch,
                     peer::FederateLoops loops, AttendanceLaw attendance)
    : measured_(std::make_unique<MeasuredFederate>(setting, peer, link, clock, begin, epoch, loops,
                                                   std::move(attendance))) {}
WholePeer::~WholePeer() = default;

void WholePeer::step(double time, Crowd& crowd) {
  MeasuredFederate& s = *measured_;
  const nanoseconds begun = peer::thread_cpu_time();
  if (s.handles.empty()) s.register_all(time, crowd);
  for (std::size_t i = 0; i < s.handles.size(); ++i)
    s.federate.update_attributes(
        s.handles[i], s.truth(s.owned.first + static_cast<std::uint32_t>(i), time, crowd));
  s.pass();
  s.cpu += pdu::to_seconds(peer::thread_cpu_time() - begun);
}

bool WholePeer::is_due() { return measured_->is_due(); }

void WholePeer::serve() {
  MeasuredFederate& s = *measured_;
  const nanoseconds begun = peer::thread_cpu_time();
  s.pass();
  s.cpu += pdu::to_seconds(peer::thread_cpu_time() - begun);
}

void WholePeer::look(double time, Crowd& crowd) {
  MeasuredFederate& s = *measured_;
  const Eigen::AlignedBox2d reach = s.reach(crowd);
  for (std::uint32_t e = 0; e < s.owners.size(); ++e)
    if (e < s.owned.first || e >= s.owned.end) s.look_at(e, time, crowd, reach);
}

void WholePeer::begin_counting(double time) {
  MeasuredFederate& s = *measured_;
  s.before = s.sums();
  s.cpu_before = s.cpu;
  s.counting_since = time;
  s.counts = {};
  s.samples = {};
}

WholeCounts WholePeer::counts(double time) {
  MeasuredFederate& s = *measured_;
  WholeCounts counts = s.counts;
  const WholeCounts now = s.sums();
  for (std::uint64_t WholeCounts::*sum :
       {&WholeCounts::updates, &WholeCounts::datagrams, &WholeCounts::octets,
        &WholeCounts::heard_updates, &WholeCounts::heard_datagrams, &WholeCounts::heard_octets,
        &WholeCounts::wanted, &WholeCounts::joins, &WholeCounts::lost, &WholeCounts::dropped,
        &WholeCounts::passes})
    counts.*sum = now.*sum - s.before.*sum;
  const peer::LinkStatistics link = s.watched.statistics();
  counts.groups = link.joins - link.leaves - 1;  // without the base group
  counts.foreign = s.watched.foreign();
  counts.known = s.federate.size();
  counts.peers = 1;
  counts.seconds = time - s.counting_since;
  counts.cpu = s.cpu - s.cpu_before;
  return counts;
}

const WholeSamples& WholePeer::samples() const noexcept { return measured_->samples; }

}  // namespace reckon::bench
