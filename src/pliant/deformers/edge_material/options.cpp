#include "pliant/deformers/edge_material/options.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "pliant/core/message.h"

namespace pliant {
namespace {

Status invalid(std::string message) { return {ErrorCode::invalid_option, std::move(message)}; }

Status check_range(const char* name, double value, double most) {
  if (std::isfinite(value) && value >= 0.0 && value <= most) return {};
  return invalid(
      message({name, " is ", value, "; expected ", most == 1.0 ? "0 to 1" : "a finite number of at least 0"}));
}

Status check_strokes(const std::vector<Points>& strokes) {
  if (strokes.empty()) return invalid("field.strokes is empty; expected at least one stroke");
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const std::string name = message({"field.strokes[", i, "]"});
    const Points& stroke = strokes[i];
    if (stroke.cols() < 2) {
      return invalid(message({name, " has ", stroke.cols(), " points; expected at least 2"}));
    }
    if (!stroke.allFinite()) return invalid(name + " holds a number that is not finite");
    if ((stroke.colwise() - stroke.col(0)).isZero(0.0)) {
      return invalid(name + " has no length; expected points at different positions");
    }
  }
  return {};
}

Status check_field(const DirectionField& field, const Shape& shape) {
  using Kind = DirectionField::Kind;
  if (field.kind == Kind::strokes) return check_strokes(field.strokes);
  if (field.kind == Kind::axis && !(field.axis.allFinite() && field.axis.norm() > 0.0)) {
    return invalid("field.axis is not a direction; expected three finite numbers, not all 0");
  }
  if (field.kind != Kind::geodesic) return {};
  if (field.sources.empty()) return invalid("field.sources is empty; expected vertex ids");
  for (Index vertex : field.sources) {
    if (vertex >= 0 && vertex < shape.input_size()) continue;
    return invalid(message({"field.sources holds vertex ", vertex, "; expected 0 to ", shape.input_size() - 1}));
  }
  return {};
}

}  // namespace

bool DirectionField::operator==(const DirectionField& other) const {
  const auto same = [](const Points& a, const Points& b) { return a.cols() == b.cols() && a == b; };
  return kind == other.kind && axis == other.axis && sources == other.sources &&
         std::equal(strokes.begin(), strokes.end(), other.strokes.begin(), other.strokes.end(), same);
}

Status EdgeMaterialOptions::validate(const Shape& shape) const {
  constexpr double kAny = std::numeric_limits<double>::max();
  if (Status s = check_range("stretch", stretch, kAny); !s.ok()) return s;
  if (Status s = check_range("lambda", lambda.value_or(0.0), kAny); !s.ok()) return s;
  if (Status s = check_range("bend", bend, kAny); !s.ok()) return s;
  if (bend == 0.0 && lambda.value_or(stretch) == 0.0) {
    return invalid(
        message({"options has bend and ", lambda ? "lambda" : "stretch", " of 0; expected one of them above 0"}));
  }
  if (Status s = check_range("pStretch", p_stretch, 1.0); !s.ok()) return s;
  if (Status s = check_range("pBend", p_bend, 1.0); !s.ok()) return s;
  if (!gravity.allFinite()) return invalid("gravity holds a number that is not finite");
  return check_field(field, shape);
}

void exchange(NamedFields& fields, EdgeMaterialOptions& options) {
  if (fields.gives("stretch")) options.lambda.reset();
  fields("stretch", options.stretch);
  fields("lambda", options.lambda);
  fields("bend", options.bend);
  fields("pStretch", options.p_stretch);
  fields("pBend", options.p_bend);
  fields("gravity", options.gravity);
  if (fields.gives("field")) options.field = {};
  fields("field", options.field.kind, {"none", "strokes", "axis", "max", "min", "geodesic"});
  fields("field/strokes", options.field.strokes);
  fields("field/axis", options.field.axis);
  fields("field/sources", options.field.sources);
}

}  // namespace pliant
