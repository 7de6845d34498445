// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entity States in each compressed form: their cost (the CPU column, one iteration = one update),
// their remaining octets, and the error of receivers when some are lost. Recorded cars, ships and
// pedestrians if RECKON_DATA has them; also generated vehicles, some of them over so long a time
// that keys are rare.
#include <benchmark/benchmark.h>
#include <zdict.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>

#include "reckon/bench/micro/movers.hpp"
#include "reckon/bench/micro/octet_difference.hpp"
#include "reckon/bench/statistics/quantile.hpp"
#include "reckon/deadreckon/residual/residual_state.hpp"
#include "reckon/pdu/compression/compact_state.hpp"

namespace {

using namespace reckon;
using bench::SentState;

constexpr std::size_t kPlain = 144, kMost = 300;
constexpr std::uint32_t kLater = 3000;  // PDU around a body: 2.5 ms after the state
using Octets = std::vector<std::byte>;

// Octets of one body with its share of the PDU around the bodies: the head of 3 octets, one of
// which is in the body here, and the share of 20 octets in 1,264.
double in_company(std::size_t body) { return static_cast<double>(body + 2) * 1264.0 / 1244.0; }

/// Writes a body; a size of 0 means the plain state.
using Encoder = std::function<std::size_t(const SentState&, std::span<std::byte, 256>)>;
/// False if the state cannot be restored.
using Decoder = std::function<bool(std::size_t entity, std::span<const std::byte> body,
                                   std::uint32_t timestamp, pdu::EntityState& out)>;

struct Data {
  std::string name;
  std::vector<bench::Mover> movers;
  std::vector<SentState> sent;
};

/// One form: makes its two ends for a number of entities. `plain` is called with each plain state
/// that arrives.
struct Ends {
  Encoder encode;
  Decoder decode;
  std::function<void(std::size_t entity, const pdu::EntityState&)> plain;
};

Octets plain_octets(const pdu::EntityState& state) {
  Octets octets(kPlain);
  (void)pdu::encode(state, octets);
  return octets;
}

Ends none(const Data&) {
  return {[](const SentState&, std::span<std::byte, 256>) { return std::size_t{0}; },
          [](auto, auto, auto, auto&) { return false; }, [](auto, const auto&) {}};
}

Ends compact(const Data&) {
  return {[](const SentState& sent, std::span<std::byte, 256> out) {
            return pdu::encode_compact(sent.state, {}, out);
          },
          [](std::size_t, std::span<const std::byte> body, std::uint32_t timestamp,
             pdu::EntityState& out) { return pdu::decode_compact(body, timestamp, {}, out); },
          [](auto, const auto&) {}};
}

// The first state is plain. Then keys in the compact form follow after 1, 4, 16 updates and after
// each `most`.
struct KeyPlan {
  std::size_t most = 32, since = 0, gap = 0;
  [[nodiscard]] bool is_due() const { return since >= gap; }
  void key() {
    since = 1;
    gap = gap == 0 ? 1 : std::min(4 * gap, most);
  }
};

struct DeltaEnd {
  std::array<std::byte, kPlain> key{};
  std::uint16_t check = 0;
  KeyPlan plan{4};  // its keys are not longer than the states that depend on them

