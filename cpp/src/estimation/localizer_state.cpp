// A BaseLocalizer as bytes: what was measured and the belief at the beginning of the record; the
// rest is computed again, to the same bits.

#include <cstring>
#include <type_traits>

#include "thing_kin/core/error.hpp"
#include "thing_kin/estimation/base_localizer.hpp"

namespace thing_kin {

namespace {

constexpr std::uint32_t kStateMagic = 0x544B424CU;  // "LBKT" in memory
constexpr std::uint32_t kStateVersion = 1;

// Fowler, Noll & Vo: bytes that were cut or changed are refused.
std::uint64_t checksum(const char* data, std::size_t size) noexcept {
  std::uint64_t sum = 14695981039346656037ULL;
  for (std::size_t i = 0; i < size; ++i) {
    sum = (sum ^ static_cast<unsigned char>(data[i])) * 1099511628211ULL;
  }
  return sum;
}

// One function writes and reads: archive(x) appends x, or sets it.
class StateWriter {
 public:
  static constexpr bool kReads = false;
  template <typename T>
  void raw(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  std::string bytes;
};

class StateReader {
 public:
  static constexpr bool kReads = true;
  explicit StateReader(const std::string& bytes) : bytes_(bytes) {}
  template <typename T>
  void raw(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (bytes_.size() - at_ < sizeof(T)) {
      throw InvalidArgument("state", std::to_string(bytes_.size()) + " bytes", "more of them");
    }
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
  }

 private:
  const std::string& bytes_;
  std::size_t at_ = 0;
};

template <typename Archive, typename T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
void exchange(Archive& archive, T& value) {
  archive.raw(value);
}

template <typename Archive, int N, int M>
void exchange(Archive& archive, Eigen::Matrix<double, N, M>& matrix) {
  for (Eigen::Index i = 0; i < matrix.size(); ++i) {
    archive.raw(matrix.data()[i]);
  }
}

template <typename Archive>
void exchange(Archive& archive, PoseVerdict& verdict) {
  exchange(archive, verdict.accepted);
  exchange(archive, verdict.nis);
  exchange(archive, verdict.dof);
}

template <typename Archive>
void exchange(Archive& archive, NisBound& bound) {
  for (double& each : bound) {
    archive.raw(each);
  }
}

template <typename Archive>
void exchange(Archive& archive, TwistSample& s) {
  exchange(archive, s.t);
  exchange(archive, s.start);
  exchange(archive, s.first);
  exchange(archive, s.mask);
  exchange(archive, s.z);
  exchange(archive, s.R);
  exchange(archive, s.bound);
  exchange(archive, s.verdict);
}

template <typename Archive>
void exchange(Archive& archive, LocalizerMeasurement& m) {
  exchange(archive, m.kind);
  exchange(archive, m.t);
  exchange(archive, m.t_from);
  exchange(archive, m.source);
  exchange(archive, m.mask);
  exchange(archive, m.z);
  exchange(archive, m.R);
  exchange(archive, m.bound);
}

template <typename Archive>
void exchange(Archive& archive, NisStatistics& s) {
  exchange(archive, s.count);
  exchange(archive, s.sum);
  exchange(archive, s.dof);
  exchange(archive, s.within);
}

template <typename Archive>
void exchange(Archive& archive, SourceCounts& counts) {
  exchange(archive, counts.accepted);
  exchange(archive, counts.rejected);
  exchange(archive, counts.poses);
  exchange(archive, counts.twists);
}

template <typename Archive, typename T>
void exchange(Archive& archive, std::optional<T>& value) {
  bool there = value.has_value();
  exchange(archive, there);
  if (there) {
    if (!value) {
      value.emplace();
    }
    exchange(archive, *value);
  }
}

// Sequences of what exchange() knows.
template <typename Archive, typename Sequence>
void exchange_all(Archive& archive, Sequence& sequence) {
  std::uint64_t size = sequence.size();
  exchange(archive, size);
  if constexpr (Archive::kReads) {
    sequence.clear();
    for (std::uint64_t i = 0; i < size; ++i) {
      sequence.push_back({});
      exchange(archive, sequence.back());
    }
  } else {
    for (auto& each : sequence) {
      exchange(archive, each);
    }
  }
}

template <typename Archive>
void exchange(Archive& archive, LocalizerSource& source) {
  exchange_all(archive, source.name);
  exchange(archive, source.fuse);
  exchange(archive, source.covariance);
  exchange(archive, source.gate);
  exchange(archive, source.gates_twists);
  exchange(archive, source.bound);
  exchange_all(archive, source.track.samples);
  exchange(archive, source.track.held);
  exchange(archive, source.track.folded_stamp);
  exchange(archive, source.folded);
  exchange(archive, source.refused);
}

template <typename Archive>
void exchange(Archive& archive, BaseLocalizerOptions& o) {
  exchange(archive, o.pose);
  exchange(archive, o.covariance);
  exchange(archive, o.gate);
  exchange(archive, o.process_noise);
  exchange(archive, o.history);
  exchange(archive, o.t);
  exchange(archive, o.filter);
}

}  // namespace

// What stands in the state, in this order.
template <typename Archive>
void BaseLocalizer::exchange_state(Archive& archive) {
  exchange(archive, options_);
  exchange_all(archive, sources_);
  std::vector<double> belief = base_.numbers();
  exchange_all(archive, belief);
  base_ = PoseBelief::from_numbers(belief);
  exchange(archive, base_time_);
  exchange(archive, begin_);
  exchange(archive, latest_);
  exchange(archive, next_id_);
  std::uint64_t size = record_.size();
  exchange(archive, size);
  for (std::uint64_t k = 0; k < size; ++k) {
    if (k == record_.size()) {
      record_.push_back(Step{{}, 0, {}, base_});
    }
    exchange(archive, record_[k].measurement);
    exchange(archive, record_[k].id);
    exchange(archive, record_[k].verdict);
  }
}

std::string BaseLocalizer::save() const {
  StateWriter writer;
  writer.raw(kStateMagic);
  writer.raw(kStateVersion);
  BaseLocalizer copy = *this;
  copy.exchange_state(writer);
  writer.raw(checksum(writer.bytes.data(), writer.bytes.size()));
  return std::move(writer.bytes);
}

BaseLocalizer BaseLocalizer::restore(const std::string& bytes) {
  StateReader reader(bytes);
  std::uint32_t magic = 0;
  std::uint32_t version = 0;
  reader.raw(magic);
  reader.raw(version);
  if (magic != kStateMagic) {
    throw InvalidArgument("state", "other bytes", "what a BaseLocalizer saved");
  }
  if (version != kStateVersion) {
    throw InvalidArgument("state", "version " + std::to_string(version),
                          "version " + std::to_string(kStateVersion));
  }
  std::uint64_t sum = 0;
  const std::size_t size = bytes.size() < sizeof(sum) ? 0 : bytes.size() - sizeof(sum);
  std::memcpy(&sum, bytes.data() + size, bytes.size() - size);
  if (sum != checksum(bytes.data(), size)) {
    throw InvalidArgument("state", "bytes that were cut or changed", "all that was saved");
  }
  BaseLocalizer localizer{BaseLocalizerOptions{}};
  localizer.exchange_state(reader);
  localizer.sort_sources();
  if (!localizer.record_.empty()) {
    localizer.replay(0);
  }
  return localizer;
}

}  // namespace thing_kin
