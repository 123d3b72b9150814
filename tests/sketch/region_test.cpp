// Regions chosen by strokes, rigid parts, mirrors, and the errors. Must show 6 of the issue.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <vector>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "pliant/sketch/limb_axis.h"
#include "sketch/sketch_support.h"

namespace pliant {
namespace {

using test::front_pixel;

/// A man of cells, about one unit high: trunk, two arms, two legs, all symmetric in x.
const test::Mesh& man() {
  static const test::Mesh mesh = [] {
    const test::Mesh cells = test::cells(30, 4, 32, [](int x, int, int z) {
      const int side = x < 15 ? 14 - x : x - 15;
      const bool trunk = z >= 12 && side < 5;
      const bool arm = z >= 24 && z < 28 && side < 15;
      const bool leg = z < 12 && side >= 1 && side < 5;
      return trunk || arm || leg;
    });
    return test::transformed(cells, 1.0 / 32, Eigen::Matrix3d::Identity(), {-15.0 / 32, -2.0 / 32, 0.0});
  }();
  return mesh;
}

/// Over the arm on the right of the picture, from the shoulder to the wrist.
Stroke over_arm() { return test::straight(front_pixel(0.2, 0.81), front_pixel(0.4, 0.81)); }
Stroke arm_up() {
  return test::curved(front_pixel(0.2, 0.81), 0.2, [](double s) { return 4.0 * (s - 0.5); });
}
Stroke arm_bent() { return test::straight(front_pixel(0.2, 0.81), front_pixel(0.34, 0.95)); }

std::set<Index> with_label(const Sketch& sketch, Index label) {
  std::set<Index> found;
  const std::vector<Index> labels = sketch.labels();
  for (Index v = 0; v < static_cast<Index>(labels.size()); ++v) {
    if (labels[v] == label) found.insert(v);
  }
  return found;
}

TEST_CASE("the region is the limb drawn on, its tip follows as one, the rest stays") {
  const auto sketch = test::sketch_on(man(), over_arm());
  REQUIRE(sketch->bend(arm_bent()).ok());
  const std::vector<Index> labels = sketch->labels();
  const Points rest = test::positions_of(man()), bent = sketch->positions();
  for (Index v = 0; v < man().vertices(); ++v) {
    const double x = rest(0, v);
    if (x < 0.19) CHECK(labels[v] == 0);
    if (x > 0.24 && x < 0.37) CHECK(labels[v] == 1);
    if (x > 0.42) CHECK(labels[v] == 2);
    if (labels[v] == 0) CHECK(bent.col(v) == rest.col(v));
  }
  const std::set<Index> hand = with_label(*sketch, 2);
  for (const Index v : hand) {
    CHECK((bent.col(v) - bent.col(*hand.begin())).norm() ==
          doctest::Approx((rest.col(v) - rest.col(*hand.begin())).norm()).epsilon(1e-9));
  }
}

TEST_CASE("three reference strokes, one beside the silhouette, give one pose") {
  std::vector<Eigen::Vector3d> tips;
  for (const double z : {0.81, 0.86, 0.95}) {
    const auto sketch = test::sketch_on(man(), test::straight(front_pixel(0.2, z), front_pixel(0.4, z)));
    Stroke target = arm_bent();
    REQUIRE(sketch->bend(target).ok());
    const std::set<Index> hand = with_label(*sketch, 2);
    REQUIRE(!hand.empty());
    const Points rest = test::positions_of(man()), bent = sketch->positions();
    // The hand turns by 45 degrees, wherever the stroke was drawn.
    Index near = *hand.begin(), far = near;
    for (const Index v : hand) {
      if (rest(0, v) > rest(0, far)) far = v;
    }
    for (const Index v : hand) {
      if (rest.col(v).tail<2>() == rest.col(far).tail<2>() && rest(0, v) < 0.44) near = v;
    }
    const Eigen::Vector3d along = (bent.col(far) - bent.col(near)).normalized();
    CHECK(along.z() == doctest::Approx(std::sqrt(0.5)).epsilon(0.01));
    CHECK(along.x() == doctest::Approx(std::sqrt(0.5)).epsilon(0.01));
    CHECK(bent.rowwise().maxCoeff().z() < 1.5);
    tips.push_back(bent.rowwise().maxCoeff());
  }
  CHECK((tips[0] - tips[1]).norm() < 0.1);
}

TEST_CASE("a stroke that starts over the body still takes the limb alone") {
  // The plane through its start runs through both legs and the trunk.
  const auto sketch = test::sketch_on(man(), test::straight(front_pixel(0.1, 0.42), front_pixel(0.1, 0.08)));
  const Points rest = test::positions_of(man());
  const std::vector<Index> labels = sketch->labels();
  for (Index v = 0; v < man().vertices(); ++v) {
    if (rest(0, v) < 0.0) CHECK(labels[v] == 0);
    if (rest(0, v) > 0.04 && rest(2, v) > 0.15 && rest(2, v) < 0.3) CHECK(labels[v] == 1);
  }
}

TEST_CASE("partitions become rigid parts of their own") {
  // Along the trunk, with the arms cut off: they move as ones.
  const Stroke spine = test::straight(front_pixel(0.0, 0.42), front_pixel(0.0, 0.97));
  SketchOptions options;
  for (const double x : {-0.2, 0.2}) {
    options.partitions.push_back(test::straight(front_pixel(x, 0.95), front_pixel(x, 0.7)));
  }
  const auto sketch = test::sketch_on(man(), spine, options);
  REQUIRE(sketch->bend(test::curved(front_pixel(0.0, 0.42), 0.55, [](double) { return 2.0; })).ok());
  const Points rest = test::positions_of(man()), bent = sketch->positions();
  const std::vector<Index> labels = sketch->labels();
  std::set<Index> arms;
  for (Index v = 0; v < man().vertices(); ++v) {
    if (std::abs(rest(0, v)) > 0.25) {
      CHECK(labels[v] >= 2);
      arms.insert(labels[v]);
    }
  }
  REQUIRE(arms.size() == 2);
  for (const Index arm : arms) {
    const std::set<Index> part = with_label(*sketch, arm);
    for (const Index v : part) {
      CHECK((bent.col(v) - bent.col(*part.begin())).norm() ==
            doctest::Approx((rest.col(v) - rest.col(*part.begin())).norm()).epsilon(1e-9));
    }
  }
}

TEST_CASE("a mirrored edit is symmetric") {
  // A horn to each side; the left one has the right one's triangles, mirrored.
  const test::Mesh right =
      test::transformed(test::cylinder(24, 60, 0.05), 1.0, Eigen::Matrix3d::Identity(), {0.3, 0, 0});
  test::Mesh left = right;
  for (std::size_t i = 0; i < left.positions.size(); i += 3) left.positions[i] *= -1.0;
  for (std::size_t i = 0; i < left.triangles.size(); i += 3) {
    std::swap(left.triangles[i], left.triangles[i + 1]);
  }
  SketchOptions options;
  options.mirror = Plane{{0, 0, 0}, {2, 0, 0}};
  const auto sketch =
      test::sketch_on(test::both(right, left), test::straight(front_pixel(0.3, 0.2), front_pixel(0.3, 0.8)), options);
  REQUIRE(sketch->bend(test::curved(front_pixel(0.3, 0.2), 0.6, [](double) { return 2.0; })).ok());
  REQUIRE(sketch->twist(0.7).ok());
  const Points rest = sketch->rest(), bent = sketch->positions();
  const Index n = right.vertices();
  CHECK((bent - rest).leftCols(n).cwiseAbs().maxCoeff() > 0.1);
  Points mirrored = bent.rightCols(n);
  mirrored.row(0) *= -1.0;
  CHECK((mirrored - bent.leftCols(n)).cwiseAbs().maxCoeff() < 1e-6);
  const std::vector<Index> labels = sketch->labels();
  CHECK(*std::max_element(labels.begin(), labels.end()) == 3);

  options.mirror = Plane{{0.3, 0, 0}, {1, 0, 0}};
  const Result<std::unique_ptr<Sketch>> overlapping =
      Sketch::create(test::shape_of(man()), *Camera::create(test::front_view()), over_arm(), options);
  CHECK(overlapping.status().message().find("mirror reflects the region onto itself") == 0);
}

TEST_CASE("a region is kept under a new reference, and under another shape's labels") {
  const auto sketch = test::sketch_on(man(), over_arm());
  const std::vector<Index> labels = sketch->labels();
  REQUIRE(sketch->bend(arm_bent()).ok());
  const Points bent = sketch->positions();
  const Stroke other = test::straight(front_pixel(0.2, 0.84), front_pixel(0.4, 0.78));
  REQUIRE(sketch->redraw(*Camera::create(test::front_view()), other).ok());
  CHECK(sketch->labels() == labels);
  CHECK(sketch->positions() == test::positions_of(man()));
  REQUIRE(sketch->redraw(*Camera::create(test::front_view()), over_arm()).ok());
  REQUIRE(sketch->bend(arm_bent()).ok());
  CHECK((sketch->positions() - bent).cwiseAbs().maxCoeff() < 1e-12);

  SketchOptions options;
  options.labels = labels;
  const auto again = test::sketch_on(man(), over_arm(), options);
  CHECK(again->labels() == labels);
  REQUIRE(again->bend(arm_bent()).ok());
  // The band's triangles between two parts may count as region now: near enough the same pose.
  CHECK((again->positions() - bent).cwiseAbs().maxCoeff() < 0.05);
}

TEST_CASE("the seed holds the still part and moves the rest to where the sketch has it") {
  const auto sketch = test::sketch_on(man(), over_arm());
  REQUIRE(sketch->bend(arm_up()).ok());
  const SketchSeed seed = sketch->seed(0.05);
  const Points bent = sketch->positions();
  const std::set<Index> still = with_label(*sketch, 0);
  CHECK(std::set<Index>(seed.fixed.begin(), seed.fixed.end()) == still);
  const std::set<Index> hand = with_label(*sketch, 2);
  std::size_t in_region = 0;
  for (std::size_t i = 0; i < seed.vertices.size(); ++i) {
    CHECK(seed.targets.col(i) == bent.col(seed.vertices[i]));
    CHECK(still.count(seed.vertices[i]) == 0);
    in_region += hand.count(seed.vertices[i]) == 0;
  }
  CHECK(in_region > 0);
  CHECK(in_region < with_label(*sketch, 1).size() / 4);
  CHECK(seed.vertices.size() - in_region == hand.size());
}

TEST_CASE("several components: the one drawn on is posed") {
  const test::Mesh far = test::transformed(man(), 1.0, Eigen::Matrix3d::Identity(), {0, 3, 0});
  const auto sketch = test::sketch_on(test::both(far, man()), over_arm());
  const std::vector<Index> labels = sketch->labels();
  for (Index v = 0; v < far.vertices(); ++v) CHECK(labels[v] == 0);
  CHECK(!with_label(*sketch, 1).empty());
}

TEST_CASE("the larger side is held, whichever way one draws; the hold can be asked for") {
  const auto out = test::sketch_on(man(), over_arm());
  Stroke inwards = over_arm().rowwise().reverse(), target = arm_bent().rowwise().reverse();
  const auto in = test::sketch_on(man(), inwards);
  CHECK_FALSE(out->held_at_end());
  CHECK(in->held_at_end());
  CHECK(in->labels() == out->labels());
  // Strokes drawn the other way say the same.
  REQUIRE(out->bend(arm_bent()).ok());
  REQUIRE(in->bend(target).ok());
  CHECK((in->positions() - out->positions()).cwiseAbs().maxCoeff() < 1e-3);
  REQUIRE(out->twist(0.5).ok());
  REQUIRE(in->twist(0.5).ok());
  CHECK((in->positions() - out->positions()).cwiseAbs().maxCoeff() < 1e-3);

  // From the tip to far into the trunk: most of the man stays.
  const auto leg = test::sketch_on(man(), test::straight(front_pixel(0.1, 0.02), front_pixel(0.1, 0.42)));
  CHECK(leg->held_at_end());
  CHECK(with_label(*leg, 0).size() > 3 * (with_label(*leg, 1).size() + with_label(*leg, 2).size()));

  SketchOptions options;
  options.hold = Hold::start;
  const auto flipped = test::sketch_on(man(), inwards, options);
  CHECK_FALSE(flipped->held_at_end());
  const Points rest = test::positions_of(man());
  REQUIRE(flipped->bend(target).ok());
  const Points bent = flipped->positions();
  for (Index v = 0; v < man().vertices(); ++v) {
    if (rest(0, v) > 0.43) CHECK(bent.col(v) == rest.col(v));
    if (rest(0, v) < 0.0) CHECK((bent.col(v) - rest.col(v)).norm() > 0.01);
  }
  // The same shape but for a rigid motion.
  const auto far = [&](const Points& p) { return (p.col(0) - p.col(man().vertices() - 1)).norm(); };
  CHECK(far(bent) == doctest::Approx(far(in->positions())).epsilon(0.05));
  options.hold = Hold::end;
  CHECK(test::sketch_on(man(), over_arm(), options)->held_at_end());

  // Over a region that is given the static part is held.
  options = {};
  options.labels = out->labels();
  CHECK(test::sketch_on(man(), inwards, options)->held_at_end());
  CHECK_FALSE(test::sketch_on(man(), over_arm(), options)->held_at_end());
  REQUIRE(out->redraw(*Camera::create(test::front_view()), inwards).ok());
  CHECK(out->held_at_end());
}

TEST_CASE("an unfinished target goes on from where it was drawn, also towards the held end") {
  Stroke inwards = over_arm().rowwise().reverse(), target = arm_bent().rowwise().reverse();
  const auto sketch = test::sketch_on(man(), inwards);
  REQUIRE(sketch->bend(target).ok());
  const Points whole = sketch->positions();
  REQUIRE(sketch->bend(target.leftCols(60), true).ok());
  CHECK((sketch->positions() - whole).cwiseAbs().maxCoeff() < 0.02);
}

TEST_CASE("a stroke that leaves the shape at once is refused; the limb it began on has a stroke of its own") {
  const auto shape = test::shape_of(man());
  const Camera camera = *Camera::create(test::front_view());
  const Eigen::Vector2d paw = front_pixel(0.4, 0.81);
  const Status status = Sketch::create(shape, camera, test::straight(paw, paw - Eigen::Vector2d(0, 250))).status();
  CHECK(status.code() == ErrorCode::invalid_option);
  CHECK(status.message().find("reference leaves the shape after ") == 0);

  const auto arm = stroke_along_limb(*shape, camera, paw);
  REQUIRE_MESSAGE(arm.ok(), arm.status().message());
  // From the shoulder to the hand, along the middle.
  CHECK(((*arm)(0, 0) - 500.0) / 500.0 == doctest::Approx(0.2).epsilon(0.2));
  CHECK(((*arm)(0, arm->cols() - 1) - 500.0) / 500.0 == doctest::Approx(0.4).epsilon(0.1));
  CHECK((arm->row(1).array() - front_pixel(0.0, 0.81).y()).abs().maxCoeff() < 25.0);
  const auto sketch = Sketch::create(shape, camera, *arm);
  REQUIRE_MESSAGE(sketch.ok(), sketch.status().message());
  const Points rest = test::positions_of(man());
  const std::vector<Index> labels = (*sketch)->labels();
  for (Index v = 0; v < man().vertices(); ++v) {
    if (rest(0, v) < 0.15) CHECK(labels[v] == kStaticLabel);
    if (rest(0, v) > 0.3) CHECK(labels[v] != kStaticLabel);
  }
  // Half way up a leg, too; not on the trunk, not beside the shape.
  const auto leg = stroke_along_limb(*shape, camera, front_pixel(0.1, 0.15));
  REQUIRE_MESSAGE(leg.ok(), leg.status().message());
  CHECK(leg->row(1).minCoeff() > front_pixel(0.0, 0.45).y());
  CHECK(stroke_along_limb(*shape, camera, front_pixel(0.9, 0.9)).status().message().find("pixel lies beside") == 0);
  const auto ball = test::shape_of(test::transformed(test::sphere(3), 0.4, Eigen::Matrix3d::Identity(), {0, 0, 0.5}));
  CHECK(stroke_along_limb(*ball, camera, front_pixel(0.0, 0.6)).status().code() == ErrorCode::invalid_option);
}

TEST_CASE("bad arguments are named and nothing is built") {
  const auto shape = test::shape_of(man());
  const Camera camera = *Camera::create(test::front_view());
  const auto message = [&](const Stroke& stroke, const SketchOptions& options = {}) {
    return Sketch::create(shape, camera, stroke, options).status().message();
  };
  CHECK(message(Stroke(2, 0)) == "reference has 0 samples; expected at least 2");
  CHECK(message(test::straight({1, 1}, {2, 1})) == "reference spans 1 pixels; expected at least 5");
  Stroke broken = over_arm();
  broken(1, 3) = std::numeric_limits<double>::quiet_NaN();
  CHECK(message(broken).find("reference[3] is not a pixel") == 0);
  SketchOptions options;
  options.partitions = {test::straight(front_pixel(-0.4, 0.3), front_pixel(-0.4, 0.2))};
  CHECK(message(over_arm(), options) == "partitions[0] cuts nothing off the region; expected a line across it");
  options = {};
  options.labels.assign(3, 1);
  CHECK(message(over_arm(), options).find("labels has length 3") == 0);
  options.labels.assign(man().vertices(), 0);
  CHECK(message(over_arm(), options).find("labels has no vertex with label 1") == 0);
  options.labels.assign(man().vertices(), -4);
  CHECK(message(over_arm(), options).find("labels[0] is -4") == 0);
  const auto points = Shape::create(man().positions, {});
  REQUIRE(points.ok());
  CHECK(Sketch::create(*points, camera, over_arm()).status().code() == ErrorCode::invalid_shape);

  CameraOptions turned = test::front_view();
  turned.target = {0.0, -10.0, 0.5};
  turned.orthographic_height.reset();
  CHECK(Sketch::create(shape, *Camera::create(turned), over_arm())
            .status()
            .message()
            .find("camera.eye has the shape behind it") == 0);
  const auto sketch = test::sketch_on(man(), over_arm());
  CHECK(sketch->bend(Stroke(2, 1)).message() == "target has 1 samples; expected at least 2");
}

}  // namespace
}  // namespace pliant
