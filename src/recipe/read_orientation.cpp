#include "recipe/read_orientation.hpp"

#include <cmath>

#include "packstone/core/error.hpp"
#include "recipe/read_distribution.hpp"

namespace packstone::recipe {
namespace {

// A tensor typed by hand is symmetric to the digits typed.
constexpr double kSymmetryTolerance = 1e-9;

// A direction of length 1 within rounding is kept to the last bit, so that a recipe written and
// read again is the same.
constexpr double kUnitAlready = 4e-16;

constexpr const char* kForms3d =
    "\"random\", { axis = [x, y, z] }, { planar = \"xy\" } or { tensor = [[..], [..], [..]] }";
constexpr const char* kForms2d =
    "\"random\", { degrees = a number or a distribution }, { axis = [x, y] } or "
    "{ tensor = [[..], [..]] }";

std::optional<Vec3> read_direction(const Entry& entry, std::size_t dimension,
                                   Complaints& complaints) {
  const auto v = read_numbers(entry, {dimension}, any_number(), complaints);
  if (!v) return std::nullopt;
  const Vec3 direction{(*v)[0], (*v)[1], dimension == 3 ? (*v)[2] : 0.0};
  const double length = norm(direction);
  if (std::abs(length - 1.0) <= kUnitAlready) return direction;
  if (length > 0.0 && std::isfinite(length)) return direction / length;
  complaints.not_allowed(entry, "a direction, not zero");
  return std::nullopt;
}

std::optional<OrientationLaw> read_planar(const Entry& entry, Complaints& complaints) {
  if (!entry.node->is_table()) {
    const auto normal = read_choice<Vec3>(
        entry, {{"xy", Vec3{0, 0, 1}}, {"xz", Vec3{0, 1, 0}}, {"yz", Vec3{1, 0, 0}}}, complaints);
    if (!normal) return std::nullopt;
    return PlanarOrientation{*normal};
  }
  const TableView table(*entry.node->as_table(), entry.name, {"normal"}, complaints);
  if (!table["normal"]) {
    complaints.missing(entry.node, joined(entry.name, "normal"), "a direction [x, y, z]");
    return std::nullopt;
  }
  const auto normal = read_direction(table["normal"], 3, complaints);
  if (!normal) return std::nullopt;
  return PlanarOrientation{*normal};
}

std::optional<SymMat3> read_tensor_rows(const Entry& entry, std::size_t dimension,
                                        Complaints& complaints) {
  const toml::array* const rows = entry.node->as_array();
  if (rows == nullptr || rows->size() != dimension) {
    complaints.not_allowed(
        entry, dimension == 3 ? "three rows of three numbers" : "two rows of two numbers");
    return std::nullopt;
  }
  double t[3][3] = {};
  for (std::size_t i = 0; i < dimension; ++i) {
    const auto row = read_numbers(item(entry, i), {dimension}, any_number(), complaints);
    if (!row) return std::nullopt;
    for (std::size_t j = 0; j < dimension; ++j) t[i][j] = (*row)[j];
  }
  for (const auto& [i, j] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
    if (std::abs(t[i][j] - t[j][i]) <= kSymmetryTolerance) continue;
    complaints.not_allowed(entry, "a symmetric tensor");
    return std::nullopt;
  }
  return SymMat3{t[0][0], t[1][1], t[2][2], t[1][2], t[0][2], t[0][1]};
}

std::optional<OrientationLaw> read_tensor(const TableView& table, int dimension,
                                          Complaints& complaints) {
  TensorOrientation law;
  const auto tensor =
      read_tensor_rows(table["tensor"], static_cast<std::size_t>(dimension), complaints);
  if (const Entry family = table["family"]) {
    const auto choice = read_choice<TensorFamily>(
        family,
        {{"acg", TensorFamily::angular_central_gaussian}, {"bingham", TensorFamily::bingham}},
        complaints);
    if (!choice) return std::nullopt;
    law.family = *choice;
  }
  if (!tensor) return std::nullopt;
  law.tensor = *tensor;
  try {
    check_orientation_law(law, table.name(), dimension);
  } catch (const InvalidArgument& error) {
    complaints.add(table["tensor"].node, error.what());
    return std::nullopt;
  }
  return law;
}

std::optional<OrientationLaw> read_degrees(const Entry& entry, Complaints& complaints) {
  auto law = read_distribution(entry, Values::any, Weightable::no, complaints);
  if (!law) return std::nullopt;
  return AngleOrientation{std::move(*law)};
}

// The law of a table: exactly one of the keys that name one.
std::optional<OrientationLaw> read_law_table(const Entry& entry, int dimension,
                                             Complaints& complaints) {
  const bool plane = dimension == 2;
  const std::vector<std::string_view> known =
      plane ? std::vector<std::string_view>{"degrees", "axis", "tensor", "family"}
            : std::vector<std::string_view>{"axis", "planar", "tensor", "family"};
  const std::size_t before = complaints.count();
  const TableView table(*entry.node->as_table(), entry.name, known, complaints);
  int laws = 0;
  for (const std::string_view key : {"degrees", "axis", "planar", "tensor"}) {
    if (table[key]) ++laws;
  }
  if (complaints.count() != before) return std::nullopt;
  if (laws != 1 || (table["family"] && !table["tensor"])) {
    complaints.not_allowed(entry, plane ? kForms2d : kForms3d);
    return std::nullopt;
  }
  if (const Entry degrees = table["degrees"]) return read_degrees(degrees, complaints);
  if (const Entry planar = table["planar"]) return read_planar(planar, complaints);
  if (table["tensor"]) return read_tensor(table, dimension, complaints);
  const auto axis = read_direction(table["axis"], static_cast<std::size_t>(dimension), complaints);
  if (!axis) return std::nullopt;
  return AlignedOrientation{*axis};
}

}  // namespace

std::optional<OrientationLaw> read_orientation(const Entry& entry, int dimension,
                                               Complaints& complaints) {
  if (entry.node->is_table()) return read_law_table(entry, dimension, complaints);
  if (entry.node->value_exact<std::string>() == "random") return RandomOrientation{};
  complaints.not_allowed(entry, dimension == 2 ? kForms2d : kForms3d);
  return std::nullopt;
}

}  // namespace packstone::recipe
