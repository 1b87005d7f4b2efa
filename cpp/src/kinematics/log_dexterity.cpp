#include "thing_kin/kinematics/log_dexterity.hpp"

#include <array>
#include <cmath>

#include "kernels/kernels.hpp"

namespace thing_kin {

namespace {

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

bool is_regular(const std::array<double, 3>& values) noexcept {
  return values[1] > DexterityArguments::kSingular * values[0];
}

DexterityArguments arguments_of(const Jacobian& J, const Order& order, const double* columns,
                                const DexterityWeights& weights) noexcept {
  return {J.data(),
          order.index.data(),
          order.count,
          order.first,
          columns,
          weights.condition_number,
          weights.manipulability,
          static_cast<int>(J.cols())};
}

bool summarize_values(const std::array<double, 3>& values, const DexterityWeights& weights,
                      LogDexterity& out) noexcept {
  if (!is_regular(values)) {
    out.value = kInfinity;
    return false;
  }
  out.log_condition_number = 0.5 * std::log(values[0] / values[1]);
  out.log_manipulability = 0.5 * std::log(values[2]);
  out.value = weights.condition_number * out.log_condition_number -
              weights.manipulability * out.log_manipulability;
  return true;
}

double value_by(void (*spectrum)(const DexterityArguments&, double*) noexcept, const Jacobian& J,
                const double* column_weights) noexcept {
  std::array<int, kMaxDof> order;
  const auto n = static_cast<int>(J.cols());
  for (int i = 0; i < n; ++i) {
    order[static_cast<std::size_t>(i)] = i;
  }
  std::array<double, 3> values;
  spectrum({J.data(), order.data(), n, n, column_weights, 0.5, 0.5, kMaxDof}, values.data());
  return is_regular(values) ? 0.25 * std::log(values[0] / (values[1] * values[2])) : kInfinity;
}

}  // namespace

double log_dexterity(const Jacobian& J, const double* column_weights) noexcept {
  return value_by(kernels().dexterity_spectrum, J, column_weights);
}

double log_dexterity_bound(const Jacobian& J, const double* column_weights) noexcept {
  return value_by(kernels().dexterity_bounds, J, column_weights);
}

bool log_dexterity(const Chain& chain, const Jacobian& J, const double* column_weights,
                   LogDexterity& out, const DexterityWeights& weights) noexcept {
  const Order order = order_of(chain, column_weights);
  const Eigen::Index n = J.cols();
  out.gradient.setZero(n);
  out.hessian.setZero(n, n);
  std::array<double, 3> values;
  kernels().log_dexterity(arguments_of(J, order, column_weights, weights), values.data(),
                          out.gradient.data(), out.hessian.data());
  return summarize_values(values, weights, out);
}

bool log_dexterity_along(const Chain& chain, const Jacobian& J, const SmallMatrix& Z,
                         const double* column_weights, LogDexterity& out,
                         const DexterityWeights& weights) noexcept {
  const Order order = order_of(chain, column_weights);
  const Eigen::Index k = Z.cols();
  out.gradient.setZero(J.cols());
  out.hessian.setZero(k, k);
  std::array<double, 3> values;
  kernels().log_dexterity_along(arguments_of(J, order, column_weights, weights), Z.data(),
                                static_cast<int>(k), values.data(), out.gradient.data(),
                                out.hessian.data());
  return summarize_values(values, weights, out);
}

}  // namespace thing_kin
