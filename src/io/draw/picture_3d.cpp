#include "io/draw/picture_3d.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "io/draw/cells_3d.hpp"
#include "io/draw/palette.hpp"
#include "io/draw/solid.hpp"
#include "io/draw/triangles.hpp"
#include "packstone/core/parallel.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/support.hpp"
#include "packstone/structure/images.hpp"

namespace packstone::draw {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// --- What stands in the picture ------------------------------------------------------------------

void add_edges(const Cell& cell, std::vector<Solid>& solids) {
  const double radius = 0.0022 * norm(cell.size);
  const Vec3 color{0.03, 0.03, 0.035};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 direction;
    direction[axis] = 1.0;
    const std::size_t b = (axis + 1) % 3;
    const std::size_t c = (axis + 2) % 3;
    for (int corner = 0; corner < 4; ++corner) {
      Vec3 middle = 0.5 * cell.size[axis] * direction;
      middle[b] = (corner & 1) != 0 ? cell.size[b] : 0.0;
      middle[c] = (corner & 2) != 0 ? cell.size[c] : 0.0;
      const Spherocylinder edge{radius, 0.5 * cell.size[axis], direction};
      solids.push_back(make_solid(edge, middle, color, false));
    }
  }
}

std::vector<Solid> all_solids(const Packing& packing, const DrawOptions& options) {
  const std::vector<Vec3> colors = inclusion_colors(packing, options.color_by);
  std::vector<Solid> solids;
  for (std::size_t i = 0; i < packing.inclusions.size(); ++i) {
    const Inclusion& inclusion = packing.inclusions[i];
    if (options.cut) {
      for (const auto& image : images_in_cell(packing.cell, inclusion)) {
        const Vec3 center = inclusion.center + image_shift(packing.cell, image);
        solids.push_back(make_solid(inclusion.body, center, colors[i], true));
      }
    } else {
      solids.push_back(make_solid(inclusion.body, inclusion.center, colors[i], false));
    }
  }
  add_edges(packing.cell, solids);
  return solids;
}

Box bounds_of(const Solid& solid, const Box& clip) {
  const Vec3 half = half_extents(solid.body);
  Box box{solid.center - half, solid.center + half};
  for (std::size_t a = 0; a < 3 && solid.clipped; ++a) {
    box.low[a] = std::max(box.low[a], clip.low[a]);
    box.high[a] = std::min(box.high[a], clip.high[a]);
  }
  return box;
}

// --- Rays ----------------------------------------------------------------------------------------

struct Hit {
  double t = kInfinity;
  Vec3 normal;
  Vec3 color;
};

// Solids and triangles under Embree's bounding volume hierarchy (I. Wald et al., ACM Trans. Graph.
// 33 (2014) 143); the intersections with solids are ours, so that curved surfaces stay exact at any
// zoom.
class Scene {
 public:
  Scene(std::vector<Solid> solids, Triangles triangles, const Box& clip)
      : solids_(std::move(solids)),
        triangles_(std::move(triangles)),
        clip_(clip),
        device_(rtcNewDevice(nullptr)),
        scene_(rtcNewScene(device_.get())) {
    attach_solids();
    if (!triangles_.corners.empty()) attach_triangles();
    rtcCommitScene(scene_.get());
  }

  [[nodiscard]] Box bounds() const {
    Box all = clip_;
    for (const Solid& solid : solids_) grow(all, bounds_of(solid, clip_));
    for (const Vec3& point : triangles_.points) grow(all, {point, point});
    return all;
  }

  [[nodiscard]] const std::vector<Solid>& solids() const { return solids_; }
  [[nodiscard]] const Triangles& triangles() const { return triangles_; }

  [[nodiscard]] std::optional<Hit> first_hit(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray = to_embree(ray, kInfinity);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_.get(), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    if (query.hit.geomID == kTriangles) return triangle_hit(query);
    const Solid& solid = solids_[query.hit.primID];
    // The same rounded ray as in the query: at grazing incidence another one might miss.
    const Crossing c = visible(solid, from_embree(query.ray));
    return Hit{c.enter, c.normal, solid.color};
  }

