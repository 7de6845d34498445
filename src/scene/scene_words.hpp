// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE words of a scene file for values from a list, one table for each type. The same rows are used
// to read and to write a word.
#pragma once

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <string_view>
#include <vector>

#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/geometry/shape.hpp"
#include "reckon/peer/drivers/device_config.hpp"
#include "reckon/peer/scene_graph/graph_node.hpp"
#include "reckon/peer/settings/aoim_config.hpp"
#include "reckon/peer/settings/convergence_config.hpp"
#include "reckon/peer/settings/dead_reckoning_config.hpp"
#include "reckon/peer/settings/entity_config.hpp"
#include "reckon/peer/settings/hand_config.hpp"
#include "reckon/peer/settings/network_config.hpp"
#include "reckon/peer/settings/tier_config.hpp"

namespace reckon::peer {

/// One word and its value.
template <class T>
struct Word {
  std::string_view name;
  T value;
};

/// The words of T in the order of messages; empty for a type without words.
template <class T>
inline constexpr std::array<Word<T>, 0> kWords{};

/// Also the keys of [[operator]], exactly one of which is required.
template <>
inline constexpr auto kWords<OperatorKind> =
    std::to_array<Word<OperatorKind>>({{"trace", OperatorKind::trace},
                                       {"passive", OperatorKind::passive},
                                       {"sweep", OperatorKind::sweep}});

template <>
inline constexpr auto kWords<DeviceSource> = std::to_array<Word<DeviceSource>>(
    {{"simulated", DeviceSource::simulated}, {"pointer", DeviceSource::pointer}});

template <>
inline constexpr auto kWords<haptics::DeviceKind> =
    std::to_array<Word<haptics::DeviceKind>>({{"impedance", haptics::DeviceKind::impedance},
                                              {"admittance", haptics::DeviceKind::admittance},
                                              {"coefficients", haptics::DeviceKind::coefficients}});

template <>
inline constexpr auto kWords<haptics::MotionLoop> = std::to_array<Word<haptics::MotionLoop>>(
    {{"position", haptics::MotionLoop::position}, {"velocity", haptics::MotionLoop::velocity}});

template <>
inline constexpr auto kWords<NodeKind> =
    std::to_array<Word<NodeKind>>({{"group", NodeKind::group},
                                   {"switch", NodeKind::switch_},
                                   {"level_of_detail", NodeKind::level_of_detail}});

template <>
inline constexpr auto kWords<haptics::CsgOperation> =
    std::to_array<Word<haptics::CsgOperation>>({{"add", haptics::CsgOperation::add},
                                                {"subtract", haptics::CsgOperation::subtract},
                                                {"intersect", haptics::CsgOperation::intersect}});

template <>
inline constexpr auto kWords<aoim::CellScheme> =
    std::to_array<Word<aoim::CellScheme>>({{"square", aoim::CellScheme::square},
                                           {"hexagonal", aoim::CellScheme::hexagonal},
                                           {"quadtree", aoim::CellScheme::quad_tree},
                                           {"locales", aoim::CellScheme::locales}});

template <>
inline constexpr auto kWords<aoim::Body> =
    std::to_array<Word<aoim::Body>>({{"rigid", aoim::Body::rigid},
                                     {"approximate", aoim::Body::approximate},
                                     {"full", aoim::Body::full}});

template <>
inline constexpr auto kWords<Recipients> = std::to_array<Word<Recipients>>(
    {{"touch", Recipients::touch}, {"distance", Recipients::distance}});

template <>
inline constexpr auto kWords<Prediction> = std::to_array<Word<Prediction>>(
    {{"as_sent", Prediction::as_sent}, {"adaptive", Prediction::adaptive}});

template <>
inline constexpr auto kWords<deadreckon::AccelerationReading> =
    std::to_array<Word<deadreckon::AccelerationReading>>(
        {{"component", deadreckon::AccelerationReading::component_rate},
         {"inertial", deadreckon::AccelerationReading::inertial}});

template <>
inline constexpr auto kWords<pdu::ForceId> =
    std::to_array<Word<pdu::ForceId>>({{"other", pdu::ForceId::other},
                                       {"friendly", pdu::ForceId::friendly},
                                       {"opposing", pdu::ForceId::opposing},
                                       {"neutral", pdu::ForceId::neutral}});

template <>
inline constexpr auto kWords<pdu::ForceModelKind> = std::to_array<Word<pdu::ForceModelKind>>(
    {{"sphere", pdu::ForceModelKind::sphere},
     {"plane", pdu::ForceModelKind::plane},
     {"field", pdu::ForceModelKind::field},
     {"region", pdu::ForceModelKind::spring_damper_region}});

template <>
inline constexpr auto kWords<std::optional<pdu::DeadReckoningAlgorithm>> =
    std::to_array<Word<std::optional<pdu::DeadReckoningAlgorithm>>>({
        {"auto", std::nullopt},
        {"static", pdu::DeadReckoningAlgorithm::static_},
        {"fpw", pdu::DeadReckoningAlgorithm::fpw},
        {"rpw", pdu::DeadReckoningAlgorithm::rpw},
        {"rvw", pdu::DeadReckoningAlgorithm::rvw},
        {"fvw", pdu::DeadReckoningAlgorithm::fvw},
        {"fpb", pdu::DeadReckoningAlgorithm::fpb},
        {"rpb", pdu::DeadReckoningAlgorithm::rpb},
        {"rvb", pdu::DeadReckoningAlgorithm::rvb},
        {"fvb", pdu::DeadReckoningAlgorithm::fvb},
    });

template <>
inline constexpr auto kWords<pdu::CompressedForm> =
    std::to_array<Word<pdu::CompressedForm>>({{"none", pdu::CompressedForm::none},
                                              {"compact", pdu::CompressedForm::compact},
                                              {"residual", pdu::CompressedForm::residual}});

/// The names of a list that is defined elsewhere; `meaning` returns the value for one of its rows.
template <class T, class List, class Meaning>
constexpr auto names_as_words(const List& list, Meaning meaning) {
  std::array<Word<T>, std::tuple_size_v<List>> words{};
  std::ranges::transform(list, words.begin(), [&](const auto& row) {
    return Word<T>{row.name, meaning(row)};
  });
  return words;
}

template <>
inline constexpr auto kWords<const deadreckon::SendRule*> =
    names_as_words<const deadreckon::SendRule*>(deadreckon::kSendRules,
                                                [](const auto& row) { return &row; });

template <>
inline constexpr auto kWords<deadreckon::ConvergenceCurve> =
    names_as_words<deadreckon::ConvergenceCurve>(deadreckon::kConvergenceCurves,
                                                 [](const auto& row) { return row.curve; });

template <class T>
concept HasWords = !kWords<T>.empty();

/// "rvw", "square"; empty if the value has no word.
template <HasWords T>
[[nodiscard]] constexpr std::string_view word_of(const T& value) {
  const auto row = std::ranges::find(kWords<T>, value, &Word<T>::value);
  return row == kWords<T>.end() ? std::string_view() : row->name;
}

/// The inverse of word_of(); nothing if no value has the word.
template <HasWords T>
[[nodiscard]] constexpr std::optional<T> value_of(std::string_view word) {
  const auto row = std::ranges::find(kWords<T>, word, &Word<T>::name);
  return row == kWords<T>.end() ? std::nullopt : std::optional<T>(row->value);
}

/// All words of T, in their order.
template <HasWords T>
[[nodiscard]] std::vector<std::string_view> words_of() {
  std::vector<std::string_view> words;
  std::ranges::transform(kWords<T>, std::back_inserter(words), &Word<T>::name);
  return words;
}

}  // namespace reckon::peer
