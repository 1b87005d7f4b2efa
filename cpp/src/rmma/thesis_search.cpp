#include "thing_kin/rmma/thesis_search.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "thing_kin/estimation/unscented_kalman.hpp"
#include "thing_kin/search/stochastic.hpp"

namespace thing_kin {

namespace {

using Eigen::Matrix2d;
using Eigen::Matrix4d;
using Eigen::Vector2d;
using Eigen::Vector4d;

constexpr double kSlowest = 0.3;  // of v_b: below it the estimated speed is not believed

Matrix4d transition(double dt) {
  Matrix4d F = Matrix4d::Identity();  // (3.11), (3.12)
  F(0, 2) = F(1, 3) = dt;
  return F;
}

/// What a method believes of the base, X = (x, y, xdot, ydot). A search happens between
/// predict(dtb) and repredict(dte); update() ends the event.
class BaseBelief {
 public:
  virtual ~BaseBelief() = default;
  BaseBelief() = default;
  BaseBelief(const BaseBelief&) = delete;
  BaseBelief& operator=(const BaseBelief&) = delete;
  BaseBelief(BaseBelief&&) = delete;
  BaseBelief& operator=(BaseBelief&&) = delete;

  virtual Vector4d mean() const = 0;
  virtual Matrix2d covariance() const = 0;
  virtual void predict(double dt) = 0;
  virtual void update(const Vector2d& z, double r) = 0;
};

/// The last observation, moved on by v_b: what the spiral goes by.
class LastSeen final : public BaseBelief {
 public:
  LastSeen(const Vector2d& z, double velocity) : x_(z.x(), z.y(), velocity, 0.0) {}

  Vector4d mean() const override { return x_; }
  Matrix2d covariance() const override { return Matrix2d::Zero(); }
  void predict(double dt) override { x_ = transition(dt) * x_; }
  void update(const Vector2d& z, double /*r*/) override { x_.head<2>() = z; }

 private:
  Vector4d x_;
};

/// (3.6), (3.7), (3.19) to (3.21) with the interval known: linear, [X21] (2.3) to (2.5).
class LinearBelief final : public BaseBelief {
 public:
  LinearBelief(const Vector4d& x, double p0, double q)
      : filter_(x, (p0 * Matrix4d::Identity()).eval()), Q_(q * Matrix4d::Identity()) {}

  Vector4d mean() const override { return filter_.x(); }
  Matrix2d covariance() const override { return filter_.P().topLeftCorner<2, 2>(); }
  void predict(double dt) override { filter_.predict(transition(dt), Q_); }
  void update(const Vector2d& z, double r) override {
    filter_.update(z, Eigen::Matrix<double, 2, 4>::Identity(), r * Matrix2d::Identity());
  }

 private:
  KalmanFilter filter_;
  StateMatrix Q_;
};

/// The same through sigma points, [X21] (2.6) to (2.9); (3.17) is evaluated at the mean.
class UnscentedBelief final : public BaseBelief {
 public:
  UnscentedBelief(const Vector4d& x, double p0, double q)
      : filter_(x, (p0 * Matrix4d::Identity()).eval(), {.alpha = 1.0, .beta = 2.0, .kappa = -1.0}),
        Q_(q * Matrix4d::Identity()) {}

  Vector4d mean() const override { return filter_.x(); }
  Matrix2d covariance() const override { return filter_.P().topLeftCorner<2, 2>(); }
  void predict(double dt) override {
    filter_.sigma_points(points_);
    points_ = (transition(dt) * points_).eval();
    filter_.predict(points_, Q_);
  }
  void update(const Vector2d& z, double r) override {
    filter_.sigma_points(points_);
    filter_.update(z, points_.topRows<2>(), r * Matrix2d::Identity());
  }

 private:
  UnscentedKalmanFilter filter_;
  StateMatrix Q_;
  SigmaPoints points_;
};

/// One drive of one of the thesis's methods.
class ThesisDrive {
 public:
  ThesisDrive(WorldRun& run, const SearchPoints& side, double velocity, ThesisMethod method,
              const ThesisOptions& options, std::uint64_t key, SideOutcome& out)
      : arm_(run),
        side_(side),
        velocity_(velocity),
        method_(method),
        options_(options),
        random_(key),
        out_(out) {}

  void go() {
    out_.attempts.assign(side_.size(), {});
    out_.attempts.front().intercepted = register_first(arm_, side_.front());
    last_seen_ = arm_.seen();
    first_ = side_.front() - last_seen_;
    begin();
    std::size_t previous = 0;
    for (std::size_t i = next_fiducial(side_, 0, 0.0); i < side_.size();
         i = next_fiducial(side_, i, velocity_ * time_)) {
      attempt(i, previous);
      previous = i;
    }
  }

 private:
  void begin() {
    const Vector4d x(first_.x(), first_.y(), velocity_, 0.0);  // (3.2)
    switch (method_) {
      case ThesisMethod::kSpiral:
        belief_ = std::make_unique<LastSeen>(first_, velocity_);
        break;
      case ThesisMethod::kLinearKf:
        belief_ = std::make_unique<LinearBelief>(x, options_.p0, options_.q);
        break;
      case ThesisMethod::kUkf:
        belief_ = std::make_unique<UnscentedBelief>(x, options_.p0, options_.q);
        break;
    }
  }

