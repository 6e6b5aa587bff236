#include "packstone/structure/orientation_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "packstone/core/error.hpp"
#include "packstone/core/symmetric_eigen.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

// Below it an eigenvalue is rounding of 0, as in draw_axes().
constexpr double kNoEigenvalue = 1e-13;

// Eigenvalues of the upper left 2 x 2 part.
Vec3 plane_eigenvalues(const SymMat3& t) {
  const double middle = 0.5 * (t.xx + t.yy);
  const double radius = std::hypot(0.5 * (t.xx - t.yy), t.xy);
  return {middle + radius, middle - radius, 0.0};
}

// What `count` random axes show, times sqrt(count): mean, standard deviation, low, high of S, then
// of rho - 1.
struct Row {
  double count;
  std::array<double, 8> scaled;
};

// By 2e6 (400 axes) to 2e8 samples (5 axes, 4 in the plane) with the generator of D. Blackman,
// S. Vigna, ACM Trans. Math. Softw. 47 (2021) 36; the ends of intervals by 2e7 at most. Up to 8
// axes the moments of rho are cut at 100 to 1000 and completed by the power law of its tail. One
// and two axes and the moments of the limit are exact: see docs/algorithms/orientations.md.
constexpr Row kSphere[] = {
    {1, {1, 0, 1, 1, kNone, kNone, kNone, kNone}},
    {2, {0.88388, 0.30619, 0.38007, 1.3877, kNone, kNone, kNone, kNone}},
    {3, {0.87577, 0.29822, 0.33803, 1.5116, kNone, kNone, 2.3427, 20993}},
    {4, {0.86368, 0.30157, 0.36036, 1.5215, kNone, kNone, 2.2473, 469.01}},
    {5, {0.85622, 0.30324, 0.34368, 1.5138, 26.708, kNone, 2.1893, 128.15}},
    {6, {0.85091, 0.30348, 0.34241, 1.5141, 15.151, kNone, 2.0478, 65.648}},
    {7, {0.84701, 0.30353, 0.3402, 1.512, 11.411, 17.541, 1.9595, 43.585}},
    {8, {0.84386, 0.30338, 0.33776, 1.5099, 9.5674, 10.532, 1.9009, 32.959}},
    {9, {0.84121, 0.30308, 0.33632, 1.507, 8.4701, 7.7244, 1.8566, 26.883}},
    {10, {0.83912, 0.30278, 0.33513, 1.5052, 7.743, 6.2155, 1.8199, 23.048}},
    {12, {0.8356, 0.30211, 0.33326, 1.5013, 6.8265, 4.66, 1.764, 18.544}},
    {14, {0.83313, 0.30142, 0.33198, 1.4973, 6.2671, 3.8662, 1.7248, 16.003}},
    {17, {0.83016, 0.30057, 0.33069, 1.493, 5.737, 3.216, 1.6812, 13.786}},
    {20, {0.82782, 0.29969, 0.32979, 1.4888, 5.3914, 2.8318, 1.6499, 12.415}},
    {26, {0.82468, 0.29845, 0.32862, 1.4829, 4.9656, 2.4039, 1.6077, 10.829}},
    {36, {0.82122, 0.29688, 0.32709, 1.4757, 4.5813, 2.0551, 1.563, 9.4896}},
    {60, {0.81701, 0.29444, 0.32615, 1.4657, 4.1754, 1.7193, 1.5153, 8.1722}},
    {150, {0.81168, 0.29092, 0.325, 1.4512, 3.7581, 1.4066, 1.4573, 6.916}},
    {400, {0.8083, 0.28852, 0.32432, 1.4412, 3.5249, 1.2462, 1.4223, 6.2589}},
    {kNone, {0.80286, 0.28359, 0.32402, 1.4221, 3.2114, 1.0425, 1.3735, 5.4224}}};