  void note(const pdu::EntityState& state) {
    (void)pdu::encode(state, key);
    check = bench::key_check(key);
  }
};

Ends delta(const Data& data) {
  auto sender = std::make_shared<std::vector<DeltaEnd>>(data.movers.size());
  auto receiver = std::make_shared<std::vector<DeltaEnd>>(data.movers.size());
  return {[sender](const SentState& sent, std::span<std::byte, 256> out) {
            DeltaEnd& end = (*sender)[sent.entity];
            if (end.plan.is_due()) {
              const bool first = end.plan.gap == 0;
              end.plan.key();
              end.note(sent.state);
              if (first) return std::size_t{0};
              out[0] = std::byte{1};
              return 1 + pdu::encode_compact(sent.state, {}, out.subspan(1));
            }
            ++end.plan.since;
            std::array<std::byte, kPlain> plain;
            (void)pdu::encode(sent.state, plain);
            out[0] = std::byte{2};
            return 1 + bench::encode_delta(end.key, end.check, plain, out.subspan(1));
          },
          [receiver](std::size_t entity, std::span<const std::byte> body, std::uint32_t timestamp,
                     pdu::EntityState& out) {
            DeltaEnd& end = (*receiver)[entity];
            const bool whole = body[0] == std::byte{1};
            body = body.subspan(1);
            if (whole) {
              const bool good = pdu::decode_compact(body, timestamp, {}, out);
              if (good) end.note(out);
              return good;
            }
            std::array<std::byte, kPlain> plain;
            return end.check == bench::key_of_delta(body) &&
                   bench::decode_delta(end.key, body, plain) &&
                   pdu::decode(plain, out) == pdu::DecodeError::none;
          },
          [receiver](std::size_t entity, const pdu::EntityState& state) {
            (*receiver)[entity].note(state);
          }};
}

Ends residual(const Data& data) {
  auto sender = std::make_shared<std::vector<deadreckon::ResidualEncoder>>(data.movers.size());
  auto receiver = std::make_shared<std::vector<deadreckon::ResidualDecoder>>(data.movers.size());
  auto plans = std::make_shared<std::vector<KeyPlan>>(data.movers.size());
  return {[sender, plans](const SentState& sent, std::span<std::byte, 256> out) {
            auto& end = (*sender)[sent.entity];
            KeyPlan& plan = (*plans)[sent.entity];
            std::size_t size = 0;
            out[0] = std::byte{2};
            if (!plan.is_due()) {
              ++plan.since;
              size = end.encode(sent.state, out.subspan<1, deadreckon::kMostResidual>());
            }
            if (size != 0) return 1 + size;
            const bool first = plan.gap == 0;
            plan.key();
            (void)end.note_key(sent.state);
            if (first) return size;
            out[0] = std::byte{1};
            return 1 + pdu::encode_compact(sent.state, {}, out.subspan(1));
          },
          [receiver](std::size_t entity, std::span<const std::byte> body, std::uint32_t timestamp,
                     pdu::EntityState& out) {
            auto& end = (*receiver)[entity];
            const bool whole = body[0] == std::byte{1};
            if (!whole) {
              return end.decode(body.subspan(1), timestamp, out) ==
                     deadreckon::ResidualVerdict::good;
            }
            const bool good = pdu::decode_compact(body.subspan(1), timestamp, {}, out);
            if (good) end.note_plain(out);
            return good;
          },
          [receiver](std::size_t entity, const pdu::EntityState& state) {
            (*receiver)[entity].note_plain(state);
          }};
}

/// zstd with a dictionary trained on the first quarter: for comparison.
Ends dictionary(const Data& data) {
  Octets samples;
  std::vector<std::size_t> sizes;
  for (std::size_t i = 0; i < data.sent.size() / 4; ++i) {
    const Octets one = plain_octets(data.sent[i].state);
    samples.insert(samples.end(), one.begin(), one.end());
    sizes.push_back(kPlain);
  }
  auto trained = std::make_shared<Octets>(16 * 1024);
  const std::size_t size = ZDICT_trainFromBuffer(trained->data(), trained->size(), samples.data(),
                                                 sizes.data(), static_cast<unsigned>(sizes.size()));
  trained->resize(ZDICT_isError(size) ? 0 : size);
  const std::shared_ptr<ZSTD_CCtx> out_context(ZSTD_createCCtx(), ZSTD_freeCCtx);
  const std::shared_ptr<ZSTD_DCtx> in_context(ZSTD_createDCtx(), ZSTD_freeDCtx);
  const std::shared_ptr<ZSTD_CDict> out_words(ZSTD_createCDict(trained->data(), trained->size(), 1),
                                              ZSTD_freeCDict);
  const std::shared_ptr<ZSTD_DDict> in_words(ZSTD_createDDict(trained->data(), trained->size()),
                                             ZSTD_freeDDict);
  return {[=](const SentState& sent, std::span<std::byte, 256> out) {
            std::array<std::byte, kPlain> plain;
            (void)pdu::encode(sent.state, plain);
            const std::size_t made = ZSTD_compress_usingCDict(
                out_context.get(), out.data(), out.size(), plain.data(), kPlain, out_words.get());
            return ZSTD_isError(made) ? std::size_t{0} : made;
          },
          [=](std::size_t, std::span<const std::byte> body, std::uint32_t, pdu::EntityState& out) {
            std::array<std::byte, kPlain> plain;
            const std::size_t made = ZSTD_decompress_usingDDict(
                in_context.get(), plain.data(), kPlain, body.data(), body.size(), in_words.get());
            return made == kPlain && pdu::decode(plain, out) == pdu::DecodeError::none;
          },
          [](auto, const auto&) {}};
}

using MakeEnds = Ends (*)(const Data&);

struct Wire {
  std::vector<Octets> bodies;  // of the updates; empty: plain
  double octets = 0.0;
};

Wire encode_all(const Data& data, const Ends& ends) {
  Wire wire;
  std::array<std::byte, 256> out;
  for (const SentState& sent : data.sent) {
    const std::size_t size = ends.encode(sent, out);
    wire.bodies.emplace_back(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(size));
    wire.octets += size == 0 ? static_cast<double>(kPlain) : in_company(size);
  }
  return wire;
}

/// The state of one receiver: the model of the last state of each entity.
struct Shown {
  struct Model {
    deadreckon::KinematicState state;
    double time = 0.0;
    bool known = false;
  };
  std::vector<Model> models;
  explicit Shown(std::size_t entities) : models(entities) {}

