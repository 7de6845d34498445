// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/capture/capture_file.hpp"

#include <fmt/format.h>

#include <atomic>
#include <map>
#include <stdexcept>
#include <utility>

#include "reckon/peer/capture/capture_stream.hpp"
#include "reckon/peer/capture/frame_reader.hpp"
#include "reckon/peer/capture/ip_reassembler.hpp"
#include "reckon/peer/clocks/clock.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

// The datagrams in the frames of a file or an interface.
class CaptureSource final : public DatagramSource {
 public:
  /// `stream` is the source of a file's frames, and null for an interface.
  CaptureSource(std::unique_ptr<CaptureStream> stream, std::unique_ptr<FrameReader> frames,
                std::string name, bool is_live)
      : stream_(std::move(stream)),
        frames_(std::move(frames)),
        name_(std::move(name)),
        is_live_(is_live) {}

  SourceEvent next(SourceDatagram& out, nanoseconds patience) override;
  const SourceReport& report() const noexcept override { return report_; }
  bool is_live() const noexcept override { return is_live_; }
  std::uint16_t link_type() const noexcept override { return frames_->link_type(); }
  std::string_view interface_name() const noexcept override { return frames_->interface_name(); }
  void stop() noexcept override { stopped_.store(true, std::memory_order_relaxed); }

 private:
  void finish(FrameEvent event);
  void wait_no_longer();
  void tell_compression();
  [[nodiscard]] std::string unread_frames() const;
  bool take(const CapturedFrame& frame, SourceDatagram& out);
  bool take_udp(LinkLayer layer, const ParsedFrame& parsed, SourceDatagram& out);

  std::unique_ptr<CaptureStream> stream_;  // outlives the reader
  std::unique_ptr<FrameReader> frames_;
  std::string name_;
  bool is_live_;
  SteadyClock clock_;
  std::atomic<bool> stopped_{false};
  bool ended_{false};
  IpReassembler reassembler_;
  std::map<std::uint16_t, std::uint64_t> unread_;             ///< frames of each unknown link type
  std::map<std::string_view, std::uint64_t> unread_content_;  ///< frames by ParsedFrame::unread
  SourceReport report_;
};

SourceEvent CaptureSource::next(SourceDatagram& out, nanoseconds patience) {
  bool waited = false;
  CapturedFrame frame;
  while (!stopped_.load(std::memory_order_relaxed)) {
    if (reassembler_.take_lost(out)) {
      ++report_.datagrams;
      return SourceEvent::datagram;
    }
    if (ended_) break;
    const FrameEvent event = frames_->next(frame);
    if (event == FrameEvent::frame) {
      if (take(frame, out)) return SourceEvent::datagram;
    } else if (event == FrameEvent::nothing_yet) {
      wait_no_longer();
      if (reassembler_.has_lost()) continue;
      report_.dropped = frames_->dropped();
      if (waited || !frames_->wait(patience)) return SourceEvent::nothing_yet;
      waited = true;
    } else {
      finish(event);
    }
  }
  return SourceEvent::end;
}

// On a quiet interface no frame advances the time, so the clock must expire incomplete datagrams.
void CaptureSource::wait_no_longer() {
  if (!is_live_) return;
  reassembler_.advance(clock_.utc_now());
  report_.fragments = reassembler_.counts();
}

// The regular end of a file, or a damaged place; earlier datagrams remain valid.
void CaptureSource::finish(FrameEvent event) {
  ended_ = true;
  reassembler_.give_up_all();
  report_.fragments = reassembler_.counts();
  std::string reason;
  if (stream_) {
    tell_compression();
    reason = stream_->problem();  // an error of the stream causes the reader's error
  }
  if (reason.empty() && event == FrameEvent::damaged) reason = frames_->problem();
  if (!reason.empty())
    report_.problem =
        fmt::format("{} cannot be read beyond frame {} ({}); the {} frames before that are good",
                    name_, report_.frames, reason, report_.frames);
  const std::string unread = unread_frames();
  if (!unread.empty()) report_.problem += (reason.empty() ? name_ + ": " : "; ") + unread;
}