  [[nodiscard]] bool blocked(const Ray& ray, double reach) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay query = to_embree(ray, reach);
    rtcOccluded1(scene_.get(), &context, &query);
    return query.tfar < 0.0F;
  }

 private:
  struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  };
  struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };

  // Geometries by number, in the order in which they are attached.
  static constexpr unsigned kTriangles = 1;

  void attach_solids() {
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(solids_.size()));
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryBoundsFunction(geometry, &Scene::on_bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, &Scene::on_intersect);
    rtcSetGeometryOccludedFunction(geometry, &Scene::on_occluded);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
  }

  void attach_triangles() {
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               triangles_.points.size()));
    for (const Vec3& point : triangles_.points) {
      for (std::size_t a = 0; a < 3; ++a) *points++ = static_cast<float>(point[a]);
    }
    auto* corners = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), triangles_.corners.size()));
    for (const auto& triangle : triangles_.corners) {
      corners = std::copy(triangle.begin(), triangle.end(), corners);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
  }

  static void grow(Box& all, const Box& box) {
    for (std::size_t a = 0; a < 3; ++a) {
      all.low[a] = std::min(all.low[a], box.low[a]);
      all.high[a] = std::max(all.high[a], box.high[a]);
    }
  }

  // Both sides are lit: the normal looks back along the ray.
  [[nodiscard]] Hit triangle_hit(const RTCRayHit& query) const {
    const Vec3 normal = normalized(Vec3{query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z});
    const Vec3 direction = from_embree(query.ray).direction;
    return {query.ray.tfar, dot(normal, direction) > 0.0 ? -normal : normal,
            triangles_.colors[query.hit.primID]};
  }

  static RTCRay to_embree(const Ray& ray, double reach) {
    RTCRay query{};
    query.org_x = static_cast<float>(ray.origin.x);
    query.org_y = static_cast<float>(ray.origin.y);
    query.org_z = static_cast<float>(ray.origin.z);
    query.dir_x = static_cast<float>(ray.direction.x);
    query.dir_y = static_cast<float>(ray.direction.y);
    query.dir_z = static_cast<float>(ray.direction.z);
    query.tnear = 0.0F;
    query.tfar = static_cast<float>(reach);
    query.mask = ~0U;
    return query;
  }

  static Ray from_embree(const RTCRay& query) {
    return {{query.org_x, query.org_y, query.org_z}, {query.dir_x, query.dir_y, query.dir_z}};
  }

  [[nodiscard]] Crossing visible(const Solid& solid, const Ray& ray) const {
    const Crossing whole = crossing(solid, ray);
    return solid.clipped ? intersection(whole, crossing(clip_, ray)) : whole;
  }

  static void on_bounds(const RTCBoundsFunctionArguments* args) {
    const auto* self = static_cast<const Scene*>(args->geometryUserPtr);
    const Box box = bounds_of(self->solids_[args->primID], self->clip_);
    // One float step outward: the boxes are rounded to single precision.
    const auto down = [](double x) { return std::nextafter(static_cast<float>(x), -1e30F); };
    const auto up = [](double x) { return std::nextafter(static_cast<float>(x), 1e30F); };
    RTCBounds& out = *args->bounds_o;
    out.lower_x = down(box.low.x);
    out.lower_y = down(box.low.y);
    out.lower_z = down(box.low.z);
    out.upper_x = up(box.high.x);
    out.upper_y = up(box.high.y);
    out.upper_z = up(box.high.z);
  }

  // The entry of the ray into the solid, when it lies within the ray's reach.
  [[nodiscard]] std::optional<float> entry(unsigned solid, const RTCRay& query) const {
    const Crossing c = visible(solids_[solid], from_embree(query));
    const auto t = static_cast<float>(c.enter);
    if (c.empty() || t < query.tnear || t > query.tfar) return std::nullopt;
    return t;
  }

  static void on_intersect(const RTCIntersectFunctionNArguments* args) {
    if (args->valid[0] == 0) return;
    const auto* self = static_cast<const Scene*>(args->geometryUserPtr);
    auto* query = reinterpret_cast<RTCRayHit*>(args->rayhit);
    const std::optional<float> t = self->entry(args->primID, query->ray);
    if (!t) return;
    query->ray.tfar = *t;
    query->hit.geomID = args->geomID;
    query->hit.primID = args->primID;
  }

  static void on_occluded(const RTCOccludedFunctionNArguments* args) {
    if (args->valid[0] == 0) return;
    const auto* self = static_cast<const Scene*>(args->geometryUserPtr);
    auto* query = reinterpret_cast<RTCRay*>(args->ray);
    if (self->entry(args->primID, *query)) query->tfar = -std::numeric_limits<float>::infinity();
  }

  std::vector<Solid> solids_;
  Triangles triangles_;
  Box clip_;
  std::unique_ptr<RTCDeviceTy, ReleaseDevice> device_;
  std::unique_ptr<RTCSceneTy, ReleaseScene> scene_;
};

// --- Camera --------------------------------------------------------------------------------------

