// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/picture_sender.hpp"

#include <utility>

namespace reckon::tools {

std::shared_ptr<const std::string> PictureSender::encode(const FilledPicture& picture,
                                                         std::uint32_t number,
                                                         std::optional<std::uint16_t> own_hand,
                                                         std::chrono::nanoseconds now,
                                                         std::string& room) {
  auto octets = std::make_shared<std::string>();
  if (!difference_) {
    encode_picture(picture.rows, number, *octets);
    return octets;
  }
  const bool whole = std::exchange(needs_whole_, false) || now >= next_whole_;
  if (whole) next_whole_ = now + kWholeEvery;
  *octets = difference_->encode(picture.rows, picture.entities, {number, own_hand, whole}, room);
  return octets;
}

}  // namespace reckon::tools
