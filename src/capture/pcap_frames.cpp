// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Frames by libpcap: from pcap files and from interfaces.
#include <poll.h>

// libpcap's own header uses the BSD names u_int and u_char.
#include <pcap/pcap.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "reckon/peer/capture/frame_reader.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

using PcapHandle = std::unique_ptr<pcap_t, decltype(&pcap_close)>;

constexpr int kSnapLength = 65535;

/// The kernel keeps a frame of any length in a slot of kSnapLength: 500 slots here, while libpcap's
/// default of 2 MiB has 32, fewer than the fragments of one long datagram [octets].
constexpr int kInterfaceBuffer = 32 << 20;

int milliseconds_of(nanoseconds patience) {
  return static_cast<int>(std::chrono::ceil<std::chrono::milliseconds>(patience).count());
}

class PcapFrames final : public FrameReader {
 public:
  /// `grows` is the followed file, else null.
  PcapFrames(PcapHandle handle, bool is_interface, std::FILE* grows)
      : handle_(std::move(handle)), is_interface_(is_interface), grows_(grows) {
    const int type = pcap_datalink(handle_.get());
    layer_ = link_layer_of(type);
    if (!layer_) throw std::runtime_error(unread_link_type(type));
    link_type_ = type == DLT_RAW ? kLinkTypeRawIp : static_cast<std::uint16_t>(type);
    has_nanoseconds_ = pcap_get_tstamp_precision(handle_.get()) == PCAP_TSTAMP_PRECISION_NANO;
  }

  FrameEvent next(CapturedFrame& out) override {
    pcap_pkthdr* header = nullptr;
    const u_char* octets = nullptr;
    const off_t begin = grows_ != nullptr ? ftello(grows_) : 0;
    const int result = pcap_next_ex(handle_.get(), &header, &octets);
    if (result == 0 || (result != 1 && grows_ != nullptr && step_back(grows_, begin)))
      return FrameEvent::nothing_yet;
    if (result == PCAP_ERROR_BREAK) return FrameEvent::end;
    if (result != 1) return FrameEvent::damaged;
    out.time = bounded_time(header->ts.tv_sec, header->ts.tv_usec * (has_nanoseconds_ ? 1 : 1000));
    out.octets = {reinterpret_cast<const std::byte*>(octets), header->caplen};
    out.on_wire = header->len;
    out.link_type = link_type_;
    out.layer = layer_;
    return FrameEvent::frame;
  }

  std::string problem() const override { return pcap_geterr(handle_.get()); }
  std::uint16_t link_type() const noexcept override { return link_type_; }

  bool wait(nanoseconds patience) override {
    if (!is_interface_) return FrameReader::wait(patience);
    pollfd entry{pcap_get_selectable_fd(handle_.get()), POLLIN, 0};
    return ::poll(&entry, 1, milliseconds_of(patience)) > 0;
  }

  std::uint64_t dropped() override {
    pcap_stat statistics{};
    return is_interface_ && pcap_stats(handle_.get(), &statistics) == 0 ? statistics.ps_drop : 0;
  }

 private:
  PcapHandle handle_;
  bool is_interface_;
  std::FILE* grows_;
  std::optional<LinkLayer> layer_;
  std::uint16_t link_type_{0};
  bool has_nanoseconds_{false};
};

// Passes only frames that may contain UDP; the kernel drops the rest. Later fragments have no ports
// to filter by, and tunnels (IP in IP, GRE, MPLS, PPPoE) have their ports inside.
void set_udp_filter(pcap_t* handle) {
  bpf_program program{};
  const char* text =
      "udp or (ip and ip[6:2] & 0x1fff != 0) or (ip6 and ip6[6] = 44) or proto 4 or proto 41 "
      "or proto 47 or ether proto 0x8847 or ether proto 0x8848 or ether proto 0x8864 or vlan";
  if (pcap_compile(handle, &program, text, 1, PCAP_NETMASK_UNKNOWN) != 0) return;
  pcap_setfilter(handle, &program);
  pcap_freecode(&program);
}

