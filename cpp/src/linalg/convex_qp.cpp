#include "thing_kin/linalg/convex_qp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "thing_kin/core/tolerance.hpp"

namespace thing_kin {

namespace {

// A side counts as kept within this fraction of the numbers it is made of.
constexpr double kKept = 64 * kEpsilon;

// Where more sides meet than there are variables, rounding makes them miss each other: what can't
// be kept within this fraction is infeasible, what can counts as kept.
constexpr double kMissed = 1e-10;

// What is left of a form beside the active ones is rounding below this fraction.
constexpr double kDependent = 1e-12;

// Cholesky's L^-T of H, upper triangular; false if H is not positive definite.
bool inverse_factor(const SmallMatrix& H, SmallMatrix& J) noexcept {
  const Eigen::Index k = H.rows();
  SmallMatrix L(k, k);
  double largest = 0.0;
  for (Eigen::Index i = 0; i < k; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      double sum = H(i, j);
      for (Eigen::Index m = 0; m < j; ++m) {
        sum -= L(i, m) * L(j, m);
      }
      if (i == j) {
        largest = std::max(largest, H(i, i));
        if (!(sum > kEpsilon * largest)) {
          return false;
        }
        L(i, i) = std::sqrt(sum);
      } else {
        L(i, j) = sum / L(j, j);
      }
    }
  }
  J.setZero(k, k);
  for (Eigen::Index c = 0; c < k; ++c) {  // column c of L^-1 is row c of J
    J(c, c) = 1.0 / L(c, c);
    for (Eigen::Index i = c + 1; i < k; ++i) {
      double sum = 0.0;
      for (Eigen::Index m = c; m < i; ++m) {
        sum -= L(i, m) * J(c, m);
      }
      J(c, i) = sum / L(i, i);
    }
  }
  return true;
}

// The rotation that makes (a, b) into (r, 0).
struct Rotation {
  double c, s, r;
  Rotation(double a, double b) noexcept : r(std::hypot(a, b)) {
    c = r > 0.0 ? a / r : 1.0;
    s = r > 0.0 ? b / r : 0.0;
  }
  void turn(double& a, double& b) const noexcept {
    const double x = c * a + s * b;
    b = c * b - s * a;
    a = x;
  }
};

double dot(const FormsView& forms, int i, const SmallVector& x) noexcept {
  const double* a = forms.data() + i * forms.outerStride();
  double sum = 0.0;
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    sum += a[k] * x[k];
  }
  return sum;
}

}  // namespace

bool ConvexQp::begin(const SmallMatrix& H, const SmallVector& g) noexcept {
  active_ = 0;
  iterations_ = 0;
  slack_ = kKept;
  const Eigen::Index k = g.size();
  R_.resize(k, k);
  u_.resize(k);
  d_.resize(k);
  x_ = SmallVector::Zero(k);
  if (!inverse_factor(H, J_)) {
    return false;
  }
  for (Eigen::Index c = 0; c < k; ++c) {
    double along = 0.0;
    for (Eigen::Index i = 0; i <= c; ++i) {
      along += J_(i, c) * g[i];
    }
    for (Eigen::Index i = 0; i <= c; ++i) {
      x_[i] -= along * J_(i, c);
    }
  }
  return true;
}

// The most violated side, and by how much; equalities first. 0 if all are kept. What is active is
// kept but for rounding.
double ConvexQp::violation(const FormsView& forms, const double* lower, const double* upper,
                           Side& side) const noexcept {
  double most = 0.0;
  bool equality = false;
  const double size = 1.0 + x_.cwiseAbs().maxCoeff();
  for (int i = 0; i < static_cast<int>(forms.cols()); ++i) {
    const double value = dot(forms, i, x_);
    const bool below = value < lower[i];
    const double out = below ? lower[i] - value : value - upper[i];
    if (!(out > 0.0)) {
      continue;
    }
    const double bound = std::abs(below ? lower[i] : upper[i]);
    const bool fixed = lower[i] == upper[i];
    const bool worse = fixed == equality ? out > most : fixed;
    if (worse && out > slack_ * (bound + size) && !holds(i)) {
      most = out;
      equality = fixed;
      side = {i, below ? 1.0 : -1.0, fixed};
    }
  }
  return most;
}

bool ConvexQp::holds(int form) const noexcept {
  const auto* const end = sides_.begin() + active_;
  return std::any_of(sides_.begin(), end, [&](const Side& side) { return side.form == form; });
}

