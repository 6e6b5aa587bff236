#pragma once

/// @file
/// One inclusion as its file spells it: named fields, not yet a shape.

#include <array>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "packstone/structure/packing.hpp"

namespace packstone {

/// Fields of an inclusion that hold numbers.
enum class NumberField { center, radius, half_length, axis, axes, quaternion, angle };

inline constexpr std::size_t kNumberFields = 7;
inline constexpr std::size_t kShapeKinds = std::variant_size_v<Body>;

/// "sphere", "ellipsoid", ...: the names of ShapeKind, in its order.
[[nodiscard]] std::vector<std::string> shape_words();

/// "center", "radius", ...: the word in the file.
[[nodiscard]] std::string_view name(NumberField field) noexcept;

/// Numbers that `field` holds in an inclusion of this shape; 0 when it has no such field.
[[nodiscard]] int arity(NumberField field, ShapeKind shape) noexcept;

/// Whether the field is an array in the file.
[[nodiscard]] constexpr bool is_array(NumberField field) noexcept {
  return field != NumberField::radius && field != NumberField::half_length &&
         field != NumberField::angle;
}

/// Values by field.
class InclusionRecord {
 public:
  /// No field has more.
  static constexpr int kMaxNumbers = 4;

  std::array<double, kMaxNumbers>& operator[](NumberField field) {
    return numbers_[static_cast<std::size_t>(field)];
  }
  const std::array<double, kMaxNumbers>& operator[](NumberField field) const {
    return numbers_[static_cast<std::size_t>(field)];
  }

  [[nodiscard]] Vec3 center(int dimension) const;
  /// The body that the fields of `shape` describe; unchecked.
  [[nodiscard]] Body body(ShapeKind shape) const;
  /// Sets the fields of `inclusion`; the others keep what they hold.
  void set(const Inclusion& inclusion);

 private:
  std::array<std::array<double, kMaxNumbers>, kNumberFields> numbers_{};
};

}  // namespace packstone
