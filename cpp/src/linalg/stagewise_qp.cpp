#include "thing_kin/linalg/stagewise_qp.hpp"

#include <algorithm>
#include <cmath>

#include "stagewise_blocks.hpp"
#include "thing_kin/core/max_dof.hpp"

namespace thing_kin {

namespace {

constexpr double kToBoundary = 0.995;    // how much of the way to the first bound a step may go
constexpr double kGapTolerance = 1e-11;  // of complementarity, summed
constexpr double kNearEnough = 1e-7;
constexpr double kDualTolerance = 1e-10;

std::size_t index(int i) { return static_cast<std::size_t>(i); }

}  // namespace

StagewiseQp::StagewiseQp(int size) : m_(std::clamp(size, 1, kMaxDof)) {}

void StagewiseQp::reserve(int stages, int rows) {
  const auto vectors = index(stages * m_);
  const auto matrices = index(stages * m_ * m_);
  for (auto* v : {&H_, &E_, &S_, &W_}) {
    v->reserve(matrices);
  }
  for (auto* v : {&g_, &p_, &dp_, &rd_}) {
    v->reserve(vectors);
  }
  rows_.reserve(index(rows));
  coefficients_.reserve(index(2 * m_ * rows));
}

void StagewiseQp::reset(int stages) {
  stages_ = stages;
  const auto vectors = index(stages * m_);
  const auto matrices = index(stages * m_ * m_);
  for (auto* v : {&H_, &E_, &S_, &W_}) {
    v->assign(matrices, 0.0);
  }
  for (auto* v : {&g_, &p_, &dp_, &rd_}) {
    v->assign(vectors, 0.0);
  }
  rows_.clear();
  coefficients_.clear();
}

double* StagewiseQp::add_row(int stage, double c, double rho) {
  Row row{};
  row.stage = stage;
  row.c = c;
  row.rho = rho;
  rows_.push_back(row);
  coefficients_.resize(coefficients_.size() + index(2 * m_), 0.0);
  return coefficients_.data() + coefficients_.size() - index(2 * m_);
}

bool StagewiseQp::is_convex(double damping) noexcept {
  for (Row& row : rows_) {
    row.D = 0.0;
  }
  return with_size(m_, [&](auto size) {
    assemble<size()>(damping);
    return factor<size()>();
  });
}

bool StagewiseQp::solve(double damping, double mu) noexcept {
  return with_size(m_, [&](auto size) { return solve_sized<size()>(damping, mu); });
}

// d of every row at p; rows of the last stage have no next one, and their b is zero.
template <int M>
void StagewiseQp::values(const std::vector<double>& p) noexcept {
  const int m = M > 0 ? M : m_;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    Row& row = rows_[i];
    const double* a = coefficients_.data() + i * index(2 * m);
    const double* at = p.data() + row.stage * m;
    row.d = row.c + dot<M>(m, a, at);
    if (row.stage + 1 < stages_) {
      row.d += dot<M>(m, a + m, at + m);
    }
  }
}

// On the central path of mu for p = 0: z w = mu, (rho - z) s = mu, w = d + s.
template <int M>
void StagewiseQp::begin(double mu) noexcept {
  std::ranges::fill(p_, 0.0);
  violation_before_ = 0.0;
  for (Row& row : rows_) {
    const double d = row.c;
    const double ratio = mu / row.rho;
    const double root = std::sqrt(4.0 * ratio * ratio + d * d);
    // s = ((2 ratio - d) + root)/2 and w = ((2 ratio + d) + root)/2, without cancellation.
    row.s = d <= 0.0 ? ratio + 0.5 * (root - d) : ratio + 2.0 * ratio * ratio / (root + d);
    row.w = d >= 0.0 ? ratio + 0.5 * (root + d) : ratio + 2.0 * ratio * ratio / (root - d);
    row.z = mu / row.w;
    violation_before_ += std::max(0.0, -d);
  }
}

