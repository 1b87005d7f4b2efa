#include "thing_kin/kinematics/log_dexterity.hpp"

#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "thing_kin/core/tolerance.hpp"

namespace thing_kin {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Columns = Jacobian;

// Two eigenvalues nearer than this fraction count as this far apart.
constexpr double kLeastGap = 1e-8;

// Joints in chain order, and which of them change the singular values at all.
struct Order {
  std::array<int, kMaxDof> index;  // in q
  int count = 0;
  int first = 0;  // all before it move the whole robot without change of J W J^T
};

// Shifts of the whole robot leave J as it is; a turn of all of it turns J J^T, unless columns of
// joints before it don't turn with it. Those of a base with equal weights on x and y do not show.
Order order_of(const Chain& chain, const double* weights) noexcept {
  Order order;
  const auto joints = chain.joints();
  const auto weight = [&](int i) { return weights == nullptr ? 1.0 : weights[i]; };
  for (const Chain::Joint& joint : joints) {
    order.index[static_cast<std::size_t>(order.count++)] = joint.index;
  }
  while (order.first < order.count &&
         joints[static_cast<std::size_t>(order.first)].type == JointType::kPrismatic) {
    ++order.first;
  }
  const auto& base = chain.base_joints();
  const bool symmetric_base = base && order.first == 2 && weight((*base)[0]) == weight((*base)[1]);
  if (order.first < order.count && (order.first == 0 || symmetric_base)) {
    ++order.first;
  }
  return order;
}

Columns weighted(const Jacobian& J, const double* weights) noexcept {
  Columns out = J;
  for (Eigen::Index i = 0; weights != nullptr && i < J.cols(); ++i) {
    out.col(i) *= weights[i];
  }
  return out;
}

// The eigenvalues of J W J^T, falling, and their vectors.
struct Spectrum {
  Vector6 lambda;
  Matrix6 u;
  bool regular = false;
};

void decompose(const Columns& J, Spectrum& spectrum) noexcept {
  Matrix6 A;
  A.noalias() = J * J.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(A);
  spectrum.lambda = solver.eigenvalues().reverse();
  spectrum.u = solver.eigenvectors().rowwise().reverse();
  spectrum.regular = spectrum.lambda[5] > 6 * kEpsilon * spectrum.lambda[0];
}

void set_values(const Vector6& lambda, const DexterityWeights& weights,
                LogDexterity& out) noexcept {
  out.log_condition_number = 0.5 * std::log(lambda[0] / lambda[5]);
  out.log_manipulability = 0.5 * std::log(lambda.prod());
  out.value = weights.condition_number * out.log_condition_number -
              weights.manipulability * out.log_manipulability;
}

// sum_m P_m . d^2 J_m / dq_k dq_l for all k <= l in chain order: P fixed covectors, one a column.
//
// Position: the third derivative of p by a <= b <= c is w_a x (w_b x v_c). Axis: that of w_m by
// k <= l < m is w_k x (w_l x w_m), and zero else. x . (a x (b x c)) is linear in each: sums over m
// are collected in running 3 x 3 matrices.
class SecondDerivative {
 public:
  SecondDerivative(const Jacobian& J, const Columns& P, const Order& order) noexcept
      : J_(J), order_(order) {
    const int n = order.count;
    Matrix3d outer = Matrix3d::Zero();
    for (int m = n - 1; m >= 0; --m) {
      const Vector3d force = P.col(at(m)).head<3>();
      const Vector3d torque = P.col(at(m)).tail<3>();
      add(v(m), force, outer);
      outer_[static_cast<std::size_t>(m)] = outer;  // w_m itself turns by joints before it only
      add(w(m), torque, outer);
    }
    Matrix3d between = Matrix3d::Zero();
    Vector3d inner = Vector3d::Zero();
    for (int m = 0; m < n; ++m) {
      between_[static_cast<std::size_t>(m)] = between;
      inner_[static_cast<std::size_t>(m)] = inner;
      const Vector3d force = P.col(at(m)).head<3>();
      between += force.dot(w(m)) * Matrix3d::Identity() - w(m) * force.transpose();
      inner += force.cross(w(m));
    }
  }

  double operator()(int k, int l) const noexcept {
    const auto i = static_cast<std::size_t>(k);
    const auto j = static_cast<std::size_t>(l);
    const Vector3d far = outer_[j] * w(l) + (between_[j] - between_[i]) * v(l);
    return w(k).dot(far) + inner_[i].dot(w(k).cross(v(l)));
  }

 private:
  int at(int m) const { return order_.index[static_cast<std::size_t>(m)]; }
  Vector3d v(int m) const { return J_.col(at(m)).head<3>(); }
  Vector3d w(int m) const { return J_.col(at(m)).tail<3>(); }

  // x . (a x (b x c)) = a^T (c x^T - (x . c) I) b.
  static void add(const Vector3d& c, const Vector3d& x, Matrix3d& sum) {
    sum += c * x.transpose();
    sum.diagonal().array() -= x.dot(c);
  }

