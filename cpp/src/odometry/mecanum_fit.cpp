#include "mecanum_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Cholesky>

namespace thing_kin {

namespace {

// A motion whose squared, normalized error exceeds this is weighed down: chi-square, 3 degrees of
// freedom, 99.9 %.
constexpr double kOutlier = 16.27;

}  // namespace

MecanumFit::MecanumFit(const ReferenceRecord& reference, WheelPath wheels,
                       const MecanumIdentificationOptions& options)
    : reference_(reference), wheels_(std::move(wheels)), window_(options.window) {
  const bool radius_known = options.wheel_radius > 0.0;
  const bool k_known = options.k > 0.0;
  prior << std::log(radius_known ? options.wheel_radius : 0.1), std::log(k_known ? options.k : 0.4),
      options.mount, 0.0;
  prior_std << (radius_known ? options.wheel_radius_std : std::log(3.0)),
      (k_known ? options.k_std : std::numbers::ln2), options.mount_std, options.clock_offset_std;
  x = prior;
  for (std::size_t i = 0; i < held.size(); ++i) {
    held[i] = prior_std[static_cast<Eigen::Index>(i)] == 0.0;
  }
}

void MecanumFit::linearize() {
  wheels_.set(std::exp(x[0]), std::exp(x[1]), x[5]);
  windows_ = cut_windows(reference_, wheels_, mount(), window_);
  rolled_.clear();
  motions_.clear();
  for (std::size_t i = 0; i + 1 < windows_.size(); ++i) {
    rolled_.push_back(wheels_.motion(windows_[i].t, windows_[i + 1].t, noise.slip));
    motions_.push_back(relative_motion(windows_[i], windows_[i + 1], rolled_[i], mount()));
  }
  weights_.resize(motions_.size(), 1.0);
}

std::size_t MecanumFit::used() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(weights_, [](double weight) { return weight > 0.0; }));
}

double MecanumFit::travel() const {
  double sum = 0.0;
  for (const WheelMotion& motion : rolled_) {
    sum += motion.travel;
  }
  return sum;
}

Eigen::Matrix3d MecanumFit::covariance_of(const RelativeMotion& motion, std::size_t from,
                                          std::size_t to) const {
  const Eigen::Vector3d before = windows_[from].variance + noise.reference;
  const Eigen::Vector3d after = windows_[to].variance + noise.reference;
  Eigen::Matrix3d sum = motion.wheels;
  sum += motion.by_from * before.asDiagonal() * motion.by_from.transpose();
  sum += motion.by_to * after.asDiagonal() * motion.by_to.transpose();
  return scale_ * sum;
}

void MecanumFit::weigh() {
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const Eigen::Matrix3d S = covariance_of(motions_[i], i, i + 1);
    const double nees = motions_[i].error.dot(S.llt().solve(motions_[i].error));
    const double weight = nees > kOutlier ? kOutlier / nees : 1.0;
    weights_[i] = motions_[i].whole && std::isfinite(nees) ? weight : 0.0;
  }
}

// Where residuals are larger than the noise explains, all variances grow; they never shrink.
void MecanumFit::rescale() {
  scale_ = 1.0;
  const auto degrees = 3.0 * static_cast<double>(used()) - kMecanumParameters;
  if (degrees > 0.0) {
    scale_ = std::max(1.0, normal_equations().chi2 / degrees);
  }
}

// Generalized least squares by block Cholesky: successive motions share a window, so that their
// covariance is block-tridiagonal.
MecanumFit::Normal MecanumFit::normal_equations() const {
  Normal normal;
  Eigen::Matrix<double, 3, kMecanumParameters + 1> before;  // [J, error], decorrelated
  Eigen::LLT<Eigen::Matrix3d> S_before;
  bool chained = false;
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    if (weights_[i] == 0.0) {
      chained = false;
      continue;
    }
    const RelativeMotion& motion = motions_[i];
    Eigen::Matrix3d S = covariance_of(motion, i, i + 1) / weights_[i];
    Eigen::Matrix<double, 3, kMecanumParameters + 1> row;
    row << motion.J, motion.error;
    if (chained) {
      const Eigen::Vector3d shared = scale_ * (windows_[i].variance + noise.reference);
      const Eigen::Matrix3d C =
          motions_[i - 1].by_to * shared.asDiagonal() * motion.by_from.transpose();
      row -= C.transpose() * S_before.solve(before);
      S -= C.transpose() * S_before.solve(C);
    }
    S_before.compute(S);
    before = row;
    chained = true;
    const Eigen::Matrix<double, 3, kMecanumParameters + 1> white = S_before.solve(row);
    normal.H +=
        row.leftCols<kMecanumParameters>().transpose() * white.leftCols<kMecanumParameters>();
    normal.g += row.leftCols<kMecanumParameters>().transpose() * white.col(kMecanumParameters);
    normal.chi2 += row.col(kMecanumParameters).dot(white.col(kMecanumParameters));
  }
  return normal;
}

