#include "pose_program.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include <Eigen/Eigenvalues>

namespace thing_kin {

namespace {

// Curvature below this fraction of the largest is taken for it, so that the program is convex.
constexpr double kLeastCurvature = 1e-6;

constexpr double kFirstPenalty = 5.0;

template <typename Matrix>
Matrix with_sizes_of_curvature(const Matrix& H) noexcept {
  const Eigen::Index k = H.rows();
  // Loops, and the solver in two steps: GCC 12 takes Eigen's own for reading what is not set.
  Eigen::SelfAdjointEigenSolver<Matrix> solver(k);
  solver.compute(H);
  double largest = 0.0;
  for (Eigen::Index i = 0; i < k; ++i) {
    largest = std::max(largest, std::abs(solver.eigenvalues()[i]));
  }
  const double least = std::max(kLeastCurvature * largest, 1e-12);
  Matrix sum = Matrix::Zero(k, k);
  for (Eigen::Index i = 0; i < k; ++i) {
    const auto v = solver.eigenvectors().col(i);
    sum += std::max(std::abs(solver.eigenvalues()[i]), least) * v * v.transpose();
  }
  return sum;
}

}  // namespace

PoseProgram::PoseProgram(int joints, int slacks) : joints_(joints) {
  // One row more for what all inequalities may fall short by, and one form more: its side.
  forms_.resize(joints, joints + slacks + 1);
  lower_.resize(joints + slacks + 1);
  upper_.resize(joints + slacks + 1);
  inequalities_.reserve(static_cast<std::size_t>(slacks));
  mu_.resize(slacks);
  begin();
}

void PoseProgram::begin() noexcept {
  mu_.setZero();
  nu_ = JointVector::Zero(joints_);
  penalty_ = kFirstPenalty;
}

void PoseProgram::reset(const SmallMatrix& Z, const SmallMatrix& H, const SmallVector& g) noexcept {
  H_ = H;
  g_ = g;
  forms_.topLeftCorner(Z.cols(), joints_) = Z.transpose();
  inequalities_.clear();
}

void PoseProgram::bound(Eigen::Index joint, double lower, double upper) noexcept {
  lower_[joint] = lower;
  upper_[joint] = upper;
}

void PoseProgram::add(int i, double slack, const SmallMatrix& Z,
                      const JointVector& along) noexcept {
  const Eigen::Index column = count();
  forms_.col(column).head(Z.cols()).noalias() = Z.transpose() * along;
  lower_[column] = -slack;
  upper_[column] = std::numeric_limits<double>::infinity();
  inequalities_.push_back(i);
}

// Curvature across sides that were active in the last step costs nothing if they hold again, and
// may be all that is missing to convexity: |a . z - b|^2 vanishes on them.
bool PoseProgram::stiffen(const FormsView& forms) noexcept {
  const double stiffness = 10.0 * H_.cwiseAbs().maxCoeff();
  const auto n = static_cast<int>(joints_);
  SmallMatrix H = H_;
  SmallVector g = g_;
  int count = 0;
  const auto add = [&](int form, double bound) {
    const auto a = forms.col(form);
    const double weight = stiffness / std::max(a.squaredNorm(), kLeastCurvature);
    H += weight * a * a.transpose();
    g -= weight * bound * a;
    stiffened_[static_cast<std::size_t>(count++)] = form;
  };
  for (int j = 0; j < n && count < kMaxDof; ++j) {
    if (nu_[j] != 0.0) {
      add(j, nu_[j] > 0.0 ? lower_[j] : upper_[j]);
    }
  }
  for (int i = 0; std::cmp_less(i, inequalities_.size()) && count < kMaxDof; ++i) {
    if (mu_[inequalities_[static_cast<std::size_t>(i)]] > 0.0) {
      add(n + i, lower_[n + i]);
    }
  }
  if (count == 0 ||
      qp_.minimize(H, g, forms, lower_.data(), upper_.data()) != ConvexQp::Status::kOptimal) {
    return false;
  }
  return std::all_of(stiffened_.begin(), std::next(stiffened_.begin(), count),
                     [&](int form) { return qp_.holds(form); });
}

// The Hessian with the size of each curvature instead of itself.
void PoseProgram::convexify() noexcept {
  if (H_.rows() == 3) {  // most robots: a size that the compiler knows is three times as fast
    H_ = with_sizes_of_curvature<Eigen::Matrix3d>(H_);
  } else {
    H_ = with_sizes_of_curvature<SmallMatrix>(H_);
  }
}

bool PoseProgram::minimize() noexcept {
  const auto forms = forms_.topLeftCorner(g_.size(), count());
  ConvexQp::Status status = qp_.minimize(H_, g_, forms, lower_.data(), upper_.data());
  exact_ = status != ConvexQp::Status::kNotConvex;
  if (!exact_ && stiffen(forms)) {
    exact_ = true;
    status = ConvexQp::Status::kOptimal;
  } else if (!exact_) {
    convexify();
    status = qp_.minimize(H_, g_, forms, lower_.data(), upper_.data());
  }
  if (status == ConvexQp::Status::kOptimal) {
    z_ = qp_.x();
    remember_multipliers();
    return true;
  }
  return status == ConvexQp::Status::kInfeasible && relax();
}

// Where no step keeps all inequalities: one more variable t >= 0 that they may all fall short by,
// at a price.
bool PoseProgram::relax() noexcept {
  const Eigen::Index n = joints_;
  const Eigen::Index k = g_.size();
  const Eigen::Index count = this->count();
  if (k + 1 > kMaxDof || k + 1 > forms_.rows()) {
    return false;
  }
  SmallMatrix H = SmallMatrix::Zero(k + 1, k + 1);
  H.topLeftCorner(k, k) = H_;
  const double price = std::max(10.0 * penalty_, 100.0 * (1.0 + g_.cwiseAbs().maxCoeff()));
  H(k, k) = 1e-3 * price;
  SmallVector g(k + 1);
  g << g_, price;
  forms_.row(k).head(n).setZero();
  forms_.row(k).segment(n, count - n).setOnes();
  forms_.col(count).head(k).setZero();
  forms_(k, count) = 1.0;
  lower_[count] = 0.0;
  upper_[count] = std::numeric_limits<double>::infinity();
  const auto forms = forms_.topLeftCorner(k + 1, count + 1);
  if (qp_.minimize(H, g, forms, lower_.data(), upper_.data()) != ConvexQp::Status::kOptimal) {
    return false;
  }
  z_ = qp_.x().head(k);
  exact_ = false;
  remember_multipliers();
  return true;
}

void PoseProgram::remember_multipliers() noexcept {
  const auto n = static_cast<int>(joints_);
  mu_.setZero();
  nu_.setZero();
  for (int i = 0; i < qp_.active(); ++i) {
    const ConvexQp::Active active = qp_[i];
    const auto beyond = static_cast<std::size_t>(active.form - n);
    if (active.form < n) {
      nu_[active.form] = active.multiplier;
    } else if (beyond < inequalities_.size()) {
      mu_[inequalities_[beyond]] = active.multiplier;
    }
  }
  // Powell (1978): a multiplier that was large for one step does not hold up all later ones.
  const double needed = 1.5 * mu_.sum();
  penalty_ = std::max({kFirstPenalty, needed, 0.5 * (penalty_ + needed)});
}

double PoseProgram::violation() const noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < inequalities_.size(); ++i) {
    const Eigen::Index column = joints_ + static_cast<Eigen::Index>(i);
    const double along = forms_.col(column).head(z_.size()).dot(z_);
    sum += std::max(0.0, lower_[column] - along);
  }
  return sum;
}

}  // namespace thing_kin
