#pragma once

/// @file
/// The standard normal law between two bounds, accurate however far out they lie.

namespace packstone {

/// Standard normal, given that it falls in [lo, hi]. lo < hi; either may be infinite.
///
/// Three ways to invert, by where the bounds lie:
///   (1) hi - lo < 1e-4: the density is exp(-m x) about the middle m, up to a factor
///       1 + (hi - lo)^2 / 8;
///   (2) both bounds beyond 5 on one side: Newton on the logarithm of the survival function
///       Q(x) = phi(x) R(x), R being Mills' ratio; -log Q is convex, so that Newton from the right
///       converges from one side;
///   (3) otherwise the distribution function itself, always taken in the nearer tail.
class TruncatedNormal {
 public:
  TruncatedNormal(double lo, double hi) noexcept;

  /// x with P(X < x) = u, 0 < u < 1; inside [lo, hi].
  [[nodiscard]] double quantile(double u) const noexcept;

  /// log of the probability of [lo, hi] under the untruncated law.
  [[nodiscard]] double log_mass() const noexcept;

 private:
  enum class Way { narrow, tail, body };

  [[nodiscard]] double tail_quantile(double u) const noexcept;

  double lo_, hi_;
  Way way_;
  bool flipped_ = false;       // lo_, hi_ are the mirrored bounds
  double log_survival_ = 0.0;  // tail: log Q(hi_) / Q(lo_)
  double below_ = 0.0;         // body: P(X < lo_)
  double above_ = 0.0;         // body: P(X > hi_)
};

/// Mills' ratio Q(x) / phi(x) for x >= 5, by Laplace's continued fraction; relative error < 1e-15.
[[nodiscard]] double mills_ratio(double x) noexcept;

}  // namespace packstone
