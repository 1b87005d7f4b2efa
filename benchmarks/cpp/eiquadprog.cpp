// eiquadprog's fastest class, with its workspace kept.

#include <eiquadprog/eiquadprog-fast.hpp>

#include "quadratic_program.hpp"

namespace {

struct Fast {
  eiquadprog::solvers::EiquadprogFast solver;
  Eigen::MatrixXd H, CE, CI;
  Eigen::VectorXd g, ce, ci, x;

  Fast() : CI(18, 9), ci(18), x(9) {
    solver.reset(9, 6, 18);
    CI.topRows(9).setIdentity();
    CI.bottomRows(9) = -CI.topRows(9);
    ci.setConstant(bench::QuadraticProgram::kSide);
  }

  const Eigen::VectorXd& operator()(const bench::QuadraticProgram& program) {
    H = program.H;
    g = program.g;
    CE = program.A;
    ce = -program.b;
    solver.solve_quadprog(H, g, CE, ce, CI, ci, x);
    return x;
  }
};

[[maybe_unused]] const bool entered = bench::enter(
    "qp_9_6_18", "eiquadprog",
    [solver = Fast()](const bench::Problem::Input& input) mutable {
      return Eigen::VectorXd(solver(bench::QuadraticProgram(input)));
    },
    bench::as_it_is);

}  // namespace
