#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "thing_kin/estimation/localizer_source.hpp"
#include "thing_kin/estimation/pose_belief.hpp"
#include "thing_kin/estimation/twist_track.hpp"

namespace thing_kin {

/// Largest size of a measured number, and of a variance: squares must not overflow.
inline constexpr double kMostMeasured = 1e12;
inline constexpr double kMostVariance = 1e24;

/// Where the base is, how fast it goes, and how sure that is.
struct BaseEstimate {
  double t = 0.0;
  Pose2 pose;
  Eigen::Matrix3d covariance;  ///< of (x, y, theta), world axes
  Twist2 twist;                ///< in the body
  Eigen::Matrix3d twist_covariance;
};

struct BaseLocalizerOptions {
  Pose2 pose = Pose2::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity() * 1e-6;
  double gate = 0.999;
  Eigen::Matrix3d process_noise = Eigen::Matrix3d::Identity() * 1e-4;  ///< per second, world axes
  double history = 10.0;                                               ///< s
  std::optional<double> t;  ///< when time begins; else with the first measurement
  PoseFilter filter = PoseFilter::kExtended;
};

/// What a source reports. For a motion between two times, t is the later one.
struct LocalizerMeasurement {
  /// In the order in which measurements of one time are taken; kClone marks where a motion begins.
  enum class Kind : std::uint8_t { kTwist, kPose, kRelative, kYaw, kClone };
  Kind kind = Kind::kPose;
  double t = 0.0;
  double t_from = 0.0;  ///< of a motion: when it began
  int source = 0;
  std::uint8_t mask = 7;
  Eigen::Vector3d z = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  NisBound bound{};  ///< its source's gate when it came
};

using MeasurementKind = LocalizerMeasurement::Kind;

/// Fuses what any number of named sources say of a planar base, in whatever order it comes.
///
/// A record of the last seconds is kept in order of time, with the belief after each measurement;
/// one that comes late is put where it belongs, and what follows is computed again. The result is a
/// function of the record, not of the order of arrival: equal to the last bit.
class BaseLocalizer {
 public:
  /// Throws InvalidArgument naming pose, covariance, gate, process_noise, history or t.
  explicit BaseLocalizer(const BaseLocalizerOptions& options);

  /// Declares a source, or changes it: later measurements are concerned, earlier ones are as they
  /// were. `fuse` holds FuseBits; the localizer's gate unless `gate` is given.
  void source(const std::string& name, std::uint8_t fuse,
              const std::optional<Eigen::Matrix3d>& covariance, std::optional<double> gate);
  /// The source of this name; declared with everything, if it is new.
  int find_or_declare(const std::string& name);
  /// The source of this name, or nullptr.
  const LocalizerSource* look_up(const std::string& name) const noexcept;
  const LocalizerSource& source_at(int index) const {
    return sources_[static_cast<std::size_t>(index)];
  }

  /// False if it is older than the history, and counted as that. The measurement must be checked:
  /// finite numbers, a positive definite R, a mask that is not zero.
  bool add(const LocalizerMeasurement& measurement);

  /// At the time of the latest measurement, or at any time within the history or after it. Throws
  /// InvalidArgument("t", ...).
  BaseEstimate estimate(std::optional<double> t) const;

  /// Forgets all measurements but not the sources and their counts.
  void reset(const Pose2& pose, const Eigen::Matrix3d& covariance, std::optional<double> t);

  /// By name; every source that is declared or was heard.
  std::map<std::string, SourceCounts> counts() const;
  std::map<std::string, long> refused() const;

  const BaseLocalizerOptions& options() const noexcept { return options_; }
  std::optional<double> latest() const noexcept { return latest_; }
  std::size_t record_size() const noexcept { return record_.size(); }

  /// Everything, as bytes of a versioned format; what comes back goes on to the same bits. Throws
  /// InvalidArgument("state", ...) for bytes that are not such a state.
  std::string save() const;
  static BaseLocalizer restore(const std::string& bytes);

 private:
  struct Step {
    LocalizerMeasurement measurement;
    std::uint64_t id = 0;  ///< of a motion and the clone that it begins with
    PoseVerdict verdict{true, 0.0, 0};
    PoseBelief belief;  ///< after it
  };
  using Cursors = std::vector<std::size_t>;

  double origin() const noexcept;
  bool before(const LocalizerMeasurement& a, const LocalizerMeasurement& b) const noexcept;
  double time_before(double t) const noexcept;
  std::size_t insert(const LocalizerMeasurement& measurement, std::uint64_t id);
  double insert_sample(const LocalizerMeasurement& measurement);
  void replay(std::size_t from);
  void apply(Step& step, PoseBelief& belief) const;
  void set_cursors(double a, Cursors& cursors) const;
  std::vector<TwistShare>& shares_of(const Cursors& cursors, double a, double b) const;
  void judge_beginning(const Cursors& cursors, double a, double b);
  void advance(PoseBelief& belief, const Cursors& cursors, double a, double b) const noexcept;
  void fold();
  void sort_sources();
  template <typename Archive>
  void exchange_state(Archive& archive);

  BaseLocalizerOptions options_;
  std::vector<LocalizerSource> sources_;
  std::vector<int> by_name_;
  // The belief at the beginning, or after the last measurement that was folded away.
  PoseBelief base_;
  std::optional<double> base_time_;
  std::optional<double> begin_;  ///< of time: given, or the first folded measurement's
  std::optional<double> latest_;
  std::deque<Step> record_;
  std::uint64_t next_id_ = 1;
  Cursors cursors_;
  mutable std::vector<TwistShare> shares_;
};

/// Throws InvalidArgument, naming it, unless t is a time, v are three moderate numbers, or R (n
/// rows of it) is a covariance without a zero; returns R symmetric.
void check_time(double t, const std::string& name);
void check_measured(const Eigen::Vector3d& v, const std::string& name);
Eigen::Matrix3d check_measured_covariance(const Eigen::Matrix3d& R, const std::string& name);

}  // namespace thing_kin
