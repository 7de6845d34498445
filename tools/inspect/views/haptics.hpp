// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The view `haptics`: contact forces between haptic entities over time, from the models on the
// wire, before any receiver's gate.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "reckon/peer/counters/error_histogram.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"
#include "reckon/tools/inspect/output/format.hpp"
#include "reckon/tools/inspect/output/options.hpp"
#include "reckon/tools/inspect/output/view.hpp"
#include "reckon/tools/listener/contact_forces.hpp"
#include "reckon/tools/listener/force_history.hpp"
#include "reckon/tools/terminal/plot.hpp"

namespace reckon::tools {

/// Time course of the force of one entity's model on another entity.
struct ContactCourse {
  explicit ContactCourse(std::chrono::nanoseconds step) : history(step) {}

  std::uint64_t samples = 0;             ///< in contact
  std::uint64_t touches = 0;             ///< number of beginnings of contact
  std::uint64_t last = 0;                ///< number of the last sample in contact
  double sum = 0;                        ///< [N]
  double peak = 0;                       ///< [N]
  std::chrono::nanoseconds peak_time{};  ///< since the first datagram
  std::uint64_t updates = 0;             ///< received during contact
  peer::ErrorHistogram jumps;            ///< [N], from these updates
  ForceHistory history;

  [[nodiscard]] double mean() const {
    return samples == 0 ? 0 : sum / static_cast<double>(samples);
  }
};

class HapticsView final : public View {
 public:
  /// Limit of directed pairs whose course is kept. Samples of further pairs are written, but not in
  /// the tables.
  static constexpr std::size_t kMostContacts = 128;
  static constexpr std::chrono::nanoseconds kStep = std::chrono::milliseconds(10);

  /// @throws UsageError if options.svg cannot be written or the step is too small.
  HapticsView(const InspectOptions& options, const PlotCanvas& canvas);

  void begin(std::string& out) override;
  /// Samples up to the arrival of the next datagram, from the state before it.
  void expect(const peer::SourceDatagram& datagram) override;
  void pdu(const peer::SourceDatagram& datagram, const PduRow& row, std::chrono::nanoseconds start,
           std::string& out) override;
  void datagram(const peer::SourceDatagram& datagram, std::chrono::nanoseconds start,
                std::string& out) override;
  /// Writes pending samples when no datagram arrives.
  void tick(std::chrono::nanoseconds, const peer::SourceReport&, std::string& out) override {
    flush(out);
  }
  void finish(const InspectTally& tally, std::string& out) override;

 private:
  using Key = std::array<std::uint16_t, 6>;  // on, by
  struct Coefficients {
    pdu::EntityId id;
    std::string marking;
    deadreckon::ForceModel model;
    std::uint64_t updates = 0;
    std::chrono::nanoseconds valid_until{};
  };

  void sample(std::chrono::nanoseconds time);
  [[nodiscard]] ContactCourse* contact(const pdu::EntityId& on, const pdu::EntityId& by);
  void remember_updated();
  void flush(std::string& out);
  void append_sample(const ContactForce& force, std::chrono::nanoseconds time);
  [[nodiscard]] double seconds(std::uint64_t samples) const;
  [[nodiscard]] std::chrono::nanoseconds span() const;

  void text(std::string& out);
  void text_contacts(std::string& out) const;
  void text_entities(std::string& out) const;
  void text_left_out(std::string& out) const;
  void text_plots(std::string& out) const;
  void json(std::string& out) const;
  void write_svg() const;

  /// A curve of the plots: a contact, or two with equal forces in both directions.
  struct Curve {
    std::string name;
    const ContactCourse* course;
  };
  [[nodiscard]] std::vector<Curve> curves() const;

  Format format_;
  std::string svg_;
  std::chrono::nanoseconds step_;
  PlotCanvas canvas_;
  Listener heard_{kPeerRules};
  ContactForces forces_;
  std::map<Key, ContactCourse> contacts_;
  std::map<std::array<std::uint16_t, 3>, Coefficients> entities_;
  std::uint64_t crowded_contacts_ = 0;  // samples of contacts without room
  std::uint64_t number_ = 0;            // number of samples taken
  bool started_ = false;
  std::chrono::nanoseconds start_{};
  std::chrono::nanoseconds next_{};
  std::chrono::nanoseconds last_{};
  std::string rows_;  // samples not yet written
};

}  // namespace reckon::tools
