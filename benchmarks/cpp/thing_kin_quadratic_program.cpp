// The equations eliminated by a QR factorization, then three variables: as plan_pose does it.

#include <array>

#include "quadratic_program.hpp"
#include "thing_kin/linalg/convex_qp.hpp"
#include "thing_kin/linalg/row_qr.hpp"

namespace {

using namespace thing_kin;

struct Eliminated {
  RowQr rows;
  ConvexQp qp;
  SmallMatrix Z;

  JointVector operator()(const bench::QuadraticProgram& program) {
    rows.factor(program.A);
    rows.null_space(Z);
    Vector6 y = program.b;
    rows.solve_r_transposed(y.data());
    JointVector x(9);
    rows.lift(y.data(), x.data());
    const SmallMatrix HZ = program.H.lazyProduct(Z);
    const SmallMatrix H = Z.transpose().lazyProduct(HZ);
    const JointVector pull = program.g + program.H.lazyProduct(x);
    const SmallVector g = Z.transpose().lazyProduct(pull);
    std::array<double, 9> lower;
    std::array<double, 9> upper;
    for (Eigen::Index j = 0; j < 9; ++j) {
      lower[static_cast<std::size_t>(j)] = -bench::QuadraticProgram::kSide - x[j];
      upper[static_cast<std::size_t>(j)] = bench::QuadraticProgram::kSide - x[j];
    }
    const SmallMatrix forms = Z.transpose();
    qp.minimize(H, g, forms, lower.data(), upper.data());
    return x + Z.lazyProduct(qp.x());
  }
};

[[maybe_unused]] const bool entered = bench::enter(
    "qp_9_6_18", "thing_kin",
    [solver = Eliminated()](const bench::Problem::Input& input) mutable {
      return solver(bench::QuadraticProgram(input));
    },
    bench::as_it_is);

}  // namespace
