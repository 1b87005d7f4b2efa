#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "path_maps.hpp"
#include "path_solver.hpp"
#include "thing_kin/kinematics/log_dexterity.hpp"
#include "thing_kin/kinematics/pose_curvature.hpp"
#include "thing_kin/linalg/row_qr.hpp"

namespace thing_kin {

using namespace path;

// Null spaces, the objective's derivatives.
void PathSolver::linearize() noexcept {
  for (int k = 0; k < count(); ++k) {
    linearize_waypoint(k);
  }
  for (int k = 0; k < count(); ++k) {
    Vector g(gradient_.data() + k * n_, n_);
    g = problem_.dexterity_weight * ConstVector(dexterity_gradient_.data() + k * n_, n_);
    if (k > 0) {
      g += square_weights_.cwiseProduct(ConstVector(q(k), n_) - ConstVector(q(k - 1), n_));
    } else if (has_origin_) {
      g += square_weights_.cwiseProduct(ConstVector(q(k), n_) - origin_);
    }
    if (k + 1 < count()) {
      g -= square_weights_.cwiseProduct(ConstVector(q(k + 1), n_) - ConstVector(q(k), n_));
    }
  }
}

void PathSolver::linearize_waypoint(int k) noexcept {
  const Chain& chain = problem_.chain();
  place_joints(chain, q(k), postures_[index(k)]);
  Jacobian& J = J_[index(k)];
  geometric_jacobian(chain, postures_[index(k)], problem_.frame(), ReferenceFrame::kWorldAligned,
                     J);
  SmallMatrix A = J;
  RowQr qr;
  qr.factor(A);
  SmallMatrix null;
  qr.null_space(null);
  Matrix(Z_.data() + k * n_ * m_, n_, m_) = null;
  Vector g(dexterity_gradient_.data() + k * n_, n_);
  Matrix H(dexterity_hessian_.data() + k * n_ * n_, n_, n_);
  LogDexterity dexterity;
  if (problem_.dexterity_weight > 0.0 &&
      log_dexterity(chain, J, problem_.column_weights.data(), dexterity) &&
      dexterity.value < kWorstDexterity) {
    g = dexterity.gradient;
    H = dexterity.hessian;
  } else {
    g.setZero();
    H.setZero();
  }
}

// H, g and E of the joints' steps, and g of the dexterity.
void PathSolver::add_objective() noexcept {
  for (int k = fixed_; k < count(); ++k) {
    const ConstMatrix Zk(basis(k), n_, m_);
    Vector(qp_.g(stage(k)), m_) =
        Zk.transpose().lazyProduct(ConstVector(gradient_.data() + k * n_, n_));
    const int sides = (k > 0 || has_origin_ ? 1 : 0) + (k + 1 < count() ? 1 : 0);
    for (int a = 0; a < m_; ++a) {
      for (int b = 0; b < m_; ++b) {
        double same = 0.0;
        double next = 0.0;
        for (int j = 0; j < n_; ++j) {
          const double left = square_weights_[j] * basis(k)[a * n_ + j];
          same += left * basis(k)[b * n_ + j];
          next += k + 1 < count() ? left * basis(k + 1)[b * n_ + j] : 0.0;
        }
        qp_.block(stage(k))[b * m_ + a] = sides * same;
        qp_.coupling(stage(k))[b * m_ + a] = -next;
      }
    }
  }
}

void PathSolver::project(int k, const SmallMatrix& H, double* out, bool convex) const noexcept {
  const ConstMatrix Zk(basis(k), n_, m_);
  SmallMatrix HZ(n_, m_);
  HZ.noalias() = H.lazyProduct(Zk);
  SmallMatrix block(m_, m_);
  block.noalias() = Zk.transpose().lazyProduct(HZ);
  if (convex) {
    const Eigen::SelfAdjointEigenSolver<SmallMatrix> eigen(block);
    const SmallVector values = eigen.eigenvalues().cwiseMax(0.0);
    block = eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
  }
  Matrix(out, m_, m_) += 0.5 * (block + block.transpose());
}

// Second derivatives of the Lagrangian beyond those of the joints' steps: dexterity, constraints by
// their multipliers, the poses by theirs.
void PathSolver::add_curvature(bool convex) noexcept {
  const Chain& chain = problem_.chain();
  std::size_t next = 0;
  SmallMatrix H(n_, n_);
  for (int k = 0; k < count(); ++k) {
    if (k >= fixed_) {
      H = problem_.dexterity_weight * ConstMatrix(dexterity_hessian_.data() + k * n_ * n_, n_, n_);
      const Jacobian& J = J_[index(k)];
      Matrix6 gram;
      gram.noalias() = J.lazyProduct(J.transpose());
      gram.diagonal().array() += kGramDamping;
      const Vector6 right = J.lazyProduct(ConstVector(lagrangian_.data() + k * n_, n_));
      const Vector6 y = gram.llt().solve(right);
      if (y.allFinite()) {
        add_pose_curvature(chain, J, -y, H);
      }
      const double z = base_multiplier_[index(k)];
      if (z > 0.0) {
        const auto& base = *chain.base_joints();
        const double r = std::max(problem_.base_radius, kLeastBaseRadius);
        H(base[0], base[0]) += z / r;
        H(base[1], base[1]) += z / r;
      }
    }
    // Those at the waypoint come first, then those of the segment behind it.
    for (; next < points_.size() && points_[next].k == k && points_[next].t < 0.0; ++next) {
      Posture posture;
      place_joints(chain, q(k), posture);
      problem_.clearances().add_hessian(posture, q(k), points_[next].i, -points_[next].z, H);
    }
    if (k >= fixed_) {
      project(k, H, qp_.block(stage(k)), convex);
    }
    for (; next < points_.size() && points_[next].k == k; ++next) {
      add_point_curvature(points_[next], convex);
    }
  }
}

// A clearance's minimum within a segment moves along it: d(q(t)) has the slope s = grad d . dq by
// t, and at the minimum the second derivative is that at fixed t less ds ds^T/(d^2 d/dt^2).
void PathSolver::add_point_curvature(const PointRow& point, bool convex) noexcept {
  const int k = point.k;
  const JointVector dq = ConstVector(q(k + 1), n_) - ConstVector(q(k), n_);
  const JointVector at = ConstVector(q(k), n_) + point.t * dq;
  Posture posture;
  JointVector gradient;
  place_joints(problem_.chain(), at.data(), posture);
  problem_.clearances().gradient(posture, at.data(), point.i, gradient);
  SmallMatrix C = SmallMatrix::Zero(n_, n_);
  problem_.clearances().add_hessian(posture, at.data(), point.i, 1.0, C);
  const JointVector bend = C.lazyProduct(dq);
  const double curvature = dq.dot(bend);
  const double share = curvature > 0.0 ? point.z / curvature : 0.0;
  C *= -point.z;
  SmallMatrix CZ(n_, m_);
  SmallVector slopes[2];
  for (int side = 0; side < 2; ++side) {
    const double part = side == 0 ? 1.0 - point.t : point.t;
    const ConstMatrix Zs(basis(k + side), n_, m_);
    const JointVector ds = part * bend + (side == 0 ? -1.0 : 1.0) * gradient;
    slopes[side] = Zs.transpose().lazyProduct(ds);
    if (k + side < fixed_) {
      continue;
    }
    Matrix H(qp_.block(stage(k + side)), m_, m_);
    H.noalias() += share * slopes[side].lazyProduct(slopes[side].transpose());
    if (!convex) {
      CZ.noalias() = C.lazyProduct(Zs);
      H.noalias() += part * part * Zs.transpose().lazyProduct(CZ);
    }
  }
  if (k >= fixed_) {  // CZ is that of the second side
    Matrix E(qp_.coupling(stage(k)), m_, m_);
    E.noalias() += share * slopes[0].lazyProduct(slopes[1].transpose());
    if (!convex) {
      E.noalias() +=
          point.t * (1.0 - point.t) * ConstMatrix(basis(k), n_, m_).transpose().lazyProduct(CZ);
    }
  }
}

}  // namespace thing_kin
