#include "support/oracle.hpp"

#include <ccd/ccd.h>
#include <ccd/vec3.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "packstone/core/overloaded.hpp"
#include "packstone/geometry/support.hpp"

namespace packstone::oracle {
namespace {

using Real = long double;

struct Point {
  Real x = 0, y = 0, z = 0;
};
Point point(const Vec3& v) { return {v.x, v.y, v.z}; }
Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Point operator*(Real s, const Point& a) { return {s * a.x, s * a.y, s * a.z}; }
Real dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Real norm(const Point& a) { return std::sqrt(dot(a, a)); }
Point unit(const Point& a) { return (1 / norm(a)) * a; }

// Coordinates along the axes of an ellipsoid, by turning with the quaternion itself.
Point turned_back(const Quaternion& q, const Point& v) {
  const Real n = std::sqrt(Real(q.w) * q.w + Real(q.x) * q.x + Real(q.y) * q.y + Real(q.z) * q.z);
  const Real w = q.w / n;
  const Point u{-q.x / n, -q.y / n, -q.z / n};
  const auto cross = [](const Point& a, const Point& b) {
    return Point{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  };
  const Point t = 2 * cross(u, v);
  return v + w * t + cross(u, t);
}

Point turned_back(const Ellipse& b, const Point& v) {
  const Real c = std::cos(Real(b.angle)), s = std::sin(Real(b.angle));
  return {c * v.x + s * v.y, c * v.y - s * v.x, 0};
}

// Coordinates along and across an axis.
struct Polar {
  Real along, across;
};
Polar polar(const Vec3& axis, const Point& v) {
  const Point u = unit(point(axis));
  const Real along = dot(u, v);
  return {along, norm(v - along * u)};
}

Real support_of(const Body& body, const Point& d) {
  return std::visit(
      Overloaded{[&](const Sphere& b) { return b.radius * norm(d); },
                 [&](const Ellipsoid& b) {
                   const Point v = turned_back(b.orientation, d);
                   return norm({b.semi_axes.x * v.x, b.semi_axes.y * v.y, b.semi_axes.z * v.z});
                 },
                 [&](const Cylinder& b) {
                   const Polar p = polar(b.axis, d);
                   return b.half_length * std::abs(p.along) + b.radius * p.across;
                 },
                 [&](const Spherocylinder& b) {
                   return b.half_length * std::abs(polar(b.axis, d).along) + b.radius * norm(d);
                 },
                 [&](const Disk& b) { return b.radius * norm(d); },
                 [&](const Ellipse& b) {
                   const Point v = turned_back(b, d);
                   return norm({b.semi_axes.x * v.x, b.semi_axes.y * v.y, 0});
                 }},
      body);
}

// Gauge of a spherocylinder: |x - t u| = mu r with t = min(mu h, x.u).
Real spherocylinder_gauge(const Spherocylinder& b, const Polar& p) {
  const Real along = std::abs(p.along);
  const Real side = p.across / b.radius;
  if (along <= side * b.half_length) return side;
  const Real h = b.half_length, r = b.radius;
  const Real qa = r * r - h * h, qb = along * h, qc = -(along * along + p.across * p.across);
  if (std::abs(qa) < 1e-15L * r * r) return -qc / (2 * qb);
  const Real root = std::sqrt(qb * qb - qa * qc);
  return qa > 0 ? -qc / (qb + root) : -qc / (qb + root);
}

Real gauge_of(const Body& body, const Point& x) {
  return std::visit(
      Overloaded{[&](const Sphere& b) { return norm(x) / b.radius; },
                 [&](const Ellipsoid& b) {
                   const Point v = turned_back(b.orientation, x);
                   return norm({v.x / b.semi_axes.x, v.y / b.semi_axes.y, v.z / b.semi_axes.z});
                 },
                 [&](const Cylinder& b) {
                   const Polar p = polar(b.axis, x);
                   return std::max(std::abs(p.along) / b.half_length, p.across / b.radius);
                 },
                 [&](const Spherocylinder& b) { return spherocylinder_gauge(b, polar(b.axis, x)); },
                 [&](const Disk& b) { return norm(x) / b.radius; },
                 [&](const Ellipse& b) {
                   const Point v = turned_back(b, x);
                   return norm({v.x / b.semi_axes.x, v.y / b.semi_axes.y, 0});
                 }},
      body);
}

Real value(const Body& a, const Body& b, const Point& r, const Point& unit_d) {
  return dot(unit_d, r) - support_of(a, unit_d) - support_of(b, unit_d);
}

}  // namespace

long double gap_along(const Body& a, const Body& b, const Vec3& r, const Vec3& d) {
  return value(a, b, point(r), unit(point(d)));
}

long double support(const Body& body, const Vec3& d) { return support_of(body, point(d)); }

long double gauge(const Body& body, const Vec3& x) { return gauge_of(body, point(x)); }

bool certified(const Body& a, const Body& b, const Vec3& r, double min_gap,
               const Decision& decision) {
  if (decision.verdict == Verdict::separated) {
    return gap_along(a, b, r, decision.witness) > min_gap;
  }
  if (decision.verdict == Verdict::undecided || min_gap > 0.0) return true;
  const Point x = point(decision.witness);
  return gauge_of(a, x) <= 1 && gauge_of(b, x - point(r)) <= 1;
}

// A (1+1) evolution strategy on the sphere: steps grow on success and shrink on failure.
long double search_gap(const Body& a, const Body& b, const Vec3& r_ab, int starts,
                       std::uint64_t seed, const Vec3* hint) {
  std::mt19937_64 engine(seed);
  const auto uniform = [&] { return Real(engine() >> 11) * 0x1p-52L - 1; };
  const bool planar = dimension(kind(a)) == 2;
  const Point r = point(r_ab);
  Real best = -std::numeric_limits<Real>::infinity();
  for (int start = 0; start < starts; ++start) {
    Point d{uniform(), uniform(), planar ? 0 : uniform()};
    Real step = 1;
    if (start == 0 && hint) d = point(*hint), step = 1e-3L;
    if (start == 1 && norm(r) > 0) d = r;
    d = unit(d);
    Real here = value(a, b, r, d);
    int failures = 0;
    for (int trial = 0; trial < 3000 && step > 1e-17L; ++trial) {
      const Point offset{step * uniform(), step * uniform(), planar ? 0 : step * uniform()};
      const Point next = unit(d + offset);
      const Real there = value(a, b, r, next);
      if (there > here) {
        here = there, d = next, step = std::min<Real>(1, step * 1.7L), failures = 0;
      } else if (++failures % 2 == 0) {
        step *= 0.83L;
      }
    }
    best = std::max(best, here);
  }
  return best;
}

namespace {

struct CcdBody {
  const Body* body;
  Vec3 center;
};

void ccd_support(const void* object, const ccd_vec3_t* d, ccd_vec3_t* out) {
  const auto& o = *static_cast<const CcdBody*>(object);
  const Vec3 p = o.center + support_point(*o.body, {d->v[0], d->v[1], d->v[2]});
  ccdVec3Set(out, p.x, p.y, p.z);
}

}  // namespace

bool ccd_overlap(const Body& a, const Body& b, const Vec3& r) {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd_support;
  ccd.support2 = ccd_support;
  ccd.max_iterations = 500;
  const CcdBody body_a{&a, {}}, body_b{&b, r};
  return ccdGJKIntersect(&body_a, &body_b, &ccd) != 0;
}

}  // namespace packstone::oracle
