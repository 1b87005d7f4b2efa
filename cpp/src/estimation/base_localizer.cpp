#include "thing_kin/estimation/base_localizer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "thing_kin/core/error.hpp"
#include "thing_kin/linalg/spd.hpp"

namespace thing_kin {

namespace {

using Eigen::Matrix3d;

Matrix3d checked_belief(const Matrix3d& P, const std::string& name) {
  check_covariance(P, 3, name);
  if (P.cwiseAbs().maxCoeff() > kMostVariance) {
    throw InvalidArgument(name, text(P.cwiseAbs().maxCoeff()), "variances below 1e24");
  }
  Matrix3d kept = 0.5 * (P + P.transpose());
  keep_positive(kept, 1.0);
  return kept;
}

BaseLocalizerOptions checked(BaseLocalizerOptions options) {
  check_measured(options.pose, "pose");
  options.covariance = checked_belief(options.covariance, "covariance");
  options.process_noise = checked_belief(options.process_noise, "process_noise");
  if (!(options.history > 0.0 && std::isfinite(options.history))) {
    throw InvalidArgument("history", text(options.history), "a number of seconds > 0");
  }
  if (options.t) {
    check_time(*options.t, "t");
  }
  LocalizerSource().set_gate(options.gate);
  return options;
}

}  // namespace

void check_time(double t, const std::string& name) {
  if (!(std::abs(t) <= kMostMeasured)) {
    throw InvalidArgument(name, text(t), "a time in seconds, at most 1e12 in size");
  }
}

void check_measured(const Eigen::Vector3d& v, const std::string& name) {
  if (!(v.cwiseAbs().maxCoeff() <= kMostMeasured) || !v.allFinite()) {
    throw InvalidArgument(name, "an entry that is not finite or over 1e12",
                          "finite numbers, at most 1e12 in size");
  }
}

Matrix3d check_measured_covariance(const Matrix3d& R, const std::string& name) {
  const Matrix3d kept = checked_belief(R, name);
  if (!(kept.diagonal().minCoeff() >= 1.0 / kMostVariance)) {
    throw InvalidArgument(name, "a variance of " + text(kept.diagonal().minCoeff()),
                          "a positive definite matrix, variances from 1e-24");
  }
  return kept;
}

BaseLocalizer::BaseLocalizer(const BaseLocalizerOptions& options)
    : options_(checked(options)),
      base_(options_.pose, options_.covariance),
      base_time_(options_.t),
      begin_(options_.t) {}

void BaseLocalizer::source(const std::string& name, std::uint8_t fuse,
                           const std::optional<Matrix3d>& covariance, std::optional<double> gate) {
  LocalizerSource checked_first;
  checked_first.set_gate(gate.value_or(options_.gate));
  LocalizerSource& found = sources_[static_cast<std::size_t>(find_or_declare(name))];
  found.fuse = fuse;
  found.covariance = covariance;
  found.gate = checked_first.gate;
  found.bound = checked_first.bound;
  found.gates_twists = gate.has_value();
}

int BaseLocalizer::find_or_declare(const std::string& name) {
  if (const LocalizerSource* const known = look_up(name)) {
    return static_cast<int>(known - sources_.data());
  }
  LocalizerSource fresh;
  fresh.name = name;
  fresh.set_gate(options_.gate);
  sources_.push_back(std::move(fresh));
  sort_sources();
  return static_cast<int>(sources_.size()) - 1;
}

const LocalizerSource* BaseLocalizer::look_up(const std::string& name) const noexcept {
  const auto found = std::ranges::find(sources_, name, &LocalizerSource::name);
  return found == sources_.end() ? nullptr : &*found;
}

// Sums over sources are taken by name, whichever was heard first.
void BaseLocalizer::sort_sources() {
  by_name_.resize(sources_.size());
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    by_name_[i] = static_cast<int>(i);
  }
  std::ranges::sort(by_name_, {}, [&](int i) -> const std::string& { return source_at(i).name; });
  cursors_.assign(sources_.size(), 0);
  shares_.reserve(sources_.size());
}

double BaseLocalizer::origin() const noexcept {
  return begin_ ? *begin_ : record_.front().measurement.t;
}

bool BaseLocalizer::add(const LocalizerMeasurement& measurement) {
  const bool motion = measurement.kind == MeasurementKind::kRelative;
  const double oldest = motion ? measurement.t_from : measurement.t;
  const double latest = std::max(measurement.t, latest_.value_or(measurement.t));
  LocalizerSource& from = sources_[static_cast<std::size_t>(measurement.source)];
  if (oldest < latest - options_.history || (begin_ && oldest < *begin_)) {
    ++from.refused;
    return false;
  }
  std::size_t first = 0;
  if (measurement.kind == MeasurementKind::kTwist) {
    const double affected = insert_sample(measurement);
    first = insert(measurement, 0);
    const auto after = std::ranges::upper_bound(
        record_, affected, {}, [](const Step& step) { return step.measurement.t; });
    first = std::min(first, static_cast<std::size_t>(after - record_.begin()));
  } else if (motion) {
    LocalizerMeasurement clone = measurement;
    clone.kind = MeasurementKind::kClone;
    std::swap(clone.t, clone.t_from);
    insert(measurement, next_id_);
    first = insert(clone, next_id_++);
  } else {
    first = insert(measurement, 0);
  }
  latest_ = latest;
  replay(first);
  fold();
  return true;
}