constexpr Row kCircle[] = {
    {1, {1, 0, 1, 1, kNone, kNone, kNone, kNone}},
    {2, {0.90032, 0.43524, 0.055522, 1.4131, kNone, kNone, 0.11558, 3665.9}},
    {3, {0.90911, 0.4166, 0.21043, 1.6801, kNone, kNone, 0.47905, 112.06}},
    {4, {0.89952, 0.43684, 0.14702, 1.802, 7.517, kNone, 0.31738, 36.407}},
    {5, {0.89812, 0.43988, 0.17373, 1.8422, 4.8137, kNone, 0.37672, 20.916}},
    {6, {0.89568, 0.44477, 0.16234, 1.8518, 3.9436, 6.2603, 0.34772, 15.179}},
    {7, {0.89446, 0.44732, 0.16608, 1.8565, 3.514, 4.0921, 0.3544, 12.448}},
    {8, {0.89334, 0.4495, 0.16355, 1.8667, 3.2521, 3.2305, 0.34718, 10.979}},
    {9, {0.89252, 0.45105, 0.16382, 1.8733, 3.0738, 2.7857, 0.34656, 9.9765}},
    {10, {0.89179, 0.4523, 0.1631, 1.8783, 2.9423, 2.5056, 0.34394, 9.2517}},
    {12, {0.89078, 0.45414, 0.16244, 1.8852, 2.7601, 2.1688, 0.34087, 8.2721}},
    {14, {0.89007, 0.45534, 0.16198, 1.89, 2.6375, 1.9688, 0.33863, 7.6384}},
    {17, {0.88959, 0.45695, 0.16133, 1.8965, 2.5137, 1.7859, 0.33579, 7.0235}},
    {20, {0.88911, 0.45781, 0.16107, 1.8998, 2.4277, 1.6664, 0.33418, 6.6057}},
    {26, {0.88835, 0.45913, 0.16073, 1.9052, 2.3148, 1.5205, 0.33193, 6.0834}},
    {36, {0.88785, 0.46031, 0.16008, 1.9092, 2.208, 1.3897, 0.32893, 5.6004}},
    {60, {0.88721, 0.46155, 0.15982, 1.914, 2.0878, 1.2519, 0.32638, 5.0843}},
    {150, {0.88634, 0.46254, 0.15947, 1.9171, 1.9561, 1.1104, 0.32314, 4.5459}},
    {400, {0.88597, 0.46308, 0.15908, 1.9208, 1.8791, 1.0321, 0.32072, 4.2496}},
    {kNone, {0.88623, 0.46325, 0.15912, 1.9206, 1.7725, 0.9265, 0.31823, 3.8413}}};

// Lagrange's polynomial through four rows around `count`, in 1 / sqrt(count).
std::array<double, 8> interpolated(std::span<const Row> rows, std::size_t above, double count) {
  const std::size_t first = std::clamp<std::size_t>(above, 2, rows.size() - 2) - 2;
  const auto h = [](double n) { return 1.0 / std::sqrt(n); };
  std::array<double, 8> result{};
  for (std::size_t i = first; i < first + 4; ++i) {
    double weight = 1.0;
    for (std::size_t j = first; j < first + 4; ++j) {
      if (j == i) continue;
      weight *= (h(count) - h(rows[j].count)) / (h(rows[i].count) - h(rows[j].count));
    }
    for (std::size_t k = 0; k < 8; ++k) result[k] += weight * rows[i].scaled[k];
  }
  return result;
}

std::array<double, 8> scaled_values(std::span<const Row> rows, double count) {
  const auto above = std::find_if(rows.begin(), rows.end(),
                                  [count](const Row& row) { return row.count >= count; });
  if (above->count == count) return above->scaled;
  return interpolated(rows, static_cast<std::size_t>(above - rows.begin()), count);
}

}  // namespace

OrientationOrder orientation_order(const SymMat3& tensor, int dimension) noexcept {
  const bool flat = dimension == 2;
  const Vec3 values = flat ? plane_eigenvalues(tensor) : symmetric_eigen(tensor).values;
  const double least = flat ? values.y : values.z;
  return {.eigenvalues = values,
          .nematic = flat ? 2.0 * values.x - 1.0 : 1.5 * values.x - 0.5,
          .rho = least < kNoEigenvalue ? kNone : values.x / least};
}

std::vector<Vec3> symmetry_axes(const Packing& packing, int group) {
  std::vector<Vec3> axes;
  for (const Inclusion& inclusion : packing.inclusions) {
    if (inclusion.group != group) continue;
    if (const auto axis = symmetry_axis(inclusion.body)) axes.push_back(*axis);
  }
  return axes;
}

RandomOrder random_order(std::int64_t count, int dimension) {
  if (count < 1) {
    throw InvalidArgument("count = " + std::to_string(count) + "; allowed are numbers >= 1");
  }
  if (dimension != 2 && dimension != 3) {
    throw InvalidArgument("dimension = " + std::to_string(dimension) + "; allowed are 2 and 3");
  }
  const std::span<const Row> rows = dimension == 2 ? std::span<const Row>(kCircle) : kSphere;
  const auto axes = static_cast<double>(count);
  std::array<double, 8> v = scaled_values(rows, axes);
  for (double& value : v) value /= std::sqrt(axes);
  return {.nematic = {v[0], v[1], v[2], v[3]}, .rho = {1.0 + v[4], v[5], 1.0 + v[6], 1.0 + v[7]}};
}

}  // namespace packstone
