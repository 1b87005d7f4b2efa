#include "thing_kin/linalg/pseudoinverse.hpp"

#include "thing_kin/linalg/minimum_norm.hpp"

namespace thing_kin {

SmallVector exact_gains(const Svd& svd) noexcept {
  SmallVector gains = SmallVector::Zero(svd.sigma.size());
  gains.head(svd.rank) = svd.sigma.head(svd.rank).cwiseInverse();
  return gains;
}

SmallVector damped_gains(const Svd& svd, double lambda) noexcept {
  return damped_gains(svd, SmallVector::Constant(svd.sigma.size(), lambda));
}

SmallVector damped_gains(const Svd& svd, const SmallVector& lambda) noexcept {
  SmallVector gains = exact_gains(svd);
  for (Eigen::Index i = 0; i < gains.size(); ++i) {
    if (lambda[i] > 0.0) {  // sigma/(sigma^2 + lambda), without the square that could overflow
      gains[i] = svd.sigma[i] > 0.0 ? 1.0 / (svd.sigma[i] + lambda[i] / svd.sigma[i]) : 0.0;
    }
  }
  return gains;
}

SmallMatrix exact_pseudoinverse(const SmallMatrix& A) noexcept {
  MinimumNorm regular;
  if (regular.factor(A)) {
    return regular.pseudoinverse();
  }
  Svd svd;
  decompose(A, svd);
  return pseudoinverse(svd, exact_gains(svd));
}

JointVector minimum_norm_solution(const SmallMatrix& A, const SmallVector& e) noexcept {
  MinimumNorm regular;
  if (regular.factor(A)) {
    return regular.solve(e);
  }
  Svd svd;
  decompose(A, svd);
  return apply_pseudoinverse(svd, exact_gains(svd), e);
}

SmallMatrix pseudoinverse(const Svd& svd, const SmallVector& gains) noexcept {
  const SmallMatrix scaled = svd.thin_v() * gains.asDiagonal();
  return scaled * svd.u.transpose();
}

JointVector apply_pseudoinverse(const Svd& svd, const SmallVector& gains,
                                const SmallVector& e) noexcept {
  const SmallVector along = svd.u.transpose() * e;
  return svd.thin_v() * gains.cwiseProduct(along);
}

}  // namespace thing_kin
