#include "generate/relaxation/tensor_hold.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "packstone/core/symmetric_eigen.hpp"
#include "structure/tensor_turns.hpp"

namespace packstone::relaxation {
namespace {

SymMat3 mean_dyad(const Bodies& bodies, const std::vector<std::size_t>& members) {
  SymMat3 sum{};
  for (const std::size_t i : members) sum = sum + dyad(bodies.posed[i].pose.axis);
  return (1.0 / static_cast<double>(members.size())) * sum;
}

// How turns change the mean, and motions.
TensorHold::Slopes slopes_of(const Bodies& bodies, const std::vector<std::size_t>& members) {
  TensorHold::Slopes sums;
  const double weight = 2.0 / static_cast<double>(members.size());
  for (const std::size_t i : members) {
    const auto turns = basis_turns(bodies.posed[i].pose.axis);
    const double arm = bodies.turning[i].arm;
    add_products(turns, weight, sums.of_turns);
    add_products(turns, 1.0 / (arm * arm), sums.of_motions);
  }
  return {made_definite(sums.of_turns), made_definite(sums.of_motions)};
}

// The axis of a body becomes `axis`, which is near; a second axis keeps across it.
void set_axis(PosedBody& body, const Vec3& axis) {
  body.pose.axis = axis;
  if (body.form != Form::scalene) return;
  body.pose.second = normalized(body.pose.second - dot(body.pose.second, axis) * axis);
}

void lock(Bodies& bodies, const std::vector<std::size_t>& members) {
  for (const std::size_t i : members) bodies.turning[i].slot = -1;
}

// Gives those that still turn the numbers from 0 on.
void renumber(Bodies& bodies) {
  bodies.turning_count = 0;
  for (Turning& turning : bodies.turning) {
    if (turning.slot >= 0) turning.slot = bodies.turning_count++;
  }
}

// Bodies with an axis that turn, of one group.
std::vector<std::size_t> members_of(const Bodies& bodies, const Packing& packing, int group) {
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    if (packing.inclusions[i].group == group && bodies.turning[i].slot >= 0) members.push_back(i);
  }
  return members;
}

}  // namespace

void TensorHold::look(const Bodies& bodies) { slopes_ = slopes_of(bodies, members_); }

void TensorHold::project(const Bodies& bodies, Motion& motion) const {
  SymMat3 change{};
  for (const std::size_t i : members_) {
    const Vec3& u = bodies.posed[i].pose.axis;
    const Vec3 t = (1.0 / bodies.turning[i].arm) * cross(vec_at(motion, bodies.turn_at(i)), u);
    change = change + SymMat3{u.x * t.x,
                              u.y * t.y,
                              u.z * t.z,
                              0.5 * (u.y * t.z + u.z * t.y),
                              0.5 * (u.x * t.z + u.z * t.x),
                              0.5 * (u.x * t.y + u.y * t.x)};
  }
  const SymMat3 map = from_components(solve(slopes_.of_motions, components(change)));
  for (const std::size_t i : members_) {
    const Vec3& u = bodies.posed[i].pose.axis;
    add_at(motion, bodies.turn_at(i), (-1.0 / bodies.turning[i].arm) * cross(u, map * u));
  }
}

// Newton's steps. The slopes of the last look, a step away, mostly do.
bool TensorHold::restore(Bodies& bodies) const {
  constexpr int kMostRounds = 16, kPatience = 4;
  constexpr double kMet = 1e-14, kGoodEnough = 1e-12;
  double error = 0.0;
  Mat6 at_hand = slopes_.of_turns;
  for (int round = 0; round < kMostRounds; ++round) {
    if (round >= kPatience) at_hand = slopes_of(bodies, members_).of_turns;
    const Vec6 missing = components(tensor_ - mean_dyad(bodies, members_));
    error = 0.0;
    for (const double m : missing) error = std::max(error, std::abs(m));
    if (error <= kMet) return true;
    if (!(error < 0.3)) return false;
    const SymMat3 map = from_components(solve(at_hand, missing));
    for (const std::size_t i : members_) {
      const Vec3& u = bodies.posed[i].pose.axis;
      set_axis(bodies.posed[i], normalized(u + map * u));
    }
  }
  return error <= kGoodEnough;
}

std::vector<TensorHold> tensor_holds(Bodies& bodies, const Packing& packing,
                                     const RelaxationOptions& options) {
  constexpr double kNone = 1e-9;  // Of an eigenvalue.
  std::vector<TensorHold> holds;
  const bool plane = packing.cell.dimension == 2;
  const std::size_t fewest = plane ? 3 : 4;
  for (int group = 0; group < static_cast<int>(packing.groups.size()); ++group) {
    const auto g = static_cast<std::size_t>(group);
    if (!options.turn.empty() && options.turn[g] != RelaxationTurn::hold_tensor) continue;
    std::vector<std::size_t> members = members_of(bodies, packing, group);
    if (members.empty()) continue;
    const SymMat3 tensor = mean_dyad(bodies, members);
    const SymmetricEigen eigen = symmetric_eigen(tensor);
    if (members.size() < fewest || eigen.values.y < kNone) {
      lock(bodies, members);
      continue;
    }
    if (!plane && eigen.values.z < kNone) {
      for (const std::size_t i : members) bodies.turning[i].about = eigen.vectors.col_z;
    }
    holds.emplace_back(std::move(members), tensor);
    holds.back().look(bodies);
  }
  renumber(bodies);
  return holds;
}

}  // namespace packstone::relaxation
