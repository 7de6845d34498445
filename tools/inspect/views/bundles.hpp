// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The view `bundles`: one line per datagram with its PDUs in order.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/tools/datagrams/pdu_row.hpp"
#include "reckon/tools/inspect/output/format.hpp"
#include "reckon/tools/inspect/output/view.hpp"

namespace reckon::tools {

class BundlesView final : public View {
 public:
  explicit BundlesView(Format format) : format_(format) {}

  /// Titles of the columns, if the format has them.
  void begin(std::string& out) override;
  /// Counts one PDU of the present datagram.
  void look(const PduRow& row) override;
  /// Writes the datagram's line; `start` is the time of the first datagram.
  void datagram(const peer::SourceDatagram& datagram, std::chrono::nanoseconds start,
                std::string& out) override;
  /// Called instead of datagram() for a datagram that is not shown.
  void skip() override;

 private:
  /// Adjacent PDUs of one type.
  struct Run {
    std::string_view type;
    std::size_t count;
    std::size_t states = 0;  ///< compressed ones
    std::size_t octets = 0;  ///< of the PDUs that contain them
  };

  static void count_states(const PduRow& row, Run& run);
  [[nodiscard]] std::string types() const;
  void line(const peer::SourceDatagram& datagram, std::chrono::nanoseconds start,
            std::string& out) const;
  void json(const peer::SourceDatagram& datagram, std::string& out) const;
  void csv(const peer::SourceDatagram& datagram, std::string& out) const;
  [[nodiscard]] std::size_t padding(const peer::SourceDatagram& datagram) const;

  Format format_;
  std::vector<Run> runs_;
  std::size_t pdus_ = 0;
  std::size_t pdu_octets_ = 0;
  std::size_t broken_octets_ = 0;
  std::size_t order_broken_at_ = 0;  // PDU number, 0 = order is correct
  std::uint8_t rank_ = 0;
};

}  // namespace reckon::tools
