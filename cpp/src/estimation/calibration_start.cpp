#include "thing_kin/estimation/calibration_start.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rigid_fit.hpp"
#include "thing_kin/linalg/singular_basis.hpp"

namespace thing_kin {

namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kLever = 0.3;  // m: of the points that stand for a pose's axes

// A place in the world of point `point`, whose frame before the tool is `last`.
struct Sight {
  SE3 last;
  Vector3d place;
  int point = 0;
  double weight = 1.0;
};

struct Unknowns {
  SE3 root;  // of the world in the root: M, u
  Eigen::Matrix3Xd points;
};

class Start {
 public:
  Start(CalibrationModel& model, const CalibrationData& data, std::span<const int> postures,
        CalibrationState nominal)
      : nominal_(std::move(nominal)) {
    for (const CalibrationParameter& parameter : model.parameters()) {
      frees_base_ = frees_base_ || parameter.part == CalibrationPart::kBase;
      frees_tool_ = frees_tool_ || parameter.part == CalibrationPart::kTool;
      frees_points_ = frees_points_ || parameter.part == CalibrationPart::kPoint;
    }
    collect(model, data, postures);
  }

  bool is_needed() const {
    return !sights_.empty() && (frees_base_ || frees_tool_ || frees_points_);
  }

  CalibrationState find(const CalibrationModel& model) {
    Unknowns found = known();
    double typical = 0.0;
    for (int i = 0; i < 4; ++i) {
      found = solve(found);
      const double before = std::exchange(typical, reweigh(found));
      if (std::abs(typical - before) < 0.02 * before) {
        break;
      }
    }
    CalibrationState state = nominal_;
    state.base = frees_base_ ? found.root.inverse() : state.base;
    if (frees_tool_ && is_pose_) {
      const Matrix3d axes = (found.points.rightCols<3>().colwise() - found.points.col(0)) / kLever;
      state.tool = {nearest_rotation(axes), found.points.col(0)};
    } else if (frees_tool_) {
      VectorXd times_seen = VectorXd::Zero(points_.cols());
      for (const Sight& sight : sights_) {
        times_seen[sight.point] += 1.0;
      }
      state.tool = fitted_motion(points_, found.points, times_seen);
    }
    for (int i = 0; i < model.size(); ++i) {
      const CalibrationParameter& parameter = model.parameters()[static_cast<std::size_t>(i)];
      if (parameter.part == CalibrationPart::kPoint) {
        const Vector3d place = state.tool.inverse() * Vector3d(found.points.col(parameter.place));
        state.values[i] = place[parameter.axis] - points_(parameter.axis, parameter.place);
      }
    }
    return state;
  }

 private:
  void collect(CalibrationModel& model, const CalibrationData& data,
               std::span<const int> postures) {
    is_pose_ = data.kind == CalibrationKind::kPoses;
    points_ = data.points;
    if (is_pose_) {
      points_.resize(3, 4);
      points_ << Vector3d::Zero(), kLever * Matrix3d::Identity();
    }
    CalibrationState alone = nominal_;
    alone.base = alone.tool = SE3{};
    model.set(alone);
    const VectorXd none = VectorXd::Zero(data.q.rows());
    for (const int posture : postures) {
      const SE3 last = model.tool(data.q.col(posture), none, nullptr, nullptr);
      for (Index point = 0; point < points_.cols(); ++point) {
        const auto at = is_pose_ ? static_cast<std::size_t>(posture)
                                 : static_cast<std::size_t>(posture * points_.cols() + point);
        if (data.seen[at]) {
          const Vector3d place = is_pose_ ? data.poses[at] * Vector3d(points_.col(point))
                                          : data.places.col(static_cast<Index>(at)).eval();
          sights_.push_back({last, place, static_cast<int>(point), 1.0});
        }
      }
    }
  }

  Unknowns known() const {
    Unknowns unknowns{nominal_.base.inverse(), points_};
    for (Index i = 0; i < points_.cols(); ++i) {
      unknowns.points.col(i) = nominal_.tool * Vector3d(points_.col(i));
    }
    return unknowns;
  }

  bool points_are_free() const { return frees_tool_ || frees_points_; }

