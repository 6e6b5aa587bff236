#include <limits>

#include "io/export/formats.hpp"
#include "io/export/placements.hpp"
#include "packstone/core/error.hpp"
#include "packstone/io/surface_mesh.hpp"

namespace packstone {
namespace {

void write_vector(ByteWriter& out, const Vec3& v) {
  out.number(static_cast<float>(v.x));
  out.number(static_cast<float>(v.y));
  out.number(static_cast<float>(v.z));
}

void write_body(ByteWriter& out, const SurfaceMesh& mesh, const Vec3& center) {
  for (const auto& triangle : mesh.triangles) {
    const auto corner = [&](std::size_t i) {
      return mesh.points[static_cast<std::size_t>(triangle[i])];
    };
    const Vec3 across = cross(corner(1) - corner(0), corner(2) - corner(0));
    const double length = norm(across);
    write_vector(out, length > 0.0 ? across / length : Vec3{});
    for (std::size_t i = 0; i < 3; ++i) write_vector(out, center + corner(i));
    out.number(std::uint16_t{0});
  }
}

}  // namespace

void write_stl(ByteWriter& out, const Packing& packing, const ExportOptions& options) {
  if (packing.cell.dimension != 3) throw InvalidArgument("STL holds 3D surfaces; the cell is 2D");
  const std::vector<Placement> all = placements(packing, options.images);
  std::uint64_t triangles = 0;
  for (const Placement& placement : all) {
    const Body& body = packing.inclusions[placement.inclusion].body;
    triangles += triangle_count(kind(body), options.segments);
  }
  if (triangles > std::numeric_limits<std::uint32_t>::max()) {
    throw InvalidArgument("STL holds at most 2^32 - 1 triangles, these are " +
                          std::to_string(triangles) + "; take fewer segments");
  }
  constexpr std::size_t kHeader = 80;
  std::string header = "packstone binary STL";
  header.resize(kHeader, ' ');
  out.text(header);
  out.number(static_cast<std::uint32_t>(triangles));
  for (const Placement& placement : all) {
    const Body& body = packing.inclusions[placement.inclusion].body;
    write_body(out, surface_mesh(body, options.segments), placement.center);
  }
}

}  // namespace packstone
