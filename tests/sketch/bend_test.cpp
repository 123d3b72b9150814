// Must show 1 and 4 of the issue: cylinders bent into letters, noisy strokes, refinement, morph.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "pliant/geometry/measure.h"
#include "sketch/sketch_support.h"
#include "support/random.h"

namespace pliant {
namespace {

using test::front_pixel;

constexpr double pi = std::numbers::pi;
constexpr int around = 60, along = 200;  // 12,000 vertices and two lids
constexpr double radius = 0.05;
constexpr double low = 0.02, high = 0.98;  // where the reference begins and ends

const test::Mesh& rod() {
  static const test::Mesh mesh = test::cylinder(around, along, radius);
  return mesh;
}

Stroke reference() { return test::straight(front_pixel(0.0, low), front_pixel(0.0, high)); }

Eigen::Vector3d center(const Points& positions, int ring) {
  return positions.middleCols(ring * around, around).rowwise().mean();
}

double length_of_axis(const Points& positions) {
  double length = 0.0;
  for (int j = 1; j < along; ++j) {
    length += (center(positions, j) - center(positions, j - 1)).norm();
  }
  return length;
}

struct Letter {
  const char* name;
  double (*curvature)(double s);  ///< times the stroke's length
  std::vector<double> jumps;      ///< of the curvature, over s
};

// Unit curvature pi over the whole stroke is half a turn.
const Letter letters[] = {
    {"C", [](double) { return -1.3 * pi; }, {}},
    {"S", [](double s) { return s < 0.5 ? 1.2 * pi : -1.2 * pi; }, {0.5}},
    {"O", [](double) { return 1.95 * pi; }, {}},
    {"U", [](double s) { return s > 0.35 && s < 0.65 ? -pi / 0.3 : 0.0; }, {0.35, 0.65}},
    {"L", [](double s) { return s > 0.6 && s < 0.75 ? -0.5 * pi / 0.15 : 0.0; }, {0.6, 0.75}},
    {"e", [](double s) { return s < 0.3 ? 0.0 : (s < 0.45 ? 0.5 * pi / 0.15 : 1.2 * pi / 0.55); }, {0.3, 0.45}},
};

Stroke target_of(const Letter& letter) {
  return test::curved(front_pixel(0.0, low), high - low, [&](double s) { return letter.curvature(s) / (high - low); });
}

TEST_CASE("a target equal to the reference changes nothing") {
  for (const bool smooth : {false, true}) {
    SketchOptions options;
    options.smooth = smooth;
    const Stroke wavy = test::curved(front_pixel(0.0, low), high - low, [](double s) { return std::sin(9.0 * s); });
    const auto sketch = test::sketch_on(rod(), wavy, options);
    REQUIRE(sketch->bend(wavy).ok());
    CHECK((sketch->positions() - test::positions_of(rod())).cwiseAbs().maxCoeff() <= 1e-6 * test::diagonal(rod()));
    // The same stroke moved is the same target.
    Stroke moved = wavy;
    moved.colwise() += Eigen::Vector2d(130.0, -75.0);
    REQUIRE(sketch->bend(moved).ok());
    CHECK((sketch->positions() - test::positions_of(rod())).cwiseAbs().maxCoeff() <= 1e-6 * test::diagonal(rod()));
  }
}

TEST_CASE("a cylinder bent into letters keeps length and volume and does not fold") {
  for (const Letter& letter : letters) {
    CAPTURE(std::string(letter.name));
    for (const bool smooth : {false, true}) {
      SketchOptions options;
      options.smooth = smooth;
      const auto sketch = test::sketch_on(rod(), reference(), options);
      REQUIRE(sketch->bend(target_of(letter)).ok());
      const Points bent = sketch->positions();
      CHECK(length_of_axis(bent) == doctest::Approx(1.0).epsilon(0.01));
      const Quality quality = measure_quality(sketch->shape(), test::point_positions(*sketch), false);
      CHECK(*quality.volume == doctest::Approx(1.0).epsilon(0.01));
      CHECK(quality.folds == 0);  // kappa r stays below 0.9
    }
  }
}

TEST_CASE("a bent fibre stretches by 1 - kappa r, on both sides of the curve") {
  SketchOptions options;
  options.smooth = false;
  for (const Letter& letter : letters) {
    CAPTURE(std::string(letter.name));
    const auto sketch = test::sketch_on(rod(), reference(), options);
    REQUIRE(sketch->bend(target_of(letter)).ok());
    const Points bent = sketch->positions();
    std::vector<double> jumps = letter.jumps;
    jumps.insert(jumps.end(), {0.0, 1.0});
    double worst = 0.0;
    for (int j = 0; j + 1 < along; ++j) {
      const double s = ((j + 0.5) / (along - 1) - low) / (high - low);
      const bool near_jump =
          std::any_of(jumps.begin(), jumps.end(), [&](double jump) { return std::abs(s - jump) < 0.04; });
      if (s < 0.0 || s > 1.0 || near_jump) continue;
      const double kappa = letter.curvature(s) / (high - low);
      for (int i = 0; i < around; ++i) {
        const double x = radius * std::cos(2 * pi * i / around);
        const double stretch = (bent.col((j + 1) * around + i) - bent.col(j * around + i)).norm() * (along - 1);
        worst = std::max(worst, std::abs(stretch / (1.0 + kappa * x) - 1.0));
      }
    }
    CHECK(worst < 0.01);
  }
}

TEST_CASE("what is beyond the stroke stays still or moves as one") {
  const auto sketch = test::sketch_on(rod(), reference());
  REQUIRE(sketch->bend(target_of(letters[0])).ok());
  const std::vector<Index> labels = sketch->labels();
  const Points rest = test::positions_of(rod()), bent = sketch->positions();
  std::vector<Index> rigid;
  for (Index v = 0; v < rod().vertices(); ++v) {
    if (labels[v] == 0) CHECK(bent.col(v) == rest.col(v));
    if (labels[v] == 2) rigid.push_back(v);
  }
  REQUIRE(rigid.size() > around);
  for (const Index v : rigid) {
    const double before = (rest.col(v) - rest.col(rigid[0])).norm();
    CHECK((bent.col(v) - bent.col(rigid[0])).norm() == doctest::Approx(before).epsilon(1e-9));
  }
}

TEST_CASE("a noisy stroke: smoothing takes the roughness, not the tip") {
  test::Random random(7);
  Stroke noisy = target_of(letters[0]);
  noisy = noisy(Eigen::all, Eigen::seq(0, Eigen::last, 9)).eval();
  for (Index i = 1; i + 1 < noisy.cols(); ++i) {
    noisy.col(i) += 2.0 * Eigen::Vector2d(random.number(), random.number());
  }
  SketchOptions options;
  options.smooth = false;
  const auto sketch = test::sketch_on(rod(), reference(), options);
  // What the stroke adds: a rod of triangles has a roughness of its own at rest, which smoothing a
  // stroke cannot take away.
  const auto roughness = [&] {
    const Quality q = measure_quality(sketch->shape(), test::point_positions(*sketch), false);
    return std::sqrt(q.roughness * q.roughness - q.roughness_rest * q.roughness_rest);
  };
  REQUIRE(sketch->bend(noisy).ok());
  const double before = roughness();
  const Eigen::Vector3d tip = center(sketch->positions(), along - 1);
  sketch->set_smooth(true);
  MESSAGE("roughness after smoothing over before: " << roughness() / before);
  CHECK(roughness() <= 0.4 * before);
  CHECK((center(sketch->positions(), along - 1) - tip).norm() <= 0.02);
}

TEST_CASE("morph ends at rest and at the pose, and stretches less than a straight blend") {
  const auto sketch = test::sketch_on(rod(), reference());
  REQUIRE(sketch->bend(target_of(letters[3])).ok());
  const Points rest = sketch->shape().points(), pose = test::point_positions(*sketch);
  REQUIRE(sketch->set_morph(0.0).ok());
  CHECK(test::point_positions(*sketch) == rest);
  REQUIRE(sketch->set_morph(1.0).ok());
  CHECK(test::point_positions(*sketch) == pose);
  REQUIRE(sketch->set_morph(0.5).ok());
  const Quality half = measure_quality(sketch->shape(), test::point_positions(*sketch), false);
  const Quality straight = measure_quality(sketch->shape(), 0.5 * (rest + pose), false);
  CHECK(half.stretch_mean <= 0.5 * straight.stretch_mean);
  CHECK(sketch->set_morph(1.5).message() == "morph is 1.5; expected a number from 0 to 1");
}

TEST_CASE("the turning control adds F(s) - s radians a unit of s, whatever the stroke") {
  const std::vector<Profile::Point> points{{0.0, 2.0}, {1.0, 3.0}};
  const Profile offset = *Profile::create(points, "turning");
  for (const double end : {0.3, high}) {
    const auto sketch = test::sketch_on(rod(), test::straight(front_pixel(0.0, low), front_pixel(0.0, end)));
    REQUIRE(sketch->bend(test::straight(front_pixel(0.0, low), front_pixel(0.0, end))).ok());
    sketch->set_turning(offset);
    const SketchPose pose = sketch->pose();
    double turned = 0.0;
    for (const double turn : pose.turns) turned += turn;
    CHECK(turned == doctest::Approx(2.0).epsilon(0.03));
    sketch->set_turning(Profile::identity());
    CHECK(test::point_positions(*sketch) == sketch->shape().points());
  }
}

TEST_CASE("an unfinished target bends as far as it is drawn and goes on as the reference") {
  const auto sketch = test::sketch_on(rod(), reference());
  const Stroke whole = target_of(letters[0]);
  REQUIRE(sketch->bend(whole.leftCols(500), true).ok());
  const Points half_drawn = sketch->positions();
  CHECK(length_of_axis(half_drawn) == doctest::Approx(1.0).epsilon(0.01));
  REQUIRE(sketch->bend(whole).ok());
  const Points drawn = sketch->positions();
  for (int j = 0; j < along * 4 / 10; ++j) {
    CHECK((center(drawn, j) - center(half_drawn, j)).norm() < 0.01);
  }
}

TEST_CASE("poses are kept, blended and set again") {
  const auto sketch = test::sketch_on(rod(), reference());
  const SketchPose rest = sketch->pose();
  REQUIRE(sketch->bend(target_of(letters[1])).ok());
  REQUIRE(sketch->twist(1.0).ok());
  const SketchPose s = sketch->pose();
  const Points at_s = sketch->positions();
  REQUIRE(sketch->set_morph(0.5).ok());
  const Points halfway = sketch->positions();
  REQUIRE(sketch->set_morph(1.0).ok());
  REQUIRE(sketch->set_pose(SketchPose::blend(rest, s, 0.5)).ok());
  CHECK((sketch->positions() - halfway).cwiseAbs().maxCoeff() < 1e-9);
  REQUIRE(sketch->set_pose(s).ok());
  CHECK((sketch->positions() - at_s).cwiseAbs().maxCoeff() < 1e-9);
  sketch->reset();
  CHECK(sketch->positions() == test::positions_of(rod()));
  SketchPose wrong = s;
  wrong.turns.pop_back();
  CHECK_FALSE(sketch->set_pose(wrong).ok());
}

TEST_CASE("a scene of any size, anywhere, is posed alike") {
  const test::Mesh mesh = test::cylinder(16, 40, 0.05);
  const Stroke reference = test::straight(front_pixel(0.0, 0.2), front_pixel(0.0, 0.8));
  const Stroke target = test::curved(front_pixel(0.0, 0.2), 0.6, [](double) { return 2.0; });
  const auto posed = [&](double scale, const Eigen::Vector3d& origin, bool perspective) {
    CameraOptions camera = test::front_view();
    camera.eye = scale * camera.eye + origin;
    camera.target = scale * camera.target + origin;
    if (perspective) {
      camera.orthographic_height.reset();
      camera.fov_y = 22.6;
    } else {
      camera.orthographic_height = scale * *camera.orthographic_height;
    }
    const test::Mesh there = test::transformed(mesh, scale, Eigen::Matrix3d::Identity(), origin);
    const auto sketch = test::sketch_on(there, reference, {}, camera);
    CHECK(sketch->bend(target).ok());
    CHECK(sketch->twist(1.0).ok());
    CHECK(sketch->set_scale(Profile::constant(1.5)).ok());
    CHECK(sketch->refine(there.triangles).ok());
    sketch->unrefine();
    return Points((sketch->positions().colwise() - origin) / scale);
  };
  for (const bool perspective : {false, true}) {
    const Points expected = posed(1.0, {0, 0, 0}, perspective);
    for (const double scale : {1e-30, 1e-20, 1e-6, 1e6, 1e20, 1e28}) {
      INFO(scale << " " << perspective);
      CHECK((posed(scale, {0, 0, 0}, perspective) - expected).cwiseAbs().maxCoeff() < 1e-6);
    }
    CHECK((posed(1.0, {1e6, -3e6, 1e6}, perspective) - expected).cwiseAbs().maxCoeff() < 1e-4);
  }
}

TEST_CASE("a shape too small to be seen is refused, points that all but coincide move as one") {
  const Stroke reference = test::straight(front_pixel(0.0, 0.2), front_pixel(0.0, 0.8));
  const Camera camera = *Camera::create(test::front_view());
  const test::Mesh tiny = test::transformed(test::cylinder(16, 40, 0.05), 1e-20);
  const Status status = Sketch::create(test::shape_of(tiny), camera, reference).status();
  CHECK(status.code() == ErrorCode::invalid_option);
  CHECK(status.message() == "camera.eye is 5 away from the shape; expected at most 1e7 times its size");

  test::Mesh mesh = test::cylinder(16, 40, 0.05);
  const auto a = static_cast<std::size_t>(mesh.triangles[1800]), b = static_cast<std::size_t>(mesh.triangles[1801]);
  for (std::size_t k = 0; k < 3; ++k) mesh.positions[3 * a + k] = mesh.positions[3 * b + k];
  mesh.positions[3 * a + 1] *= 1.0 - 1e-15;  // not welded, and one as seen from five away
  const auto sketch = test::sketch_on(mesh, reference);
  REQUIRE(sketch->bend(test::curved(front_pixel(0.0, 0.2), 0.6, [](double) { return 2.0; })).ok());
  CHECK(sketch->positions().allFinite());
}

}  // namespace
}  // namespace pliant
