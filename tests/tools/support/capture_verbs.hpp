// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Captures for the tests of record, replay, info and cut, and the output of these verbs. All
// traffic stays on the loopback interface.
#pragma once

#include <gmock/gmock.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/peer/capture/capture_file.hpp"
#include "reckon/peer/capture/capture_writer.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/udp_multicast.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools::captures {

using namespace std::chrono_literals;
using nlohmann::json;
using std::chrono::nanoseconds;
using test::ProgramResult;
using test::run_reckon;
using test::ScratchFolder;

using Octets = std::vector<std::byte>;

/// A group of this test program's own.
inline peer::GroupAddress group(std::uint8_t number) {
  return peer::IpEndpoint::v4(0xefc04f00U + number,
                              static_cast<std::uint16_t>(20000 + getpid() % 20000));
}

template <typename Pdu>
void append(Octets& datagram, const Pdu& pdu) {
  const std::size_t begin = datagram.size();
  datagram.resize(begin + wire_size(pdu));
  ASSERT_GT(encode(pdu, std::span(datagram).subspan(begin)), 0U);
}

inline Octets entity_state(std::uint16_t entity) {
  pdu::EntityState pdu;
  pdu.entity_id = {1, 2, entity};
  pdu.marking.set("HAND");
  Octets out;
  append(out, pdu);
  return out;
}

/// A capture of `count` datagrams, one every `spacing`: entity 1 to group 0 and entity 2 to group 1
/// alternate; every fourth has an Attribute PDU, too.
inline std::string make_capture(const ScratchFolder& folder, std::size_t count, nanoseconds spacing,
                                const std::string& name = "made.pcapng") {
  const std::string path = folder.file(name);
  peer::CaptureWriter writer({.path = path, .compress = name.ends_with(".zst")});
  for (std::size_t i = 0; i < count; ++i) {
    Octets bytes = entity_state(static_cast<std::uint16_t>(1 + i % 2));
    if (i % 4 == 0) append(bytes, pdu::Attribute{});
    peer::SourceDatagram datagram;
    datagram.time = 1'700'000'000s + static_cast<std::int64_t>(i) * spacing;
    datagram.source = peer::IpEndpoint::v4(0x0a000001, 4000);
    datagram.group = group(static_cast<std::uint8_t>(i % 2));
    datagram.bytes = bytes;
    writer.write(datagram);
  }
  writer.finish(count, 0);
  return path;
}

inline json info_of(const std::string& path, int status = 0) {
  const ProgramResult result = run_reckon({"info", path, "--json"});
  EXPECT_EQ(result.status, status) << result.err;
  return json::parse(result.out);
}

inline peer::UdpMulticastOptions on_loopback() {
  peer::UdpMulticastOptions options;
  options.interface = "lo";
  return options;
}

/// Sends `count` Entity States to a group on the loopback interface.
inline void send_some(const peer::GroupAddress& to, std::size_t count, std::uint16_t entity = 1) {
  const peer::SteadyClock clock;
  peer::UdpMulticast link(on_loopback(), clock);
  for (std::size_t i = 0; i < count; ++i) EXPECT_TRUE(link.send(to, entity_state(entity)));
}

/// Datagrams in a capture, even one that is still being written.
inline std::size_t datagrams_in(const std::string& path) {
  std::size_t count = 0;
  try {
    const auto source = peer::open_capture(path);
    peer::SourceDatagram datagram;
    while (source->next(datagram, {}) == peer::SourceEvent::datagram) ++count;
  } catch (const std::runtime_error&) {
    // The file or its header does not exist yet.
  }
  return count;
}

/// Waits for an action of another thread or process, at most 10 s.
template <typename Condition>
bool soon(Condition&& condition) {
  for (int i = 0; i < 1000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

}  // namespace reckon::tools::captures
