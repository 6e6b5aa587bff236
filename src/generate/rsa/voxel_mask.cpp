#include "generate/rsa/voxel_mask.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace packstone::rsa {
namespace {

// Edges of voxels are at most this part of the radius of the ball [-].
constexpr double kEdgePerRadius = 0.5;

// The ball is shrunk by this part, far above the rounding of corners and centers [-].
constexpr double kShrink = 1e-9;

// Half extent of the capsule about a body along an axis.
double extent(const Outline& outline, std::size_t axis) {
  return outline.half_length * std::abs(outline.axis[axis]) + outline.radius;
}

}  // namespace

// Where a ball meets a body: the body grown by the radius of the ball. Its rounding errors are far
// below what the ball is shrunk by.
class VoxelMask::BallRegion {
 public:
  BallRegion(const Outline& body, const Vec3& center, double ball)
      : center_(center),
        axis_(body.axis),
        half_length_(body.half_length),
        radius_(body.ends == Outline::Ends::flat ? body.radius : 0.0),
        range_(ball + (body.ends == Outline::Ends::round ? body.radius : 0.0)),
        across_(radius_ + range_),
        along_(half_length_ + range_),
        slope_(1.0 - axis_.x * axis_.x),
        per_slope_(slope_ > 1e-9 ? 1.0 / slope_ : 0.0),
        per_x_(std::abs(axis_.x) > 1e-9 ? 1.0 / axis_.x : 0.0) {}

  // Goes to the line along x through (y, z). False where it misses the region.
  bool enter(double y, double z) {
    const double dy = y - center_.y, dz = z - center_.z;
    off_ = dy * axis_.y + dz * axis_.z;
    off_sq_ = dy * dy + dz * dz;
    const double c = off_sq_ - across_ * across_;
    if (half_length_ == 0.0) {
      if (c >= 0.0) return false;
      hi_ = std::sqrt(-c);
      lo_ = -hi_;
      return true;
    }
    lo_ = -along_ - across_;
    hi_ = along_ + across_;
    if (per_slope_ > 0.0) {
      const double middle = axis_.x * off_;
      const double discriminant = middle * middle - slope_ * (c - off_ * off_);
      if (discriminant <= 0.0) return false;
      const double root = std::sqrt(discriminant);
      lo_ = (middle - root) * per_slope_;
      hi_ = (middle + root) * per_slope_;
    } else if (c - off_ * off_ >= 0.0) {
      return false;
    }
    if (per_x_ != 0.0) {
      const double one = (-along_ - off_) * per_x_, other = (along_ - off_) * per_x_;
      lo_ = std::max(lo_, std::min(one, other));
      hi_ = std::min(hi_, std::max(one, other));
    }
    return lo_ < hi_;
  }

  // What of the line may lie in the region: all of what does, and little else.
  [[nodiscard]] double lo() const { return center_.x + lo_; }
  [[nodiscard]] double hi() const { return center_.x + hi_; }

  // Of x in [lo(), hi()].
  [[nodiscard]] bool holds(double x) const {
    if (half_length_ == 0.0) return true;
    const double dx = x - center_.x;
    const double along = dx * axis_.x + off_;
    if (std::abs(along) <= half_length_) return true;
    const double side = std::sqrt(std::max(0.0, dx * dx + off_sq_ - along * along));
    const double past_side = std::max(0.0, side - radius_);
    const double past_end = std::max(0.0, std::abs(along) - half_length_);
    return past_side * past_side + past_end * past_end <= range_ * range_;
  }

 private:
  Vec3 center_, axis_;
  double half_length_, radius_, range_;
  double across_, along_;  // Half extents of a cylinder about the region.
  double slope_, per_slope_, per_x_;
  double off_ = 0.0, off_sq_ = 0.0, lo_ = 0.0, hi_ = 0.0;  // Of the line.
};

VoxelMask::VoxelMask(const PlacedBodies& placed, double ball, const CenterBox& domain)
    : placed_(placed),
      ball_(ball),
      dimension_(static_cast<std::size_t>(placed.cell().dimension)),
      origin_{domain.lo.x, domain.lo.y, domain.lo.z},
      end_{domain.hi.x, domain.hi.y, domain.hi.z} {
  if (dimension_ == 2) origin_[2] = end_[2] = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) length_[axis] = end_[axis] - origin_[axis];
  for (std::size_t axis = 0; axis < dimension_; ++axis) {
    const double wanted = length_[axis] / (kEdgePerRadius * ball);
    counts_[axis] = static_cast<std::int32_t>(
        std::clamp(std::ceil(wanted), 1.0, static_cast<double>(kMostAlongAxis)));
    per_count_[axis] = 1.0 / counts_[axis];
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    per_edge_[axis] = length_[axis] > 0.0 ? counts_[axis] / length_[axis] : 0.0;
    for (std::int32_t k = 0; k <= counts_[axis]; ++k) corners_[axis][k] = corner(axis, k);
  }
  open_.assign(static_cast<std::size_t>(counts_[1]) * static_cast<std::size_t>(counts_[2]),
               (Line{1} << counts_[0]) - 1);
}

bool VoxelMask::serves(double ball, const CenterBox& domain) const {
  return ball == ball_ && domain.lo == Vec3{origin_[0], origin_[1], origin_[2]} &&
         domain.hi == Vec3{end_[0], end_[1], end_[2]};
}

double VoxelMask::part() const {
  return static_cast<double>(left_.size()) /
         (static_cast<double>(open_.size()) * static_cast<double>(counts_[0]));
}

std::array<std::int32_t, 3> VoxelMask::index(std::int64_t k) const {
  const std::int32_t voxel = left_[static_cast<std::size_t>(k)];
  return {voxel & 0x3ff, (voxel >> 10) & 0x3ff, voxel >> 20};
}

