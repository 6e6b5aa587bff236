#include "generate/relaxation/overlap_energy.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/local_gap.hpp"
#include "geometry/touching_points.hpp"
#include "packstone/core/parallel.hpp"

namespace packstone::relaxation {
namespace {

constexpr std::size_t kChunk = NearPairs::kChunk;
constexpr double kRoundedDown = 1.0 - 0x1p-20;  // Of paths.

double mean_lateral(const Bodies& bodies) {
  double sum = 0.0;
  for (const PosedBody& body : bodies.posed) sum += body.lateral;
  return sum / static_cast<double>(bodies.count());
}

// The part of a torque that turns what may turn, per unit of motion.
Vec3 turning_part(const Turning& turning, const Vec3& torque) {
  if (turning.slot < 0) return {};
  const Vec3 part = turning.about == Vec3{} ? torque : dot(torque, turning.about) * turning.about;
  return (1.0 / turning.arm) * part;
}

}  // namespace

// Lists that last long hold many pairs in vain, and short ones are made too often.
void OverlapEnergy::find_pairs(const Bodies& bodies) {
  constexpr double kFirst = 0.5, kLeast = 0.1, kMost = 4.0;
  constexpr std::int64_t kShort = 16, kLong = 64;
  const double width = mean_lateral(bodies);
  if (margin_ == 0.0) {
    margin_ = kFirst * width;
  } else if (since_search_ < kShort) {
    margin_ = std::min(1.5 * margin_, kMost * width);
  } else if (since_search_ > kLong) {
    margin_ = std::max(0.7 * margin_, kLeast * width);
  }
  since_search_ = 0;
  ++searches_;
  pairs_.find(bodies, margin_, threads_);
}

void OverlapEnergy::look_at_pairs(const Bodies& bodies, std::size_t chunk, Contacts& contacts) {
  for (NearPair& pair : pairs_.chunk(chunk)) {
    const auto i = static_cast<std::size_t>(pair.body), j = static_cast<std::size_t>(pair.other);
    const double path = pairs_.path(i) + pairs_.path(j);
    if (path < static_cast<double>(pair.clear_until)) continue;
    const PosedBody& a = bodies.posed[i];
    const PosedBody& b = bodies.posed[j];
    const double shell = std::min(bodies.shell[i], bodies.shell[j]);
    const double wanted = bodies.min_gap + shell;
    const Vec3 r = b.pose.center - a.pose.center +
                   image_shift(cell_, {pair.image[0], pair.image[1], pair.image[2]});
    const double reach = bodies.reach[i] + bodies.reach[j] + wanted;
    if (norm_sq(r) >= reach * reach) {
      pair.clear_until = static_cast<float>((path + norm(r) - reach) * kRoundedDown);
      continue;
    }
    Vec3 hint{pair.hint[0], pair.hint[1], pair.hint[2]};
    if (hint != Vec3{}) hint = normalized(hint);
    LocalGap gap;
    const bool pushes = local_gap(a, b, r, wanted, hint, gap);
    pair.hint = {static_cast<float>(hint.x), static_cast<float>(hint.y),
                 static_cast<float>(hint.z)};
    const double depth = wanted - gap.value;
    pair.clear_until = static_cast<float>((path - depth) * kRoundedDown);
    if (!pushes) continue;
    const Vec3 force = depth * gap.normal;
    contacts.push_back({{pair.body, pair.other, depth},
                        0.5 * shell,
                        force,
                        turning_part(bodies.turning[i], cross(gap.point_a, force)),
                        turning_part(bodies.turning[j], cross(force, gap.point_b))});
  }
}

// A wall is to be kept off by the shell alone.
void OverlapEnergy::look_at_walls(const Bodies& bodies, std::size_t i, Contacts& contacts) const {
  const PosedBody& body = bodies.posed[i];
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell_.dimension); ++axis) {
    if (cell_.periodic[axis]) continue;
    for (const double side : {-1.0, 1.0}) {
      Vec3 out;
      out[axis] = side;
      const double center = body.pose.center[axis];
      const double room = side > 0.0 ? cell_.size[axis] - center : center;
      if (room - bodies.reach[i] >= bodies.shell[i]) continue;
      const double depth = bodies.shell[i] - (room - support(body, out));
      if (!(depth > 0.0)) continue;
      const Vec3 force = depth * out;
      const Vec3 point = touching_point(body, out, {});
      contacts.push_back({{static_cast<std::int32_t>(i), -1, depth},
                          0.5 * bodies.shell[i],
                          force,
                          turning_part(bodies.turning[i], cross(point, force)),
                          {}});
    }
  }
}

void OverlapEnergy::add(const Bodies& bodies, const Contact& contact, Motion& gradient,
                        Energy& energy) {
  const double depth = contact.push.depth;
  energy.value += 0.5 * depth * depth;
  energy.deepest = std::max(energy.deepest, depth);
  energy.most_left = std::max(energy.most_left, depth / contact.allowed);
  ++energy.contacts;
  const auto a = static_cast<std::size_t>(contact.push.a);
  add_at(gradient, 3 * a, contact.force);
  if (bodies.turning[a].slot >= 0) add_at(gradient, bodies.turn_at(a), contact.turn_a);
  if (contact.push.b < 0) return;
  const auto b = static_cast<std::size_t>(contact.push.b);
  add_at(gradient, 3 * b, -contact.force);
  if (bodies.turning[b].slot >= 0) add_at(gradient, bodies.turn_at(b), contact.turn_b);
}

Energy OverlapEnergy::operator()(const Bodies& bodies, Motion& gradient) {
  if (!pairs_.follow(bodies, threads_)) find_pairs(bodies);
  ++evaluations_;
  ++since_search_;
  const std::size_t n = bodies.count();
  const std::size_t chunks = (n + kChunk - 1) / kChunk;
  contacts_.resize(chunks);
  parallel_for(
      static_cast<std::int64_t>(chunks), threads_, 1, [&](std::int64_t from, std::int64_t to) {
        for (auto c = static_cast<std::size_t>(from); c < static_cast<std::size_t>(to); ++c) {
          contacts_[c].clear();
          look_at_pairs(bodies, c, contacts_[c]);
          const std::size_t last = std::min(n, (c + 1) * kChunk);
          for (std::size_t i = c * kChunk; i < last; ++i) look_at_walls(bodies, i, contacts_[c]);
        }
      });
  gradient.assign(bodies.motion_size(), 0.0);
  Energy energy;
  for (const Contacts& contacts : contacts_) {
    for (const Contact& contact : contacts) add(bodies, contact, gradient, energy);
  }
  return energy;
}

std::vector<Push> OverlapEnergy::pushes() const {
  std::vector<Push> pushes;
  for (const Contacts& contacts : contacts_) {
    for (const Contact& contact : contacts) pushes.push_back(contact.push);
  }
  return pushes;
}

}  // namespace packstone::relaxation