std::string interface_problem(const std::string& name, int status, const std::string& reason) {
  if (status == PCAP_ERROR_NO_SUCH_DEVICE)
    return name + ": no such interface; `ip link` lists them";
  if (status == PCAP_ERROR_PERM_DENIED)
    return name +
           ": capturing is not allowed; run as root, or setcap cap_net_raw+ep on the program";
  if (status == PCAP_ERROR_IFACE_NOT_UP)
    return name + ": the interface is down; ip link set " + name + " up";
  return name + ": " + reason + "; choose another interface; `ip link` lists them";
}

/// Whether the file begins as pcapng; consumes nothing.
bool begins_pcapng(std::FILE* file) {
  constexpr std::array<unsigned char, 4> kSectionHeader{0x0a, 0x0d, 0x0d, 0x0a};
  std::array<unsigned char, 4> head{};
  const std::size_t held = std::fread(head.data(), 1, head.size(), file);
  for (std::size_t i = held; i-- > 0;) std::ungetc(head[i], file);
  return held == head.size() && head == kSectionHeader;
}

}  // namespace

bool FrameReader::wait(nanoseconds patience) {
  // A regular file is always readable, so only time can pass.
  return ::poll(nullptr, 0, milliseconds_of(patience)) == 0;
}

nanoseconds bounded_time(std::int64_t second, std::int64_t nanosecond) noexcept {
  constexpr std::int64_t kEarliestSecond = -(std::int64_t{1} << 31);
  constexpr std::int64_t kLatestSecond = 6'000'000'000;  // in the year 2160
  return std::chrono::seconds(std::clamp(second, kEarliestSecond, kLatestSecond)) +
         nanoseconds(nanosecond);
}

std::optional<LinkLayer> link_layer_of(int link_type) noexcept {
  switch (link_type) {
    case DLT_EN10MB:
      return LinkLayer::ethernet;
    case DLT_RAW:
    case kLinkTypeRawIp:
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

std::string unread_link_type(int link_type) {
  const char* known = pcap_datalink_val_to_name(link_type);
  return "link type " + std::to_string(link_type) + " (" + (known != nullptr ? known : "unknown") +
         ") is not supported; capture on an Ethernet, loopback or 'any' interface";
}

bool step_back(std::FILE* file, off_t position) {
  if (std::feof(file) == 0) return false;
  std::clearerr(file);
  return fseeko(file, position, SEEK_SET) == 0;
}

std::unique_ptr<FrameReader> open_frames(std::FILE* file, bool grows) {
  if (begins_pcapng(file)) return open_pcapng_frames(file, grows);
  std::array<char, PCAP_ERRBUF_SIZE> error{};
  PcapHandle handle(
      pcap_fopen_offline_with_tstamp_precision(file, PCAP_TSTAMP_PRECISION_NANO, error.data()),
      pcap_close);
  if (!handle) {
    std::fclose(file);
    throw std::runtime_error(error.data());
  }
  return std::make_unique<PcapFrames>(std::move(handle), false, grows ? file : nullptr);
}

std::unique_ptr<FrameReader> open_interface_frames(const std::string& name) {
  std::array<char, PCAP_ERRBUF_SIZE> error{};
  PcapHandle handle(pcap_create(name.c_str(), error.data()), pcap_close);
  if (!handle) throw std::runtime_error(name + ": " + error.data());
  pcap_set_snaplen(handle.get(), kSnapLength);
  pcap_set_buffer_size(handle.get(), kInterfaceBuffer);
  pcap_set_promisc(handle.get(), 0);
  pcap_set_immediate_mode(handle.get(), 1);
  pcap_set_tstamp_precision(handle.get(), PCAP_TSTAMP_PRECISION_NANO);
  if (const int status = pcap_activate(handle.get()); status < 0)
    throw std::runtime_error(interface_problem(name, status, pcap_geterr(handle.get())));
  set_udp_filter(handle.get());
  if (pcap_setnonblock(handle.get(), 1, error.data()) != 0) {
    throw std::runtime_error(name + ": " + error.data());
  }
  return std::make_unique<PcapFrames>(std::move(handle), true, nullptr);
}

}  // namespace reckon::peer
