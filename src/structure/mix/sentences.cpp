#include "structure/mix/sentences.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "packstone/core/number_text.hpp"
#include "packstone/core/overloaded.hpp"
#include "packstone/geometry/measures.hpp"
#include "structure/mix/group_checks.hpp"

namespace packstone::mix {
namespace {

std::string plain_label(const InclusionGroup& group, int index) {
  return group.name.empty() ? "group " + std::to_string(index) : group.name;
}

std::vector<std::string> length_names(ShapeKind shape) {
  switch (shape) {
    case ShapeKind::ellipsoid:
      return {"semi-axis a", "semi-axis b", "semi-axis c"};
    case ShapeKind::ellipse:
      return {"semi-axis a", "semi-axis b"};
    case ShapeKind::cylinder:
      return {"diameter", "length"};
    case ShapeKind::spherocylinder:
      return {"diameter", "straight length"};
    case ShapeKind::sphere:
    case ShapeKind::disk:
      break;
  }
  return {"diameter"};
}

}  // namespace

Vec3 lengths_of(const Body& body) {
  return std::visit(Overloaded{[](const Ellipsoid& b) { return b.semi_axes; },
                               [](const Ellipse& b) { return lift(b.semi_axes); },
                               [](const Cylinder& b) {
                                 return Vec3{2.0 * b.radius, 2.0 * b.half_length, 0.0};
                               },
                               [](const Spherocylinder& b) {
                                 return Vec3{2.0 * b.radius, 2.0 * b.half_length, 0.0};
                               },
                               [](const auto& b) {
                                 return Vec3{2.0 * b.radius, 0.0, 0.0};
                               }},
                    body);
}

std::string lengths_text(const std::vector<Body>& bodies) {
  Vec3 least = lengths_of(bodies.front());
  Vec3 most = least;
  for (const Body& body : bodies) {
    const Vec3 lengths = lengths_of(body);
    for (std::size_t i = 0; i < 3; ++i) {
      least[i] = std::min(least[i], lengths[i]);
      most[i] = std::max(most[i], lengths[i]);
    }
  }
  const std::vector<std::string> names = length_names(kind(bodies.front()));
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " and " : ", ";
    text += names[i] + " " + number_text(least[i]);
    if (most[i] - least[i] > 1e-9 * most[i]) text += " to " + number_text(most[i]);
  }
  return text;
}

std::string derived_sentence(const InclusionGroup& group, int index,
                             const std::vector<Body>& bodies, double reached) {
  const std::string start = plain_label(group, index) + ": ";
  const std::string lengths = lengths_text(bodies);
  const std::string count = "count " + std::to_string(bodies.size());
  if (group.count && group.fraction) {
    return start + lengths + (is_round(group.shape) ? " follows" : " follow") + " from " + count +
           " and fraction " + number_text(*group.fraction);
  }
  if (group.count) {
    return start + "fraction " + number_text(reached) + " follows from " + count + " and " +
           lengths;
  }
  return start + count + " follows from fraction " + number_text(*group.fraction) + " and " +
         lengths + "; whole inclusions make it fraction " + number_text(reached);
}

std::string open_count_sentence(const InclusionGroup& group, int index) {
  const bool tensor =
      !is_round(group.shape) && std::holds_alternative<TensorOrientation>(group.orientation);
  return plain_label(group, index) +
         ": the count is open, inclusions are added until the cell is full" +
         (tensor ? "; the orientation tensor is met by chance only, to about 0.4 / sqrt(count), as "
                   "a sample is corrected only where its count is known"
                 : "");
}

}  // namespace packstone::mix
