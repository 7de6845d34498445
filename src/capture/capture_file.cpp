// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/capture/capture_file.hpp"

#include <poll.h>

// libpcap's own header uses the BSD names u_int and u_char.
#include <pcap/pcap.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include "reckon/peer/capture/capture_stream.hpp"
#include "reckon/peer/capture/frame_parser.hpp"
#include "reckon/peer/capture/ip_reassembler.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

// Damaged files contain times beyond 63 bits of nanoseconds; sums with these limits can still be
// recognised.
constexpr std::int64_t kEarliestSecond = -(std::int64_t{1} << 31);
constexpr std::int64_t kLatestSecond = 6'000'000'000;  // in the year 2160

nanoseconds time_of(const timeval& stamp, bool has_nanoseconds) {
  const auto second = std::clamp<std::int64_t>(stamp.tv_sec, kEarliestSecond, kLatestSecond);
  return std::chrono::seconds(second) + nanoseconds(stamp.tv_usec * (has_nanoseconds ? 1 : 1000));
}

using PcapHandle = std::unique_ptr<pcap_t, decltype(&pcap_close)>;

constexpr int kSnapLength = 65535;

std::optional<LinkLayer> link_layer_of(int type) {
  switch (type) {
    case DLT_EN10MB:
      return LinkLayer::ethernet;
    case DLT_RAW:
    case DLT_IPV4:
    case DLT_IPV6:
      return LinkLayer::raw_ip;
    case DLT_LINUX_SLL:
      return LinkLayer::linux_cooked;
    case DLT_LINUX_SLL2:
      return LinkLayer::linux_cooked_2;
    case DLT_NULL:
    case DLT_LOOP:
      return LinkLayer::bsd_loopback;
    default:
      return std::nullopt;
  }
}

LinkLayer link_layer_or_throw(pcap_t* handle, const std::string& name) {
  const int type = pcap_datalink(handle);
  if (const auto layer = link_layer_of(type)) return *layer;
  const char* known = pcap_datalink_val_to_name(type);
  throw std::runtime_error(name + ": link type " + std::to_string(type) + " (" +
                           (known != nullptr ? known : "unknown") +
                           ") is not read here; capture on an Ethernet, loopback or 'any' "
                           "interface");
}

// A file or an interface through libpcap.
class PcapSource final : public DatagramSource {
 public:
  /// `stream` is the source of a file's handle, and null for an interface; `grows` is the file that
  /// is followed, else null.
  PcapSource(std::unique_ptr<CaptureStream> stream, PcapHandle handle, std::string name,
             std::FILE* grows = nullptr)
      : stream_(std::move(stream)),
        handle_(std::move(handle)),
        name_(std::move(name)),
        grows_(grows),
        layer_(link_layer_or_throw(handle_.get(), name_)) {
    nanosecond_stamps_ = pcap_get_tstamp_precision(handle_.get()) == PCAP_TSTAMP_PRECISION_NANO;
  }

  SourceEvent next(SourceDatagram& out, nanoseconds patience) override;
  const SourceReport& report() const noexcept override { return report_; }
  bool is_live() const noexcept override { return !stream_ || grows_ != nullptr; }
  std::uint16_t link_type() const noexcept override {
    const int type = pcap_datalink(handle_.get());
    return type == DLT_RAW ? kLinkTypeRawIp : static_cast<std::uint16_t>(type);
  }
  void stop() noexcept override { stopped_.store(true, std::memory_order_relaxed); }

 private:
  void finish(int result);
  void tell_compression();
  bool step_back(off_t frame);
  bool take(const pcap_pkthdr& header, const u_char* bytes, SourceDatagram& out);
  bool take_udp(const ParsedFrame& parsed, SourceDatagram& out);
  bool wait(nanoseconds patience);
  void count_drops();