  // Columns 0-8: M by columns; 9-11: u; then the points. Each sight has one of these.
  Unknowns solve(const Unknowns& before) const {
    const Index points = points_are_free() ? 3 * points_.cols() : 0;
    const Index base = frees_base_ ? 12 : 0;
    MatrixXd A = MatrixXd::Zero(12 + points, 12 + points);
    VectorXd b = VectorXd::Zero(12 + points);
    Eigen::Matrix<double, 3, 12> row = Eigen::Matrix<double, 3, 12>::Zero();
    row.rightCols<3>().setIdentity();
    for (const Sight& sight : sights_) {
      Vector3d right = sight.last.translation;
      for (Index axis = 0; axis < 3; ++axis) {
        row.middleCols<3>(3 * axis).diagonal().setConstant(sight.place[axis]);
      }
      if (!frees_base_) {
        right -= before.root * sight.place;
      }
      if (!points_are_free()) {
        right += sight.last.rotation * before.points.col(sight.point);
      } else {
        const Index at = 12 + 3 * sight.point;
        A.block<12, 3>(0, at) -= sight.weight * row.transpose() * sight.last.rotation;
        A.block<3, 3>(at, at).diagonal().array() += sight.weight;
        b.segment<3>(at) -= sight.weight * sight.last.rotation.transpose() * right;
      }
      A.topLeftCorner<12, 12>() += sight.weight * row.transpose() * row;
      b.head<12>() += sight.weight * row.transpose() * right;
    }
    A.bottomLeftCorner(points, 12) = A.topRightCorner(12, points).transpose();
    const Index size = base + points;
    const VectorXd x = least_norm(A.bottomRightCorner(size, size), b.tail(size));
    Unknowns after = before;
    if (points_are_free()) {
      after.points = Eigen::Map<const Eigen::Matrix3Xd>(x.data() + base, 3, points_.cols());
    }
    if (frees_base_) {
      const Matrix3d M = nearest_rotation(Eigen::Map<const Matrix3d>(x.data()));
      after.root = {M, x.segment<3>(9)};
    }
    settle(after);
    return after;
  }

  // A x = b of a symmetric A, not negative, that may have lost rank.
  static VectorXd least_norm(const MatrixXd& A, const VectorXd& b) {
    const SingularBasis basis = singular_basis(A);
    const double least = 1e-10 * basis.sigma[0];
    VectorXd x = VectorXd::Zero(b.size());
    for (Index i = 0; i < b.size() && basis.sigma[i] > least; ++i) {
      x += basis.v.col(i).dot(b) / basis.sigma[i] * basis.v.col(i);
    }
    return x;
  }

  // Once M is a rotation: points and base in turn, each the best for the other.
  void settle(Unknowns& unknowns) const {
    for (int i = 0; i < 4; ++i) {
      if (points_are_free()) {
        Eigen::Matrix3Xd sum = Eigen::Matrix3Xd::Zero(3, points_.cols());
        VectorXd weight = VectorXd::Constant(points_.cols(), 1e-12);
        for (const Sight& sight : sights_) {
          sum.col(sight.point) +=
              sight.weight * (sight.last.inverse() * (unknowns.root * sight.place));
          weight[sight.point] += sight.weight;
        }
        unknowns.points = sum * weight.cwiseInverse().asDiagonal();
      }
      if (!frees_base_) {
        break;
      }
      const auto sights = static_cast<Index>(sights_.size());
      Eigen::Matrix3Xd from(3, sights);
      Eigen::Matrix3Xd to(3, sights);
      VectorXd weights(sights);
      for (Index k = 0; k < sights; ++k) {
        const Sight& sight = sights_[static_cast<std::size_t>(k)];
        from.col(k) = sight.place;
        to.col(k) = sight.last * Vector3d(unknowns.points.col(sight.point));
        weights[k] = sight.weight;
      }
      unknowns.root = fitted_motion(from, to, weights);
    }
  }

  // Cauchy's weights about the median error, which it returns.
  double reweigh(const Unknowns& unknowns) {
    std::vector<double> distances;
    distances.reserve(sights_.size());
    for (const Sight& sight : sights_) {
      distances.push_back(
          (unknowns.root * sight.place - sight.last * Vector3d(unknowns.points.col(sight.point)))
              .norm());
    }
    std::vector<double> sorted = distances;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::ranges::nth_element(sorted, middle);
    const double width = std::max(2.0 * *middle, 1e-9);
    for (std::size_t i = 0; i < sights_.size(); ++i) {
      const double relative = distances[i] / width;
      sights_[i].weight = 1.0 / (1.0 + relative * relative);
    }
    return *middle;
  }

  CalibrationState nominal_;
  bool frees_base_ = false, frees_tool_ = false, frees_points_ = false, is_pose_ = false;
  Eigen::Matrix3Xd points_;
  std::vector<Sight> sights_;
};

// Grows slowly with what is far off, so that outliers decide nothing.
double misfit(CalibrationResiduals& residuals, const CalibrationState& state) {
  constexpr double kNear = 0.02;  // m, rad
  VectorXd e;
  residuals.errors(state, e, nullptr);
  double sum = 0.0;
  for (Index row = 0; row < e.size(); row += residuals.data().rows()) {
    const double far = e.segment(row, residuals.data().rows()).squaredNorm() / (kNear * kNear);
    sum += std::log1p(far);
  }
  return sum;
}

}  // namespace

CalibrationState calibration_start(CalibrationModel& model, const CalibrationData& data,
                                   std::span<const int> postures, const CalibrationState& nominal) {
  if (data.kind == CalibrationKind::kHits) {
    return nominal;
  }
  Start start(model, data, postures, nominal);
  if (!start.is_needed()) {
    return nominal;
  }
  CalibrationState found = start.find(model);
  CalibrationResiduals residuals(model, data, postures);
  if (!found.base.translation.allFinite() || !found.tool.translation.allFinite() ||
      misfit(residuals, nominal) < misfit(residuals, found)) {
    return nominal;
  }
  return found;
}

}  // namespace thing_kin
