#include "thing_kin/rmma/covering_search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/LU>

namespace thing_kin {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kReadingDistance = 0.02;  // m from one reading of the odometry to the next
constexpr double kLeastReserve = 4.0;      // s that the next fiducial is left
constexpr double kStopsReserved = 8.0;
constexpr double kExtent = 0.1;      // m: farther away nothing is looked for
constexpr double kLeastRate = 1e-4;  // of finding it, per s: below it a search ends
// A filter's belief has light tails; what was not thought of has not.
constexpr double kUsual = 0.85, kWide = 0.12, kAnywhere = 0.03;
constexpr double kWideVariance = 9.0;        // times the usual one
constexpr double kAnywhereDeviation = 0.04;  // m

std::vector<PlanarNormal> with_tails(const std::vector<PlanarNormal>& belief) {
  std::vector<PlanarNormal> parts;
  for (const PlanarNormal& part : belief) {
    const auto add = [&](double weight, const Matrix2d& covariance) {
      parts.push_back({part.weight * weight, part.mean, covariance});
    };
    add(kUsual, part.covariance);
    add(kWide, kWideVariance * part.covariance);
  }
  PlanarNormal all{.weight = 0.0};
  for (const PlanarNormal& part : belief) {
    all.weight += part.weight;
    all.mean += part.weight * part.mean;
  }
  all.mean /= all.weight;
  all.weight *= kAnywhere;
  all.covariance = kAnywhereDeviation * kAnywhereDeviation * Matrix2d::Identity();
  parts.push_back(all);
  return parts;
}

class CoveringDrive {
 public:
  CoveringDrive(WorldRun& run, const SearchPoints& side, double velocity,
                const CoveringDriveOptions& options, NoiseMemory& memory, SideOutcome& out)
      : arm_(run), side_(side), velocity_(velocity), options_(options), out_(out) {
    out_.attempts.assign(side_.size(), {});
    out_.attempts.front().intercepted = register_first(arm_, side_.front());
    base_.emplace(side_.front(), arm_.seen(), velocity, options.detection_radius, memory);
    stop_time_.stop = arm_.sample_time(arm_.command());
    constexpr double kProbe = 0.05;
    const double way = arm_.sample_time(arm_.command() + Vector2d(kProbe, 0.0));
    stop_time_.per_metre = std::max(0.0, way - stop_time_.stop) / kProbe;
    reserve_ = std::max(kLeastReserve, kStopsReserved * stop_time_.stop);
  }

  void go() {
    if (options_.odometry == OdometryUse::kContinuous) {
      base_->read_odometry(arm_.run().odometry(0.0));
    }
    for (std::size_t i = 1; i < side_.size(); ++i) {
      if (time_left(i) > 0.5 * reserve_) {
        attempt(i);
      }
    }
  }

 private:
  /// s until a fiducial leaves the arm's reach.
  double time_left(std::size_t i) const {
    return (side_[i].x() - base_->pose().x() + options_.reach) / base_->speed();
  }

  /// The displacement that brings the tool to a point of the side's frame.
  Vector2d displacement(const Vector2d& point) const {
    return compose(inverse(base_->pose()), Pose2(point.x(), point.y(), 0.0)).head<2>();
  }

  Vector2d tool(const Vector2d& displacement) const {
    return compose(base_->pose(), Pose2(displacement.x(), displacement.y(), 0.0)).head<2>();
  }

  void pass(double dt) {
    base_->predict(dt);
    time_ += dt;
  }

  void attempt(std::size_t i) {
    approach(side_[i]);
    const std::vector<PlanarNormal> belief = with_tails(base_->offsets(displacement(side_[i])));
    const Vector2d shift = first_shift(belief);
    bring(side_[i] + shift);
    Attempt& attempt = out_.attempts[i];
    attempt.searched = true;
    SearchTrace trace;
    trace.fiducial = static_cast<int>(i);
    trace.start = time_;
    trace.predicted = base_->pose().head<2>();
    trace.covariance = base_->covariance();
    look_for(i, belief, shift, attempt, trace);
    attempt.search_time = time_ - trace.start;
    if (out_.trace != nullptr) {
      trace.end = time_;
      trace.hit = attempt.intercepted;
      trace.position_error = attempt.position_error;
      out_.trace->push_back(std::move(trace));
    }
  }

  /// Sends the arm ahead, waits for the base, and brings the tool to where it should meet the
  /// fiducial.
  void approach(const Vector2d& fiducial) {
    const double lead =
        std::clamp(fiducial.x() - base_->pose().x(), -options_.u_max, options_.u_max);
    const double trigger = fiducial.x() - lead;
    const double there = time_ + arm_.move_to({lead, displacement(fiducial).y()});
    // Forward kinematics tells how far off the arm stopped; a short move mends it, if there is
    // time.
    const double correction = stop_time_(0.005);
    const double step = kReadingDistance / velocity_;
    double start = 0.0;
    while (true) {
      const double wait = (trigger - base_->pose().x()) / base_->speed();
      start = std::max({time_ + wait, there, time_});
      if (start - time_ <= step + correction) {
        break;
      }
      pass(step);
      if (options_.odometry == OdometryUse::kContinuous) {
        base_->read_odometry(arm_.run().odometry(time_));
      }
    }
    // Until then nothing more is learnt: where the tool is to go is known, and the arm may set out.
    set_out_ = std::max(there, time_);
    pass(start - time_);
    const bool seen = start >= there + correction;
    if (seen) {
      arm_.look();
    }
    offset_ = Vector2d::Zero();
    looks_ = 0.0;
    if (seen) {
      note_offset();
    }
  }

