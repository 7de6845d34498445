// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/python/captures/state_columns.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <system_error>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/capture/capture_file.hpp"

namespace reckon::python {
namespace {

constexpr std::size_t kLeastFrame = 16 + 42 + 144;  // of a capture with one Entity State [octets]
constexpr std::size_t kLarge = 4 << 20;             // smallest size that is worth large pages
                                                    // [octets]
constexpr std::size_t kMostReserved = 16'000'000;   // rows; a greater file grows its columns

void add_vector(auto& column, const auto& v) { column.insert(column.end(), {v.x, v.y, v.z}); }

std::size_t rows_of(const std::string& path) {
  std::error_code none;
  const auto octets = std::filesystem::file_size(path, none);
  return none ? 0 : std::min<std::size_t>(octets / kLeastFrame, kMostReserved);
}

void add_datagram(const peer::SourceDatagram& datagram, StateColumns& columns) {
  pdu::EntityState state;
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram.bytes)) {
    ++columns.pdus;
    if (bundled.error != pdu::DecodeError::none) {
      ++columns.damaged;
    } else if (bundled.header.pdu_type == pdu::PduType::entity_state) {
      if (pdu::decode(bundled.bytes, state) == pdu::DecodeError::none) {
        columns.add(datagram, state);
      } else {
        ++columns.damaged;
      }
    }
  }
}

// Requests large pages from the kernel: the first access to small pages takes a third of the time.
template <typename T>
void reserve_large(std::vector<T>& column, std::size_t count) {
  column.reserve(count);
  constexpr std::uintptr_t kPage = 4096;
  const auto data = reinterpret_cast<std::uintptr_t>(column.data());
  const std::uintptr_t begin = (data + kPage - 1) / kPage * kPage;
  const std::uintptr_t end = data + count * sizeof(T);
  if (end > begin + kLarge)
    static_cast<void>(madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE));
}

}  // namespace

void StateColumns::reserve(std::size_t rows) {
  const auto all = [rows](std::size_t width, auto&... columns) {
    (reserve_large(columns, width * rows), ...);
  };
  all(1, time, frame, exercise_id, timestamp, force_id, algorithm, appearance);
  all(3, entity_id, location, orientation, linear_velocity, linear_acceleration, angular_velocity);
  all(7, entity_type);
  all(11, marking);
}

void StateColumns::add(const peer::SourceDatagram& datagram, const pdu::EntityState& state) {
  time.push_back(pdu::to_seconds(datagram.time));
  frame.push_back(datagram.frame);
  exercise_id.push_back(state.header.exercise_id);
  timestamp.push_back(state.header.timestamp);
  const pdu::EntityId& id = state.entity_id;
  entity_id.insert(entity_id.end(), {id.site, id.application, id.entity});
  force_id.push_back(static_cast<std::uint8_t>(state.force_id));
  const auto type = state.entity_type.numbers();
  entity_type.insert(entity_type.end(), type.begin(), type.end());
  add_vector(location, state.location);
  const pdu::EulerAngles& angles = state.orientation;
  orientation.insert(orientation.end(), {angles.psi, angles.theta, angles.phi});
  add_vector(linear_velocity, state.linear_velocity);
  add_vector(linear_acceleration, state.dead_reckoning.linear_acceleration);
  add_vector(angular_velocity, state.dead_reckoning.angular_velocity);
  algorithm.push_back(static_cast<std::uint8_t>(state.dead_reckoning.algorithm));
  appearance.push_back(state.appearance);
  marking.insert(marking.end(), state.marking.text.begin(), state.marking.text.end());
}

StateColumns read_state_columns(const std::string& path) {
  const auto source = peer::open_capture(path);
  StateColumns columns;
  columns.reserve(rows_of(path));
  peer::SourceDatagram datagram;
  while (source->next(datagram, std::chrono::nanoseconds(0)) == peer::SourceEvent::datagram) {
    if (datagram.portion == peer::Portion::whole) {
      add_datagram(datagram, columns);
    } else {
      ++columns.damaged;
    }
  }
  columns.problem = source->report().problem;
  return columns;
}

}  // namespace reckon::python