template <int M>
double StagewiseQp::dual_residual() noexcept {
  const int m = M > 0 ? M : m_;
  for (int k = 0; k < stages_; ++k) {
    double* r = rd_.data() + k * m;
    std::copy_n(g(k), m, r);
    add_product<M>(m, block(k), p(k), r);
    add_scaled<M>(m, damping_, p(k), r);
    if (k + 1 < stages_) {
      add_product<M>(m, coupling(k), p(k + 1), r);
    }
    if (k > 0) {
      add_transposed_product<M>(m, coupling(k - 1), p(k - 1), r);
    }
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double* a = coefficients_.data() + i * index(2 * m);
    double* r = rd_.data() + rows_[i].stage * m;
    add_scaled<M>(m, -rows_[i].z, a, r);
    if (rows_[i].stage + 1 < stages_) {
      add_scaled<M>(m, -rows_[i].z, a + m, r + m);
    }
  }
  double largest = 0.0;
  for (const double r : rd_) {
    largest = std::max(largest, std::abs(r));
  }
  return largest;
}

// S and W hold H + damping + A^T D A; the factor replaces it.
template <int M>
void StagewiseQp::assemble(double damping) noexcept {
  const int m = M > 0 ? M : m_;
  std::ranges::copy(H_, S_.begin());
  std::ranges::copy(E_, W_.begin());
  for (int k = 0; k < stages_; ++k) {
    for (int j = 0; j < m; ++j) {
      S_[index((k * m + j) * m + j)] += damping;
    }
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    if (row.D == 0.0) {
      continue;
    }
    const double* a = coefficients_.data() + i * index(2 * m);
    double* S = S_.data() + row.stage * m * m;
    add_outer<M>(m, row.D, a, a, S);
    if (row.stage + 1 < stages_) {
      add_outer<M>(m, row.D, a, a + m, W_.data() + row.stage * m * m);
      add_outer<M>(m, row.D, a + m, a + m, S + m * m);
    }
  }
}

template <int M>
bool StagewiseQp::factor() noexcept {
  const int m = M > 0 ? M : m_;
  for (int k = 0; k < stages_; ++k) {
    double* S = S_.data() + k * m * m;
    if (!cholesky<M>(m, S)) {
      return false;
    }
    if (k + 1 < stages_) {
      double* W = W_.data() + k * m * m;  // L^-1 E
      for (int j = 0; j < m; ++j) {
        solve_lower<M>(m, S, W + j * m);
      }
      subtract_gram<M>(m, W, S + m * m);
    }
  }
  return true;
}

// dp, then what follows of it for the rows.
template <int M>
void StagewiseQp::direction() noexcept {
  const int m = M > 0 ? M : m_;
  for (std::size_t i = 0; i < dp_.size(); ++i) {
    dp_[i] = -rd_[i];
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    Row& row = rows_[i];
    const double r3 = row.d + row.s - row.w;
    row.dz = r3 - row.r1 / row.z + row.r2 / (row.rho - row.z);
    const double* a = coefficients_.data() + i * index(2 * m);
    double* r = dp_.data() + row.stage * m;
    add_scaled<M>(m, -row.D * row.dz, a, r);
    if (row.stage + 1 < stages_) {
      add_scaled<M>(m, -row.D * row.dz, a + m, r + m);
    }
  }
  for (int k = 0; k < stages_; ++k) {
    double* x = dp_.data() + k * m;
    solve_lower<M>(m, S_.data() + k * m * m, x);
    if (k + 1 < stages_) {
      subtract_transposed_product<M>(m, W_.data() + k * m * m, x, x + m);
    }
  }
  for (int k = stages_ - 1; k >= 0; --k) {
    double* x = dp_.data() + k * m;
    if (k + 1 < stages_) {
      subtract_product<M>(m, W_.data() + k * m * m, x + m, x);
    }
    solve_lower_transposed<M>(m, S_.data() + k * m * m, x);
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    Row& row = rows_[i];
    const double* a = coefficients_.data() + i * index(2 * m);
    const double* x = dp_.data() + row.stage * m;
    double change = dot<M>(m, a, x);
    if (row.stage + 1 < stages_) {
      change += dot<M>(m, a + m, x + m);
    }
    row.dz = -row.D * (change + row.dz);
    row.dw = (row.r1 - row.w * row.dz) / row.z;
    row.ds = (row.r2 + row.s * row.dz) / (row.rho - row.z);
  }
}