// The same expressions as in VacancyList, so that a list made of voxels loses no point.
double VoxelMask::corner(std::size_t axis, std::int32_t index) const {
  return origin_[axis] + length_[axis] * (static_cast<double>(index) * per_count_[axis]);
}

VoxelMask::Range VoxelMask::corners_within(std::size_t axis, double low, double high) const {
  const double most = counts_[axis];
  const double first = std::ceil((low - origin_[axis]) * per_edge_[axis]);
  const double last = std::floor((high - origin_[axis]) * per_edge_[axis]);
  return {static_cast<std::int32_t>(std::clamp(first, 0.0, most + 1.0)),
          static_cast<std::int32_t>(std::clamp(last, -1.0, most))};
}

std::int64_t VoxelMask::expected_cost() const {
  double cost = static_cast<double>(open_.size());
  for (std::int32_t i = noticed_; i < placed_.size(); ++i) {
    const Outline& other = placed_.outline(i);
    double lines = 7.0;
    for (std::size_t axis = 1; axis < dimension_; ++axis) {
      const double reach = ball_ + extent(other, axis) + placed_.min_gap();
      lines *= 2.0 * reach * counts_[axis] / length_[axis];
    }
    cost += lines;
  }
  return static_cast<std::int64_t>(cost);
}

void VoxelMask::notice_placed() {
  if (noticed_ == placed_.size() && !left_.empty()) return;
  const Vec3 lo{origin_[0], origin_[1], origin_[2]}, hi{end_[0], end_[1], end_[2]};
  std::vector<PlacedImage> images;
  for (; noticed_ < placed_.size(); ++noticed_) {
    placed_.add_images_near(noticed_, lo, hi, ball_, images);
  }
  for (const PlacedImage& image : images) strike_out(image);
  list_left();
}

void VoxelMask::strike_out(const PlacedImage& image) {
  const Outline& other = placed_.outline(image.body);
  const double min_gap = placed_.min_gap();
  std::array<Range, 3> range{Range{0, 0}, {0, 0}, {0, 0}};
  for (std::size_t axis = 0; axis < dimension_; ++axis) {
    const double reach = ball_ + extent(other, axis) + min_gap;
    range[axis] = corners_within(axis, image.center[axis] - reach, image.center[axis] + reach);
    if (range[axis].first >= range[axis].last) return;
  }
  const bool loose = other.ends == Outline::Ends::loose;
  BallRegion region(loose ? ball_outline(other.in_radius) : other, image.center,
                    (ball_ + min_gap) * (1.0 - kShrink));
  strike_out_in(region, range[1], range[2]);
}

VoxelMask::Line VoxelMask::corners_in(BallRegion& region, std::int32_t y, std::int32_t z) const {
  if (!region.enter(corners_[1][y], corners_[2][z])) return 0;
  const double* x = corners_[0].data();
  const double first = (region.lo() - origin_[0]) * per_edge_[0];
  const double last = (region.hi() - origin_[0]) * per_edge_[0];
  if (last < 0.0 || first > counts_[0]) return 0;
  auto lo = static_cast<std::int32_t>(std::max(first, 0.0));
  auto hi = static_cast<std::int32_t>(std::min(last, static_cast<double>(counts_[0])));
  if (lo < first) ++lo;
  while (lo < hi && !region.holds(x[lo])) ++lo;
  while (lo < hi && !region.holds(x[hi])) --hi;
  return lo < hi ? ((Line{2} << (hi - lo)) - 1) << lo : 0;
}

void VoxelMask::strike_out_in(BallRegion& region, const Range& y, const Range& z) {
  std::array<Line, kMostAlongAxis + 1> below{}, above{};
  for (std::int32_t iz = z.first; iz <= z.last; ++iz) {
    for (std::int32_t iy = y.first; iy <= y.last; ++iy) {
      above[static_cast<std::size_t>(iy)] = corners_in(region, iy, iz);
    }
    if (dimension_ == 2 || iz > z.first) {
      const auto& other = dimension_ == 2 ? above : below;
      const std::int32_t layer = dimension_ == 2 ? 0 : iz - 1;
      Line* row = open_.data() + static_cast<std::ptrdiff_t>(layer) * counts_[1];
      for (auto iy = static_cast<std::size_t>(y.first); iy < static_cast<std::size_t>(y.last);
           ++iy) {
        const Line all = above[iy] & above[iy + 1] & other[iy] & other[iy + 1];
        row[iy] &= ~(all & (all >> 1));
      }
    }
    std::swap(below, above);
  }
}

void VoxelMask::list_left() {
  left_.clear();
  std::int32_t row = 0;
  for (std::int32_t z = 0; z < counts_[2]; ++z) {
    for (std::int32_t y = 0; y < counts_[1]; ++y) {
      for (Line bits = open_[static_cast<std::size_t>(row++)]; bits != 0; bits &= bits - 1) {
        left_.push_back(std::countr_zero(bits) | y << 10 | z << 20);
      }
    }
  }
}

Vec3 VoxelMask::draw(TrialNumbers::Row& numbers) const {
  const std::array<std::int32_t, 3> at =
      index(static_cast<std::int64_t>(numbers.below(static_cast<std::uint64_t>(size()))));
  Vec3 center{0, 0, 0};
  for (std::size_t axis = 0; axis < dimension_; ++axis) {
    // In the voxel but for rounding, which the shrinking covers.
    const double part = (at[axis] + numbers.uniform()) * per_count_[axis];
    center[axis] = std::min(origin_[axis] + length_[axis] * part, end_[axis]);
  }
  return center;
}

}  // namespace packstone::rsa