// The beginning of a motion and its end are compared like anything else, so that equal records have
// equal orders.
bool BaseLocalizer::before(const LocalizerMeasurement& a,
                           const LocalizerMeasurement& b) const noexcept {
  if (a.t != b.t || (a.kind != b.kind && (std::min(a.kind, b.kind) == MeasurementKind::kTwist ||
                                          std::max(a.kind, b.kind) == MeasurementKind::kClone))) {
    return a.t != b.t ? a.t < b.t : a.kind < b.kind;
  }
  if (a.source != b.source) {
    return source_at(a.source).name < source_at(b.source).name;
  }
  if (a.kind != b.kind || a.t_from != b.t_from) {
    return a.kind != b.kind ? a.kind < b.kind : a.t_from < b.t_from;
  }
  if (a.z != b.z) {
    return std::lexicographical_compare(a.z.data(), a.z.data() + 3, b.z.data(), b.z.data() + 3);
  }
  if (a.R != b.R) {
    return std::lexicographical_compare(a.R.data(), a.R.data() + 9, b.R.data(), b.R.data() + 9);
  }
  return a.mask < b.mask;
}

std::size_t BaseLocalizer::insert(const LocalizerMeasurement& measurement, std::uint64_t id) {
  auto place = record_.end();
  while (place != record_.begin() && before(measurement, (place - 1)->measurement)) {
    --place;
  }
  const auto index = static_cast<std::size_t>(place - record_.begin());
  record_.insert(place, Step{measurement, id, {true, 0.0, 0}, base_});
  return index;
}

// The time of the last measurement before t; -infinity if there is none.
double BaseLocalizer::time_before(double t) const noexcept {
  const auto place =
      std::ranges::lower_bound(record_, t, {}, [](const Step& step) { return step.measurement.t; });
  if (place != record_.begin()) {
    return (place - 1)->measurement.t;
  }
  return base_time_ && *base_time_ < t ? *base_time_ : -std::numeric_limits<double>::infinity();
}

// Where the sample stands for the motion, it and the next one; returns the time after which that
// changes something.
double BaseLocalizer::insert_sample(const LocalizerMeasurement& m) {
  TwistTrack& track = sources_[static_cast<std::size_t>(m.source)].track;
  auto place = track.samples.end();
  const auto later = [&](const TwistSample& s) {
    LocalizerMeasurement other = m;
    other.t = s.t;
    other.z = s.z;
    other.R = s.R;
    other.mask = s.mask;
    return before(m, other);
  };
  while (place != track.samples.begin() && later(*(place - 1))) {
    --place;
  }
  const auto index = static_cast<std::size_t>(place - track.samples.begin());
  track.samples.insert(place,
                       TwistSample{m.t, 0.0, false, m.mask, m.z, m.R, m.bound, {true, 0.0, 0}});
  // Beyond the history nothing is computed again: there a sample reaches back to the last time that
  // anything was measured.
  const auto begins = [&](std::size_t k) {
    TwistSample& sample = track.samples[k];
    const std::optional<double> previous =
        k > 0 ? std::optional(track.samples[k - 1].t) : track.folded_stamp;
    const double reach = sample.t - options_.history;
    sample.first = !previous;
    sample.start = previous && *previous >= reach ? *previous : time_before(reach);
    sample.start = previous ? std::max(*previous, sample.start) : sample.start;
    return sample.start;
  };
  double affected = begins(index);
  if (index + 1 < track.samples.size()) {
    affected = std::min({affected, track.samples[index + 1].start, begins(index + 1)});
  }
  return affected;
}

void BaseLocalizer::fold() {
  const double keep = *latest_ - 2.0 * options_.history;
  while (!record_.empty() && record_.front().measurement.t < keep) {
    Step& step = record_.front();
    const LocalizerMeasurement& m = step.measurement;
    LocalizerSource& from = sources_[static_cast<std::size_t>(m.source)];
    if (!begin_) {
      begin_ = m.t;
    }
    if (m.kind == MeasurementKind::kTwist) {
      TwistSample& sample = from.track.samples.front();
      sample.start = std::max(sample.start, *begin_);
      from.folded.add(sample.verdict, true);
      from.track.folded_stamp = sample.t;
      if (sample.verdict.accepted) {
        from.track.held = sample;
      }
      from.track.samples.pop_front();
    } else if (m.kind != MeasurementKind::kClone) {
      from.folded.add(step.verdict, false);
    }
    base_ = std::move(step.belief);
    base_time_ = m.t;
    record_.pop_front();
  }
}

void BaseLocalizer::reset(const Pose2& pose, const Matrix3d& covariance, std::optional<double> t) {
  check_measured(pose, "pose");
  const Matrix3d P = checked_belief(covariance, "covariance");
  if (t) {
    check_time(*t, "t");
  }
  const std::map<std::string, SourceCounts> before_reset = counts();
  for (LocalizerSource& each : sources_) {
    each.folded = before_reset.at(each.name);
    each.track = TwistTrack();
  }
  record_.clear();
  base_ = PoseBelief(pose, P);
  base_time_ = begin_ = t;
  latest_ = t;
}

std::map<std::string, SourceCounts> BaseLocalizer::counts() const {
  std::map<std::string, SourceCounts> all;
  for (const LocalizerSource& each : sources_) {
    SourceCounts& sum = all[each.name] = each.folded;
    for (const TwistSample& sample : each.track.samples) {
      sum.add(sample.verdict, true);
    }
  }
  for (const Step& step : record_) {
    if (step.measurement.kind != MeasurementKind::kTwist &&
        step.measurement.kind != MeasurementKind::kClone) {
      all[source_at(step.measurement.source).name].add(step.verdict, false);
    }
  }
  return all;
}

std::map<std::string, long> BaseLocalizer::refused() const {
  std::map<std::string, long> all;
  for (const LocalizerSource& each : sources_) {
    all[each.name] = each.refused;
  }
  return all;
}

}  // namespace thing_kin
