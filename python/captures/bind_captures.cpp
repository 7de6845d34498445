// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/python/captures/bind_captures.hpp"

#include <memory>
#include <string>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/capture/capture_file.hpp"
#include "reckon/python/captures/arrays.hpp"
#include "reckon/python/captures/state_columns.hpp"
#include "reckon/python/records/codec_calls.hpp"

namespace reckon::python {
namespace py = pybind11;
namespace {

/// 11 characters a row as an array of dtype S11: numpy shows each text up to the first NUL.
py::array markings(std::vector<char>&& text) {
  const py::array octets = array_of(std::move(text));
  return octets.attr("view")("S11");
}

py::dict columns_of(const std::string& path) {
  StateColumns columns;
  {
    const py::gil_scoped_release others_run;
    columns = read_state_columns(path);
  }
  py::dict all;
  all["time"] = array_of(std::move(columns.time));
  all["frame"] = array_of(std::move(columns.frame));
  all["exercise_id"] = array_of(std::move(columns.exercise_id));
  all["timestamp"] = array_of(std::move(columns.timestamp));
  all["entity_id"] = array_of(std::move(columns.entity_id), 3);
  all["force_id"] = array_of(std::move(columns.force_id));
  all["entity_type"] = array_of(std::move(columns.entity_type), 7);
  all["location"] = array_of(std::move(columns.location), 3);
  all["orientation"] = array_of(std::move(columns.orientation), 3);
  all["linear_velocity"] = array_of(std::move(columns.linear_velocity), 3);
  all["linear_acceleration"] = array_of(std::move(columns.linear_acceleration), 3);
  all["angular_velocity"] = array_of(std::move(columns.angular_velocity), 3);
  all["dead_reckoning_algorithm"] = array_of(std::move(columns.algorithm));
  all["appearance"] = array_of(std::move(columns.appearance));
  all["marking"] = markings(std::move(columns.marking));
  all["pdus"] = columns.pdus;
  all["damaged"] = columns.damaged;
  all["problem"] = columns.problem;
  return all;
}

/// A capture that is read datagram by datagram.
class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path), source_(peer::open_capture(path)) {}

  /// (frame, time [s], source, destination, octets), or None at the end.
  py::object next() {
    peer::SourceDatagram datagram;
    peer::SourceEvent event;
    {
      const py::gil_scoped_release others_run;
      event = source_->next(datagram, std::chrono::nanoseconds(0));
    }
    if (event != peer::SourceEvent::datagram) return py::none();
    return py::make_tuple(
        datagram.frame, pdu::to_seconds(datagram.time), datagram.source.text(),
        datagram.group.text(),
        py::bytes(reinterpret_cast<const char*>(datagram.bytes.data()), datagram.bytes.size()));
  }
  [[nodiscard]] std::string problem() const { return source_->report().problem; }
  /// Decodes the PDUs of a datagram of this capture; messages contain its path and frame.
  [[nodiscard]] py::list decode(std::uint64_t frame, const py::object& octets) const {
    return decode_datagram(OctetBuffer(octets).octets(),
                           path_ + ", frame " + std::to_string(frame) + ", ");
  }

 private:
  std::string path_;
  std::unique_ptr<peer::DatagramSource> source_;
};

}  // namespace

void bind_captures(py::module_& module) {
  module.def("columns_of", columns_of);
  py::class_<Reader>(module, "Reader")
      .def(py::init<const std::string&>())
      .def("next", &Reader::next)
      .def("problem", &Reader::problem)
      .def("decode", &Reader::decode);
}

}  // namespace reckon::python
