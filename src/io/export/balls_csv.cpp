#include "io/export/csv_text.hpp"
#include "io/export/formats.hpp"
#include "io/export/placements.hpp"
#include "packstone/geometry/inscribed_balls.hpp"

namespace packstone {

void write_balls_csv(ByteWriter& out, const Packing& packing, const ExportOptions& options) {
  const auto axes = static_cast<std::size_t>(packing.cell.dimension);
  out.text(axes == 2 ? "inclusion,group,center_x,center_y,radius\n"
                     : "inclusion,group,center_x,center_y,center_z,radius\n");
  for (const Placement& placement : placements(packing, options.images)) {
    const Inclusion& inclusion = packing.inclusions[placement.inclusion];
    const std::string body = std::to_string(placement.inclusion) + "," +
                             csv_text(packing.groups[static_cast<std::size_t>(inclusion.group)]);
    for (const InscribedBall& ball : inscribed_balls(inclusion.body, *options.ball_spacing)) {
      const Vec3 center = placement.center + ball.center;
      std::string line = body;
      for (std::size_t a = 0; a < axes; ++a) line.append(",").append(shortest(center[a]));
      out.text(line + "," + shortest(ball.radius) + "\n");
    }
  }
}

}  // namespace packstone