class Camera {
 public:
  // Looks at the middle of `box`, far enough away that lines stay almost parallel; the solids fill
  // the picture but for a margin.
  Camera(const Scene& scene, const Box& box, const DrawOptions& options)
      : aspect_(static_cast<double>(options.width) / options.height) {
    const double azimuth = options.azimuth * std::numbers::pi / 180.0;
    const double elevation = options.elevation * std::numbers::pi / 180.0;
    const Vec3 back{std::cos(elevation) * std::sin(azimuth),
                    -std::cos(elevation) * std::cos(azimuth), std::sin(elevation)};
    right_ = {std::cos(azimuth), std::sin(azimuth), 0.0};
    up_ = cross(back, right_);
    forward_ = -back;
    const Vec3 middle = 0.5 * (box.low + box.high);
    eye_ = middle + 2.6 * norm(box.high - box.low) * back;
    frame(scene);
  }

  // x, y in [0, 1] from the lower left corner.
  [[nodiscard]] Ray ray(double x, double y) const {
    const double u = center_u_ + (2.0 * x - 1.0) * half_ * aspect_;
    const double v = center_v_ + (2.0 * y - 1.0) * half_;
    return {eye_, normalized(forward_ + u * right_ + v * up_)};
  }

  // Over the left shoulder, from above.
  [[nodiscard]] Vec3 key_light() const {
    return normalized(-0.55 * right_ + Vec3{0, 0, 1.0} - 0.45 * forward_);
  }

 private:
  // How far the solid reaches along `side` in the picture plane. The outermost point of a view in
  // perspective lies where the plane through the eye touches; a second look from there suffices,
  // since the view is almost parallel.
  [[nodiscard]] double edge(const Solid& solid, const Vec3& side) const {
    double at = 0.0;
    for (int look = 0; look < 2; ++look) {
      const Vec3 p = solid.center + support_point(solid.body, side - at * forward_) - eye_;
      at = dot(p, side) / dot(p, forward_);
    }
    return at;
  }

  void frame(const Scene& scene) {
    Vec2 low{kInfinity, kInfinity};
    Vec2 high{-kInfinity, -kInfinity};
    for (const Solid& solid : scene.solids()) {
      if (solid.clipped) continue;  // inside the cell, whose edges are solids too
      low = {std::min(low.x, -edge(solid, -right_)), std::min(low.y, -edge(solid, -up_))};
      high = {std::max(high.x, edge(solid, right_)), std::max(high.y, edge(solid, up_))};
    }
    for (const Vec3& point : scene.triangles().points) {
      const Vec3 p = point - eye_;
      const Vec2 at{dot(p, right_) / dot(p, forward_), dot(p, up_) / dot(p, forward_)};
      low = {std::min(low.x, at.x), std::min(low.y, at.y)};
      high = {std::max(high.x, at.x), std::max(high.y, at.y)};
    }
    constexpr double margin = 1.05;
    center_u_ = 0.5 * (low.x + high.x);
    center_v_ = 0.5 * (low.y + high.y);
    half_ = margin * std::max(0.5 * (high.y - low.y), 0.5 * (high.x - low.x) / aspect_);
  }

  double aspect_;
  Vec3 eye_, right_, up_, forward_;
  double center_u_ = 0.0, center_v_ = 0.0, half_ = 1.0;
};

// --- Light ---------------------------------------------------------------------------------------

// Well spread points of the unit square for the samples of one pixel: an additive recurrence with
// the powers of 1/1.32471796 (M. Roberts, "The unreasonable effectiveness of quasirandom
// sequences", 2018), turned by an offset of its own in every pixel so that no pattern shows.
class PixelSamples {
 public:
  PixelSamples(int x, int y)
      : random_(0, StreamId::draw, static_cast<std::uint64_t>(y), static_cast<std::uint64_t>(x)) {
    for (Vec2& offset : offsets_) offset = {random_.uniform(), random_.uniform()};
  }

  void select(int sample) { sample_ = sample; }

  // The selected sample's point for one use.
  enum Use : std::size_t { film, sky, key };
  [[nodiscard]] Vec2 point(Use use) const {
    const Vec2& offset = offsets_[use];
    return {part(offset.x + 0.7548776662466927 * sample_),
            part(offset.y + 0.5698402909980532 * sample_)};
  }

 private:
  static double part(double x) { return x - std::floor(x); }

  RandomStream random_;
  std::array<Vec2, 3> offsets_{};
  int sample_ = 0;
};

// A direction about `axis`, its cosine distributed so that `spread` = 1 gives Lambert's law over
// the half-space and a small `spread` a narrow cone.
Vec3 direction_about(const Vec3& axis, double spread, const Vec2& point) {
  const Vec3 side = any_perpendicular(axis);
  const double rho = spread * std::sqrt(point.x);
  const double phi = 2.0 * std::numbers::pi * point.y;
  const Vec3 across = rho * (std::cos(phi) * side + std::sin(phi) * cross(axis, side));
  return across + std::sqrt(1.0 - rho * rho) * axis;
}

