// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon cut --audio`: the sound of a radio as a WAV file.
#include "reckon/tools/captures/radio_audio.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/tests/support/capture_builder.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tests/tools/support/written_files.hpp"

namespace reckon::tools::radio_audio_test {
namespace {

using namespace std::chrono_literals;
using test::Octets;
using test::run_reckon;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;

constexpr std::chrono::nanoseconds kStart = 1'700'000'000s;
constexpr std::uint16_t kMuLaw = 1, kPcm = 4, kPcm8 = 5, kLittlePcm = 100;

struct SampleSignal {
  std::uint16_t radio = 1;
  std::uint16_t encoding = kPcm8;
  std::uint32_t rate = 8000;
  std::uint16_t entity = 3;
  std::uint32_t timestamp = 0;
};

Octets signal(const Octets& data, const SampleSignal& sample = {}) {
  pdu::Signal pdu;
  pdu.header.timestamp = sample.timestamp;
  pdu.reference_id = {1, 2, sample.entity};
  pdu.number = sample.radio;
  pdu.encoding_scheme = sample.encoding;
  pdu.sample_rate = sample.rate;
  pdu.data = {static_cast<std::uint16_t>(8 * data.size()), data};
  Octets octets;
  test::append_pdu(octets, pdu);
  return octets;
}

/// `octets` octets of 8-bit PCM with the same value.
Octets level(std::size_t octets, std::uint8_t value) {
  return Octets(octets, static_cast<std::byte>(value));
}

class CutAudio : public ::testing::Test {
 protected:
  test::ProgramResult cut(std::vector<std::string> words = {}) {
    words.insert(words.begin(), {"cut", capture.path(), "--audio", wav(), "--force"});
    return run_reckon(words);
  }
  [[nodiscard]] std::string wav() const { return folder.file("radio.wav"); }
  [[nodiscard]] std::uint32_t number(std::size_t at, std::size_t octets) const {
    const std::string all = test::content(wav());
    std::uint32_t value = 0;
    for (std::size_t i = octets; i-- > 0;)
      value = value << 8 | static_cast<std::uint8_t>(all.at(at + i));
    return value;
  }
  [[nodiscard]] std::vector<int> samples() const {
    const std::string all = test::content(wav());
    std::vector<int> samples;
    for (std::size_t at = WaveFile::kHeader; at + 1 < all.size(); at += 2)
      samples.push_back(static_cast<std::int16_t>(static_cast<std::uint8_t>(all[at]) |
                                                  static_cast<std::uint8_t>(all[at + 1]) << 8));
    return samples;
  }
  void refuse(const std::string& words) {
    const auto result = cut();
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr(words));
    EXPECT_FALSE(std::filesystem::exists(wav()));
  }

