// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The sound of a radio from its Signal PDUs, by their capture times.
#pragma once

#include <chrono>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/radio/signal.hpp"
#include "reckon/tools/captures/audio_encoding.hpp"
#include "reckon/tools/captures/wave_file.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"

namespace reckon::tools {

/// Writes the sound of one radio to a WAV file, which is created with the first sample. Gaps of the
/// capture become silence. Early PDUs are appended, up to kMostAhead; samples that overlap by more
/// are dropped.
class RadioAudio {
 public:
  static constexpr std::chrono::nanoseconds kMostAhead = std::chrono::milliseconds(250);
  static constexpr std::uint32_t kMostRate = 384'000;  ///< samples a second

  RadioAudio(std::string path, bool overwrite) : path_(std::move(path)), overwrite_(overwrite) {}

  /// Takes a PDU; ignores PDUs other than Signal.
  /// @throws UsageError with the frame if rate or encoding change, or the file gets too long
  void take(const PduRow& row);
  /// Completes the file. @throws UsageError with the radios and the remedy if there are several.
  void finish();

  /// Whether there was nothing to write.
  [[nodiscard]] bool empty() const noexcept { return radios_.empty(); }
  /// Sentences on what was written and left out, a line each.
  [[nodiscard]] std::string summary() const;

 private:
  struct Radio {
    pdu::EntityId entity;
    std::uint16_t number = 0;
    [[nodiscard]] std::string text() const;
    friend auto operator<=>(const Radio&, const Radio&) = default;
  };

  void check_stream(const PduRow& row, const pdu::Signal& signal);
  void place(const PduRow& row);
  [[nodiscard]] std::string time_text(std::uint64_t samples) const;

  std::string path_;
  bool overwrite_;
  std::optional<WaveFile> file_;
  std::map<Radio, std::uint64_t> radios_;          // number of their Signal PDUs
  std::map<std::uint16_t, std::uint64_t> others_;  // Signal PDUs by a scheme that is not decoded
  // Of the file.
  std::chrono::nanoseconds begin_{0};
  std::uint16_t encoding_scheme_ = 0;
  std::uint32_t rate_ = 0;
  std::uint64_t written_ = 0, gaps_ = 0, silence_ = 0, overlap_ = 0;  // samples, except gaps_
  std::uint64_t repeats_ = 0;                                         // Signal PDUs
  std::vector<std::byte> last_;                                       // the PDU before
  std::vector<std::int16_t> samples_;                                 // of the present PDU
};

}  // namespace reckon::tools
