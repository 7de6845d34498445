// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/web/byte_stream.hpp"

#include <asio/write.hpp>
#include <utility>

namespace reckon::tools {

using asio::ip::tcp;

ByteStream::ByteStream(tcp::socket socket, asio::ssl::context* tls) : plain_(std::move(socket)) {
  std::error_code error;
  if (const auto end = plain_.remote_endpoint(error); !error) from_ = end.address().to_string();
  plain_.set_option(tcp::no_delay(true), error);
  plain_.set_option(asio::socket_base::keep_alive(true), error);
  if (tls != nullptr) secure_ = std::make_unique<Secure>(std::move(plain_), *tls);
}

const tcp::socket& ByteStream::socket() const { return secure_ ? secure_->next_layer() : plain_; }
tcp::socket& ByteStream::socket() { return secure_ ? secure_->next_layer() : plain_; }

void ByteStream::open(std::function<void(std::error_code)> done) {
  if (!secure_) return done({});
  secure_->async_handshake(asio::ssl::stream_base::server, std::move(done));
}

void ByteStream::read(asio::mutable_buffer room, Done done) {
  if (secure_) return secure_->async_read_some(room, std::move(done));
  plain_.async_read_some(room, std::move(done));
}

void ByteStream::write(const Parts& parts, Done done) {
  if (secure_) return asio::async_write(*secure_, parts, std::move(done));
  asio::async_write(plain_, parts, std::move(done));
}

void ByteStream::write_now(const Parts& parts) {
  std::error_code ignored;
  socket().non_blocking(true, ignored);
  if (secure_)
    secure_->write_some(parts, ignored);
  else
    plain_.write_some(parts, ignored);
}

void ByteStream::end(std::function<void()> done) {
  if (secure_)
    return secure_->async_shutdown([done = std::move(done)](std::error_code) { done(); });
  std::error_code ignored;
  plain_.shutdown(tcp::socket::shutdown_both, ignored);
  done();
}

void ByteStream::close() {
  std::error_code ignored;
  socket().close(ignored);
}

}  // namespace reckon::tools
