#include "thing_kin/kinematics/damped_inverse.hpp"

#include "kernels/kernels.hpp"

namespace thing_kin {

namespace {

using Padded = Eigen::Matrix<double, 4, 3>;

}  // namespace

static_assert(sizeof(RowFactors) == 24 * sizeof(double));

void RowFactors::set(const Eigen::Matrix3d& of_linear, const Eigen::Matrix3d& of_angular) noexcept {
  Eigen::Map<Padded>(linear.data()).topRows<3>() = of_linear;
  Eigen::Map<Padded>(angular.data()).topRows<3>() = of_angular;
}

RowFactors RowFactors::transposed() const noexcept {
  RowFactors result;
  result.set(Eigen::Map<const Padded>(linear.data()).topRows<3>().transpose(),
             Eigen::Map<const Padded>(angular.data()).topRows<3>().transpose());
  return result;
}

Vector6 RowFactors::operator*(const Vector6& c) const noexcept {
  Vector6 product;
  product << Eigen::Map<const Padded>(linear.data()).topRows<3>() * c.head<3>(),
      Eigen::Map<const Padded>(angular.data()).topRows<3>() * c.tail<3>();
  return product;
}

void damped_inverse(const Jacobian& J, const RowFactors& M, const double* mobility, double lambda,
                    const Vector6& e, double* dq) noexcept {
  kernels().damped_inverse(J.data(), mobility, static_cast<int>(J.cols()), M.linear.data(), lambda,
                           e.data(), dq);
}

}  // namespace thing_kin
