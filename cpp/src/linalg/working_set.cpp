#include "thing_kin/linalg/working_set.hpp"

#include <cmath>

namespace thing_kin {

namespace {

bool has_one_entry(const SmallVector& v, Eigen::Index& where) {
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    if (v[i] != 0.0) {
      where = i;
      ++count;
    }
  }
  return count == 1;
}

}  // namespace

void WorkingSet::reset(const SmallMatrix& Z) noexcept {
  q_ = Z;
  r_.resize(Z.cols(), Z.cols());
  size_ = 0;
}

// N <- N (I - beta v v^T).
void WorkingSet::reflect_columns(const SmallVector& v) noexcept {
  const Eigen::Index rows = q_.rows();
  const double beta = 2.0 / v.squaredNorm();
  JointVector image = JointVector::Zero(rows);
  for (Eigen::Index j = 0; j < v.size(); ++j) {
    image += v[j] * q_.col(size_ + j);
  }
  image *= beta;
  for (Eigen::Index j = 0; j < v.size(); ++j) {
    q_.col(size_ + j) -= v[j] * image;
  }
}

bool WorkingSet::add(Entry entry, const SmallVector& along, double least) noexcept {
  const Eigen::Index free_columns = free();
  if (free_columns <= 0) {
    return false;
  }
  SmallVector v = along.tail(free_columns);
  const double norm = v.norm();
  if (!(norm > least)) {
    return false;
  }
  double diagonal = 0.0;
  Eigen::Index only = -1;
  if (has_one_entry(v, only)) {  // a bound on a coordinate axis: as it is at the first level
    diagonal = v[only];
    q_.col(size_).swap(q_.col(size_ + only));
  } else {
    diagonal = -std::copysign(norm, v[0]);
    v[0] -= diagonal;
    reflect_columns(v);
  }
  r_.col(size_).head(size_) = along.head(size_);
  r_(size_, size_) = diagonal;
  entries_[static_cast<std::size_t>(size_)] = entry;
  ++size_;
  return true;
}

void WorkingSet::drop(int i) noexcept {
  --size_;
  for (int j = i; j < size_; ++j) {
    entries_[static_cast<std::size_t>(j)] = entries_[static_cast<std::size_t>(j) + 1];
    r_.col(j).head(j + 2) = r_.col(j + 1).head(j + 2);
  }
  for (int j = i; j < size_; ++j) {  // column j has an entry below its diagonal: turn it away
    const double length = std::hypot(r_(j, j), r_(j + 1, j));
    const double c = r_(j, j) / length;
    const double s = r_(j + 1, j) / length;
    for (int k = j; k < size_; ++k) {
      const double up = r_(j, k);
      const double down = r_(j + 1, k);
      r_(j, k) = c * up + s * down;
      r_(j + 1, k) = c * down - s * up;
    }
    for (Eigen::Index row = 0; row < q_.rows(); ++row) {
      const double left = q_(row, j);
      const double right = q_(row, j + 1);
      q_(row, j) = c * left + s * right;
      q_(row, j + 1) = c * right - s * left;
    }
  }
}

void WorkingSet::multipliers(const SmallVector& gradient_along, SmallVector& mu) const noexcept {
  mu.resize(size_);
  for (int i = size_ - 1; i >= 0; --i) {
    double sum = -gradient_along[i];
    for (int j = i + 1; j < size_; ++j) {
      sum -= r_(i, j) * mu[j];
    }
    mu[i] = sum / r_(i, i);
  }
}

}  // namespace thing_kin
