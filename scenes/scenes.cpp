#include "scenes.hpp"

#include <bit>
#include <initializer_list>

#include "packstone/core/overloaded.hpp"

namespace packstone::scenes {
namespace {

class Hash {
 public:
  void add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) {
      state_ = (state_ ^ (word & 0xff)) * 0x100000001b3ULL;
      word >>= 8;
    }
  }
  void add(std::initializer_list<double> values) {
    for (double value : values) add(std::bit_cast<std::uint64_t>(value));
  }
  [[nodiscard]] std::uint64_t state() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

void add_body(Hash& hash, const Body& body) {
  hash.add(static_cast<std::uint64_t>(body.index()));
  const auto rod = [&](const auto& b) {
    hash.add({b.radius, b.half_length, b.axis.x, b.axis.y, b.axis.z});
  };
  std::visit(
      Overloaded{[&](const Sphere& b) { hash.add({b.radius}); },
                 [&](const Ellipsoid& b) {
                   const auto& q = b.orientation;
                   hash.add({b.semi_axes.x, b.semi_axes.y, b.semi_axes.z, q.w, q.x, q.y, q.z});
                 },
                 [&](const Cylinder& b) { rod(b); }, [&](const Spherocylinder& b) { rod(b); },
                 [&](const Disk& b) { hash.add({b.radius}); },
                 [&](const Ellipse& b) {
                   hash.add({b.semi_axes.x, b.semi_axes.y, b.angle});
                 }},
      body);
}

}  // namespace

std::uint64_t state_hash(const Packing& packing) {
  Hash hash;
  for (const Inclusion& inclusion : packing.inclusions) {
    hash.add({inclusion.center.x, inclusion.center.y, inclusion.center.z});
    add_body(hash, inclusion.body);
  }
  return hash.state();
}

}  // namespace packstone::scenes
