// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/captures/exercise_map.hpp"

#include <fmt/format.h>

#include <numeric>
#include <string_view>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/entity/entity_state_update.hpp"
#include "reckon/pdu/zero_length.hpp"
#include "reckon/tools/captures/number_list.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

constexpr std::size_t kExerciseAt = 1;  // in the header
constexpr std::size_t kMostEntities = std::size_t{1} << 16;

std::string line_of(std::uint64_t count, std::string_view what) {
  return count == 0 ? std::string() : fmt::format("{} {}\n", counted(count, "PDU"), what);
}

}  // namespace

void ExerciseMapOptions::declare(CommandLine& line) {
  line.option("--map-exercise", exercises,
              "send exercise FROM as TO: 1=7; or all exercises as one: 7; repeatable");
  line.option("--map-id", ids,
              "replace entity IDs wherever PDUs name them: 1:2:*=9:2:*; a rule for all entities of "
              "a simulation applies to its address too; the first match applies; repeatable");
  line.option("--map-place", place,
              "move the exercise: 48.14,11.58=34.05,-118.24, latitude,longitude[,height] in "
              "degrees and metres; without FROM=, its first position moves there");
}

ExerciseMap::ExerciseMap(const ExerciseMapOptions& options, bool lenient)
    : lenient_(lenient), ids_(options.ids) {
  std::iota(exercise_.begin(), exercise_.end(), std::uint8_t{0});
  for (const std::string& text : options.exercises) parse_exercise(text);
  if (options.place.empty()) return;
  request_.emplace(options.place);
  shift_ = request_->shift();
}

void ExerciseMap::parse_exercise(const std::string& text) {
  const auto words = parts_of(text, '=');
  const auto to = number_of<std::uint8_t>(words.back());
  const auto from = number_of<std::uint8_t>(words.front());
  if (words.size() > 2 || !to.has_value() || !from.has_value())
    throw UsageError(fmt::format(
        "--map-exercise {}: write FROM=TO, each 0 to 255, for example 1=7; or 7 for all", text));
  if (words.size() == 1)
    exercise_.fill(*to);
  else
    exercise_[*from] = *to;
  maps_exercise_ = true;
}

void ExerciseMap::apply(std::span<std::byte> datagram) {
  const auto without_length = lenient_ ? pdu::find_zero_length(datagram) : std::nullopt;
  if (!without_length.has_value()) return apply_to_all(datagram);
  pdu::set_length(datagram, *without_length,
                  static_cast<std::uint16_t>(datagram.size() - *without_length));
  apply_to_all(datagram);
  pdu::set_length(datagram, *without_length, 0);
}

void ExerciseMap::apply_to_all(std::span<std::byte> datagram) {
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
    const auto octets = datagram.subspan(bundled.offset, bundled.bytes.size());
    if (bundled.error == pdu::DecodeError::none)
      apply_to_pdu(octets, bundled.header);
    else
      ++counts_.broken;
    const bool has_header = octets.size() >= pdu::kHeaderSize &&
                            bundled.error != pdu::DecodeError::stray &&
                            pdu::is_supported_version(bundled.header.protocol_version);
    if (has_header) octets[kExerciseAt] = std::byte{exercise_[bundled.header.exercise_id]};
  }
}

void ExerciseMap::apply_to_pdu(std::span<std::byte> octets, const pdu::PduHeader& header) {
  if (request_.has_value() && !shift_.has_value()) {
    if (const auto place = first_place(octets, header)) shift_ = request_->shift_from(*place);
  }
  const PlaceShift* shift = shift_.has_value() ? &*shift_ : nullptr;
  const bool body_axes = shift != nullptr && has_body_axes(octets, header);
  count(map_pdu(octets, header, ids_, shift, body_axes));
}

void ExerciseMap::count(const MappedPdu& done) {
  if (done.error == pdu::DecodeError::unknown_type)
    ++counts_.untabled;
  else if (done.error != pdu::DecodeError::none)
    ++counts_.broken;
  if (done.error != pdu::DecodeError::none) return;
  ++counts_.mapped;
  counts_.octets += done.has_octets ? 1 : 0;
  counts_.places += done.kept_place && request_.has_value() ? 1 : 0;
  counts_.ids += done.kept_id ? 1 : 0;
}

// An Entity State Update uses the axes of the last Entity State.
bool ExerciseMap::has_body_axes(std::span<const std::byte> octets, const pdu::PduHeader& header) {
  pdu::EntityState state;
  pdu::EntityStateUpdate update;
  if (header.pdu_type == pdu::PduType::entity_state &&
      decode(octets, state) == pdu::DecodeError::none) {
    const bool body = deadreckon::drm_terms(state.dead_reckoning.algorithm).body_axes;
    const std::uint64_t key = state.entity_id.key();
    if (body_axes_.size() < kMostEntities || body_axes_.contains(key)) body_axes_[key] = body;
    return body;
  }
  if (header.pdu_type != pdu::PduType::entity_state_update ||
      decode(octets, update) != pdu::DecodeError::none)
    return false;
  const auto known = body_axes_.find(update.entity_id.key());
  return known != body_axes_.end() && known->second;
}

std::string ExerciseMap::summary() const {
  if (!is_active()) return "";
  std::string text = fmt::format("{} mapped\n", counted(counts_.mapped, "PDU"));
  if (request_.has_value() && !shift_.has_value())
    text += "no PDU has a location: none was moved\n";
  text += line_of(counts_.broken, "not mapped: damaged, sealed or not DIS");
  if (ids_.empty() && !request_.has_value()) return text;
  text += line_of(counts_.untabled,
                  "of types without a field table: their IDs and locations are unchanged");
  text += line_of(counts_.octets,
                  "with vendor records, datums or signals: their contents are unchanged");
  text += line_of(counts_.places,
                  "with locations that cannot be moved: live entities, grids, compressed states");
  text += line_of(counts_.ids, "with an ID of 8 bits that is too small for the new one");
  return text;
}

}  // namespace reckon::tools
