// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/captures/radio_audio.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/command_line/size_text.hpp"
#include "reckon/tools/terminal/text_end.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {

std::string RadioAudio::Radio::text() const {
  return fmt::format("radio {} of {}:{}:{}", number, entity.site, entity.application,
                     entity.entity);
}

void RadioAudio::take(const PduRow& row) {
  pdu::Signal signal;
  if (pdu::decode(row.bytes, signal) != pdu::DecodeError::none) return;
  const AudioEncoding* encoding = audio_encoding(signal.encoding_scheme);
  if (encoding == nullptr) {
    ++others_[signal.encoding_scheme];
    return;
  }
  ++radios_[{signal.reference_id, signal.number}];
  if (radios_.size() > 1) return;  // refused by finish()
  check_stream(row, signal);
  encoding->decode(signal.data.value().first(signal.data.count / 8), samples_);
  place(row);
}

// Creates the file with the first PDU, and compares the others with that PDU.
void RadioAudio::check_stream(const PduRow& row, const pdu::Signal& signal) {
  const std::string radio = radios_.begin()->first.text();
  if (signal.sample_rate == 0 || signal.sample_rate > kMostRate)
    throw UsageError(fmt::format("frame {}: {} has a sample rate of {} Hz; exclude it with --where",
                                 row.frame, radio, signal.sample_rate));
  if (!file_) {
    begin_ = row.time;
    encoding_scheme_ = signal.encoding_scheme;
    rate_ = signal.sample_rate;
    file_.emplace(path_, overwrite_, rate_);
  }
  const bool other_rate = signal.sample_rate != rate_;
  if (!other_rate && signal.encoding_scheme == encoding_scheme_) return;
  throw UsageError(fmt::format(
      "frame {}: {} changes from {} at {} Hz to {} at {} Hz, and a WAV file holds one format; cut "
      "each part by --from and --to, or by --where '{} == {}'",
      row.frame, radio, encoding_text(encoding_scheme_), rate_,
      encoding_text(signal.encoding_scheme), signal.sample_rate,
      other_rate ? "sample_rate" : "encoding_scheme", other_rate ? rate_ : encoding_scheme_));
}

// Capture times jitter, so a PDU that is late by less than half its length follows without a gap.
void RadioAudio::place(const PduRow& row) {
  std::span<const std::int16_t> samples = samples_;
  const auto count = static_cast<long long>(samples.size());
  const auto late = std::llround(pdu::to_seconds(row.time - begin_) * rate_) -
                    static_cast<long long>(file_->samples());
  const bool is_repeat = -late > count / 2 && std::ranges::equal(row.bytes, last_);
  last_.assign(row.bytes.begin(), row.bytes.end());
  if (is_repeat) {
    ++repeats_;
    return;
  }
  if (-late > std::llround(pdu::to_seconds(kMostAhead) * rate_)) {
    const auto left_out = static_cast<std::size_t>(std::min(-late, count));
    overlap_ += left_out;
    samples = samples.subspan(left_out);
  }
  const std::uint64_t silence = late > count / 2 ? static_cast<std::uint64_t>(late) : 0;
  if (file_->samples() + silence + samples.size() > WaveFile::kMostSamples)
    throw UsageError(
        fmt::format("frame {}: {} do not fit into a WAV file, which holds 4 GiB; cut "
                    "a part with --from and --to",
                    row.frame, time_text(file_->samples() + silence)));
  if (samples.empty()) return;
  file_->write(silence, samples);
  gaps_ += silence > 0 ? 1 : 0;
  silence_ += silence;
}

void RadioAudio::finish() {
  if (radios_.size() > 1) {
    file_.reset();
    constexpr std::size_t kMostListed = 16;
    std::string list;
    std::size_t listed = 0;
    for (auto radio = radios_.begin(); radio != radios_.end() && listed < kMostListed; ++radio)
      list += fmt::format("{}{} ({})", listed++ == 0 ? "" : ", ", radio->first.text(),
                          counted(radio->second, "PDU"));
    const Radio& first = radios_.begin()->first;
    throw UsageError(fmt::format(
        "the selection has {} radios, and a WAV file holds one: {}{}; choose one by --entity "
        "{}:{}:{}, and where an entity has several by --where 'radio_number == {}'",
        radios_.size(), list, listed < radios_.size() ? ", .." : "", first.entity.site,
        first.entity.application, first.entity.entity, first.number));
  }
  if (!file_) return;
  written_ = file_->samples();
  file_->finish();
}

std::string RadioAudio::time_text(std::uint64_t samples) const {
  return fmt::format("{:.3f} s", static_cast<double>(samples) / rate_);
}

std::string RadioAudio::summary() const {
  std::string text;
  if (empty())
    text = "no audio that can be decoded; nothing written\n";
  else
    text = fmt::format("{} of {} ({}, {} Hz, {}) written to {} ({})\n", time_text(written_),
                       radios_.begin()->first.text(), encoding_text(encoding_scheme_), rate_,
                       counted(radios_.begin()->second, "Signal PDU"), path_,
                       size_text(WaveFile::kHeader + 2 * written_));
  const auto tell = [&](std::uint64_t count, const std::string& what, const std::string& why) {
    if (count > 0) fmt::format_to(end_of(text), "{} {}\n", what, why);
  };
  tell(gaps_, time_text(silence_) + " of this is silence, in", counted(gaps_, "gap"));
  tell(repeats_, counted(repeats_, "Signal PDU"), "left out: the same PDU as before");
  tell(overlap_, time_text(overlap_), "left out: it overlaps an earlier PDU");
  for (const auto& [scheme, count] : others_)
    tell(count, counted(count, "Signal PDU"),
         fmt::format("left out: {} is not supported", encoding_text(scheme)));
  return text;
}

}  // namespace reckon::tools
