// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Input of the viewer's server from a connection: a request, then frames of a page. Any octets are
// read within bounds and without heap; the server waits for the rest of truncated input; the values
// of page requests are finite and in range. No client without an own address and the password is
// admitted.
#include <algorithm>
#include <cmath>
#include <string_view>

#include "reckon/tests/fuzz/fuzz_target.hpp"
#include "reckon/tools/viewer/protocol/page_request.hpp"
#include "reckon/tools/viewer/web/access.hpp"
#include "reckon/tools/viewer/web/http_request.hpp"
#include "reckon/tools/viewer/web/message_deflate.hpp"
#include "reckon/tools/viewer/web/web_socket.hpp"

namespace reckon::fuzz {
namespace {

using tools::FrameVerdict;
using tools::HttpRequest;
using tools::RequestVerdict;

constexpr std::string_view kHost = "127.0.0.1:8642";

bool is_within(std::string_view part, std::string_view all) {
  return part.empty() ||
         (part.data() >= all.data() && part.data() + part.size() <= all.data() + all.size());
}

const tools::Access& access() {
  static const tools::Access kAccess({"127.0.0.1"}, 8642, "0123456789abcdef");
  return kAccess;
}

void check_access(const HttpRequest& request) {
  require(access().is_own_host(request.host) == (request.host == kHost), "another name is taken");
  if (access().is_own_origin(request.origin, request.host))
    require(request.origin.substr(7) == kHost, "another origin is taken");
  const std::string_view word = tools::value_in_query(request.query, "word");
  require(is_within(word, request.query), "a word from elsewhere");
  require(access().is_word(word) == (word == access().word()), "another word is taken");
}

/// The octets of the header; 0 if there is none.
std::size_t check_request(std::string_view text) {
  HttpRequest request, cut;
  const RequestVerdict verdict = read_request(text, request);
  require(verdict != RequestVerdict::incomplete || text.size() < tools::kLongestHead,
          "waits for ever");
  require((verdict == RequestVerdict::too_long) <= (text.size() >= tools::kLongestHead),
          "a short head is too long");
  if (verdict != RequestVerdict::good) return 0;
  require(request.length <= text.size() && request.length <= tools::kLongestHead + 4, "its length");
  require(request.path.starts_with('/'), "no path");
  const std::string_view head = text.substr(0, request.length);
  for (const std::string_view part :
       {request.method, request.path, request.query, request.host, request.origin, request.upgrade,
        request.connection, request.key, request.version})
    require(is_within(part, head), "a part from elsewhere");
  require(read_request(head.substr(0, head.size() - 1), cut) == RequestVerdict::incomplete,
          "a head without its end is taken");
  (void)tools::lists_word(request.connection, "upgrade");
  (void)tools::is_web_socket_key(request.key);
  check_access(request);
  return request.length;
}

struct CheckRequest {
  void operator()(const tools::SeekRequest& seek) const {
    require(std::isfinite(seek.time), "a time that is none");
  }
  void operator()(const tools::SpeedRequest& speed) const {
    require(speed.speed == 0 || (speed.speed >= 0.1F && speed.speed <= 16), "a speed");
  }
  void operator()(const tools::StepRequest& step) const {
    require(std::abs(step.seconds) + std::abs(step.updates) == 1, "a step");
  }
  void operator()(const tools::PointerRequest& pointer) const {
    require(pointer.position.allFinite() &&
                pointer.position.cwiseAbs().maxCoeff() <= tools::PointerRequest::kFarthest,
            "a place");
  }
  void operator()(const tools::NetworkRequest& network) const {
    require(network.delay_ms >= 0 && network.delay_ms <= 300 && network.jitter_ms >= 0 &&
                network.jitter_ms <= 300 && network.loss >= 0 && network.loss <= 1,
            "a network");
  }
  template <typename Request>
  void operator()(const Request&) const {}
};

/// RFC 7692 7.2.3.1. The first message allocates.
bool inflates_hello(tools::MessageCompression& compression) {
  tools::ClientFrame frame;
  for (const unsigned octet : {0xF2U, 0x48U, 0xCDU, 0xC9U, 0xC9U, 0x07U, 0x00U})
    frame.octets[frame.size++] = static_cast<std::byte>(octet);
  return compression.inflate(frame) && frame.size == 5;
}

void check_frames(std::span<const std::byte> octets, tools::MessageCompression& compression) {
  tools::ClientFrame frame;
  for (;;) {
    const FrameVerdict verdict = read_client_frame(octets, true, frame);
    require(verdict != FrameVerdict::incomplete || octets.size() < 131, "waits for too much");
    if (verdict != FrameVerdict::good) return;
    require(frame.size <= tools::kLongestClientFrame && frame.length == frame.size + 6 &&
                frame.length <= octets.size(),
            "a frame longer than it is");
    if (frame.is_compressed && !compression.inflate(frame)) return;
    require(frame.size <= tools::kLongestClientFrame, "a frame inflates beyond its limit");
    if (const auto request = tools::read_page_request(frame.payload()))
      std::visit(CheckRequest{}, *request);
    octets = octets.subspan(frame.length);
  }
}

}  // namespace

void check(std::span<const std::byte> input) {
  (void)access();
  static tools::MessageCompression compression({tools::MessageCompression::kWindowBits, true, {}});
  static const bool inflates = inflates_hello(compression);
  require(inflates, "a message of RFC 7692 is refused");
  const HeapMeter heap;
  const std::size_t head = check_request(text_of(input));
  check_frames(input.subspan(head), compression);
  (void)tools::read_page_request(input);
  require(heap.allocations() == 0, "the heap is used");
  if (const auto terms = tools::agree_on_deflate(text_of(input)))
    require(terms->window_bits >= 9 && terms->window_bits <= 15, "a window");
}

}  // namespace reckon::fuzz
