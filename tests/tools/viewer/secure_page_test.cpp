// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The page over https, with a client of OpenSSL.
#include <gtest/gtest.h>
#include <openssl/ssl.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/served_page.hpp"
#include "reckon/tests/tools/support/test_certificate.hpp"

namespace reckon::tools::secure_page_test {
namespace {

using served::Client;
using served::kMostRounds;
using served::Served;

/// A TLS client of at most this version.
class SecureClient : public Client {
 public:
  explicit SecureClient(Served& served, int version = TLS1_3_VERSION)
      : Client(served),
        context_(SSL_CTX_new(TLS_client_method()), SSL_CTX_free),
        ssl_(nullptr, SSL_free) {
    SSL_CTX_set_security_level(context_.get(), 0);
    SSL_CTX_set_min_proto_version(context_.get(), TLS1_VERSION);
    SSL_CTX_set_max_proto_version(context_.get(), version);
    ssl_.reset(SSL_new(context_.get()));
    SSL_set_fd(ssl_.get(), socket_);
    is_open = finish([this] { return SSL_connect(ssl_.get()); }) == 1;
  }
  void say(const std::string& text) {
    EXPECT_EQ(
        finish([&] { return SSL_write(ssl_.get(), text.data(), static_cast<int>(text.size())); }),
        static_cast<int>(text.size()));
  }
  /// Reads until the data contains `wanted`, or to the end.
  std::string hear(std::string_view wanted) {
    std::string all;
    std::array<char, 4096> room;
    while (all.find(wanted) == std::string::npos) {
      const int size = finish([&] { return SSL_read(ssl_.get(), room.data(), room.size()); });
      if (size <= 0) break;
      all.append(room.data(), static_cast<std::size_t>(size));
    }
    return all;
  }

  bool is_open = false;

 private:
  template <typename Call>
  int finish(Call&& call) {
    for (int i = 0; i < kMostRounds; ++i) {
      const int result = call();
      if (result > 0) return result;
      const int why = SSL_get_error(ssl_.get(), result);
      if (why != SSL_ERROR_WANT_READ && why != SSL_ERROR_WANT_WRITE) return result;
      if (i % 4 == 3) served_.tick();
      served_.poll();
    }
    return 0;
  }

  std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> context_;
  std::unique_ptr<SSL, decltype(&SSL_free)> ssl_;
};

class SecurePage : public ::testing::Test {
 protected:
  const test::ScratchFolder folder_;
  const std::string own_ = test::write_certificate(folder_.file("own"), "page.lan");
  Served served_{3, "TRUCK", {.needs_word = true, .tls = {own_ + ".crt", own_ + ".key"}}};
  const std::string name_ = "page.lan:" + std::to_string(served_.server.port());

  [[nodiscard]] std::string answer(std::map<std::string, std::string> fields,
                                   std::string_view wanted) {
    SecureClient client(served_);
    EXPECT_TRUE(client.is_open);
    client.say(served::upgrade(served_, std::move(fields), "?word=1f2e"));
    return client.hear(wanted);
  }
};

TEST_F(SecurePage, ServesFilesAndPictures) {
  SecureClient file(served_);
  file.say(served::request(served_, "GET /main.js"));
  EXPECT_TRUE(file.hear("\r\n\r\n").starts_with("HTTP/1.1 200"));
  for (const std::string& host : {name_, served_.host()}) {
    // "RKV4": a picture
    const std::string all = answer({{"Host", host}, {"Origin", "https://" + host}}, "RKV4");
    EXPECT_TRUE(all.starts_with("HTTP/1.1 101")) << host;
    EXPECT_NE(all.find("RKV4"), std::string::npos) << host;
  }
}

TEST_F(SecurePage, HoldsToItsNamesAndItsScheme) {
  for (const auto& [host, origin] : std::map<std::string, std::string>{
           {served_.host(), "http://" + served_.host()},
           {"evil.example" + name_.substr(8), "https://evil.example" + name_.substr(8)},
           {name_, "https://" + served_.host()}})
    EXPECT_TRUE(answer({{"Host", host}, {"Origin", origin}}, "RKV4").starts_with("HTTP/1.1 403"))
        << origin;
  EXPECT_EQ(served_.server.address(), "https://" + name_ + "/#word=1f2e");
}

TEST_F(SecurePage, HangsUpOnPlainHttpAndOldTls) {
  Client plain(served_);
  plain.send(served::request(served_, "GET /"));
  EXPECT_TRUE(plain.hangs_up());
  EXPECT_EQ(plain.in.find("HTTP"), std::string::npos);
  EXPECT_FALSE(SecureClient(served_, TLS1_1_VERSION).is_open);
  EXPECT_TRUE(SecureClient(served_, TLS1_2_VERSION).is_open);
}

TEST_F(SecurePage, EndsAHandshakeThatNeverComes) {
  Client silent(served_);
  for (int i = 0; i < 160; ++i) served_.tick();
  EXPECT_TRUE(silent.hangs_up()) << "5.3 s";
}

}  // namespace
}  // namespace reckon::tools::secure_page_test
