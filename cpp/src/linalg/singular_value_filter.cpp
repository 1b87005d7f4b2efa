#include "thing_kin/linalg/singular_value_filter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "thing_kin/core/error.hpp"

namespace thing_kin {

namespace {

// h' is smallest at s*, where (2s + nu)/(s^2 + nu s + 2)^2 peaks.
bool is_increasing(double sigma0, double nu) {
  const double s = nu < std::numbers::sqrt2
                       ? std::max(0.0, (std::sqrt(24.0 - 3.0 * nu * nu) - 3.0 * nu) / 6.0)
                       : 0.0;
  const double denominator = s * s + nu * s + 2.0;
  return 2.0 * sigma0 * (2.0 * s + nu) <= denominator * denominator;
}

}  // namespace

SingularValueFilter::SingularValueFilter(double sigma0, double nu) : sigma0_(sigma0), nu_(nu) {
  if (!(std::isfinite(sigma0) && sigma0 >= 0.0)) {
    throw InvalidArgument("sigma0", text(sigma0), "a finite number >= 0");
  }
  if (!(std::isfinite(nu) && nu >= 0.0)) {
    throw InvalidArgument("nu", text(nu), "a finite number >= 0");
  }
  if (!is_increasing(sigma0, nu)) {
    throw InvalidArgument(
        "sigma0", text(sigma0) + " with nu = " + text(nu) + ", a filter that is not increasing",
        "a smaller sigma0");
  }
}

double SingularValueFilter::operator()(double s) const {
  // s + 2 s0/(...) is (4.12) divided out: nothing overflows, and h(s) > s shows.
  return s + 2.0 * sigma0_ / (s * s + nu_ * s + 2.0);
}

void SingularValueFilter::apply(Svd& svd) const noexcept {
  for (double& s : svd.sigma) {
    s = (*this)(s);
  }
  if (sigma0_ > 0.0) {
    svd.rank = static_cast<int>(svd.sigma.size());
  }
}

SmallMatrix filter_singular_values(const SmallMatrix& A,
                                   const SingularValueFilter& filter) noexcept {
  Svd svd;
  decompose(A, svd);
  filter.apply(svd);
  return svd.u * svd.sigma.asDiagonal() * svd.thin_v().transpose();
}

}  // namespace thing_kin
