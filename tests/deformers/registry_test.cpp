// Methods built by their names, and options that go by name in both directions.
#include "pliant/deformers/registry.h"

#include <algorithm>
#include <string>

#include <doctest/doctest.h>

#include "support/shapes.h"

using namespace pliant;

namespace {

std::shared_ptr<const Shape> shape() { return test::shape_of(test::potato(3)); }

Status error_of(const std::string& method, const NamedValues& options) {
  return build_deformer(method, shape(), options).status();
}

const NamedValue* find(const NamedValues& values, const std::string& name) {
  const auto found = std::find_if(values.begin(), values.end(), [&](const NamedValue& v) { return v.name == name; });
  return found == values.end() ? nullptr : &*found;
}

}  // namespace

TEST_CASE("a method is built by its name, with what is given and the defaults of its struct") {
  for (const RegisteredMethod& method : registered_methods()) {
    CAPTURE(method.name);
    const auto plain = build_deformer(method.name, shape(), {});
    REQUIRE(plain.ok());
    const NamedValues options = (*plain)->options_by_name();
    const auto again = build_deformer(method.name, shape(), options);
    REQUIRE(again.ok());
    const NamedValues same = (*again)->options_by_name();
    REQUIRE(same.size() == options.size());
    for (std::size_t i = 0; i < options.size(); ++i) {
      CHECK(same[i].name == options[i].name);
      CHECK(same[i].word == options[i].word);
      CHECK(same[i].numbers == options[i].numbers);
    }
  }
  const auto soft =
      build_deformer("arap", shape(), {{"constraintWeight", "", {3.0}}, {"energy", "spokes-and-rims", {}}});
  REQUIRE(soft.ok());
  CHECK(find((*soft)->options_by_name(), "constraintWeight")->numbers == std::vector<double>{3.0});
  CHECK(find((*soft)->options_by_name(), "energy")->word == "spokes-and-rims");
}

TEST_CASE("options change by name: those not given stay, a bad one changes nothing") {
  auto material = std::move(*build_deformer("edge-material", shape(), {{"stretch", "", {3.0}}, {"bend", "", {2.0}}}));
  REQUIRE(material->set_options({{"lambda", "", {0.5}}}).ok());
  NamedValues options = material->options_by_name();
  CHECK(find(options, "lambda")->numbers == std::vector<double>{0.5});
  CHECK(find(options, "bend")->numbers == std::vector<double>{2.0});
  REQUIRE(material->set_options({{"stretch", "", {4.0}}}).ok());
  CHECK(find(material->options_by_name(), "lambda")->numbers.empty());
  const NamedValues lists = {{"field", "strokes", {}},
                             {"field/strokes", "", {-1, 0, 0, 1, 0, 0, 0, -1, 0, 0, 1, 0, 0, 1, 1}},
                             {"field/strokes/sizes", "", {6, 9}}};
  REQUIRE(material->set_options(lists).ok());
  CHECK(find(material->options_by_name(), "field/strokes")->numbers == lists[1].numbers);
  CHECK(find(material->options_by_name(), "field/strokes/sizes")->numbers == lists[2].numbers);
  for (const NamedValue& bad :
       {NamedValue{"bend", "", {-1.0}}, NamedValue{"bend", "much", {}}, NamedValue{"bend", "", {1.0, 2.0}},
        NamedValue{"gravity", "", {1.0}}, NamedValue{"field", "swirl", {}}, NamedValue{"colour", "", {1.0}},
        NamedValue{"field/strokes/sizes", "", {100.0}}}) {
    CAPTURE(bad.name);
    const Status status = material->set_options({{"pBend", "", {0.5}}, bad});
    CHECK(status.code() == ErrorCode::invalid_option);
    CHECK(status.message().find(bad.name) != std::string::npos);
    CHECK(find(material->options_by_name(), "bend")->numbers == std::vector<double>{2.0});
    CHECK(find(material->options_by_name(), "pBend")->numbers == std::vector<double>{1.0});
  }
  auto graph = std::move(*build_deformer("embedded-graph", shape(), {}));
  CHECK(graph->set_options({}).ok());
  CHECK(graph->set_options({{"seed", "", {2.0}}}).code() == ErrorCode::invalid_option);
}

TEST_CASE("unknown methods and options that do not go together are named") {
  const Status unknown = error_of("arrap", {});
  CHECK(unknown.code() == ErrorCode::invalid_option);
  for (const RegisteredMethod& method : registered_methods()) {
    CHECK(unknown.message().find(method.name) != std::string::npos);
  }
  CHECK(error_of("arap", {{"stretch", "", {1.0}}}).message().find("stretch is not known") == 0);
  CHECK(error_of("embedded-graph", {{"nodes", "", {0, 0, 0, 1, 0, 0}}, {"nodeCount", "", {2.0}}})
            .message()
            .find("nodeCount") == 0);
}