// Moves x and the multipliers until the side is kept, dropping what blocks on the way.
ConvexQp::Status ConvexQp::take_in(const FormsView& forms, const Side& side,
                                   double short_of) noexcept {
  const Eigen::Index k = x_.size();
  const double* a = forms.data() + side.form * forms.outerStride();
  double multiplier = 0.0;
  while (++iterations_ <= most_) {
    double all = 0.0;
    double left = 0.0;  // squared, of the form beside the active ones
    for (Eigen::Index c = 0; c < k; ++c) {
      double sum = 0.0;
      for (Eigen::Index i = 0; i < k; ++i) {
        sum += J_(i, c) * a[i];
      }
      d_[c] = side.sign * sum;
      all += sum * sum;
      left += c < active_ ? 0.0 : sum * sum;
    }
    SmallVector r = d_.head(active_);  // how the multipliers give way
    for (int i = active_ - 1; i >= 0; --i) {
      for (int j = i + 1; j < active_; ++j) {
        r[i] -= R_(i, j) * r[j];
      }
      r[i] /= R_(i, i);
    }
    double dual = std::numeric_limits<double>::infinity();
    int block = -1;
    for (int i = 0; i < active_; ++i) {
      if (!sides_[static_cast<std::size_t>(i)].equality && r[i] > 0.0 && u_[i] < dual * r[i]) {
        dual = u_[i] / r[i];
        block = i;
      }
    }
    const bool dependent = active_ == k || left <= kDependent * kDependent * all;
    if (dependent && block < 0) {
      const double missed = short_of / (1.0 + x_.cwiseAbs().maxCoeff());
      slack_ = std::max(slack_, 2.0 * missed);
      return missed <= kMissed ? Status::kOptimal : Status::kInfeasible;
    }
    const double primal = dependent ? std::numeric_limits<double>::infinity() : short_of / left;
    const double step = std::min(primal, dual);
    for (int i = 0; i < active_; ++i) {
      u_[i] -= step * r[i];
    }
    multiplier += step;
    if (!dependent) {
      for (Eigen::Index c = active_; c < k; ++c) {
        for (Eigen::Index i = 0; i < k; ++i) {
          x_[i] += step * d_[c] * J_(i, c);
        }
      }
      short_of -= step * left;
    }
    if (primal <= dual) {
      append(side, multiplier);
      return Status::kOptimal;
    }
    drop(block);
  }
  return Status::kIterations;
}

// d = J^T a becomes the last column of R; rotations of J make its rest zero.
void ConvexQp::append(const Side& side, double multiplier) noexcept {
  const Eigen::Index k = x_.size();
  for (Eigen::Index c = k - 1; c > active_; --c) {
    const Rotation rotation(d_[c - 1], d_[c]);
    for (Eigen::Index i = 0; i < k; ++i) {
      rotation.turn(J_(i, c - 1), J_(i, c));
    }
    d_[c - 1] = rotation.r;
  }
  for (int i = 0; i <= active_; ++i) {
    R_(i, active_) = d_[i];
  }
  sides_[static_cast<std::size_t>(active_)] = side;
  u_[active_] = multiplier;
  ++active_;
}

void ConvexQp::drop(int i) noexcept {
  const Eigen::Index k = x_.size();
  for (int c = i; c + 1 < active_; ++c) {
    const auto at = static_cast<std::size_t>(c);
    sides_[at] = sides_[at + 1];
    u_[c] = u_[c + 1];
    for (int j = 0; j <= c + 1; ++j) {
      R_(j, c) = R_(j, c + 1);
    }
    const Rotation rotation(R_(c, c), R_(c + 1, c));
    R_(c, c) = rotation.r;
    for (int j = c + 2; j < active_; ++j) {  // still at their old places
      rotation.turn(R_(c, j), R_(c + 1, j));
    }
    for (Eigen::Index j = 0; j < k; ++j) {
      rotation.turn(J_(j, c), J_(j, c + 1));
    }
  }
  --active_;
}

ConvexQp::Active ConvexQp::operator[](int i) const {
  const Side& side = sides_[static_cast<std::size_t>(i)];
  return {side.form, side.sign * u_[i]};
}

ConvexQp::Status ConvexQp::minimize(const SmallMatrix& H, const SmallVector& g,
                                    const FormsView& forms, const double* lower,
                                    const double* upper) noexcept {
  if (!begin(H, g)) {
    return Status::kNotConvex;
  }
  most_ = 10 * static_cast<int>(forms.cols() + g.size()) + 20;
  Side side{};
  double short_of = violation(forms, lower, upper, side);
  while (short_of > 0.0) {
    const Status status = take_in(forms, side, short_of);
    if (status != Status::kOptimal) {
      return status;
    }
    short_of = violation(forms, lower, upper, side);
  }
  return Status::kOptimal;
}

}  // namespace thing_kin
