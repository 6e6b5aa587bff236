#include "generate/relaxation/relocation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/local_gap.hpp"
#include "spatial/capsule_grid.hpp"

namespace packstone::relaxation {
namespace {

constexpr int kPlaces = 1000;

// What is quicker to look at and overlaps nearly as much: for a long cylinder the spherocylinder in
// it that is as long.
PosedBody stand_in(PosedBody body) {
  constexpr double kLong = 4.0;
  if (body.form != Form::cylinder || body.axial < kLong * body.lateral) return body;
  body.form = Form::spherocylinder;
  body.axial -= body.lateral;
  return body;
}

// Finds how much a body would overlap at a place.
class Places {
 public:
  Places(Bodies& bodies, const Cell& cell) : bodies_(bodies), cell_(cell), grid_(cell) {
    std::vector<Capsule> capsules;
    for (std::size_t i = 0; i < bodies.count(); ++i) {
      bodies.posed[i].pose.center = wrapped(cell, bodies.posed[i].pose.center);
      capsules.push_back(capsule_of(i));
    }
    grid_.reset(capsules);
    for (std::size_t i = 0; i < bodies.count(); ++i) {
      grid_.insert(static_cast<std::int32_t>(i), capsules[i]);
    }
  }

  // The best of kPlaces random ones, or the first without overlap.
  void move_to_best(std::size_t i, RandomStream& random) {
    grid_.remove(static_cast<std::int32_t>(i));
    double least = std::numeric_limits<double>::infinity();
    Vec3 best = bodies_.posed[i].pose.center;
    for (int k = 0; k < kPlaces && least > 0.0; ++k) {
      Vec3 place;
      for (std::size_t a = 0; a < static_cast<std::size_t>(cell_.dimension); ++a) {
        place[a] = place_along(i, a, random.uniform());
      }
      bodies_.posed[i].pose.center = place;
      const double overlap = overlap_of(i, least);
      if (!(overlap < least)) continue;
      least = overlap;
      best = place;
    }
    bodies_.posed[i].pose.center = best;
    grid_.insert(static_cast<std::int32_t>(i), capsule_of(i));
  }

 private:
  [[nodiscard]] Capsule capsule_of(std::size_t i) const {
    return capsule_about(bodies_.posed[i], 0.5 * (bodies_.min_gap + bodies_.shell[i]));
  }

  // Between the walls, where there are any.
  [[nodiscard]] double place_along(std::size_t i, std::size_t axis, double part) const {
    if (cell_.periodic[axis]) return part * cell_.size[axis];
    Vec3 out;
    out[axis] = 1.0;
    const double room = std::min(support(bodies_.posed[i], out), 0.5 * cell_.size[axis]);
    return room + part * (cell_.size[axis] - 2.0 * room);
  }

  // Sum of squared depths, as far as it is below `most`.
  double overlap_of(std::size_t i, double most) {
    double sum = 0.0;
    const PosedBody a = stand_in(bodies_.posed[i]);
    grid_.query(capsule_of(i), scratch_, [&](std::int32_t other, const CapsuleGrid::Image& image) {
      const auto j = static_cast<std::size_t>(other);
      const double wanted = bodies_.min_gap + std::min(bodies_.shell[i], bodies_.shell[j]);
      const PosedBody b = stand_in(bodies_.posed[j]);
      Vec3 hint;
      LocalGap gap;
      const Vec3 r = b.pose.center + image_shift(cell_, image) - a.pose.center;
      if (!local_gap(a, b, r, wanted, hint, gap)) return true;
      sum += (wanted - gap.value) * (wanted - gap.value);
      return sum < most;
    });
    return sum;
  }

  Bodies& bodies_;
  Cell cell_;
  CapsuleGrid grid_;
  CapsuleGrid::Scratch scratch_;
};

}  // namespace

std::int64_t relocate(Bodies& bodies, const Cell& cell, std::vector<Push> pushes, double share,
                      RandomStream& random) {
  constexpr double kOfDeepest = 0.3, kOfWidth = 0.1;
  if (pushes.empty() || !(share > 0.0)) return 0;
  std::stable_sort(pushes.begin(), pushes.end(),
                   [](const Push& p, const Push& q) { return p.depth > q.depth; });
  const auto most = static_cast<std::int64_t>(
      std::max(1.0, std::floor(share * static_cast<double>(bodies.count()))));
  Places places(bodies, cell);
  std::vector<bool> moved(bodies.count(), false);
  std::int64_t count = 0;
  for (const Push& push : pushes) {
    const auto a = static_cast<std::size_t>(push.a);
    const bool shallow = push.depth < kOfWidth * bodies.posed[a].lateral &&
                         push.depth < kOfDeepest * pushes.front().depth;
    if (shallow || count == most) break;
    const auto b = push.b < 0 ? a : static_cast<std::size_t>(push.b);
    if (moved[a] || moved[b]) continue;
    moved[a] = moved[b] = true;
    places.move_to_best(random.below(2) == 0 ? a : b, random);
    ++count;
  }
  return count;
}

}  // namespace packstone::relaxation
