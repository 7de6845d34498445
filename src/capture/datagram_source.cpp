// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/capture/datagram_source.hpp"

#include <net/if.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "reckon/peer/capture/capture_file.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/udp_listener.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kMaxRawFile = 65535;
constexpr std::size_t kBatch = 32;

// A file with one bare datagram.
class RawSource final : public DatagramSource {
 public:
  explicit RawSource(const std::string& path) {
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    bytes_.resize(kMaxRawFile + 1);
    file.read(reinterpret_cast<char*>(bytes_.data()), static_cast<std::streamsize>(bytes_.size()));
    if (file.bad() || !file.is_open() || (file.gcount() == 0 && errno != 0)) {
      throw std::system_error(errno, std::generic_category(), "cannot read " + path);
    }
    bytes_.resize(static_cast<std::size_t>(file.gcount()));
    if (bytes_.size() <= kMaxRawFile) return;
    bytes_.resize(kMaxRawFile);
    report_.cut = 1;
    report_.problem = path + " is longer than a datagram can be; its first 65535 octets are read";
  }

  SourceEvent next(SourceDatagram& out, nanoseconds) override {
    if (stopped_.load(std::memory_order_relaxed) || report_.frames == 1) return SourceEvent::end;
    report_.frames = report_.datagrams = 1;
    out = {};
    out.frame = 1;
    out.bytes = bytes_;
    out.portion = report_.cut == 0 ? Portion::whole : Portion::cut;
    return SourceEvent::datagram;
  }
  const SourceReport& report() const noexcept override { return report_; }
  bool is_live() const noexcept override { return false; }
  void stop() noexcept override { stopped_.store(true, std::memory_order_relaxed); }

 private:
  std::vector<std::byte> bytes_;
  std::atomic<bool> stopped_{false};
  SourceReport report_;
};

// The live groups.
class GroupsSource final : public DatagramSource {
 public:
  explicit GroupsSource(const GroupsOptions& options)
      : listener_({options.interface, options.groups, options.skips_failures}, clock_) {
    count();
  }

  SourceEvent next(SourceDatagram& out, nanoseconds patience) override {
    if (next_ == count_) refill(patience);
    if (stopped_.load(std::memory_order_relaxed)) return SourceEvent::end;
    if (next_ == count_) return SourceEvent::nothing_yet;
    const Datagram& datagram = batch_[next_++];
    const nanoseconds age = clock_.now() - datagram.received;
    out = {};
    out.frame = ++report_.frames;
    out.time = clock_.utc_now() - age;
    out.source = datagram.sender;
    out.group = datagram.group;
    out.bytes = datagram.bytes;
    ListenedInterface& interface = interface_of(listener_.interface_of(datagram));
    ++interface.datagrams;
    out.interface = interface.name;
    ++report_.datagrams;
    return SourceEvent::datagram;
  }
  const SourceReport& report() const noexcept override { return report_; }
  bool is_live() const noexcept override { return true; }
  void stop() noexcept override {
    stopped_.store(true, std::memory_order_relaxed);
    listener_.wake();
  }

 private:
  void refill(nanoseconds patience) {
    next_ = count_ = 0;
    listener_.wait(patience);
    if (!stopped_.load(std::memory_order_relaxed)) count_ = listener_.receive(batch_);
    count();
  }

  void count() {
    const LinkStatistics statistics = listener_.statistics();
    report_.dropped = statistics.kernel_drops;
    report_.malformed = statistics.truncated;
    report_.copies = listener_.copies();
    if (report_.unheard.size() != listener_.warnings().size())
      report_.unheard = listener_.warnings();
    for (const NetworkInterface& interface : listener_.interfaces()) interface_of(interface.index);
  }

  // A datagram may arrive on an interface outside the list: an own address is reached through lo.
  ListenedInterface& interface_of(unsigned index) {
    const auto found = std::find_if(rows_.begin(), rows_.end(),
                                    [&](const Row& one) { return one.index == index; });
    if (found != rows_.end()) return report_.interfaces[found->place];
    std::array<char, IF_NAMESIZE> name{};
    if (if_indextoname(index, name.data()) == nullptr) name = {'?'};
    // An interface that was removed and added again has a new index and its old row.
    auto& rows = report_.interfaces;
    const auto row = std::find_if(rows.begin(), rows.end(),
                                  [&](const auto& one) { return one.name == name.data(); });
    rows_.push_back({index, static_cast<std::size_t>(row - rows.begin())});
    if (row != rows.end()) return *row;
    return rows.emplace_back(ListenedInterface{name.data()});
  }

  SteadyClock clock_;
  UdpListener listener_;
  struct Row {
    unsigned index;     // of an interface
    std::size_t place;  // in report_.interfaces
  };
  std::vector<Row> rows_;
  std::array<Datagram, kBatch> batch_{};
  std::size_t next_{0};
  std::size_t count_{0};
  std::atomic<bool> stopped_{false};
  SourceReport report_;
};

}  // namespace

std::unique_ptr<DatagramSource> open_raw_file(const std::string& path) {
  return std::make_unique<RawSource>(path);
}

std::unique_ptr<DatagramSource> open_groups(const GroupsOptions& options) {
  return std::make_unique<GroupsSource>(options);
}

std::unique_ptr<DatagramSource> open_source(std::string_view text, bool follow) {
  if (text.starts_with("raw:")) return open_raw_file(std::string(text.substr(4)));
  if (text.starts_with("iface:")) return open_interface_capture(std::string(text.substr(6)));
  return open_capture(std::string(text), follow);
}

}  // namespace reckon::peer
