// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Any octets as a capture file: it opens or is refused with std::runtime_error, then returns frames
// until its end, with their datagrams inside the frames. The octets also go to the frame parser
// alone, as one frame of each link layer.
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "reckon/peer/capture/capture_file.hpp"
#include "reckon/peer/capture/frame_parser.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"

namespace reckon::fuzz {
namespace {

using Octets = std::span<const std::byte>;
using peer::LinkLayer;

bool holds(Octets whole, Octets part) {
  return part.empty() ||
         (part.data() >= whole.data() && part.data() + part.size() <= whole.data() + whole.size());
}

void check_frame(Octets frame) {
  for (const auto layer : {LinkLayer::ethernet, LinkLayer::raw_ip, LinkLayer::linux_cooked,
                           LinkLayer::linux_cooked_2, LinkLayer::bsd_loopback}) {
    for (const std::size_t on_wire : {frame.size(), frame.size() + 100}) {
      peer::SourceDatagram out;
      const peer::ParsedFrame parsed = parse_frame(layer, frame, on_wire, out);
      if (parsed.content != peer::FrameContent::udp) continue;
      require(holds(frame, out.bytes), "a datagram lies outside its frame");
      if (!parsed.fragment) continue;
      require(holds(frame, parsed.fragment->octets), "a fragment lies outside its frame");
      require(parsed.fragment->octets_at <= frame.size() && parsed.fragment->ip_at < frame.size() &&
                  parsed.fragment->next_at < frame.size(),
              "the headers of a fragment lie outside its frame");
    }
  }
}

/// The in-memory file of all runs; it is named by its descriptor.
int file_descriptor() {
  static const int kFile = memfd_create("reckon", MFD_CLOEXEC);
  return kFile;
}

void write_file(Octets octets) {
  const int file = file_descriptor();
  require(ftruncate(file, 0) == 0 &&
              pwrite(file, octets.data(), octets.size(), 0) == static_cast<ssize_t>(octets.size()),
          "the file cannot be written");
}

void read_all(peer::DatagramSource& source, std::size_t octets) {
  std::uint64_t last = 0;
  peer::SourceDatagram datagram;
  while (source.next(datagram, {}) == peer::SourceEvent::datagram) {
    // Fragments that were given up come later than their successors.
    const bool is_in_order =
        datagram.portion == peer::Portion::whole || datagram.portion == peer::Portion::cut;
    require(!is_in_order || datagram.frame > last, "frames are not counted upwards");
    require(datagram.frame <= source.report().frames, "a frame that was not read");
    last = std::max(last, datagram.frame);
    require(holds(datagram.captured, datagram.bytes), "a datagram lies outside its frame");
  }
  const peer::SourceReport& report = source.report();
  // Compressed files contain more octets than they have.
  const std::uint64_t room = std::max<std::uint64_t>(octets, report.compressed_content);
  require(report.frames <= room / 16, "more frames than the file has room for");
  const peer::FragmentCounts& fragments = report.fragments;
  require(report.datagrams + report.skipped + report.malformed + fragments.frames ==
              report.frames + fragments.whole + fragments.lost + fragments.overlapping,
          "a frame is in no count");
}

}  // namespace

void check(std::span<const std::byte> octets) {
  check_frame(octets);
  write_file(octets);
  const std::string path = "/proc/self/fd/" + std::to_string(file_descriptor());
  try {
    read_all(*peer::open_capture(path), octets.size());
  } catch (const std::runtime_error& error) {
    require(!std::string_view(error.what()).empty(), "refused without a sentence");
  }
}

}  // namespace reckon::fuzz
