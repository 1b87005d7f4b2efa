#include "thing_kin/estimation/twist_track.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include <Eigen/Cholesky>

namespace thing_kin {

namespace {

using Eigen::Matrix3d;

// s: a weight must be finite.
constexpr double kShortest = 1e-9;

Matrix3d block(const Matrix3d& R, std::uint8_t mask) {
  Matrix3d kept = R;
  for (int k = 0; k < 3; ++k) {
    if ((mask >> k & 1U) == 0) {
      kept.row(k).setZero();
      kept.col(k).setZero();
    }
  }
  return kept;
}

// The inverse of the block that counts, zero elsewhere.
Matrix3d information(const Matrix3d& R, std::uint8_t mask) {
  Matrix3d padded = block(R, mask);
  for (int k = 0; k < 3; ++k) {
    padded(k, k) = (mask >> k & 1U) == 0 ? 1.0 : padded(k, k);
  }
  return block(padded.llt().solve(Matrix3d::Identity()), mask);
}

// Which entries of a share count: those where no share has a higher rank.
std::uint8_t counting(const TwistShare& share, const std::array<int, 3>& highest) {
  std::uint8_t mask = 0;
  for (unsigned k = 0; k < 3; ++k) {
    if ((share.sample->mask >> k & 1U) != 0 && share.rank == highest[k]) {
      mask = static_cast<std::uint8_t>(mask | 1U << k);
    }
  }
  return mask;
}

std::array<int, 3> highest_ranks(std::span<const TwistShare> shares) {
  std::array<int, 3> highest{-1, -1, -1};
  for (const TwistShare& share : shares) {
    for (unsigned k = 0; k < 3; ++k) {
      if ((share.sample->mask >> k & 1U) != 0) {
        highest[k] = std::max(highest[k], share.rank);
      }
    }
  }
  return highest;
}

Twist2 entries(const Twist2& z, std::uint8_t mask) {
  return {(mask & 1U) != 0 ? z.x() : 0.0, (mask & 2U) != 0 ? z.y() : 0.0,
          (mask & 4U) != 0 ? z.z() : 0.0};
}

}  // namespace

std::size_t TwistTrack::after(double a) const noexcept {
  const auto found = std::ranges::upper_bound(samples, a, std::ranges::less(), &TwistSample::t);
  return static_cast<std::size_t>(found - samples.begin());
}

const TwistSample* TwistTrack::last_accepted(std::size_t next) const noexcept {
  while (next > 0) {
    --next;
    if (samples[next].verdict.accepted) {
      return &samples[next];
    }
  }
  return held ? &*held : nullptr;
}

TwistShare share_of(const TwistTrack& track, std::size_t next, double a, double b, double origin) {
  const TwistSample* const coming =
      next < track.samples.size() && track.samples[next].verdict.accepted ? &track.samples[next]
                                                                          : nullptr;
  if (coming != nullptr && !coming->first && coming->start <= a) {
    const double T = coming->t - coming->start;
    return {coming, 2, T, T * (b - a)};
  }
  if (const TwistSample* const last = track.last_accepted(next)) {
    // R s^2 after s seconds: as if the sample were repeated at the time asked.
    const double sum = (a - last->t) + (b - last->t);
    const double T = last->t - std::max(last->start, origin);
    return {last, 1, std::max({T, sum, kShortest}), (b - a) * sum};
  }
  if (coming != nullptr && coming->first && std::max(coming->start, origin) <= a) {
    const double T = coming->t - std::max(coming->start, origin);
    return {coming, 0, T, T * (b - a)};
  }
  return {};
}

TwistMix mix(std::span<const TwistShare> shares) noexcept {
  TwistMix mixed;
  if (shares.size() == 1) {
    const TwistSample& sample = *shares[0].sample;
    mixed.twist = entries(sample.z, sample.mask);
    mixed.covariance = block(sample.R, sample.mask);
    mixed.increment = shares[0].increment * mixed.covariance;
    return mixed;
  }
  const std::array<int, 3> highest = highest_ranks(shares);
  const auto weight = [&](const TwistShare& share, std::uint8_t mask) {
    return Matrix3d(information(share.sample->R, mask) / share.seconds);
  };
  Matrix3d sum = Matrix3d::Zero();
  for (const TwistShare& share : shares) {
    sum += weight(share, counting(share, highest));
  }
  std::uint8_t known = 0;
  for (unsigned k = 0; k < 3; ++k) {
    known = static_cast<std::uint8_t>(known | (highest[k] >= 0 ? 1U << k : 0U));
  }
  const Matrix3d inverse = information(sum, known);
  for (const TwistShare& share : shares) {
    const std::uint8_t mask = counting(share, highest);
    if (mask == 0) {
      continue;
    }
    const Matrix3d W = inverse * weight(share, mask);
    const Matrix3d own = W * block(share.sample->R, mask) * W.transpose();
    mixed.twist += W * entries(share.sample->z, mask);
    mixed.covariance += own;
    mixed.increment += share.increment * own;
  }
  return mixed;
}

PoseVerdict judge(const TwistSample& sample, std::span<const TwistShare> others) noexcept {
  std::uint8_t known = 0;
  for (const TwistShare& other : others) {
    known = static_cast<std::uint8_t>(known | other.sample->mask);
  }
  const std::uint8_t common = known & sample.mask;
  if (common == 0) {
    return {true, 0.0, 0};
  }
  const TwistMix expected = mix(others);
  const Matrix3d S = block(sample.R + expected.covariance, common);
  const Twist2 r = entries(sample.z - expected.twist, common);
  PoseVerdict verdict;
  verdict.dof = std::popcount(common);
  verdict.nis = r.dot(information(S, common) * r);
  verdict.accepted = verdict.nis <= sample.bound[static_cast<std::size_t>(verdict.dof)];
  return verdict;
}

}  // namespace thing_kin