// What is held has a stiff equation of its own: x = prior.
MecanumFit::Normal MecanumFit::with_prior(Normal normal) const {
  for (int i = 0; i < kMecanumParameters; ++i) {
    if (held[static_cast<std::size_t>(i)]) {
      normal.H.row(i).setZero();
      normal.H.col(i).setZero();
      normal.H(i, i) = 1.0;
      normal.g[i] = 0.0;
    } else {
      const double information = 1.0 / (prior_std[i] * prior_std[i]);
      normal.H(i, i) += information;
      const double off = x[i] - prior[i];
      normal.g[i] += information * (i == 4 ? wrap_angle(off) : off);
    }
  }
  return normal;
}

double MecanumFit::step() {
  const Normal normal = with_prior(normal_equations());
  const Eigen::LDLT<MecanumMatrix> factors(normal.H);
  MecanumVector dx = -factors.solve(normal.g);
  const MecanumVector variance = factors.solve(MecanumMatrix::Identity()).diagonal();
  constexpr double kLongestStep = 0.5;
  const double largest = dx.cwiseAbs().maxCoeff();
  if (!(largest < 1e6)) {
    return std::numeric_limits<double>::infinity();
  }
  dx *= std::min(1.0, kLongestStep / std::max(largest, kLongestStep));
  x += dx;
  x[4] = wrap_angle(x[4]);
  return (dx.array() / variance.array().abs().sqrt().max(1e-12)).abs().maxCoeff();
}

MecanumMatrix MecanumFit::covariance() const {
  const Normal data = normal_equations();
  const MecanumMatrix P = with_prior(data).H.ldlt().solve(MecanumMatrix::Identity());
  // x_free = ... - P_ff H_fc x_held: what is held wrongly carries over (Schmidt).
  MecanumMatrix carry = MecanumMatrix::Identity();
  MecanumVector own = MecanumVector::Zero();
  for (int j = 0; j < kMecanumParameters; ++j) {
    if (!held[static_cast<std::size_t>(j)]) {
      continue;
    }
    own[j] = prior_std[j] * prior_std[j];
    for (int i = 0; i < kMecanumParameters; ++i) {
      if (!held[static_cast<std::size_t>(i)]) {
        double sum = 0.0;
        for (int f = 0; f < kMecanumParameters; ++f) {
          sum += held[static_cast<std::size_t>(f)] ? 0.0 : P(i, f) * data.H(f, j);
        }
        carry(i, j) = -sum;
      }
    }
  }
  MecanumMatrix free = P;
  for (int j = 0; j < kMecanumParameters; ++j) {
    if (held[static_cast<std::size_t>(j)]) {
      free(j, j) = 0.0;
    }
  }
  MecanumMatrix held_columns = carry;
  for (int j = 0; j < kMecanumParameters; ++j) {
    if (!held[static_cast<std::size_t>(j)]) {
      held_columns.col(j).setZero();
    }
  }
  const MecanumMatrix sum = free + held_columns * own.asDiagonal() * held_columns.transpose();
  return 0.5 * (sum + sum.transpose());
}

std::vector<RelativeMotion> MecanumFit::from_start() const {
  std::vector<RelativeMotion> motions;
  WheelMotion rolled;
  for (std::size_t i = 0; i < rolled_.size(); ++i) {
    rolled = combine(rolled, rolled_[i]);
    motions.push_back(relative_motion(windows_.front(), windows_[i + 1], rolled, mount()));
  }
  return motions;
}

}  // namespace thing_kin
