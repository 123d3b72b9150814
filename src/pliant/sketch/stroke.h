// From what a mouse reports to a curve: filtered and evenly spaced.
#pragma once

#include "pliant/core/status.h"
#include "pliant/curves/plane_curve.h"

namespace pliant {

/// A stroke in pixels, one sample a column.
using Stroke = Polyline;

/// Segments of a filtered stroke are at least this long, pixels, where that leaves
/// min_stroke_nodes.
inline constexpr double kMinStrokeSegment = 5.0;
inline constexpr Index kMinStrokeNodes = 61;
inline constexpr Index kMaxStrokeNodes = 1001;

/// At least two samples, finite, with an extent of at least min_stroke_segment.
/// Errors: invalid_option, naming `argument` ("reference") and the sample.
Status check_stroke(const Stroke& stroke, const char* argument);

/// How many nodes a stroke deserves: segments of min_stroke_segment, within the limits above.
Index nodes_for(const Stroke& stroke);

/// The paper's filter (section 4.1): samples are averaged along the stroke, then spread over
/// `nodes` points of equal steps. The average keeps straight and evenly curved strokes as they are:
/// it is a parabola fitted to the samples within 8 pixels.
Stroke filtered(const Stroke& stroke, Index nodes);

/// The filtered stroke without its first part, `fraction` in [0, 1) of its length; as many nodes.
Stroke without_start(const Stroke& stroke, double fraction);

/// The stroke, which is held at its end or at its start, from there on.
Stroke from_held_end(const Stroke& drawn, bool held_at_end);

}  // namespace pliant