  std::unique_ptr<CaptureStream> stream_;  // outlives the handle
  PcapHandle handle_;
  std::string name_;
  std::FILE* grows_;
  LinkLayer layer_;
  bool nanosecond_stamps_{false};
  std::atomic<bool> stopped_{false};
  bool ended_{false};
  IpReassembler reassembler_;
  SourceReport report_;
};

SourceEvent PcapSource::next(SourceDatagram& out, nanoseconds patience) {
  bool waited = false;
  while (!stopped_.load(std::memory_order_relaxed)) {
    if (reassembler_.take_lost(out)) {
      ++report_.datagrams;
      return SourceEvent::datagram;
    }
    if (ended_) break;
    pcap_pkthdr* header = nullptr;
    const u_char* bytes = nullptr;
    const off_t frame = grows_ != nullptr ? ftello(grows_) : 0;
    const int result = pcap_next_ex(handle_.get(), &header, &bytes);
    if (result == 1) {
      if (take(*header, bytes, out)) return SourceEvent::datagram;
    } else if (result == 0 || step_back(frame)) {
      if (waited || !wait(patience)) return SourceEvent::nothing_yet;
      waited = true;
    } else {
      finish(result);
    }
  }
  return SourceEvent::end;
}

// At the end of a growing file: back to the begin of the incomplete frame.
bool PcapSource::step_back(off_t frame) {
  if (grows_ == nullptr || std::feof(grows_) == 0) return false;
  std::clearerr(grows_);
  return fseeko(grows_, frame, SEEK_SET) == 0;
}

// The true end of a file, or a damaged place: what came before it remains valid.
void PcapSource::finish(int result) {
  ended_ = true;
  reassembler_.give_up_all();
  report_.fragments = reassembler_.counts();
  std::string reason;
  if (stream_) {
    tell_compression();
    reason = stream_->problem();  // the error of the stream causes that of libpcap
  }
  if (reason.empty() && result == PCAP_ERROR_BREAK) return;
  if (reason.empty()) reason = pcap_geterr(handle_.get());
  report_.problem = name_ + " cannot be read beyond frame " + std::to_string(report_.frames) +
                    " (" + reason + "); the " + std::to_string(report_.frames) +
                    " frames before that are good";
}

void PcapSource::tell_compression() {
  if (!stream_->is_compressed()) return;
  report_.zstd_frames = stream_->zstd_frames();
  report_.zstd_octets = stream_->octets();
  report_.zstd_content = stream_->content();
}

bool PcapSource::take(const pcap_pkthdr& header, const u_char* bytes, SourceDatagram& out) {
  out = {};
  out.frame = ++report_.frames;
  out.time = time_of(header.ts, nanosecond_stamps_);
  const std::span frame(reinterpret_cast<const std::byte*>(bytes), header.caplen);
  out.captured = frame;
  out.captured_on_wire = header.len;
  reassembler_.advance(out.time);
  const ParsedFrame parsed = parse_frame(layer_, frame, header.len, out);
  const bool is_datagram = parsed.content == FrameContent::udp && take_udp(parsed, out);
  if (parsed.content == FrameContent::not_udp) ++report_.skipped;
  if (parsed.content == FrameContent::malformed) ++report_.malformed;
  report_.fragments = reassembler_.counts();
  if (!is_datagram) return false;
  ++report_.datagrams;
  if (out.portion == Portion::cut) ++report_.cut;
  return true;
}

// Whether there is a datagram to return.
bool PcapSource::take_udp(const ParsedFrame& parsed, SourceDatagram& out) {
  if (!parsed.fragment) return true;
  const FragmentFate fate = reassembler_.take(layer_, *parsed.fragment, out);
  if (fate == FragmentFate::not_udp) ++report_.skipped;
  if (fate == FragmentFate::malformed) ++report_.malformed;
  return fate == FragmentFate::whole || fate == FragmentFate::overlapping;
}

