// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A page of trucks that is served on loopback, with its time stepped by hand, and its clients.
#pragma once

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reckon/tests/tools/support/driven_trucks.hpp"
#include "reckon/tests/tools/support/message_inflate.hpp"
#include "reckon/tests/tools/support/picture_reader.hpp"
#include "reckon/tools/viewer/view_server.hpp"

namespace reckon::tools::served {

using trucks::kStart;
using trucks::milliseconds;
using trucks::nanoseconds;
using trucks::seconds;

inline constexpr std::string_view kKey = "dGhlIHNhbXBsZSBub25jZQ==";
/// Data that has not arrived after this many rounds does not come.
inline constexpr int kMostRounds = 2000;

/// A server of trucks whose time is stepped by hand.
class Served {
 public:
  explicit Served(std::size_t trucks = 3, const std::string& marking = "TRUCK",
                  ViewServerOptions options = {})
      : server(stage, on_loopback(std::move(options))) {
    for (std::size_t i = 1; i <= trucks; ++i) {
      trucks::Sent sent{{}, kStart};
      test::append_pdu(sent.octets, trucks::truck(static_cast<std::uint16_t>(i), 0, marking));
      (void)stage.take(trucks::datagram_of(sent));
    }
    tick();
  }
  /// Advances by a thirtieth of a second.
  void tick() {
    now += ViewServer::kTick;
    stage.pass(kStart + now);
    server.tick(now);
    poll();
  }
  void poll() {
    for (int i = 0; i < 4; ++i) server.poll(milliseconds(1));
  }
  [[nodiscard]] std::string host() const { return "127.0.0.1:" + std::to_string(server.port()); }

  static ViewServerOptions on_loopback(ViewServerOptions options) {
    options.port = 0;
    options.word = "1f2e";
    return options;
  }

  nanoseconds now{0};
  ViewStage stage{StageOptions{}};
  ViewServer server;
};

/// A client connection.
class Client {
 public:
  /// @param host it connects from 127.0.0.N
  explicit Client(Served& served, int receive_buffer = 0, std::uint32_t host = 1)
      : served_(served) {
    socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0);
    if (receive_buffer > 0)
      setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl((INADDR_LOOPBACK & ~0xFFU) | host);
    (void)bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    address.sin_port = htons(served.server.port());
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    (void)connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    served.poll();
  }
  ~Client() { ::close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void send(std::string_view text) {
    while (!text.empty()) {
      const ssize_t sent = ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
      if (sent < 0 && errno != EAGAIN) return;  // the server has already closed it
      if (sent > 0) text.remove_prefix(static_cast<std::size_t>(sent));
      served_.poll();
    }
  }
  /// Reads arrived data. @return false if the server has closed the connection
  bool receive() {
    served_.poll();
    std::array<char, 65536> room;
    for (;;) {
      const ssize_t size = ::recv(socket_, room.data(), room.size(), 0);
      if (size > 0) in.append(room.data(), static_cast<std::size_t>(size));
      if (size == 0 || (size < 0 && errno != EAGAIN)) return false;
      if (size < 0) return true;
    }
  }
  /// Reads all data until the server closes the connection.
  const std::string& receive_all() {
    for (int i = 0; i < kMostRounds && receive(); ++i) continue;
    return in;
  }
  [[nodiscard]] bool hangs_up() {
    for (int i = 0; i < kMostRounds; ++i)
      if (!receive()) return true;
    return false;
  }

  std::string in;

 protected:
  Served& served_;
  int socket_;
};

/// The head of a request with the given fields changed, or omitted if empty.
inline std::string request(const Served& served, const std::string& line,
                           std::map<std::string, std::string> fields = {}) {
  fields.try_emplace("Host", served.host());
  std::string text = line + " HTTP/1.1\r\n";
  for (const auto& [name, value] : fields)
    if (!value.empty()) text += name + ": " + value + "\r\n";
  return text + "\r\n";
}

inline std::string upgrade(const Served& served, std::map<std::string, std::string> fields = {},
                           const std::string& query = "") {
  fields.try_emplace("Origin", "http://" + served.host());
  fields.try_emplace("Upgrade", "websocket");
  fields.try_emplace("Connection", "Upgrade");
  fields.try_emplace("Sec-WebSocket-Key", std::string(kKey));
  fields.try_emplace("Sec-WebSocket-Version", "13");
  return request(served, "GET /stream" + query, fields);
}

inline std::string answer_to(Served& served, const std::string& text) {
  Client client(served);
  client.send(text);
  return client.receive_all();
}

inline std::string status_of(const std::string& answer) { return answer.substr(0, 12); }

/// A tab: a client after its handshake.
class Tab : public Client {
 public:
  /// @param extensions that it offers
  explicit Tab(Served& served, const std::string& query = "", int receive_buffer = 0,
               std::uint32_t host = 1, const std::string& extensions = "")
      : Client(served, receive_buffer, host) {
    send(upgrade(served, {{"Sec-WebSocket-Extensions", extensions}}, query));
    for (int i = 0; i < kMostRounds && in.find("\r\n\r\n") == std::string::npos; ++i)
      if (!receive()) break;
    head = in.substr(0, in.find("\r\n\r\n"));
    in.erase(0, std::min(in.size(), head.size() + 4));
  }

  /// A masked frame.
  void frame(const std::string& payload, unsigned first = 0x82) {
    std::string text{static_cast<char>(first), static_cast<char>(0x80U | payload.size())};
    text += std::string("\x01\x02\x03\x04");
    for (std::size_t i = 0; i < payload.size(); ++i)
      text += static_cast<char>(payload[i] ^ static_cast<char>(1 + i % 4));
    send(text);
  }
  /// Sorts arrived data into texts and pictures; @return false if the server has closed the
  /// connection
  bool take() {
    const bool goes_on = receive();
    while (in.size() >= 2) {
      const auto octet = [this](std::size_t i) { return static_cast<unsigned char>(in[i]); };
      std::size_t size = octet(1), at = 2;
      if (size == 126) at = 4;
      if (size == 127) at = 10;
      if (in.size() < at) break;
      if (at > 2) {
        size = 0;
        for (std::size_t i = 2; i < at; ++i) size = size << 8 | octet(i);
      }
      if (in.size() < at + size) break;
      std::string payload = in.substr(at, size);
      octets += payload.size();
      if ((octet(0) & 0x40U) != 0) payload = inflater_.inflate(payload);
      if ((octet(0) & 0xBFU) == 0x81) texts.push_back(nlohmann::json::parse(payload));
      if ((octet(0) & 0xBFU) == 0x82) pictures.push_back(reader.take(payload));
      if (octet(0) == 0x88) closed = true;
      in.erase(0, at + size);
    }
    return goes_on;
  }
  void draw() { frame(std::string("\x01") + pictures.back().substr(4, 4)); }
  [[nodiscard]] double time() const {
    double time = 0;
    std::memcpy(&time, pictures.back().data() + 8, sizeof time);
    return time;
  }

  std::string head;
  std::vector<nlohmann::json> texts;
  std::vector<std::string> pictures;  ///< whole
  reading::PictureReader reader;
  std::size_t octets = 0;  ///< of payloads as they were sent
  bool closed = false;

 private:
  StreamInflater inflater_;
};

}  // namespace reckon::tools::served
