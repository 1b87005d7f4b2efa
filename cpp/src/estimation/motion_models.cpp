#include "thing_kin/estimation/motion_models.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "thing_kin/core/error.hpp"
#include "thing_kin/lie/se2.hpp"

namespace thing_kin {

namespace {

constexpr std::array<int, 1> kHeading{2};

void check_noise(const VectorView& noise) {
  if (!(noise.allFinite() && (noise.array() >= 0.0).all())) {
    throw InvalidArgument("noise", "a negative number, NaN or infinity", "finite numbers from 0");
  }
}

// Axes that move alike: x, y, z; vx, ...; ax, ...
std::vector<std::string> axis_variables(int dimension, int orders) {
  if (dimension < 1 || dimension > 3) {
    throw InvalidArgument("dimension", std::to_string(dimension), "1, 2 or 3");
  }
  std::vector<std::string> names;
  for (int order = 0; order < orders; ++order) {
    for (int axis = 0; axis < dimension; ++axis) {
      std::string variable(order == 0 ? "" : order == 1 ? "v" : "a");
      names.push_back(variable.append(1, "xyz"[axis]));
    }
  }
  return names;
}

// A polynomial in time for each axis, its highest derivative driven by white noise.
class Polynomial final : public MotionModel {
 public:
  Polynomial(std::string name, int dimension, int orders, double noise)
      : MotionModel(std::move(name), axis_variables(dimension, orders)),
        dimension_(dimension),
        orders_(orders),
        noise_(noise) {
    check_noise(Eigen::Matrix<double, 1, 1>(noise));
  }

  void step(const double* x, double dt, double* out) const noexcept override {
    const std::array<double, 3> factor{1.0, dt, 0.5 * dt * dt};
    for (int order = 0; order < orders_; ++order) {
      for (int axis = 0; axis < dimension_; ++axis) {
        double sum = x[order * dimension_ + axis];
        for (int k = order + 1; k < orders_; ++k) {
          sum += x[k * dimension_ + axis] * factor[static_cast<std::size_t>(k - order)];
        }
        out[order * dimension_ + axis] = sum;
      }
    }
  }

  void jacobian(const double* /*x*/, double dt, double* F) const noexcept override {
    const int n = size();
    std::fill_n(F, n * n, 0.0);
    for (int axis = 0; axis < dimension_; ++axis) {
      for (int order = 0; order < orders_; ++order) {
        double factor = 1.0;
        for (int k = order; k < orders_; ++k) {
          F[(order * dimension_ + axis) * n + k * dimension_ + axis] = factor;
          factor *= dt / (k - order + 1);
        }
      }
    }
  }

  // The integral over s in [0, dt] of g g^T, g_i = s^(p - i)/(p - i)!, p the highest derivative.
  void noise(const double* /*x*/, double dt, double* Q) const noexcept override {
    const int n = size();
    std::fill_n(Q, n * n, 0.0);
    const int p = orders_ - 1;
    constexpr std::array<double, 3> kFactorial{1.0, 1.0, 2.0};
    for (int i = 0; i < orders_; ++i) {
      for (int j = 0; j < orders_; ++j) {
        const int power = 2 * p - i - j + 1;
        const double entry = noise_ * std::pow(dt, power) /
                             (power * kFactorial[static_cast<std::size_t>(p - i)] *
                              kFactorial[static_cast<std::size_t>(p - j)]);
        for (int axis = 0; axis < dimension_; ++axis) {
          Q[(i * dimension_ + axis) * n + j * dimension_ + axis] = entry;
        }
      }
    }
  }

 private:
  int dimension_, orders_;
  double noise_;
};

class ConstantTwist final : public MotionModel {
 public:
  explicit ConstantTwist(const Eigen::Vector3d& noise)
      : MotionModel("constant_twist", {"x", "y", "theta", "vx", "vy", "omega"},
                    AngleSet(kHeading, 6)),
        noise_(noise) {
    check_noise(noise);
  }

  void step(const double* x, double dt, double* out) const noexcept override {
    const Eigen::Map<const Eigen::Vector3d> pose(x);
    const Eigen::Map<const Eigen::Vector3d> twist(x + 3);
    const Pose2 moved = compose(pose, se2_exp(twist * dt));
    const Eigen::Vector3d held = twist;
    Eigen::Map<Eigen::Vector3d>(out).noalias() = moved;
    Eigen::Map<Eigen::Vector3d>(out + 3).noalias() = held;
  }

  // exp(xi + d) = exp(J_l d) exp(xi); in the body's axes at the beginning, exp's translation moves
  // by J_l d's own and by its turn of the way gone.
  void jacobian(const double* x, double dt, double* F) const noexcept override {
    Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> all(F);
    const double c = std::cos(x[2]);
    const double s = std::sin(x[2]);
    const Eigen::Map<const Eigen::Vector3d> twist(x + 3);
    const Twist2 xi = twist * dt;
    const Pose2 way = se2_exp(xi);
    Eigen::Matrix3d local = se2_left_jacobian(xi);
    local.row(0) -= way.y() * local.row(2);
    local.row(1) += way.x() * local.row(2);
    Eigen::Matrix3d turn;
    turn << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
    all.setIdentity();
    all(0, 2) = -s * way.x() - c * way.y();
    all(1, 2) = c * way.x() - s * way.y();
    all.topRightCorner<3, 3>().noalias() = turn * local * dt;
  }