double StagewiseQp::longest_step() const noexcept {
  double rate = 0.0;  // the reciprocal of the way to the first bound
  for (const Row& row : rows_) {
    rate = std::max(
        {rate, -row.dw / row.w, -row.ds / row.s, -row.dz / row.z, row.dz / (row.rho - row.z)});
  }
  return rate > 0.0 ? 1.0 / rate : 1e300;
}

double StagewiseQp::gap() const noexcept {
  double sum = 0.0;
  for (const Row& row : rows_) {
    sum += row.w * row.z + row.s * (row.rho - row.z);
  }
  return sum;
}

template <int M>
void StagewiseQp::finish() noexcept {
  const int m = M > 0 ? M : m_;
  values<M>(p_);
  double change = 0.0;
  violation_after_ = 0.0;
  double penalty = 0.0;
  for (const Row& row : rows_) {
    violation_after_ += std::max(0.0, -row.d);
    penalty += row.rho * (std::max(0.0, -row.c) - std::max(0.0, -row.d));
  }
  for (int k = 0; k < stages_; ++k) {
    double Hp[kMaxDof] = {};
    add_product<M>(m, block(k), p(k), Hp);
    change += dot<M>(m, g(k), p(k)) + 0.5 * dot<M>(m, Hp, p(k));
    if (k + 1 < stages_) {
      double Ep[kMaxDof] = {};
      add_product<M>(m, coupling(k), p(k + 1), Ep);
      change += dot<M>(m, Ep, p(k));
    }
  }
  decrease_ = penalty - change;
}

template <int M>
bool StagewiseQp::solve_sized(double damping, double mu) noexcept {
  damping_ = damping;
  begin<M>(mu);
  values<M>(p_);
  const double count = 2.0 * static_cast<double>(std::max<std::size_t>(rows_.size(), 1));
  for (iterations_ = 0; iterations_ < kMaxIterations; ++iterations_) {
    const double residual = dual_residual<M>();
    const double current = gap();
    if (!(std::isfinite(residual) && std::isfinite(current))) {
      return false;
    }
    if (residual < kDualTolerance && current < kGapTolerance) {
      break;
    }
    for (Row& row : rows_) {
      row.D = 1.0 / (row.w / row.z + row.s / (row.rho - row.z));
      row.r1 = -row.w * row.z;
      row.r2 = -row.s * (row.rho - row.z);
    }
    assemble<M>(damping);
    if (!factor<M>()) {  // at the end of the path rounding may break it: that is near enough
      if (residual > kNearEnough || current > kNearEnough) {
        return false;
      }
      break;
    }
    direction<M>();
    const double affine = std::min(1.0, longest_step());
    if (!rows_.empty()) {
      double after = 0.0;
      for (const Row& row : rows_) {
        after += (row.w + affine * row.dw) * (row.z + affine * row.dz) +
                 (row.s + affine * row.ds) * (row.rho - row.z - affine * row.dz);
      }
      const double ratio = after / current;
      const double target = ratio * ratio * ratio * current / count;
      for (Row& row : rows_) {
        row.r1 = target - row.w * row.z - row.dw * row.dz;
        row.r2 = target - row.s * (row.rho - row.z) + row.ds * row.dz;
      }
      direction<M>();
    }
    const double step = std::min(1.0, kToBoundary * longest_step());
    add_all(step, dp_, p_);
    for (Row& row : rows_) {
      row.w += step * row.dw;
      row.s += step * row.ds;
      row.z += step * row.dz;
    }
    values<M>(p_);
    if (step == 1.0 && rows_.empty()) {
      break;
    }
  }
  finish<M>();
  return std::isfinite(decrease_);
}

}  // namespace thing_kin
