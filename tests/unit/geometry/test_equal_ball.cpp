#include "packstone/geometry/equal_ball.hpp"

#include <catch2/catch.hpp>

#include "packstone/geometry/measures.hpp"

namespace packstone {

TEST_CASE("a ball of the radius returned is as large as asked") {
  for (const double measure : {1e-300, 1e-9, 1.0, 7.3, 1e12}) {
    CHECK(volume(Body{Disk{equal_ball_radius(2, measure)}}) == Approx(measure).epsilon(1e-14));
    CHECK(volume(Body{Sphere{equal_ball_radius(3, measure)}}) == Approx(measure).epsilon(1e-14));
  }
  CHECK(equal_ball_radius(2, 0.0) == 0.0);
  CHECK(equal_ball_radius(3, 0.0) == 0.0);
}

}  // namespace packstone