  void take(std::size_t entity, double time, const pdu::EntityState& state) {
    Model& model = models[entity];
    model.known |= deadreckon::from_wire(state, bench::town(), model.state) ==
                   deadreckon::ConversionError::none;
    model.time = time;
  }
  [[nodiscard]] double error(std::size_t entity, double time, const Eigen::Vector3d& truth) const {
    const Model& model = models[entity];
    return (deadreckon::extrapolate(model.state, time - model.time).position - truth).norm();
  }
};

/// Errors just before each update that was sent, for receivers that get all updates but the lost
/// ones.
struct Run {
  double p99 = 0.0, plain_p99 = 0.0;  // [m]
  double rounding = 0.0;              // [m], greatest rounding of an arrived state
  double waited = 0.0;                // share of the arrived updates that could not be restored
};

Run run(const Data& data, const Ends& ends, const Wire& wire, double loss) {
  std::mt19937_64 random(9);
  std::bernoulli_distribution lost(loss);
  Shown form(data.movers.size()), plain(data.movers.size());
  std::vector<double> errors, plain_errors;
  Run result;
  double arrived = 0.0;
  for (std::size_t i = 0; i < data.sent.size(); ++i) {
    const SentState& sent = data.sent[i];
    const Eigen::Vector3d truth = data.movers[sent.entity].at(sent.time).position;
    if (form.models[sent.entity].known && plain.models[sent.entity].known) {
      errors.push_back(form.error(sent.entity, sent.time, truth));
      plain_errors.push_back(plain.error(sent.entity, sent.time, truth));
    }
    if (lost(random)) continue;
    arrived += 1.0;
    plain.take(sent.entity, sent.time, sent.state);
    pdu::EntityState restored = sent.state;
    restored.location = {};
    if (wire.bodies[i].empty()) {
      restored = sent.state;
      ends.plain(sent.entity, restored);
    } else if (!ends.decode(sent.entity, wire.bodies[i], sent.state.header.timestamp + kLater,
                            restored)) {
      result.waited += 1.0;
      continue;
    }
    form.take(sent.entity, sent.time, restored);
    const auto& a = restored.location;
    const auto& b = sent.state.location;
    result.rounding =
        std::max(result.rounding, Eigen::Vector3d(a.x - b.x, a.y - b.y, a.z - b.z).norm());
  }
  result.waited /= std::max(1.0, arrived);
  result.p99 = bench::quantile(errors, 0.99);
  result.plain_p99 = bench::quantile(plain_errors, 0.99);
  return result;
}

void encode(benchmark::State& state, const Data& data, MakeEnds make) {
  const Wire wire = encode_all(data, make(data));
  std::array<std::byte, 256> out;
  std::optional<Ends> ends;
  std::size_t i = data.sent.size();
  for (auto _ : state) {
    if (i == data.sent.size()) {
      state.PauseTiming();
      ends = make(data);
      i = 0;
      state.ResumeTiming();
    }
    benchmark::DoNotOptimize(ends->encode(data.sent[i++], out));
  }
  const auto updates = static_cast<double>(data.sent.size());
  state.counters["octets"] = wire.octets / updates;
  state.counters["ratio"] = kPlain * updates / wire.octets;
}

void decode(benchmark::State& state, const Data& data, MakeEnds make, double loss) {
  const Ends ends = make(data);
  const Wire wire = encode_all(data, ends);
  const Run result = run(data, make(data), wire, loss);
  std::optional<Ends> timed;
  std::size_t i = data.sent.size();
  pdu::EntityState restored;
  for (auto _ : state) {
    if (i == data.sent.size()) {
      state.PauseTiming();
      timed = make(data);
      i = 0;
      state.ResumeTiming();
    }
    const SentState& sent = data.sent[i];
    if (wire.bodies[i].empty()) {
      timed->plain(sent.entity, sent.state);
    } else {
      benchmark::DoNotOptimize(timed->decode(sent.entity, wire.bodies[i],
                                             sent.state.header.timestamp + kLater, restored));
    }
    ++i;
  }
  state.counters["p99_m"] = result.p99;
  state.counters["plain_p99_m"] = result.plain_p99;
  state.counters["most_rounding_m"] = result.rounding;
  state.counters["waited_share"] = result.waited;
}

std::vector<Data> all_data() {
  std::vector<Data> data;
  const char* set = std::getenv("RECKON_DATA");
  const std::string folder = (set == nullptr ? std::string() : std::string(set)) + "/trajectories";
  if (std::filesystem::exists(folder)) {
    data.push_back({"cars", bench::cars(folder, kMost), {}});
    data.push_back({"ships", bench::ships(folder, kMost), {}});
    data.push_back({"pedestrians", bench::pedestrians(folder, kMost), {}});
  } else {
    std::fputs("no recorded movers: set RECKON_DATA to the folder that holds trajectories/\n",
               stderr);
  }
  data.push_back({"made", bench::made(kMost), {}});
  constexpr double kLong = 400.0;  // [s]
  data.push_back({"long", bench::made(30, kLong), {}});
  for (Data& one : data)
    one.sent = bench::sent_states(one.movers, 1.0, one.name == "long" ? kLong : 120.0);
  return data;
}

const bool kRegistered = [] {
  static const std::vector<Data> kData = all_data();
  constexpr std::array<std::pair<const char*, MakeEnds>, 5> kForms = {
      {{"none", none},
       {"compact", compact},
       {"octets that differ", delta},
       {"residual", residual},
       {"dictionary", dictionary}}};
  for (const auto& [form, make] : kForms) {
    for (const Data& data : kData) {
      const std::string name = std::string(form) + "/" + data.name;
      benchmark::RegisterBenchmark(("encode/" + name).c_str(), encode, data, make);
      for (const int loss : {0, 1, 5, 20}) {
        benchmark::RegisterBenchmark(("decode/" + name + "/loss:" + std::to_string(loss)).c_str(),
                                     decode, data, make, loss / 100.0);
      }
    }
  }
  return true;
}();

}  // namespace