  const Jacobian& J_;
  const Order& order_;
  std::array<Matrix3d, kMaxDof> outer_, between_;
  std::array<Vector3d, kMaxDof> inner_;
};

// dJ/dq_k, world-aligned: an inner joint turns everything further out; an outer one moves the
// point.
void differentiate(const Jacobian& J, const Order& order, int k, const double* weights,
                   Columns& out) noexcept {
  const int at_k = order.index[static_cast<std::size_t>(k)];
  const Vector3d vk = J.col(at_k).head<3>();
  const Vector3d wk = J.col(at_k).tail<3>();
  out.resize(6, J.cols());
  for (int m = 0; m < order.count; ++m) {
    const int at = order.index[static_cast<std::size_t>(m)];
    const double weight = weights == nullptr ? 1.0 : weights[at];
    const Vector3d v = J.col(at).head<3>();
    const Vector3d w = J.col(at).tail<3>();
    if (m < k) {
      out.col(at).head<3>() = weight * w.cross(vk);
      out.col(at).tail<3>().setZero();
    } else {
      out.col(at).head<3>() = weight * wk.cross(v);
      out.col(at).tail<3>() = weight * wk.cross(w);
    }
  }
}

// What the eigenvalues do as one joint moves: turned = U^T dJ, rate = U^T dA U.
struct Rate {
  Columns turned;
  Matrix6 rate;
};

// c_i = value of d(sum)/d(log l_i): sum = w_kappa log kappa - w_M log M.
Vector6 shares(const DexterityWeights& weights) noexcept {
  Vector6 c = Vector6::Constant(-0.5 * weights.manipulability);
  c[0] += 0.5 * weights.condition_number;
  c[5] -= 0.5 * weights.condition_number;
  return c;
}

// Of -log det (all together, no gaps) and of l_1 and l_6 (each with the gaps to the others): what
// the second derivative has beyond that of A.
double curvature(const Spectrum& s, const DexterityWeights& weights, const Matrix6& Mk,
                 const Matrix6& Ml) noexcept {
  const Vector6 inverse = s.lambda.cwiseInverse();
  const Matrix6 both = Mk.cwiseProduct(Ml);
  double sum = 0.5 * weights.manipulability * inverse.dot(both * inverse);
  for (const Eigen::Index i : {Eigen::Index{0}, Eigen::Index{5}}) {
    double second = 0.0;
    for (Eigen::Index j = 0; j < 6; ++j) {
      const double gap = std::max(std::abs(s.lambda[i] - s.lambda[j]), kLeastGap * s.lambda[i]);
      second += j == i ? 0.0 : 2.0 * both(i, j) / gap;
    }
    const double square = both(i, i) * inverse[i] * inverse[i];
    sum += 0.5 * weights.condition_number *
           (i == 0 ? second * inverse[0] - square : second * inverse[5] + square);
  }
  return sum;
}

}  // namespace

double log_dexterity(const Jacobian& J, const double* column_weights) noexcept {
  const Columns columns = weighted(J, column_weights);
  Matrix6 A;
  A.noalias() = columns * columns.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(A, Eigen::EigenvaluesOnly);
  const Vector6 lambda = solver.eigenvalues();  // rising
  if (!(lambda[0] > 6 * kEpsilon * lambda[5])) {
    return std::numeric_limits<double>::infinity();
  }
  return -0.25 * std::log(lambda.head<5>().prod() * lambda[0]);
}

bool log_dexterity(const Chain& chain, const Jacobian& J, const double* column_weights,
                   LogDexterity& out, const DexterityWeights& weights) noexcept {
  const Columns columns = weighted(J, column_weights);
  Spectrum s;
  decompose(columns, s);
  if (!s.regular) {
    out.value = std::numeric_limits<double>::infinity();
    return false;
  }
  set_values(s.lambda, weights, out);
  const Order order = order_of(chain, column_weights);
  const Columns B = s.u.transpose() * columns;
  const Vector6 share = shares(weights).cwiseQuotient(s.lambda);
  const Eigen::Index n = J.cols();
  out.gradient = JointVector::Zero(n);
  out.hessian = SmallMatrix::Zero(n, n);

  std::array<Rate, kMaxDof> rates;
  for (int k = order.first; k < order.count; ++k) {
    Rate& rate = rates[static_cast<std::size_t>(k)];
    Columns derivative;
    differentiate(J, order, k, column_weights, derivative);
    rate.turned.noalias() = s.u.transpose() * derivative;
    rate.rate.noalias() = rate.turned * B.transpose();
    rate.rate += rate.rate.transpose().eval();
    out.gradient[order.index[static_cast<std::size_t>(k)]] = share.dot(rate.rate.diagonal());
  }

  // sum_i share_i u_i^T d^2A u_i = 2 (P . d^2J) + 2 sum_i share_i (U^T dJ_k)_i . (U^T dJ_l)_i.
  Columns P = s.u * (share.asDiagonal() * B);
  for (Eigen::Index i = 0; column_weights != nullptr && i < n; ++i) {
    P.col(i) *= column_weights[i];
  }
  const SecondDerivative second(J, P, order);
  for (int k = order.first; k < order.count; ++k) {
    const Rate& at_k = rates[static_cast<std::size_t>(k)];
    const Columns scaled = share.asDiagonal() * at_k.turned;
    for (int l = k; l < order.count; ++l) {
      const Rate& at_l = rates[static_cast<std::size_t>(l)];
      const double value = 2.0 * (second(k, l) + scaled.cwiseProduct(at_l.turned).sum()) +
                           curvature(s, weights, at_k.rate, at_l.rate);
      const int i = order.index[static_cast<std::size_t>(k)];
      const int j = order.index[static_cast<std::size_t>(l)];
      out.hessian(i, j) = value;
      out.hessian(j, i) = value;
    }
  }
  return true;
}

}  // namespace thing_kin
