// A region skinned to its reference curve, and the pass that poses it. Kho and Garland,
// sections 4.3 and 5.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "pliant/sketch/parameter_smoother.h"
#include "pliant/sketch/pose.h"
#include "pliant/sketch/region.h"

namespace pliant {

/// Arrays over the shape's points, and after them points added between two others (refinement).
class Limb {
 public:
  /// Takes all three over. `set_smooth` is to be called before the first pose.
  Limb(SeenShape&& seen, LaidStroke&& stroke, Region&& region);

  const PlaneCurve& reference() const { return stroke_.curve; }
  const Region& region() const { return region_; }
  const Camera& camera() const { return seen_.camera; }
  double depth() const { return stroke_.depth; }

  /// Places the joints: middles between the first two hits of every pixel (section 5.2).
  /// Errors: invalid_option (a pixel that meets the shape less than twice). Cheap when they stand.
  Status find_joints();
  bool has_joints() const { return joints_.cols() > 0; }
  /// Joints in view coordinates, 3 x nodes.
  const Points& joints() const { return joints_; }

  /// Whether eq. 9 smooths s and every other parameter. The pose is to be set again.
  void set_smooth(bool smooth);
  /// Parameters of all points in a pose, eq. 9 to a relative tolerance; twists and scales need
  /// joints.
  void set_pose(const SketchPose& pose, double tolerance);
  /// Writes the places of all points from `first` on that a part t of the pose moves; others are
  /// left alone.
  void show(double t, Points& world, Index first = 0) const;

  /// Adds points in the middle between two others each (refinement), until `drop_added`. Their
  /// parameters are the means of their parents'.
  void add(std::span<const std::array<Index, 2>> parents);
  void drop_added();
  /// Where a part t of the pose takes the middles between two points each, 3 x edges.
  Points middles(std::span<const std::array<Index, 2>> edges, double t) const;
  /// Whether the pose can move the point.
  bool moves(Index point) const { return moved_[point]; }

  // Parameters a point; angles in radians as the viewer sees them, of a whole pose.
  const std::vector<double>& s() const { return s_; }
  const std::vector<double>& bend() const { return bend_; }
  const std::vector<double>& twist() const { return twist_; }
  const std::vector<double>& scale() const { return scale_; }

 private:
  struct Part {
    std::vector<Index> points;
    double s = 0.0;  ///< of its virtual vertex
  };
  struct Parameters {
    double s, bend, twist, scale;
  };
  void skin();
  void collect_points();
  void sort_along_curve();
  void prepare_smoother();
  void place_virtual_vertices();
  /// A parameter that is f(s) in the region and rigid(s of the virtual vertex) in a rigid part;
  /// the static part has `at_static`.
  template <class F, class G>
  void spread(const F& f, double at_static, const G& rigid, std::vector<double>& values);
  void spread_to_added(std::vector<double>& values) const;
  Eigen::Vector3d tangent(double s) const;
  Eigen::Vector3d twisted(const Eigen::Vector3d& view, const Parameters& at, double t) const;
  Parameters between(Index a, Index b) const;
  /// Places points of one pose after the other.
  class Placer;

  SeenShape seen_;
  LaidStroke stroke_;
  Region region_;
  bool smooth_ = false;
  Index points_ = 0;           ///< of the shape
  std::vector<Index> free_;    ///< points of the region, along the curve
  std::vector<Index> pinned_;  ///< points of other parts that touch it
  std::vector<Part> parts_;    ///< rigid ones
  std::vector<bool> moved_;
  std::vector<std::array<Index, 2>> added_;
  std::vector<double> raw_s_;  ///< of free_
  std::vector<double> s_, bend_, twist_, scale_;
  ParameterSmoother smoother_;
  std::vector<double> raw_, pins_, solved_;
  SketchPose pose_;
  double tolerance_ = 1e-8;     ///< of the parameters of pose_
  std::vector<double> angles_;  ///< theta of eq. 5, evenly over s, of the whole pose
  Points joints_;
};

}  // namespace pliant