bool PcapSource::wait(nanoseconds patience) {
  const auto ms = std::chrono::ceil<std::chrono::milliseconds>(patience).count();
  // A regular file is always readable, so only time can pass.
  if (grows_ != nullptr) return ::poll(nullptr, 0, static_cast<int>(ms)) == 0;
  count_drops();
  pollfd entry{pcap_get_selectable_fd(handle_.get()), POLLIN, 0};
  return ::poll(&entry, 1, static_cast<int>(ms)) > 0;
}

void PcapSource::count_drops() {
  pcap_stat statistics{};
  if (pcap_stats(handle_.get(), &statistics) == 0) report_.dropped = statistics.ps_drop;
}

// Passes only what may be UDP: the kernel drops the rest. Later fragments have no ports to filter
// by.
void set_udp_filter(pcap_t* handle) {
  bpf_program program{};
  const char* text = "udp or (ip and ip[6:2] & 0x1fff != 0) or (ip6 and ip6[6] = 44) or vlan";
  if (pcap_compile(handle, &program, text, 1, PCAP_NETMASK_UNKNOWN) != 0) return;
  pcap_setfilter(handle, &program);
  pcap_freecode(&program);
}

std::string interface_problem(const std::string& name, int status, const std::string& reason) {
  if (status == PCAP_ERROR_NO_SUCH_DEVICE)
    return name + ": there is no such interface; `ip link` lists the names";
  if (status == PCAP_ERROR_PERM_DENIED)
    return name +
           ": capturing is not allowed; run as root, or setcap cap_net_raw+ep on the program";
  if (status == PCAP_ERROR_IFACE_NOT_UP)
    return name + ": the interface is down; ip link set " + name + " up";
  return name + ": " + reason + "; take another interface, `ip link` lists them";
}

}  // namespace

std::unique_ptr<DatagramSource> open_capture(const std::string& path, bool follow) {
  auto stream = std::make_unique<CaptureStream>(path);
  const std::string name = path == "-" ? "standard input" : path;
  std::FILE* file = stream->open();
  if (file == nullptr) throw std::runtime_error(name + " cannot be opened; try again");
  std::array<char, PCAP_ERRBUF_SIZE> error{};
  PcapHandle handle(
      pcap_fopen_offline_with_tstamp_precision(file, PCAP_TSTAMP_PRECISION_NANO, error.data()),
      pcap_close);
  if (!handle) {
    std::fclose(file);
    std::string reason = stream->problem();
    if (reason.empty()) reason = error.data();
    throw std::runtime_error(name + (stream->is_compressed() ? ", decompressed: " : ": ") + reason +
                             "; give a pcap or pcapng file, or raw:FILE for one bare PDU");
  }
  if (follow && stream->is_compressed())
    throw std::runtime_error(name +
                             " is compressed, and --follow reads plain files only; record "
                             "to a name without .zst, or leave --follow out");
  std::FILE* grows = follow && stream->is_plain_file() ? file : nullptr;
  return std::make_unique<PcapSource>(std::move(stream), std::move(handle), name, grows);
}

std::unique_ptr<DatagramSource> open_interface_capture(const std::string& name) {
  std::array<char, PCAP_ERRBUF_SIZE> error{};
  PcapHandle handle(pcap_create(name.c_str(), error.data()), pcap_close);
  if (!handle) throw std::runtime_error(name + ": " + error.data());
  pcap_set_snaplen(handle.get(), kSnapLength);
  pcap_set_promisc(handle.get(), 0);
  pcap_set_immediate_mode(handle.get(), 1);
  pcap_set_tstamp_precision(handle.get(), PCAP_TSTAMP_PRECISION_NANO);
  if (const int status = pcap_activate(handle.get()); status < 0)
    throw std::runtime_error(interface_problem(name, status, pcap_geterr(handle.get())));
  set_udp_filter(handle.get());
  if (pcap_setnonblock(handle.get(), 1, error.data()) != 0) {
    throw std::runtime_error(name + ": " + error.data());
  }
  return std::make_unique<PcapSource>(nullptr, std::move(handle), name);
}

}  // namespace reckon::peer