class Shader {
 public:
  Shader(const Scene& scene, const Box& box, const Camera& camera)
      : scene_(scene),
        key_(camera.key_light()),
        reach_(0.35 * norm(box.high - box.low)),
        offset_(1e-5 * norm(box.high - box.low)),
        ground_(box.low.z - 0.015 * norm(box.high - box.low)) {}

  [[nodiscard]] Vec3 color(const Ray& ray, const PixelSamples& samples) const {
    if (const auto hit = scene_.first_hit(ray)) return lit(*hit, ray, samples);
    return ground(ray, samples);
  }

 private:
  [[nodiscard]] Vec3 lit(const Hit& hit, const Ray& ray, const PixelSamples& samples) const {
    const Vec3 at = ray.origin + hit.t * ray.direction + offset_ * hit.normal;
    const Vec3 sky = direction_about(hit.normal, 1.0, samples.point(PixelSamples::sky));
    const double ambient = scene_.blocked({at, sky}, reach_) ? 0.24 : 0.62;
    const Vec3 light = direction_about(key_, 0.12, samples.point(PixelSamples::key));
    const double facing = dot(hit.normal, light);
    const bool lighted = facing > 0.0 && !scene_.blocked({at, light}, kInfinity);
    const double key = lighted ? 0.75 * facing : 0.0;
    const Vec3 halfway = normalized(light - ray.direction);
    const double gloss =
        lighted ? 0.10 * std::pow(std::max(0.0, dot(hit.normal, halfway)), 40.0) : 0.0;
    return (ambient + key) * hit.color + gloss * Vec3{1, 1, 1};
  }

  // White paper that only takes shadows.
  [[nodiscard]] Vec3 ground(const Ray& ray, const PixelSamples& samples) const {
    constexpr Vec3 paper{1, 1, 1};
    if (ray.direction.z >= 0.0) return paper;
    const double t = (ground_ - ray.origin.z) / ray.direction.z;
    const Vec3 at = ray.origin + t * ray.direction;
    const Vec3 sky = direction_about({0, 0, 1}, 1.0, samples.point(PixelSamples::sky));
    const Vec3 light = direction_about(key_, 0.12, samples.point(PixelSamples::key));
    const bool under = scene_.blocked({at, sky}, reach_);
    const bool shaded = scene_.blocked({at, light}, kInfinity);
    return (1.0 - (under ? 0.25 : 0.0) - (shaded ? 0.28 : 0.0)) * paper;
  }

  const Scene& scene_;
  Vec3 key_;
  double reach_;
  double offset_;
  double ground_;
};

Vec3 pixel(const Shader& shader, const Camera& camera, const DrawOptions& options, int x, int y) {
  PixelSamples samples(x, y);
  const int count = options.samples * options.samples;
  Vec3 sum;
  for (int i = 0; i < count; ++i) {
    samples.select(i);
    const Vec2 at = samples.point(PixelSamples::film);
    sum += shader.color(camera.ray((x + at.x) / options.width, 1.0 - (y + at.y) / options.height),
                        samples);
  }
  return sum / static_cast<double>(count);
}

Image picture_of(const Scene& scene, const DrawOptions& options, RunContext& run) {
  const Box box = scene.bounds();
  const Camera camera(scene, box, options);
  const Shader shader(scene, box, camera);
  Image image(options.width, options.height);
  // Embree limits the pool of threads to the machine's; asking for more would only draw a warning.
  const int threads = std::min(run.threads(), hardware_threads());
  constexpr int band = 16;  // rows between two looks at the run context
  for (int top = 0; top < options.height; top += band) {
    if (run.stop_request() != StopRequest::none) break;
    const int rows = std::min(band, options.height - top);
    parallel_for(rows, threads, 1, [&](std::int64_t begin, std::int64_t end) {
      for (auto row = top + static_cast<int>(begin); row < top + static_cast<int>(end); ++row) {
        for (int x = 0; x < options.width; ++x) {
          image.at(x, row) = pixel(shader, camera, options, x, row);
        }
      }
    });
    run.report({.stage = "drawing", .done = static_cast<double>(top + rows) / options.height});
  }
  return image;
}

}  // namespace

Image picture_3d(const Packing& packing, const DrawOptions& options, RunContext& run) {
  const Scene scene(all_solids(packing, options), {}, {{0, 0, 0}, packing.cell.size});
  return picture_of(scene, options, run);
}

Image cells_3d(const Tessellation& tessellation, const DrawOptions& options, RunContext& run) {
  std::vector<Solid> edges = outer_edges(tessellation);
  add_edges(tessellation.box, edges);
  const Scene scene(std::move(edges), outer_facets(tessellation, options.color_by),
                    {{0, 0, 0}, tessellation.box.size});
  return picture_of(scene, options, run);
}

}  // namespace packstone::draw