void CaptureSource::tell_compression() {
  if (!stream_->is_compressed()) return;
  report_.compression = stream_->compression();
  report_.compressed_octets = stream_->octets();
  report_.compressed_content = stream_->content();
  report_.zstd_frames = stream_->zstd_frames();
}

std::string CaptureSource::unread_frames() const {
  std::string text;
  for (const auto& [type, frames] : unread_)
    text += fmt::format("{}{} of its frames are skipped: {}", text.empty() ? "" : "; ", frames,
                        unread_link_type(type));
  for (const auto& [name, frames] : unread_content_)
    text += fmt::format("{}{} {} of {} {} not read", text.empty() ? "" : "; ", frames,
                        frames == 1 ? "frame" : "frames", name, frames == 1 ? "is" : "are");
  return text;
}

bool CaptureSource::take(const CapturedFrame& frame, SourceDatagram& out) {
  out = {};
  out.frame = ++report_.frames;
  out.time = frame.time;
  out.captured = frame.octets;
  out.captured_on_wire = frame.on_wire;
  out.link_type = frame.link_type;
  reassembler_.advance(out.time);
  if (!frame.layer) {
    ++report_.skipped;
    ++unread_[frame.link_type];
    return false;
  }
  const ParsedFrame parsed = parse_frame(*frame.layer, frame.octets, frame.on_wire, out);
  const bool is_datagram =
      parsed.content == FrameContent::udp && take_udp(*frame.layer, parsed, out);
  if (parsed.content == FrameContent::not_udp) ++report_.skipped;
  if (parsed.content == FrameContent::malformed) ++report_.malformed;
  if (!parsed.unread.empty()) ++unread_content_[parsed.unread];
  report_.fragments = reassembler_.counts();
  if (!is_datagram) return false;
  ++report_.datagrams;
  if (out.portion == Portion::cut) ++report_.cut;
  return true;
}

// Whether there is a datagram to return.
bool CaptureSource::take_udp(LinkLayer layer, const ParsedFrame& parsed, SourceDatagram& out) {
  if (!parsed.fragment) return true;
  const FragmentFate fate = reassembler_.take(layer, *parsed.fragment, out);
  if (fate == FragmentFate::not_udp) ++report_.skipped;
  if (fate == FragmentFate::malformed) ++report_.malformed;
  return fate == FragmentFate::whole || fate == FragmentFate::overlapping;
}

}  // namespace

std::unique_ptr<DatagramSource> open_capture(const std::string& path, bool follow) {
  auto stream = std::make_unique<CaptureStream>(path);
  const std::string name = path == "-" ? "standard input" : path;
  if (follow && stream->is_compressed())
    throw std::runtime_error(name +
                             " is compressed, and --follow reads plain files only; record "
                             "to a name without .zst, or leave --follow out");
  std::FILE* file = stream->open();
  if (file == nullptr) throw std::runtime_error(name + " cannot be opened; try again");
  const bool grows = follow && stream->is_plain_file();
  try {
    auto frames = open_frames(file, grows);
    return std::make_unique<CaptureSource>(std::move(stream), std::move(frames), name, grows);
  } catch (const std::runtime_error& error) {
    std::string reason = stream->problem();
    if (reason.empty()) reason = error.what();
    throw std::runtime_error(name + (stream->is_compressed() ? ", decompressed: " : ": ") + reason +
                             "; give a pcap or pcapng file, or raw:FILE for one bare PDU");
  }
}

std::unique_ptr<DatagramSource> open_interface_capture(const std::string& name) {
  return std::make_unique<CaptureSource>(nullptr, open_interface_frames(name), name, true);
}

}  // namespace reckon::peer
