#include "thing_kin/linalg/interval_search.hpp"

#include <algorithm>

namespace thing_kin {

namespace {

// The derivative of half the sum of squares: piecewise linear and rising, with a kink where a row
// enters or leaves its interval. Its zero is sought from kink to kink.
class LineSearch {
 public:
  LineSearch(const SmallVector& v, const SmallVector& s, const SmallVector& l, const SmallVector& u)
      : v_(v), s_(s), l_(l), u_(u) {}

  double best() const {
    double left = 0.0;
    double f_left = derivative(0.0);
    if (!(f_left < 0.0)) {
      return 1.0;  // at a minimum but for rounding
    }
    while (true) {
      const double right = next_kink(left);
      const double f_right = derivative(right);
      if (f_right >= 0.0) {
        return left + (right - left) * (f_left / (f_left - f_right));
      }
      if (right >= kFar) {
        return 1.0;
      }
      left = right;
      f_left = f_right;
    }
  }

 private:
  double derivative(double alpha) const {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < v_.size(); ++i) {
      const double at = v_[i] + alpha * s_[i];
      sum += s_[i] * (at - std::clamp(at, l_[i], u_[i]));
    }
    return sum;
  }
  double next_kink(double left) const {
    double next = kFar;
    for (Eigen::Index i = 0; i < v_.size(); ++i) {
      for (const double bound : {l_[i], u_[i]}) {
        const double kink = (bound - v_[i]) / s_[i];
        if (kink > left && kink < next) {  // false for the NaN of 0/0
          next = kink;
        }
      }
    }
    return next;
  }

  static constexpr double kFar = 1e6;  // Newton's step is 1

  const SmallVector& v_;
  const SmallVector& s_;
  const SmallVector& l_;
  const SmallVector& u_;
};

}  // namespace

double interval_search(const SmallVector& v, const SmallVector& s, const SmallVector& lower,
                       const SmallVector& upper) noexcept {
  return LineSearch(v, s, lower, upper).best();
}

}  // namespace thing_kin
