// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/python/federates/bind_federates.hpp"

#include <pybind11/stl.h>

#include "reckon/python/federates/session.hpp"
#include "reckon/python/records/codec_calls.hpp"
#include "reckon/python/scenes/program_effects.hpp"

namespace reckon::python {
namespace py = pybind11;
namespace {

/// As Python has IDs: (site, application, entity).
template <std::size_t n, typename T>
py::tuple tuple_of(const std::array<T, n>& values) {
  py::tuple made(n);
  for (std::size_t i = 0; i < n; ++i) made[i] = py::cast(values[i]);
  return made;
}

/// Octets of the network as text, each a character.
py::str text_of(const std::string& octets) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeLatin1(octets.data(), static_cast<py::ssize_t>(octets.size()), nullptr));
}

void bind_seen(py::module_& module) {
  py::class_<Seen>(module, "RemoteEntity")
      .def_property_readonly("id", [](const Seen& seen) { return tuple_of(seen.id); })
      .def_readonly("type", &Seen::type)
      .def_property_readonly("marking", [](const Seen& seen) { return text_of(seen.marking); })
      .def_readonly("force_id", &Seen::force_id)
      .def_readonly("appearance", &Seen::appearance)
      .def_property_readonly("position", [](const Seen& seen) { return tuple_of(seen.position); })
      .def_property_readonly("velocity", [](const Seen& seen) { return tuple_of(seen.velocity); })
      .def_property_readonly("orientation",
                             [](const Seen& seen) { return tuple_of(seen.orientation); })
      .def_readonly("age", &Seen::age)
      .def("__repr__", [](const Seen& seen) {
        return "RemoteEntity(id=" + py::repr(tuple_of(seen.id)).cast<std::string>() +
               ", marking=" + py::repr(text_of(seen.marking)).cast<std::string>() + ")";
      });
}

std::unique_ptr<Session> join(const std::string& scene, unsigned exercise, double latitude,
                              double longitude, const std::string& interface,
                              const std::string& name, std::optional<std::uint16_t> site,
                              std::optional<std::uint16_t> application, const py::object& effects) {
  if (exercise > 0xFF) throw py::value_error("exercise must be 0 to 255");
  return std::make_unique<Session>(JoinOptions{scene, static_cast<std::uint8_t>(exercise), latitude,
                                               longitude, interface, name, site, application,
                                               effects_of(effects)});
}

}  // namespace

void bind_federates(py::module_& module) {
  bind_seen(module);
  using Id = std::array<std::uint16_t, 3>;
  const auto motion = [](const Triple& position, const Triple& velocity, const Triple& acceleration,
                         const Quadruple& orientation, const Triple& angular_velocity) {
    return Motion{position, velocity, acceleration, orientation, angular_velocity};
  };
  py::class_<Motion>(module, "Motion").def(py::init(motion));
  py::class_<Session>(module, "Session")
      .def(py::init(&join))
      .def("resign", &Session::resign)
      .def("is_joined", &Session::is_joined)
      .def("own", &Session::own)
      .def("move", &Session::move)
      .def("set_appearance", &Session::set_appearance)
      .def("remove", &Session::remove)
      .def("id_of",
           [](Session& session, std::uint16_t entity) { return tuple_of(session.id_of(entity)); })
      .def("on_discover", &Session::on_discover)
      .def("on_update", &Session::on_update)
      .def("on_remove", &Session::on_remove)
      .def("on_interaction", &Session::on_interaction)
      .def("send", [](Session& session, const py::object& pdu) { session.send(encode_pdu(pdu)); })
      .def("tick", &Session::tick)
      .def("entities", &Session::entities)
      .def("find", [](Session& session, const Id& id) { return session.find(id); })
      .def("utc", &Session::utc)
      .def("position",
           [](Session& session, double latitude, double longitude, double height) {
             return tuple_of(session.position(latitude, longitude, height));
           })
      .def("world", [](Session& session, const Triple& at) { return tuple_of(session.world(at)); });
}

}  // namespace reckon::python