  /// Stops are off by the same, where they are after one move.
  void note_offset() {
    looks_ += 1.0;
    offset_ += (arm_.seen() - arm_.command() - offset_) / looks_;
  }

  /// The short move to where the first stop is: the search begins when it is over.
  void bring(const Vector2d& point) {
    const Vector2d command = displacement(point) - offset_;
    if (arm_.run().reaches(command)) {
      pass(std::max(0.0, set_out_ + arm_.sample_time(command) - time_));
    }
  }

  void look_for(std::size_t i, const std::vector<PlanarNormal>& belief, const Vector2d& shift,
                Attempt& attempt, SearchTrace& trace) {
    const Vector2d& fiducial = side_[i];
    std::optional<CoveringSearch> covering;
    if (arm_.run().reaches(displacement(fiducial + shift) - offset_)) {
      arm_.send(displacement(fiducial + shift) - offset_);
    } else {
      covering.emplace(belief, sight(), stop_time_, kExtent);
      if (!next(fiducial, shift, *covering)) {
        give_up(attempt);
        return;
      }
    }
    while (true) {
      ++attempt.samples;
      const bool hit = arm_.sees(time_, fiducial, out_.trace != nullptr ? &trace : nullptr);
      note_offset();
      const Vector2d at = tool(arm_.seen()) - fiducial;
      if (hit) {
        attempt.intercepted = true;
        attempt.position_error = at.norm();
        found(fiducial, at, covering);
        return;
      }
      if (!covering) {
        covering.emplace(belief, sight(), stop_time_, kExtent);
      }
      covering->miss(at);
      if (out_of_time(i) || !next(fiducial, at, *covering)) {
        break;
      }
    }
    give_up(attempt);
  }

  Sight sight() const { return {.radius = options_.detection_radius}; }

  /// What a hit tells, with the stops before it that saw nothing.
  void found(const Vector2d& fiducial, const Vector2d& at,
             const std::optional<CoveringSearch>& covering) {
    PlanarNormal miss;
    if (covering) {
      miss = covering->seen_from(at);
      miss.mean -= at;
    } else {
      const double deviation = 0.5 * options_.detection_radius;
      miss.covariance = deviation * deviation * Matrix2d::Identity();
    }
    base_->hit(fiducial, arm_.seen(), miss);
  }

  /// Where the belief is densest, of the means of its parts.
  Vector2d first_shift(const std::vector<PlanarNormal>& belief) const {
    const double blur = 0.25 * options_.detection_radius * options_.detection_radius;
    Vector2d best = Vector2d::Zero();
    double most = -1.0;
    for (const PlanarNormal& place : belief) {
      double density = 0.0;
      for (const PlanarNormal& part : belief) {
        const Matrix2d covariance = part.covariance + blur * Matrix2d::Identity();
        const Vector2d d = place.mean - part.mean;
        density += part.weight / std::sqrt(covariance.determinant()) *
                   std::exp(-0.5 * d.dot(covariance.inverse() * d));
      }
      if (density > most) {
        most = density;
        best = place.mean;
      }
    }
    return best;
  }

  bool out_of_time(std::size_t i) const {
    return time_left(i) <= 0.0 || (i + 1 < side_.size() && time_left(i + 1) < reserve_);
  }

  bool next(const Vector2d& fiducial, const Vector2d& from, CoveringSearch& covering) {
    Vector2d shift;
    const auto allowed = [&](const Vector2d& point) {
      return arm_.run().reaches(displacement(fiducial + point) - offset_);
    };
    if (!covering.next(from, kLeastRate, allowed, shift)) {
      return false;
    }
    // The way there takes time in which the base moves: the arm is told where to be then.
    const Vector2d roughly = displacement(fiducial + shift) - offset_;
    const double time = arm_.sample_at(roughly);
    pass(time);
    arm_.send(displacement(fiducial + shift) - offset_);
    return true;
  }

  void give_up(Attempt& attempt) {
    const Pose2 seen = arm_.run().odometry(time_);
    attempt.position_error = (seen - base_->pose()).head<2>().norm();
    if (options_.odometry != OdometryUse::kNone) {
      base_->read_odometry(seen);
    }
  }

  SearchArm arm_;
  const SearchPoints& side_;
  double velocity_;
  const CoveringDriveOptions& options_;
  SideOutcome& out_;
  std::optional<BaseEstimator> base_;
  StopTime stop_time_;
  double reserve_ = kLeastReserve;
  Vector2d offset_ = Vector2d::Zero();  // seen minus sent, since the last move
  double looks_ = 0.0;
  double time_ = 0.0;
  double set_out_ = 0.0;  // s: from when on the arm may go to the first stop
};

}  // namespace

void covering_search(WorldRun& run, const SearchPoints& side, double velocity,
                     const CoveringDriveOptions& options, NoiseMemory& memory, SideOutcome& out) {
  CoveringDrive(run, side, velocity, options, memory, out).go();
}

}  // namespace thing_kin
