// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/peer_processes.hpp"

#include <fmt/format.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>
#include <system_error>
#include <thread>
#include <type_traits>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/udp_multicast.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

using std::chrono::nanoseconds;
using namespace std::chrono_literals;

constexpr auto kQuerier = 4s;       // until the bridge is the IGMP querier
constexpr auto kStart = 1s;         // from the decision to begin until the begin,
constexpr auto kStartEach = 100ms;  // plus this for each peer

/// A pipe; its ends are closed at destruction.
class Pipe {
 public:
  Pipe() {
    if (pipe(ends_) != 0)
      throw tools::EnvironmentError(
          fmt::format("no pipe to a peer's process: {}; raise ulimit -n", std::strerror(errno)));
  }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close_end(int end) {
    if (ends_[end] >= 0) close(ends_[end]);
    ends_[end] = -1;
  }
  /// False if the other end is closed, or for an error.
  bool read_all(void* into, std::size_t octets) const {
    for (auto* at = static_cast<char*>(into); octets > 0;) {
      const ssize_t got = read(ends_[0], at, octets);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      at += got;
      octets -= static_cast<std::size_t>(got);
    }
    return true;
  }
  bool write_all(const void* from, std::size_t octets) const {
    for (const auto* at = static_cast<const char*>(from); octets > 0;) {
      const ssize_t put = write(ends_[1], at, octets);
      if (put < 0 && errno == EINTR) continue;
      if (put <= 0) return false;
      at += put;
      octets -= static_cast<std::size_t>(put);
    }
    return true;
  }

 private:
  int ends_[2] = {-1, -1};
};

template <typename T>
bool put(const Pipe& pipe, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  return pipe.write_all(&value, sizeof value);
}
template <typename T>
bool get(const Pipe& pipe, T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  return pipe.read_all(&value, sizeof value);
}
bool put(const Pipe& pipe, const std::vector<float>& values) {
  return put(pipe, values.size()) && pipe.write_all(values.data(), values.size() * sizeof(float));
}
bool get(const Pipe& pipe, std::vector<float>& values) {
  std::size_t count = 0;
  if (!get(pipe, count)) return false;
  values.resize(count);
  return pipe.read_all(values.data(), count * sizeof(float));
}

/// Memory of this process alone [octets], without pages shared with its parent.
double own_memory() {
  std::ifstream rollup("/proc/self/smaps_rollup");
  double octets = 0;
  for (std::string line; std::getline(rollup, line);)
    if (constexpr std::string_view kKey = "Private_Dirty:"; line.starts_with(kKey))
      octets += 1024 * std::stod(line.substr(kKey.size()));
  return octets;
}

/// Runs commands of iproute2 in this process's network namespace. @throws EnvironmentError
void run_ip(const std::string& lines) {
  std::FILE* ip = popen("ip -batch -", "w");
  const bool is_said = ip != nullptr && std::fputs(lines.c_str(), ip) >= 0;
  if (ip == nullptr || pclose(ip) != 0 || !is_said)
    throw tools::EnvironmentError(
        "ip could not create the network (its output is above); it needs root and the program ip "
        "(Debian: iproute2)");
}

void enter_own_network() {
  if (unshare(CLONE_NEWNET) != 0)
    throw tools::EnvironmentError(fmt::format(
        "no network namespace: {}; run it as root, outside of containers that forbid it",
        std::strerror(errno)));
}

/// Creates the bridge between the processes. The bridge floods reports of membership until the
/// query response interval, as it was when the querier started, has passed. With IGMPv2 a host that
/// receives the report of another sends none, and the bridge never learns of it.
void make_switch(const std::vector<pid_t>& peers) {
  enter_own_network();
  std::string lines =
      "link add br0 type bridge mcast_snooping 1 mcast_igmp_version 3 "
      "mcast_query_response_interval 100 mcast_startup_query_interval 100\n"
      "link set br0 type bridge mcast_querier 1\nlink set br0 up\n";
  for (std::size_t p = 0; p < peers.size(); ++p)
    lines +=
        fmt::format("link add e0 netns {1} type veth peer name p{0}\nlink set p{0} master br0 up\n",
                    p, peers[p]);
  run_ip(lines);
}

void plug_in(std::size_t peer) {
  run_ip(
      fmt::format("link set lo up\naddr add 10.77.{}.{}/16 dev e0\nlink set e0 up\n"
                  "route add 224.0.0.0/4 dev e0\n",
                  peer / 250, peer % 250 + 1));
}