  void noise(const double* x, double dt, double* Q) const noexcept override {
    Eigen::Map<Eigen::Matrix<double, 6, 6>> all(Q);
    const double c = std::cos(x[2]);
    const double s = std::sin(x[2]);
    Eigen::Matrix3d turn;
    turn << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
    const Eigen::Matrix3d turned = turn * noise_.asDiagonal();
    all.topLeftCorner<3, 3>().noalias() = (dt * dt * dt / 3.0) * turned * turn.transpose();
    all.topRightCorner<3, 3>() = (0.5 * dt * dt) * turned;
    all.bottomLeftCorner<3, 3>() = (0.5 * dt * dt) * turned.transpose();
    all.bottomRightCorner<3, 3>() = (dt * noise_).asDiagonal();
  }

 private:
  Eigen::Vector3d noise_;
};

class Omnidirectional final : public MotionModel {
 public:
  explicit Omnidirectional(const Eigen::Matrix<double, 8, 1>& noise)
      : MotionModel("omnidirectional", {"x", "y", "theta", "vx", "vy", "omega", "ax", "ay"},
                    AngleSet(kHeading, 8)),
        noise_(noise) {
    check_noise(noise);
  }

  void step(const double* x, double dt, double* out) const noexcept override {
    move(Way(x, dt), x, dt, out);
  }

  void jacobian(const double* x, double dt, double* F) const noexcept override {
    differentiate(Way(x, dt), dt, F);
  }

  void linearize(const double* x, double dt, double* out, double* F) const noexcept override {
    const Way way(x, dt);
    differentiate(way, dt, F);
    move(way, x, dt, out);
  }

  void noise(const double* /*x*/, double dt, double* Q) const noexcept override {
    std::fill_n(Q, 64, 0.0);
    for (int i = 0; i < 8; ++i) {
      Q[i * 9] = noise_[i] * dt;
    }
  }

 private:
  // The way gone, in world axes, and the heading at its beginning.
  struct Way {
    Way(const double* x, double dt)
        : c(std::cos(x[2])),
          s(std::sin(x[2])),
          along(x[3] * dt + 0.5 * x[6] * dt * dt),
          across(x[4] * dt + 0.5 * x[7] * dt * dt),
          dx(c * along - s * across),
          dy(s * along + c * across) {}
    double c, s, along, across, dx, dy;
  };

  static void move(const Way& way, const double* x, double dt, double* out) noexcept {
    out[0] = x[0] + way.dx;
    out[1] = x[1] + way.dy;
    out[2] = x[2] + x[5] * dt;
    out[3] = x[3] + x[6] * dt;
    out[4] = x[4] + x[7] * dt;
    out[5] = x[5];
    out[6] = x[6];
    out[7] = x[7];
  }

  static void differentiate(const Way& way, double dt, double* F) noexcept {
    std::fill_n(F, 64, 0.0);
    for (int i = 0; i < 8; ++i) {
      F[i * 9] = 1.0;
    }
    const double half = 0.5 * dt * dt;
    F[2] = -way.dy;
    F[3] = way.c * dt;
    F[4] = -way.s * dt;
    F[6] = way.c * half;
    F[7] = -way.s * half;
    F[10] = way.dx;
    F[11] = way.s * dt;
    F[12] = way.c * dt;
    F[14] = way.s * half;
    F[15] = way.c * half;
    F[21] = dt;
    F[30] = dt;
    F[39] = dt;
  }

  Eigen::Matrix<double, 8, 1> noise_;
};

}  // namespace

MotionModel::MotionModel(std::string name, std::vector<std::string> variables,
                         const AngleSet& angles)
    : name_(std::move(name)), variables_(std::move(variables)), angles_(angles) {}

MotionModelPtr constant_velocity(int dimension, double noise) {
  return std::make_shared<Polynomial>("constant_velocity", dimension, 2, noise);
}

MotionModelPtr constant_acceleration(int dimension, double noise) {
  return std::make_shared<Polynomial>("constant_acceleration", dimension, 3, noise);
}

MotionModelPtr constant_twist(const Eigen::Vector3d& noise) {
  return std::make_shared<ConstantTwist>(noise);
}

MotionModelPtr omnidirectional(const Eigen::Matrix<double, 8, 1>& noise) {
  return std::make_shared<Omnidirectional>(noise);
}

Eigen::Matrix<double, 8, 1> omnidirectional_noise() {
  // robot_localization's default process noise of these variables.
  return {0.05, 0.05, 0.06, 0.025, 0.025, 0.02, 0.01, 0.01};
}

}  // namespace thing_kin