  void attempt(std::size_t i, std::size_t previous) {
    const Vector2d& fiducial = side_[i];
    const bool linear = method_ == ThesisMethod::kLinearKf;
    const Vector4d x = belief_->mean();
    // (3.13), (3.18) with the sign that they lose
    const double u_x =
        linear ? std::min(options_.u_max, std::abs(fiducial.x() - (first_.x() + time_ * velocity_)))
               : std::clamp(fiducial.x() - x.x(), -options_.u_max, options_.u_max);
    // (3.10), (3.17); what was passed already is not waited for
    const double from = linear ? side_[previous].x() - last_seen_.x() : x.x();
    const double speed = linear ? velocity_ : std::max(x(2), kSlowest * velocity_);
    const double wait = std::max(0.0, (fiducial.x() - u_x - from) / speed);
    belief_->predict(wait);
    const double meant = time_ + wait;
    // (3.14) takes the base where it set out
    const Vector2d center =
        linear ? Vector2d(fiducial.x() - u_x, first_.y()) : Vector2d(belief_->mean().head<2>());
    const double there = time_ + arm_.move_to(Vector2d(u_x, fiducial.y() - center.y()));
    Attempt& attempt = out_.attempts[i];
    attempt.searched = true;
    SearchTrace trace;
    trace.fiducial = static_cast<int>(i);
    trace.predicted = center;
    trace.covariance = belief_->covariance();
    trace.start = time_ = std::max(meant, there);
    sample(fiducial, samples(center), meant, attempt, trace);
    conclude(fiducial, meant, attempt);
    attempt.search_time = time_ - trace.start;
    if (out_.trace != nullptr) {
      trace.end = time_;
      trace.hit = attempt.intercepted;
      trace.position_error = attempt.position_error;
      out_.trace->push_back(std::move(trace));
    }
  }

  SearchPoints samples(const Vector2d& center) {
    if (method_ == ThesisMethod::kSpiral) {
      return spiral_points(center, {.gap = options_.spiral_gap,
                                    .spacing = options_.spiral_gap,
                                    .count = options_.spiral_count});
    }
    return stochastic_points(
        center, belief_->covariance(),
        {.sample_gap = options_.sample_gap, .count = options_.draws, .keep = options_.keep},
        random_);
  }

  /// Where the arm goes for the base to be at `sample`, given at `meant`: (2.2), cumulative.
  Vector2d command(const Vector2d& fiducial, const Vector2d& sample, double t, double meant) const {
    return fiducial - sample - Vector2d(velocity_ * (t - meant), 0.0);
  }

  void sample(const Vector2d& fiducial, const SearchPoints& points, double meant, Attempt& attempt,
              SearchTrace& trace) {
    SearchTrace* const record = out_.trace != nullptr ? &trace : nullptr;
    for (const Vector2d& point : points) {
      double next = time_;
      if (&point != &points.front()) {
        // The time that the way takes and the way that the time makes: twice is enough.
        for (int pass = 0; pass < 2; ++pass) {
          next = time_ + arm_.sample_time(command(fiducial, point, next, meant));
        }
      }
      const Vector2d u = command(fiducial, point, next, meant);
      if (!arm_.run().reaches(u)) {
        return;
      }
      if (&point != &points.front()) {
        arm_.sample_at(u);
        time_ = next;
      } else {
        arm_.send(u);
      }
      ++attempt.samples;
      if (arm_.sees(time_, fiducial, record)) {
        attempt.intercepted = true;
        return;
      }
    }
  }

  void conclude(const Vector2d& fiducial, double meant, Attempt& attempt) {
    Vector2d z;
    if (attempt.intercepted) {
      z = fiducial - arm_.seen();  // (3.15)
    } else {
      z = arm_.run().odometry(time_).head<2>();
    }
    last_seen_ = arm_.seen();
    belief_->predict(time_ - meant);
    attempt.position_error = (z - belief_->mean().head<2>()).norm();
    belief_->update(z, attempt.intercepted ? options_.r_hit : options_.r_fail);
  }

  SearchArm arm_;
  const SearchPoints& side_;
  double velocity_;
  ThesisMethod method_;
  const ThesisOptions& options_;
  RandomStream random_;
  SideOutcome& out_;
  std::unique_ptr<BaseBelief> belief_;
  Vector2d first_ = Vector2d::Zero();      // (x_i, y_i)
  Vector2d last_seen_ = Vector2d::Zero();  // u'
  double time_ = 0.0;
};

}  // namespace

void thesis_search(WorldRun& run, const SearchPoints& side, double velocity, ThesisMethod method,
                   const ThesisOptions& options, std::uint64_t key, SideOutcome& out) {
  ThesisDrive(run, side, velocity, method, options, key, out).go();
}

}  // namespace thing_kin