  test::ScratchFolder folder;
  test::CaptureBuilder capture;
};

// G.711 as the standard describes it: 8 chords that double their step, 33 below the first.
TEST(AudioEncodings, MuLawIsTheClosedForm) {
  EXPECT_EQ(mu_law_sample(0x00), -32124);
  EXPECT_EQ(mu_law_sample(0x80), 32124);
  EXPECT_EQ(mu_law_sample(0xFF), 0);
  EXPECT_EQ(mu_law_sample(0x7F), 0);
  for (unsigned octet = 0x80; octet < 0x100; ++octet) {
    const unsigned chord = 7 - ((octet >> 4) & 7), step = 15 - (octet & 15);
    const double value = 4.0 * (std::ldexp(16.5 + step, static_cast<int>(chord) + 1) - 33.0);
    EXPECT_EQ(mu_law_sample(static_cast<std::uint8_t>(octet)), value) << octet;
    EXPECT_EQ(mu_law_sample(static_cast<std::uint8_t>(octet - 0x80)), -value) << octet;
  }
}

TEST_F(CutAudio, WritesASecondOfPcm) {
  std::vector<int> truth;
  for (int piece = 0; piece < 50; ++piece) {
    Octets data;
    for (int i = 0; i < 160; ++i) {
      truth.push_back(static_cast<int>(std::lround(
          12'000 * std::sin(2 * 3.14159265358979 * 440 * static_cast<int>(truth.size()) / 8000))));
      const auto bits = static_cast<std::uint16_t>(truth.back());
      data.insert(data.end(), {std::byte(bits >> 8), std::byte(bits & 0xFF)});
    }
    // Captured up to 4 ms late.
    capture.add(signal(data, {.encoding = kPcm}), kStart + 20ms * piece + 1ms * (piece % 5));
  }
  const auto result = cut();
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, AllOf(HasSubstr("1.000 s of radio 1 of 1:2:3"), HasSubstr("8000 Hz")));
  EXPECT_EQ(samples(), truth);
  const std::string all = test::content(wav());
  EXPECT_EQ(all.size(), 44U + 16'000U);
  EXPECT_EQ(all.substr(0, 4) + all.substr(8, 8) + all.substr(36, 4), "RIFFWAVEfmt data");
  EXPECT_EQ(number(4, 4), 36U + 16'000U);
  EXPECT_EQ(number(16, 4), 16U);
  EXPECT_EQ(number(20, 2), 1U) << "PCM";
  EXPECT_EQ(number(22, 2), 1U) << "channels";
  EXPECT_EQ(number(24, 4), 8000U);
  EXPECT_EQ(number(28, 4), 16'000U);
  EXPECT_EQ(number(32, 2), 2U);
  EXPECT_EQ(number(34, 2), 16U);
  EXPECT_EQ(number(40, 4), 16'000U);
}

TEST_F(CutAudio, DecodesEachEncoding) {
  const Octets data{std::byte{0x00}, std::byte{0x80}};
  const auto decoded = [&](std::uint16_t encoding) {
    test::CaptureBuilder one;
    one.add(signal(data, {.encoding = encoding}), kStart);
    EXPECT_EQ(run_reckon({"cut", one.path(), "--audio", wav(), "--force"}).status, 0);
    return samples();
  };
  EXPECT_EQ(decoded(kMuLaw), (std::vector<int>{-32124, 32124}));
  EXPECT_EQ(decoded(kPcm), (std::vector<int>{128}));
  EXPECT_EQ(decoded(kPcm8), (std::vector<int>{-32768, 0}));
  EXPECT_EQ(decoded(kLittlePcm), (std::vector<int>{-32768}));
}

TEST_F(CutAudio, FillsGapsWithSilence) {
  capture.add(signal(level(160, 200)), kStart);
  capture.add(signal(level(160, 201)), kStart + 20ms);
  capture.add(signal(level(160, 202)), kStart + 60ms);  // one is missing
  capture.add(signal(level(160, 203)), kStart + 1s);
  const auto result = cut();
  EXPECT_THAT(result.err, HasSubstr("0.940 s of this is silence, in 2 gaps"));
  const auto all = samples();
  ASSERT_EQ(all.size(), 8160U);
  EXPECT_THAT(std::vector(all.begin(), all.begin() + 160), Each(72 * 256));
  EXPECT_THAT(std::vector(all.begin() + 320, all.begin() + 480), Each(0));
  EXPECT_THAT(std::vector(all.begin() + 480, all.begin() + 640), Each(74 * 256));
  EXPECT_THAT(std::vector(all.begin() + 640, all.begin() + 8000), Each(0));
  EXPECT_THAT(std::vector(all.begin() + 8000, all.end()), Each(75 * 256));
}

TEST_F(CutAudio, DoesNotDoubleRepeatsAndOverlaps) {
  capture.add(signal(level(4000, 200)), kStart);
  capture.add(signal(level(4000, 200)), kStart + 1us);    // captured twice
  capture.add(signal(level(4000, 201)), kStart + 200ms);  // overlaps 300 ms of the first
  capture.add(signal(level(160, 202)), kStart + 699ms);   // early by 1 ms
  const auto result = cut();
  EXPECT_THAT(result.err, AllOf(HasSubstr("1 Signal PDU left out: the same PDU as before"),
                                HasSubstr("0.300 s left out: it overlaps")));
  const auto all = samples();
  ASSERT_EQ(all.size(), 5760U);
  EXPECT_EQ(all[3999], 72 * 256);
  EXPECT_EQ(all[4000], 73 * 256);
  EXPECT_EQ(all[5600], 74 * 256);
}

TEST_F(CutAudio, RefusesSeveralRadiosAndTakesOne) {
  Octets both = signal(level(160, 200));
  const Octets second = signal(level(160, 201), {.radio = 2});
  both.insert(both.end(), second.begin(), second.end());
  capture.add(both, kStart);
  capture.add(signal(level(160, 202), {.entity = 4}), kStart);
  refuse("3 radios");
  EXPECT_THAT(cut().err, AllOf(HasSubstr("radio 2 of 1:2:3 (1 PDU)"), HasSubstr("radio 1 of 1:2:4"),
                               HasSubstr("--where 'radio_number == 1'")));
  EXPECT_EQ(cut({"--entity", "1:2:3", "--where", "radio_number == 2"}).status, 0);
  EXPECT_THAT(samples(), AllOf(::testing::SizeIs(160), Each(73 * 256)));
}

TEST_F(CutAudio, RefusesAChangeOfRateOrEncoding) {
  capture.add(signal(level(160, 200)), kStart);
  capture.add(signal(level(160, 200), {.rate = 16'000}), kStart + 20ms);
  refuse("frame 2: radio 1 of 1:2:3 changes from 8-bit Linear PCM, Unsigned at 8000 Hz");
  EXPECT_EQ(cut({"--where", "sample_rate == 8000"}).status, 0);
  EXPECT_EQ(samples().size(), 160U);
}

TEST_F(CutAudio, NamesEncodingsThatItDoesNotDecode) {
  capture.add(signal(level(160, 200), {.encoding = 2}), kStart);
  capture.add(signal(level(160, 200), {.encoding = 1 << 14}), kStart);
  const auto result = cut();
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("no audio that can be decoded; nothing written"),
                                HasSubstr("CVSD (MIL-STD-188-113)"), HasSubstr("Raw Binary Data")));
  EXPECT_FALSE(std::filesystem::exists(wav()));
}

TEST_F(CutAudio, NamesTheMistake) {
  capture.add(signal(level(160, 200), {.rate = 0}), kStart);
  refuse("frame 1: radio 1 of 1:2:3 has a sample rate of 0 Hz");
  const std::string in = capture.path();
  EXPECT_THAT(run_reckon({"cut", in}).err, HasSubstr("OUT is missing"));
  EXPECT_THAT(run_reckon({"cut", in, wav(), "--audio", wav()}).err, HasSubstr("remove OUT"));
  EXPECT_THAT(run_reckon({"cut", in, "--audio", in}).err, HasSubstr("overwritten"));
  capture.add(signal(level(160, 200)), kStart);
  EXPECT_EQ(cut({"--where", "sample_rate == 8000"}).status, 0);
  const std::vector<std::string> again{"cut", capture.path(), "--audio",
                                       wav(), "--where",      "sample_rate == 8000"};
  EXPECT_THAT(run_reckon(again).err, HasSubstr("--force to overwrite"));
}

// A capture time far off would fill the disk.
TEST_F(CutAudio, RefusesMoreThanAWavFileHolds) {
  capture.add(signal(level(160, 200)), kStart);
  capture.add(signal(level(160, 200)), kStart + 100h);
  refuse("frame 2: ");
}

}  // namespace
}  // namespace reckon::tools::radio_audio_test