/// The processes of a run; destruction kills the remaining ones.
class Family {
 public:
  ~Family() {
    for (const pid_t child : children_) kill(child, SIGKILL);
    for (const pid_t child : children_) waitpid(child, nullptr, 0);
  }
  /// Forks. @param work runs in the child, which then exits
  pid_t add(const std::function<void()>& work) {
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child < 0)
      throw tools::EnvironmentError(
          fmt::format("no process for a peer: {}; lower --peers", std::strerror(errno)));
    if (child > 0) {
      children_.push_back(child);
      return child;
    }
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    int status = 0;
    try {
      work();
    } catch (const std::exception& error) {
      fmt::print(stderr, "{}\n", error.what());
      status = 1;
    }
    std::fflush(nullptr);
    _exit(status);
  }
  [[nodiscard]] const std::vector<pid_t>& children() const noexcept { return children_; }

 private:
  std::vector<pid_t> children_;
};

tools::EnvironmentError ended_early(std::size_t peer) {
  return tools::EnvironmentError(
      fmt::format("the process of peer {} ended early, see above", peer + 1));
}

/// The three pipes between a process and its parent.
struct Wires {
  Pipe ready, begin, outcome;
};

void live(const ProcessPlan& plan, std::size_t index, const Wires& wires, const PeerTask& task) {
  if (plan.lan) enter_own_network();
  nanoseconds::rep begin = 0;
  if (!put(wires.ready, true) || !get(wires.begin, begin)) return;
  if (plan.lan) plug_in(index);
  const peer::SteadyClock clock;
  peer::UdpMulticastOptions options;
  options.interface = plan.lan ? "e0" : plan.interface;
  peer::UdpMulticast link(options, clock);
  const LiveOutcome outcome = task(plan.first + index, link, nanoseconds(begin));
  static_cast<void>(put(wires.outcome, outcome.counts) && put(wires.outcome, outcome.latest) &&
                    put(wires.outcome, own_memory()) && put(wires.outcome, outcome.samples.pose) &&
                    put(wires.outcome, outcome.samples.discovery));
}

/// Connects the processes by one bridge, which exists as long as `family`.
void join_by_switch(Family& family) {
  Wires hub;
  const std::vector<pid_t> children = family.children();
  family.add([&] {
    make_switch(children);
    static_cast<void>(put(hub.ready, true));
    hub.ready.close_end(1);
    for (;;) pause();  // its namespace exists as long as this process
  });
  hub.ready.close_end(1);
  bool is_there = false;
  if (!get(hub.ready, is_there)) throw tools::EnvironmentError("the bridge could not be created");
  std::this_thread::sleep_for(kQuerier);
}

/// False if `progress` ends the run.
bool wait_until(nanoseconds begin, double seconds, const ScaleProgress& progress) {
  const peer::SteadyClock clock;
  for (double share = 0; share < 1;) {
    share = std::max(0.0, std::chrono::duration<double>(clock.now() - begin).count() / seconds);
    if (progress && !progress(std::min(share, 1.0))) return false;
    std::this_thread::sleep_for(200ms);
  }
  return true;
}

}  // namespace

nanoseconds time_to_begin(std::size_t processes) noexcept {
  return kStart + static_cast<int>(processes) * kStartEach;
}

std::vector<PeerProcess> run_peer_processes(const ProcessPlan& plan, const PeerTask& task,
                                            const ScaleProgress& progress) {
  const std::size_t peers = plan.count;
  std::vector<std::unique_ptr<Wires>> wires;
  for (std::size_t p = 0; p < peers; ++p) wires.push_back(std::make_unique<Wires>());
  Family family;
  for (std::size_t p = 0; p < peers; ++p) {
    family.add([&] {
      for (std::size_t other = 0; other < peers; ++other)
        if (other != p) wires[other].reset();
      wires[p]->begin.close_end(1);
      live(plan, p, *wires[p], task);
    });
    for (Pipe* pipe : {&wires[p]->ready, &wires[p]->outcome}) pipe->close_end(1);
  }
  bool is_there = false;
  for (std::size_t p = 0; p < peers; ++p)
    if (!get(wires[p]->ready, is_there)) throw ended_early(plan.first + p);
  if (plan.lan) join_by_switch(family);
  const auto begin = plan.begin ? plan.begin() : peer::SteadyClock().now() + time_to_begin(peers);
  if (!begin) return {};
  for (const auto& wire : wires) static_cast<void>(put(wire->begin, begin->count()));
  if (!wait_until(*begin, plan.seconds, progress)) return {};
  std::vector<PeerProcess> outcomes(peers);
  for (std::size_t p = 0; p < peers; ++p) {
    PeerProcess& out = outcomes[p];
    if (!get(wires[p]->outcome, out.outcome.counts) ||
        !get(wires[p]->outcome, out.outcome.latest) || !get(wires[p]->outcome, out.resident) ||
        !get(wires[p]->outcome, out.outcome.samples.pose) ||
        !get(wires[p]->outcome, out.outcome.samples.discovery))
      throw ended_early(plan.first + p);
  }
  return outcomes;
}

}  // namespace reckon::bench
