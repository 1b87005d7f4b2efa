#pragma once

namespace thing_kin::THING_KIN_LEVEL {

/// Six numbers side by side, padded by zeros: in as many registers as it takes. (One vector of 64
/// bytes for all would live in memory where registers are shorter.)
struct Six {
#if THING_KIN_LANES >= 4
  static constexpr int kWide = 4;
#else
  static constexpr int kWide = 2;
#endif
  static constexpr int kParts = (6 + kWide - 1) / kWide;
  using Part = double __attribute__((vector_size(8 * kWide)));

  Part part[kParts];

  Six() = default;
  Six(double a, double b, double c, double d, double e, double f) : part{} {
    const double numbers[] = {a, b, c, d, e, f};
    for (int i = 0; i < 6; ++i) {
      part[i / kWide][i % kWide] = numbers[i];
    }
  }

  double operator[](int i) const { return part[i / kWide][i % kWide]; }
  void set(int i, double x) { part[i / kWide][i % kWide] = x; }

  Six& operator+=(const Six& b) { return *this = *this + b; }
  Six& operator-=(const Six& b) { return *this = *this - b; }
  Six& operator*=(double s) { return *this = s * *this; }

  friend Six operator+(const Six& a, const Six& b) {
    return each([&](int i) { return a.part[i] + b.part[i]; });
  }
  friend Six operator-(const Six& a, const Six& b) {
    return each([&](int i) { return a.part[i] - b.part[i]; });
  }
  friend Six operator*(const Six& a, const Six& b) {
    return each([&](int i) { return a.part[i] * b.part[i]; });
  }
  friend Six operator*(double s, const Six& a) {
    return each([&](int i) { return s * a.part[i]; });
  }

 private:
  template <typename Function>
  [[gnu::always_inline]] static Six each(Function function) {
    Six result;
    for (int i = 0; i < kParts; ++i) {
      result.part[i] = function(i);
    }
    return result;
  }
};

inline double sum_of(const Six& a) { return ((a[0] + a[1]) + (a[2] + a[3])) + (a[4] + a[5]); }

inline double magnitude(double x) { return x < 0.0 ? -x : x; }

/// Eigenvalues of a symmetric (6, 6) matrix, in no order, and if wanted their vectors, columns of
/// an orthonormal matrix: Householder's tridiagonal form, then QR steps with Wilkinson's shift
/// (Golub & Van Loan, Matrix Computations, 8.3).
template <bool kVectors>
struct Spectrum {
  double lambda[6];
  Six u[6];

  /// A in columns; destroyed.
  explicit Spectrum(Six A[6]) {
    if (kVectors) {
      for (int i = 0; i < 6; ++i) {
        u[i] = Six{};
        u[i].set(i, 1.0);
      }
    }
    reflect<0>(A);
    reflect<1>(A);
    reflect<2>(A);
    reflect<3>(A);
    for (int i = 0; i < 6; ++i) {
      lambda[i] = A[i][i];
    }
    for (int i = 0; i < 5; ++i) {
      beside_[i] = A[i][i + 1];
    }
    diagonalize();
  }

 private:
  static constexpr double kEps = 0x1p-52;
  static constexpr int kMostSteps = 120;  // three an eigenvalue are usual

  // Makes column k zero below the entry beside the diagonal. The index is known to the compiler, so
  // that columns stay in registers.
  template <int k>
  [[gnu::always_inline]] void reflect(Six A[6]) {
    const Six below{0.0, k < 1 ? 1.0 : 0.0, k < 2 ? 1.0 : 0.0, k < 3 ? 1.0 : 0.0, k < 4 ? 1.0 : 0.0,
                    1.0};
    const Six beside{
        0.0, k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0, k == 3 ? 1.0 : 0.0, 0.0};
    Six v = A[k] * below;
    const double first = v[k + 1];
    const double square = sum_of(v * v);
    if (!(square - first * first > 0.0)) {
      return;
    }
    const double norm = __builtin_sqrt(square);
    const double shift = first > 0.0 ? norm : -norm;
    v += shift * beside;
    const double beta = 1.0 / (square + shift * first);
    Six p{};
    Six along{};
#pragma GCC unroll 6
    for (int j = k + 1; j < 6; ++j) {
      p += v[j] * A[j];
      if (kVectors) {
        along += v[j] * u[j];
      }
    }
    p *= beta;
    along *= beta;
    const Six w = p - (0.5 * beta * sum_of(p * v)) * v;
#pragma GCC unroll 6
    for (int j = k; j < 6; ++j) {
      A[j] -= w[j] * v + v[j] * w;
      if (kVectors) {
        u[j] -= v[j] * along;
      }
    }
  }

  bool is_small(int i) const {
    return magnitude(beside_[i]) <= kEps * (magnitude(lambda[i]) + magnitude(lambda[i + 1]));
  }

  void diagonalize() {
    int end = 5;
    for (int step = 0; end > 0 && step < kMostSteps; ++step) {
      if (is_small(end - 1)) {
        --end;
        continue;
      }
      int start = end - 1;
      while (start > 0 && !is_small(start - 1)) {
        --start;
      }
      chase(start, end);
    }
  }

  // One QR step: the shift makes a bulge, which rotations chase out at the end.
  void chase(int start, int end) {
    const double e = beside_[end - 1];
    const double half = 0.5 * (lambda[end - 1] - lambda[end]);
    const double root = __builtin_sqrt(half * half + e * e);
    double x = lambda[start] - lambda[end] + e * e / (half + (half > 0.0 ? root : -root));
    double z = beside_[start];
    for (int k = start; k < end; ++k) {
      const double square = x * x + z * z;
      if (!(square > 0.0)) {
        return;
      }
      const double inverse = 1.0 / __builtin_sqrt(square);
      const double c = x * inverse;
      const double s = z * inverse;
      if (k > start) {
        beside_[k - 1] = square * inverse;
      }
      const double first = lambda[k];
      const double second = lambda[k + 1];
      const double cross = 2.0 * c * s * beside_[k];
      lambda[k] = c * c * first + cross + s * s * second;
      lambda[k + 1] = s * s * first - cross + c * c * second;
      beside_[k] = c * s * (second - first) + (c * c - s * s) * beside_[k];
      if (k + 1 < end) {
        x = beside_[k];
        z = s * beside_[k + 1];
        beside_[k + 1] *= c;
      }
      if (kVectors) {
        const Six turned = c * u[k] + s * u[k + 1];
        u[k + 1] = c * u[k + 1] - s * u[k];
        u[k] = turned;
      }
    }
  }

  double beside_[5];
};

}  // namespace thing_kin::THING_KIN_LEVEL
