#include "thing_kin/estimation/calibration_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "thing_kin/linalg/singular_basis.hpp"

namespace thing_kin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTold = 3.0;      // information, in units of that before: the deviation is halved
constexpr double kNothing = 1e-6;  // the same: rounding only
constexpr double kPartOfNothing = 0.02;  // a parameter's share in what changes nothing at all
constexpr double kPartOfLittle = 0.3;    // ... in what changes little

VectorXd deviations_of(std::span<const CalibrationParameter> parameters) {
  VectorXd deviations(static_cast<Index>(parameters.size()));
  std::ranges::transform(parameters, deviations.begin(), &CalibrationParameter::deviation);
  return deviations;
}

// How much of each parameter is in a space of motions, each measured by what it does to the data.
VectorXd shares_in(const MatrixXd& motions, const VectorXd& effect) {
  MatrixXd Q = effect.asDiagonal() * motions;
  for (Index k = 0; k < Q.cols(); ++k) {
    for (int pass = 0; pass < 2; ++pass) {  // Gram-Schmidt, twice: orthogonal to rounding
      Q.col(k).normalize();
      for (Index other = 0; other < k; ++other) {
        Q.col(k) -= Q.col(other).dot(Q.col(k)) * Q.col(other);
      }
    }
    Q.col(k).normalize();
  }
  return Q.rowwise().norm();
}

// Columns with a one at a parameter of their own, in the parameters' units: elimination with the
// largest pivot, where motions are measured by what they do to the data.
MatrixXd reduced(const MatrixXd& motions, const VectorXd& effect, const VectorXd& deviations) {
  constexpr double kNotWorthNaming = 1e-3;
  MatrixXd scaled = effect.asDiagonal() * motions;
  std::vector<Index> pivots;
  for (Index k = 0; k < scaled.cols(); ++k) {
    Index row = 0;
    Index column = 0;
    scaled.rightCols(scaled.cols() - k).cwiseAbs().maxCoeff(&row, &column);
    scaled.col(k).swap(scaled.col(k + column));
    scaled.col(k) /= scaled(row, k);
    for (Index other = 0; other < scaled.cols(); ++other) {
      if (other != k) {
        scaled.col(other) -= scaled(row, other) * scaled.col(k);
      }
    }
    pivots.push_back(row);
  }
  scaled = (scaled.cwiseAbs().array() > kNotWorthNaming).select(scaled, 0.0);
  scaled = (deviations.array() / effect.array()).matrix().asDiagonal() * scaled;
  for (Index k = 0; k < scaled.cols(); ++k) {
    scaled.col(k) /= scaled(pivots[static_cast<std::size_t>(k)], k);
    const VectorXd motion = scaled.col(k);
    const auto first = std::ranges::find_if(motion, [](double x) { return x != 0.0; });
    scaled.col(k) *= *first < 0.0 ? -1.0 : 1.0;
  }
  return scaled;
}

// Of a matrix that is positive definite, by its Cholesky factor.
double log_determinant(MatrixXd S) {
  double sum = 0.0;
  for (Index j = 0; j < S.cols(); ++j) {
    const double pivot = S(j, j);
    sum += std::log(pivot);
    const VectorXd below = S.col(j).tail(S.rows() - j - 1);
    for (Index c = j + 1; c < S.cols(); ++c) {
      S.col(c).tail(S.rows() - c) -= S(c, j) / pivot * below.tail(S.rows() - c);
    }
  }
  return sum;
}

}  // namespace

CalibrationSight calibration_sight(const RowMajorMatrix& J,
                                   std::span<const CalibrationParameter> parameters,
                                   double inflation) {
  const VectorXd deviations = deviations_of(parameters);
  const Index p = deviations.size();
  CalibrationSight sight;
  sight.is_told.assign(parameters.size(), false);
  const MatrixXd A = J * deviations.asDiagonal();
  const VectorXd norms = A.colwise().norm();
  const SingularBasis basis = singular_basis(A);
  sight.singular_values = basis.sigma;
  const VectorXd information = sight.singular_values.array().square() / inflation;
  sight.rank = static_cast<int>((information.array() > kTold).count());
  const Index seen = (information.array() > kNothing).count();
  const MatrixXd& V = basis.v;
  const VectorXd left = (information.array() + 1.0).sqrt().inverse();
  const MatrixXd root = deviations.asDiagonal() * V * left.asDiagonal();
  sight.covariance = root.lazyProduct(root.transpose());
  const double largest = norms.maxCoeff() > 0.0 ? norms.maxCoeff() : 1.0;
  const VectorXd effect = (norms.array() > 1e-12 * largest).select(norms, largest);
  const VectorXd none = shares_in(V.rightCols(p - seen), effect);
  const VectorXd little = shares_in(V.rightCols(p - sight.rank), effect);
  for (Index i = 0; i < p; ++i) {
    sight.is_told[static_cast<std::size_t>(i)] =
        none[i] < kPartOfNothing && little[i] < kPartOfLittle &&
        sight.covariance(i, i) < deviations[i] * deviations[i] / (1.0 + kTold);
  }
  sight.unseen = reduced(V.rightCols(p - sight.rank), effect, deviations);
  return sight;
}

std::vector<std::string> unseen_in_words(const CalibrationSight& sight,
                                         std::span<const CalibrationParameter> parameters) {
  std::vector<std::string> lines;
  for (Index k = 0; k < sight.unseen.cols(); ++k) {
    const VectorXd motion = sight.unseen.col(k);
    std::vector<Index> order;
    for (Index i = 0; i < motion.size(); ++i) {
      if (motion[i] != 0.0) {
        order.push_back(i);
      }
    }
    std::string line;
    for (const Index i : order) {
      char number[32];
      std::snprintf(number, sizeof number, " %+.3g", motion[i]);
      line.append(line.empty() ? "" : ", ")
          .append(parameters[static_cast<std::size_t>(i)].name)
          .append(order.size() > 1 ? number : "");
    }
    lines.push_back(line);
  }
  return lines;
}

std::vector<int> most_telling(const RowMajorMatrix& J, int rows,
                              std::span<const CalibrationParameter> parameters,
                              const MatrixXd& covariance, int count) {
  const VectorXd deviations = deviations_of(parameters);
  const VectorXd inverse = deviations.cwiseInverse();
  MatrixXd P = inverse.asDiagonal() * covariance * inverse.asDiagonal();
  const MatrixXd A = J * deviations.asDiagonal();
  const auto candidates = static_cast<int>(J.rows() / rows);
  std::vector<int> chosen;
  for (int k = 0; k < count && candidates > 0; ++k) {
    double most = -1.0;
    int best = 0;
    for (int c = 0; c < candidates; ++c) {
      const MatrixXd block = A.middleRows(static_cast<Index>(c) * rows, rows);
      const MatrixXd seen = block * P;
      const double gain =
          log_determinant(MatrixXd::Identity(rows, rows) + seen.lazyProduct(block.transpose()));
      if (gain > most) {
        most = gain;
        best = c;
      }
    }
    chosen.push_back(best);
    for (int row = best * rows; row < (best + 1) * rows; ++row) {  // one number after the other
      const VectorXd a = A.row(row).transpose();
      const VectorXd Pa = P * a;
      P -= Pa * (Pa / (1.0 + a.dot(Pa))).transpose();
    }
  }
  return chosen;
}

}  // namespace thing_kin
