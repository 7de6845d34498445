// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/web/message_deflate.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <new>
#include <utility>

#include "reckon/tools/viewer/web/http_request.hpp"

namespace reckon::tools {
namespace {

/// RFC 7692 7.2.1: the end of each message, which is not sent.
constexpr std::array<unsigned char, 4> kMessageEnd{0x00, 0x00, 0xFF, 0xFF};
constexpr int kLevel = 1;        // fastest
constexpr int kMemoryLevel = 5;  // 16 kB
constexpr int kLargestWindow = 15;

/// RFC 7692 7.1.2: 8 .. 15, also in quotes; 0: something else.
int window_bits_of(std::string_view value) {
  if (value.size() > 2 && value.starts_with('"') && value.ends_with('"'))
    value = value.substr(1, value.size() - 2);
  int bits = 0;
  const auto read = std::from_chars(value.data(), value.data() + value.size(), bits);
  const bool is_whole = read.ec == std::errc{} && read.ptr == value.data() + value.size();
  return is_whole && !value.starts_with('0') && bits >= 8 && bits <= kLargestWindow ? bits : 0;
}

/// The parameters of an offer; each may stand once.
struct Offer {
  bool server_no_context = false, client_no_context = false, client_window = false;
  int server_window = 0;

  /// @return false if the offer must be declined
  bool take(std::string_view parameter) {
    const std::string_view name = cut_trimmed(parameter, "=");
    const bool has_value = !parameter.empty();
    const auto once = [](bool& flag) { return !std::exchange(flag, true); };
    if (name == "server_no_context_takeover") return !has_value && once(server_no_context);
    if (name == "client_no_context_takeover") return !has_value && once(client_no_context);
    if (name == "client_max_window_bits")
      return once(client_window) && (!has_value || window_bits_of(parameter) != 0);
    if (name != "server_max_window_bits" || server_window != 0) return false;
    server_window = window_bits_of(parameter);
    return server_window != 0;
  }
};

std::optional<DeflateTerms> terms_of(std::string_view text) {
  if (cut_trimmed(text, ";") != "permessage-deflate") return std::nullopt;
  Offer offer;
  while (!text.empty())
    if (!offer.take(cut_trimmed(text, ";"))) return std::nullopt;
  constexpr int kLeastWindow = 9;  // of zlib
  if (offer.server_window != 0 && offer.server_window < kLeastWindow) return std::nullopt;
  DeflateTerms terms;
  terms.keeps_context = !offer.server_no_context;
  terms.window_bits = offer.server_window == 0
                          ? MessageCompression::kWindowBits
                          : std::min(offer.server_window, MessageCompression::kWindowBits);
  terms.answer = "permessage-deflate; client_no_context_takeover";
  if (!terms.keeps_context) terms.answer += "; server_no_context_takeover";
  if (offer.server_window != 0)
    terms.answer += "; server_max_window_bits=" + std::to_string(terms.window_bits);
  return terms;
}

}  // namespace

std::optional<DeflateTerms> agree_on_deflate(std::string_view offers) {
  while (!offers.empty())
    if (auto terms = terms_of(cut_trimmed(offers, ","))) return terms;
  return std::nullopt;
}

struct MessageCompression::Streams {
  z_stream out{}, in{};
  ~Streams() {
    deflateEnd(&out);
    inflateEnd(&in);
  }
};

MessageCompression::MessageCompression(const DeflateTerms& terms)
    : streams_(std::make_unique<Streams>()), keeps_context_(terms.keeps_context) {
  if (deflateInit2(&streams_->out, kLevel, Z_DEFLATED, -terms.window_bits, kMemoryLevel,
                   Z_DEFAULT_STRATEGY) != Z_OK ||
      inflateInit2(&streams_->in, -kLargestWindow) != Z_OK)
    throw std::bad_alloc();
}

MessageCompression::~MessageCompression() = default;

std::string MessageCompression::deflate(std::string_view message) {
  constexpr std::size_t kRoom = 1024;
  z_stream& z = streams_->out;
  if (!keeps_context_) deflateReset(&z);
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(message.data()));
  z.avail_in = static_cast<uInt>(message.size());
  std::string out;
  std::size_t size = 0;
  do {
    out.resize(out.size() + std::max(kRoom, message.size() / 2));
    z.next_out = reinterpret_cast<Bytef*>(out.data() + size);
    z.avail_out = static_cast<uInt>(out.size() - size);
    ::deflate(&z, Z_SYNC_FLUSH);
    size = out.size() - z.avail_out;
  } while (z.avail_out == 0);
  out.resize(size - kMessageEnd.size());
  return out;
}

PackedMessage pack_message(WebSocketOpcode opcode, std::shared_ptr<const std::string> payload,
                           MessageCompression* compression) {
  const bool compresses = compression != nullptr && opcode == WebSocketOpcode::text;
  if (compresses) payload = std::make_shared<const std::string>(compression->deflate(*payload));
  return {frame_head(opcode, payload->size(), compresses), std::move(payload)};
}

bool MessageCompression::inflate(ClientFrame& frame) noexcept {
  std::array<unsigned char, kLongestClientFrame + kMessageEnd.size()> in;
  std::array<unsigned char, kLongestClientFrame + 1> out;
  const auto* octets = reinterpret_cast<const unsigned char*>(frame.octets.data());
  std::copy_n(octets, frame.size, in.begin());
  std::ranges::copy(kMessageEnd, in.begin() + static_cast<std::ptrdiff_t>(frame.size));
  z_stream& z = streams_->in;
  inflateReset(&z);
  z.next_in = in.data();
  z.avail_in = static_cast<uInt>(frame.size + kMessageEnd.size());
  z.next_out = out.data();
  z.avail_out = static_cast<uInt>(out.size());
  const int result = ::inflate(&z, Z_SYNC_FLUSH);
  // RFC 7692 7.2.3.4: after a final block there is one octet of 0, and the end that we have added.
  const bool is_final = result == Z_STREAM_END && z.avail_in == kMessageEnd.size() + 1;
  if (!is_final && (result != Z_OK || z.avail_in != 0)) return false;
  if (z.avail_out == 0) return false;
  frame.size = out.size() - z.avail_out;
  std::copy_n(reinterpret_cast<const std::byte*>(out.data()), frame.size, frame.octets.begin());
  return true;
}

}  // namespace reckon::tools
