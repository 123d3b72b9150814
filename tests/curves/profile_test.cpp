#include "pliant/curves/profile.h"

#include <cmath>
#include <vector>

#include <doctest/doctest.h>

namespace pliant {
namespace {

Profile profile(const std::vector<Profile::Point>& points) {
  Result<Profile> result = Profile::create(points, "profile");
  REQUIRE(result.ok());
  return *result;
}

TEST_CASE("a profile is linear between its points and constant beyond them") {
  const Profile f = profile({{0.2, 1.0}, {0.6, 3.0}, {0.6, -1.0}, {0.8, 0.0}});
  CHECK(f(0.0) == 1.0);
  CHECK(f(0.4) == doctest::Approx(2.0));
  CHECK(f(0.6) == -1.0);  // a jump belongs to what follows
  CHECK(f(0.7) == doctest::Approx(-0.5));
  CHECK(f(1.0) == 0.0);
  CHECK(Profile::identity()(0.37) == 0.37);
  CHECK(f.times(2.0)(0.4) == doctest::Approx(4.0));
}

TEST_CASE("a blend is the blend of the values, everywhere") {
  const Profile f = profile({{0.2, 1.0}, {0.6, 3.0}, {0.6, -1.0}});
  const Profile g = profile({{0.0, 2.0}, {0.5, 0.0}, {1.0, 5.0}});
  const Profile h = Profile::blend(f, g, 0.3);
  for (double s = 0.0; s <= 1.0; s += 0.01) {
    CHECK(h(s) == doctest::Approx(0.7 * f(s) + 0.3 * g(s)));
  }
}

TEST_CASE("bad profiles are named") {
  const auto message = [](const std::vector<Profile::Point>& points) {
    return Profile::create(points, "scale.profile").status().message();
  };
  CHECK(message({}) == "scale.profile is empty; expected at least one point [s, f]");
  CHECK(message({{0.5, 1.0}, {0.4, 1.0}}) ==
        "scale.profile[1] is [0.4, 1]; expected s not below that of the point before");
  CHECK(message({{1.5, 1.0}}) == "scale.profile[0] is [1.5, 1]; expected s from 0 to 1");
  CHECK(message({{0.5, std::nan("")}}).find("finite") != std::string::npos);
  CHECK(message({{std::nan(""), 1.0}}).find("s from 0 to 1") != std::string::npos);
}

}  // namespace
}  // namespace pliant
