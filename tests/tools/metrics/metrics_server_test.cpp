// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Clients that request a program's metrics: all on loopback.
#include "reckon/tools/metrics/metrics_server.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools::metrics_server_test {
namespace {

using std::chrono::nanoseconds;
using test::run_reckon;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr nanoseconds kNow = std::chrono::seconds(100);

std::string host_of(const MetricsServer& server) {
  const std::string sentence = server.sentence();
  const std::size_t begin = sentence.find("http://") + 7;
  return sentence.substr(begin, sentence.find('/', begin) - begin);
}

/// A client connection that waits for its answer.
class Client {
 public:
  explicit Client(const MetricsServer& server) {
    const std::string host = host_of(server);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port =
        htons(static_cast<std::uint16_t>(std::stoi(host.substr(host.find(':') + 1))));
    if (connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
      throw std::runtime_error("cannot connect");
  }
  ~Client() { ::close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void send(std::string_view text) {
    EXPECT_EQ(::send(socket_, text.data(), text.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(text.size()));
  }
  /// All data until the server closes the connection.
  [[nodiscard]] std::string answer() {
    std::string all;
    std::array<char, 4096> room;
    for (ssize_t size; (size = ::recv(socket_, room.data(), room.size(), 0)) > 0;)
      all.append(room.data(), static_cast<std::size_t>(size));
    return all;
  }

 private:
  int socket_ = ::socket(AF_INET, SOCK_STREAM, 0);
};

std::string answer_to(const MetricsServer& server, const std::string& line,
                      const std::string& host) {
  Client client(server);
  client.send(line + " HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
  return client.answer();
}

TEST(MetricsAddress, HasAnAddressWithPortOrLocalPort) {
  EXPECT_FALSE(metrics_address("").has_value());
  EXPECT_EQ(metrics_address("9464")->address, "127.0.0.1");
  EXPECT_EQ(metrics_address("9464")->port, 9464);
  EXPECT_EQ(metrics_address("10.0.0.7:80")->address, "10.0.0.7");
  EXPECT_EQ(metrics_address("[::1]:9464")->address, "::1");
  EXPECT_EQ(metrics_address("[::1]:9464")->port, 9464);
  for (const char* wrong : {"127.0.0.1", "crane:9464", "65536", "127.0.0.1:", "::1", "127.0.0.1:x",
                            ":9464", "-1", "127.0.0.1:9464:1"})
    EXPECT_THROW((void)metrics_address(wrong), UsageError) << wrong;
}

TEST(MetricsServer, AnswersWithTheLatestText) {
  MetricsServer server({});
  const std::string host = host_of(server);
  EXPECT_THAT(host, StartsWith("127.0.0.1:"));
  EXPECT_THAT(answer_to(server, "GET /metrics", host), HasSubstr("\r\n\r\n# EOF\n"));
  EXPECT_TRUE(server.is_due(kNow));
  server.show("reckon_a 1\n# EOF\n", kNow);
  EXPECT_FALSE(server.is_due(kNow + MetricsServer::kEvery - nanoseconds(1)));
  EXPECT_TRUE(server.is_due(kNow + MetricsServer::kEvery));
  const std::string answer = answer_to(server, "GET /metrics", host);
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 200 OK\r\n"));
  EXPECT_THAT(answer, HasSubstr("Content-Type: application/openmetrics-text; version=1.0.0; "
                                "charset=utf-8\r\n"));
  EXPECT_THAT(answer, HasSubstr("Content-Length: 17\r\n"));
  EXPECT_THAT(answer, ::testing::EndsWith("\r\n\r\nreckon_a 1\n# EOF\n"));
}

TEST(MetricsServer, HasNothingElseAndNothingForOtherNames) {
  const MetricsServer server({});
  const std::string host = host_of(server);
  for (const char* line :
       {"GET /", "GET /index.html", "GET /stream", "POST /metrics", "GET /frame.html"})
    EXPECT_THAT(answer_to(server, line, host), StartsWith("HTTP/1.1 404")) << line;
  // A page whose name resolves to this host.
  EXPECT_THAT(answer_to(server, "GET /metrics", "evil.example:80"), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(answer_to(server, "malformed request", host), StartsWith("HTTP/1.1 400"));
}

TEST(MetricsServer, IsNotDelayedBySlowClients) {
  MetricsServer server({});
  const std::string host = host_of(server);
  std::vector<std::unique_ptr<Client>> slow;
  for (int i = 0; i < 40; ++i) {
    slow.push_back(std::make_unique<Client>(server));
    slow.back()->send("GET /met");
  }
  // A client that never reads its answer, which is larger than its socket buffer.
  server.show(std::string(8'000'000, '#'), kNow);
  Client deaf(server);
  deaf.send("GET /metrics HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
  Client endless(server);
  endless.send(std::string(8192, 'x'));
  EXPECT_EQ(endless.answer(), "");
  server.show("# EOF\n", kNow);
  EXPECT_THAT(answer_to(server, "GET /metrics", host), HasSubstr("\r\n\r\n# EOF\n"));
  slow.back()->send("rics HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
  EXPECT_THAT(slow.back()->answer(), HasSubstr("\r\n\r\n# EOF\n"));
}

TEST(MetricsServer, ReportsATakenPortWithARemedy) {
  const MetricsServer first({});
  const std::string host = host_of(first);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"view", "--metrics", host, "--for", "10ms", "--port", "0"},
        {"record", testing::TempDir() + "taken.pcapng", "--metrics", host, "--iface", "lo"}}) {
    const auto result = run_reckon(words);
    EXPECT_EQ(result.status, 3) << words[0];
    EXPECT_THAT(result.err, HasSubstr("cannot serve metrics at 127.0.0.1:"));
    EXPECT_THAT(result.err, HasSubstr("choose another by --metrics"));
  }
  const auto nowhere = run_reckon({"view", "--metrics", "192.0.2.1:1", "--for", "10ms"});
  EXPECT_EQ(nowhere.status, 3);
  EXPECT_THAT(nowhere.err, HasSubstr("192.0.2.1:1"));
  const auto wrong = run_reckon({"view", "--metrics", "nowhere", "--for", "10ms"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("127.0.0.1:9464"));
}

}  // namespace
}  // namespace reckon::tools::metrics_server_test
