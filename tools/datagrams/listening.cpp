// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/listening.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "reckon/pdu/codec/pdu_header.hpp"
#include "reckon/peer/network/bound_endpoints.hpp"
#include "reckon/peer/sealing/envelope.hpp"
#include "reckon/peer/sealing/sealed_link.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using peer::IpEndpoint;
using Places = std::vector<IpEndpoint>;

/// "lo", "lo and eth0", "lo, eth0 and wlan0".
std::string listed(const std::vector<peer::ListenedInterface>& interfaces) {
  std::string text;
  for (std::size_t i = 0; i < interfaces.size(); ++i) {
    if (i > 0) text += i + 1 == interfaces.size() ? " and " : ", ";
    text += interfaces[i].name;
  }
  return text.empty() ? "no interface" : text;
}

bool holds(const Places& places, const IpEndpoint& place) {
  return std::find(places.begin(), places.end(), place) != places.end();
}

/// Whether the datagram begins like a PDU: a DIS version, and a plausible length.
bool begins_with_pdu(std::span<const std::byte> bytes) {
  pdu::PduHeader header;
  return decode_header(bytes, header) == pdu::DecodeError::none && header.length <= bytes.size();
}

}  // namespace

std::string listening_text(const SourceChoice& choice, const peer::SourceReport& report) {
  if (!means_groups(choice)) {
    return is_live(choice) ? "all UDP of " + choice.source.substr(choice.source.find(':') + 1)
                           : choice.source;
  }
  const Places groups = groups_of(choice);
  std::string text = groups.front().text();
  if (groups.size() > 1) text += fmt::format(" and the {} groups after it", groups.size() - 1);
  return text + " on " + listed(report.interfaces);
}

std::string heard_text(const peer::SourceReport& report) {
  std::string text;
  for (const peer::ListenedInterface& interface : report.interfaces) {
    text +=
        fmt::format("{}{}: {}", text.empty() ? "received on " : ", ", interface.name,
                    interface.datagrams == 0 ? "none" : counted(interface.datagrams, "datagram"));
  }
  if (report.copies > 0)
    text +=
        fmt::format("; {} also arrived on another interface", counted(report.copies, "datagram"));
  if (!text.empty()) text += '\n';
  for (const std::string& sentence : report.unheard) text += sentence + '\n';
  return text;
}

Places other_places(const Places& own, bool own_too, const Places& bound, std::size_t most) {
  Places out;
  const auto add = [&](const IpEndpoint& place) {
    const bool is_new = !holds(out, place) && (own_too || !holds(own, place));
    if (is_new && out.size() < most) out.push_back(place);
  };
  const IpEndpoint& first = own.front();
  if (own_too) add(first);
  if (first.is_multicast() && first.port < std::numeric_limits<std::uint16_t>::max())
    add(peer::sealed_group(first));
  // Peers that send in the groups after a base also announce themselves in the base group.
  const peer::GroupPool plain =
      first.is_v6 ? peer::GroupPool::ipv6_default() : peer::GroupPool::ipv4_default();
  const peer::GroupPool sealed(peer::sealed_group(plain.base()), plain.size());
  const auto is_behind = [&](const IpEndpoint& place) {
    return plain.index(place).has_value() || sealed.index(place).has_value();
  };
  const IpEndpoint& base = plain.base();
  add(base);
  add(sealed.base());
  if (!first.is_v6) {
    add(IpEndpoint::v4(0xffffffffu, first.port));
    add(IpEndpoint::v4(0xffffffffu, base.port));
  }
  for (const IpEndpoint& place : bound)
    if ((place.is_multicast() || place.is_broadcast()) && !holds(own, place) && !is_behind(place))
      add(place);
  return out;
}

std::vector<std::string> SilenceWatch::look(const peer::SourceReport& report, nanoseconds now) {
  std::vector<std::string> out;
  if (over_) return out;
  if (report.datagrams > 0) {
    over_ = true;
    elsewhere_.reset();
    return out;
  }
  if (now - start_ < kPatience) return out;
  if (!begun_) begin(report, out);
  if (elsewhere_) listen(out);
  if (now - start_ < kPatience + kTried && stated_.size() < kMostStated) return out;
  over_ = true;
  if (stated_.empty() && elsewhere_)
    out.push_back(
        fmt::format("no DIS at {} other addresses of this host either (broadcast, groups of its "
                    "programs): start the sender, and check firewalls (`reckon doctor`)",
                    places_.size()));
  elsewhere_.reset();
  return out;
}

void SilenceWatch::begin(const peer::SourceReport& report, std::vector<std::string>& out) {
  begun_ = true;
  out.push_back("nothing received yet at " + listening_text(choice_, report));
  own_ = groups_of(choice_);
  const bool leaves_interfaces_out = !choice_.interface.empty() || report.interfaces.size() == 1;
  places_ = other_places(own_, leaves_interfaces_out, peer::bound_endpoints(own_.front().is_v6),
                         kMostPlaces);
  try {
    elsewhere_ = peer::open_groups({.interface = {}, .groups = places_, .skips_failures = true});
  } catch (const std::runtime_error&) {
    over_ = true;  // no interface at all: the source has reported it
  }
}

std::string SilenceWatch::remedy_for(const peer::SourceDatagram& datagram) const {
  return holds(own_, datagram.group)
             ? fmt::format("write --iface {}, or remove it", datagram.interface)
             : fmt::format("write udp://{} as the source", datagram.group.text());
}

void SilenceWatch::listen(std::vector<std::string>& out) {
  constexpr int kMostAtOnce = 256;
  peer::SourceDatagram datagram;
  for (int i = 0; i < kMostAtOnce && stated_.size() < kMostStated; ++i) {
    if (elsewhere_->next(datagram, nanoseconds::zero()) != peer::SourceEvent::datagram) return;
    const bool is_sealed = peer::is_sealed(datagram.bytes);
    if (!is_sealed && !begins_with_pdu(datagram.bytes)) continue;
    if (holds(stated_, datagram.group)) continue;
    stated_.push_back(datagram.group);
    const std::string place = fmt::format("{} on {}, from {}", datagram.group.text(),
                                          datagram.interface, datagram.source.text());
    out.push_back(is_sealed && !choice_.sealed
                      ? fmt::format("sealed datagrams arrive on port {}; give --key FILE ({})",
                                    datagram.group.port, place)
                      : fmt::format("received by this host: {}; {}", place, remedy_for(datagram)));
  }
}

}  // namespace reckon::tools
