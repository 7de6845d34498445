// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/web/tls_context.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/test_certificate.hpp"

namespace reckon::tools::tls_context_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string refusal(const std::string& certificate, const std::string& key) {
  try {
    check_tls({certificate, key});
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

TEST(TlsContext, KnowsTheNamesOfItsCertificate) {
  const test::ScratchFolder folder;
  const std::string own = test::write_certificate(folder.file("own"), "page.lan");
  asio::ssl::context context = open_tls({own + ".crt", own + ".key"});
  EXPECT_THAT(certified_names(context), ElementsAre("page.lan"));
}

TEST(TlsContext, RefusesACertificateOutOfDate) {
  const test::ScratchFolder folder;
  const std::string old = test::write_certificate(folder.file("old"), "localhost", -200'000, -60);
  EXPECT_THAT(refusal(old + ".crt", old + ".key"),
              AllOf(HasSubstr("old.crt: has expired on 2"), HasSubstr("renew it")));
  const std::string early = test::write_certificate(folder.file("early"), "localhost", 9000, 9999);
  EXPECT_THAT(refusal(early + ".crt", early + ".key"), HasSubstr("early.crt: is valid from 2"));
}

TEST(TlsContext, RefusesTheKeyOfAnotherCertificate) {
  const test::ScratchFolder folder;
  const std::string own = test::write_certificate(folder.file("own"));
  const std::string other = test::write_certificate(folder.file("other"));
  EXPECT_THAT(
      refusal(own + ".crt", other + ".key"),
      AllOf(HasSubstr("other.key: is not the key of the certificate"), HasSubstr("own.crt")));
}

TEST(TlsContext, RefusesAKeyThatOthersMayRead) {
  const test::ScratchFolder folder;
  const std::string own = test::write_certificate(folder.file("own"));
  fs::permissions(own + ".key", fs::perms(0644));
  EXPECT_THAT(refusal(own + ".crt", own + ".key"), HasSubstr("chmod 600 " + own + ".key"));
}

TEST(TlsContext, RefusesFilesThatAreNoPem) {
  const test::ScratchFolder folder;
  const std::string own = test::write_certificate(folder.file("own"));
  EXPECT_THAT(refusal(folder.file("none.crt"), own + ".key"), HasSubstr("none.crt"));
  EXPECT_THAT(refusal(own + ".crt", folder.file("none.key")),
              HasSubstr("none.key: cannot be read: No such file"));
  EXPECT_THAT(refusal(own + ".key", own + ".key"), HasSubstr("is not a PEM certificate"));
  std::ofstream(own + ".key") << "nothing\n";
  EXPECT_THAT(refusal(own + ".crt", own + ".key"), HasSubstr("is not a PEM private key"));
}

}  // namespace
}  // namespace reckon::tools::tls_context_test
