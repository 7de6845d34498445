// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Inflates the messages of a server as a browser does (RFC 7692).
#pragma once

#include <zlib.h>

#include <stdexcept>
#include <string>
#include <string_view>

namespace reckon::tools::served {

class StreamInflater {
 public:
  StreamInflater() {
    if (inflateInit2(&z_, -15) != Z_OK) throw std::runtime_error("zlib");
  }
  ~StreamInflater() { inflateEnd(&z_); }
  StreamInflater(const StreamInflater&) = delete;
  StreamInflater& operator=(const StreamInflater&) = delete;

  /// The next message. @throws std::runtime_error if it is damaged
  std::string inflate(std::string_view payload) {
    std::string in(payload);
    in.append("\x00\x00\xff\xff", 4);
    z_.next_in = reinterpret_cast<Bytef*>(in.data());
    z_.avail_in = static_cast<uInt>(in.size());
    std::string out;
    do {
      const std::size_t size = out.size();
      out.resize(size + 65536);
      z_.next_out = reinterpret_cast<Bytef*>(out.data() + size);
      z_.avail_out = 65536;
      const int result = ::inflate(&z_, Z_SYNC_FLUSH);
      out.resize(out.size() - z_.avail_out);
      if (result == Z_BUF_ERROR) break;
      if (result != Z_OK) throw std::runtime_error("a damaged message");
    } while (z_.avail_out == 0);
    return out;
  }

 private:
  z_stream z_{};
};

}  // namespace reckon::tools::served
