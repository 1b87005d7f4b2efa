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
void pass(Archive& archive, T& value) {
  archive.raw(value);
}

template <typename Archive, int N, int M>
void pass(Archive& archive, Eigen::Matrix<double, N, M>& matrix) {
  for (Eigen::Index i = 0; i < matrix.size(); ++i) {
    archive.raw(matrix.data()[i]);
  }
}

template <typename Archive>
void pass(Archive& archive, PoseVerdict& verdict) {
  pass(archive, verdict.accepted);
  pass(archive, verdict.nis);
  pass(archive, verdict.dof);
}

template <typename Archive>
void pass(Archive& archive, NisBound& bound) {
  for (double& each : bound) {
    archive.raw(each);
  }
}

template <typename Archive>
void pass(Archive& archive, TwistSample& s) {
  pass(archive, s.t);
  pass(archive, s.start);
  pass(archive, s.first);
  pass(archive, s.mask);
  pass(archive, s.z);
  pass(archive, s.R);
  pass(archive, s.bound);
  pass(archive, s.verdict);
}

template <typename Archive>
void pass(Archive& archive, LocalizerMeasurement& m) {
  pass(archive, m.kind);
  pass(archive, m.t);
  pass(archive, m.t_from);
  pass(archive, m.source);
  pass(archive, m.mask);
  pass(archive, m.z);
  pass(archive, m.R);
  pass(archive, m.bound);
}

template <typename Archive>
void pass(Archive& archive, NisStatistics& s) {
  pass(archive, s.count);
  pass(archive, s.sum);
  pass(archive, s.dof);
  pass(archive, s.within);
}

template <typename Archive>
void pass(Archive& archive, SourceCounts& counts) {
  pass(archive, counts.accepted);
  pass(archive, counts.rejected);
  pass(archive, counts.poses);
  pass(archive, counts.twists);
}

template <typename Archive, typename T>
void pass(Archive& archive, std::optional<T>& value) {
  bool there = value.has_value();
  pass(archive, there);
  if (there) {
    if (!value) {
      value.emplace();
    }
    pass(archive, *value);
  }
}

// Sequences of what pass() knows.
template <typename Archive, typename Sequence>
void pass_all(Archive& archive, Sequence& sequence) {
  std::uint64_t size = sequence.size();
  pass(archive, size);
  if constexpr (Archive::kReads) {
    sequence.clear();
    for (std::uint64_t i = 0; i < size; ++i) {
      sequence.push_back({});
      pass(archive, sequence.back());
    }
  } else {
    for (auto& each : sequence) {
      pass(archive, each);
    }
  }
}

template <typename Archive>
void pass(Archive& archive, LocalizerSource& source) {
  pass_all(archive, source.name);
  pass(archive, source.fuse);
  pass(archive, source.covariance);
  pass(archive, source.gate);
  pass(archive, source.gates_twists);
  pass(archive, source.bound);
  pass_all(archive, source.track.samples);
  pass(archive, source.track.held);
  pass(archive, source.track.folded_stamp);
  pass(archive, source.folded);
  pass(archive, source.refused);
}

template <typename Archive>
void pass(Archive& archive, BaseLocalizerOptions& o) {
  pass(archive, o.pose);
  pass(archive, o.covariance);
  pass(archive, o.gate);
  pass(archive, o.process_noise);
  pass(archive, o.history);
  pass(archive, o.t);
  pass(archive, o.filter);
}

}  // namespace

// What stands in the state, in this order.
template <typename Archive>
void BaseLocalizer::exchange_state(Archive& archive) {
  pass(archive, options_);
  pass_all(archive, sources_);
  std::vector<double> belief = base_.numbers();
  pass_all(archive, belief);
  base_ = PoseBelief::from_numbers(belief);
  pass(archive, base_time_);
  pass(archive, begin_);
  pass(archive, latest_);
  pass(archive, next_id_);
  std::uint64_t size = record_.size();
  pass(archive, size);
  for (std::uint64_t k = 0; k < size; ++k) {
    if (k == record_.size()) {
      record_.push_back(Step{{}, 0, {}, base_});
    }
    pass(archive, record_[k].measurement);
    pass(archive, record_[k].id);
    pass(archive, record_[k].verdict);
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
