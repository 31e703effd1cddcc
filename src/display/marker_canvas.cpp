#include "display/marker_canvas.h"

#include <cmath>
#include <cstddef>
#include <utility>

namespace whirl_twin {
namespace {

geometry_msgs::Point toPoint(const Eigen::Vector3d& v) {
  geometry_msgs::Point point;
  point.x = v.x();
  point.y = v.y();
  point.z = v.z();
  return point;
}

std_msgs::ColorRGBA toColor(const Color& color) {
  std_msgs::ColorRGBA rgba;
  rgba.r = color.r;
  rgba.g = color.g;
  rgba.b = color.b;
  rgba.a = color.a;
  return rgba;
}

// The points of the circle about each point of the centre line, normal to the line. The first
// normal is transported along the line without torsion.
std::vector<std::vector<Eigen::Vector3d>> tubeRings(const std::vector<Eigen::Vector3d>& line,
                                                    double radius, int sides) {
  std::vector<std::vector<Eigen::Vector3d>> rings(line.size());
  Eigen::Vector3d across = (line[1] - line[0]).unitOrthogonal();
  for (std::size_t i = 0; i < line.size(); ++i) {
    const std::size_t before = i == 0 ? 0 : i - 1;
    const std::size_t after = i + 1 == line.size() ? i : i + 1;
    const Eigen::Vector3d along = (line[after] - line[before]).normalized();
    across = (across - across.dot(along) * along).normalized();
    const Eigen::Vector3d up = along.cross(across);
    for (int side = 0; side < sides; ++side) {
      const double angle = 2.0 * M_PI * side / sides;
      rings[i].emplace_back(line[i] + radius * (std::cos(angle) * across + std::sin(angle) * up));
    }
  }
  return rings;
}

}  // namespace

MarkerCanvas::MarkerCanvas(visualization_msgs::MarkerArray& markers, std::string system,
                           const Eigen::Isometry3d& world_from_system)
    : markers_(markers), system_(std::move(system)), world_from_system_(world_from_system) {}

visualization_msgs::Marker& MarkerCanvas::add(const std::string& part, int type,
                                              const Eigen::Isometry3d& pose,
                                              const Eigen::Vector3d& scale, const Color& color) {
  visualization_msgs::Marker& marker = markers_.markers.emplace_back();
  marker.header.frame_id = kWorldFrame;
  marker.ns = system_ + "/" + part;
  marker.id = next_id_[part]++;
  marker.type = type;
  marker.action = visualization_msgs::Marker::ADD;
  const Eigen::Isometry3d in_world = world_from_system_ * pose;
  const Eigen::Quaterniond rotation(in_world.linear());
  marker.pose.position = toPoint(in_world.translation());
  marker.pose.orientation.x = rotation.x();
  marker.pose.orientation.y = rotation.y();
  marker.pose.orientation.z = rotation.z();
  marker.pose.orientation.w = rotation.w();
  marker.scale.x = scale.x();
  marker.scale.y = scale.y();
  marker.scale.z = scale.z();
  marker.color = toColor(color);
  marker.lifetime = ros::Duration(lifetime_);
  return marker;
}

MarkerCanvas MarkerCanvas::turned(const Eigen::Vector3d& at,
                                  const Eigen::Matrix3d& world_axes) const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = world_from_system_ * at;
  pose.linear() = world_axes;
  return {markers_, system_, pose};
}

MarkerCanvas MarkerCanvas::moved(const Eigen::Isometry3d& pose) const {
  MarkerCanvas canvas(markers_, system_, world_from_system_ * pose);
  canvas.lifetime_ = lifetime_;
  return canvas;
}

MarkerCanvas MarkerCanvas::beside(const std::string& name, double lifetime) const {
  MarkerCanvas canvas(markers_, system_ + "/" + name, world_from_system_);
  canvas.lifetime_ = lifetime;
  return canvas;
}

void MarkerCanvas::gone(const std::string& part) {
  add(part, visualization_msgs::Marker::CUBE, Eigen::Isometry3d::Identity(),
      Eigen::Vector3d::Ones(), {0.0F, 0.0F, 0.0F})
      .action = visualization_msgs::Marker::DELETE;
}

void MarkerCanvas::cylinder(const std::string& part, const Eigen::Vector3d& from,
                            const Eigen::Vector3d& to, double radius, const Color& color) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = 0.5 * (from + to);
  pose.linear() =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), to - from).toRotationMatrix();
  add(part, visualization_msgs::Marker::CYLINDER, pose,
      {2.0 * radius, 2.0 * radius, (to - from).norm()}, color);
}

void MarkerCanvas::sphere(const std::string& part, const Eigen::Vector3d& centre, double radius,
                          const Color& color) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = centre;
  add(part, visualization_msgs::Marker::SPHERE, pose, Eigen::Vector3d::Constant(2.0 * radius),
      color);
}

void MarkerCanvas::box(const std::string& part, const Eigen::Isometry3d& pose,
                       const Eigen::Vector3d& size, const Color& color) {
  add(part, visualization_msgs::Marker::CUBE, pose, size, color);
}

void MarkerCanvas::arrow(const std::string& part, const Eigen::Vector3d& from,
                         const Eigen::Vector3d& to, double width, const Color& color) {
  const double head = 3.0 * width;
  auto& marker = add(part, visualization_msgs::Marker::ARROW, Eigen::Isometry3d::Identity(),
                     {width, 2.4 * width, head}, color);
  marker.points = {toPoint(from), toPoint(to)};
  if ((to - from).norm() <= head) {
    marker.action = visualization_msgs::Marker::DELETE;
  }
}

void MarkerCanvas::line(const std::string& part, const std::vector<Eigen::Vector3d>& points,
                        double width, const Color& color, bool fading) {
  auto& marker = add(part, visualization_msgs::Marker::LINE_STRIP, Eigen::Isometry3d::Identity(),
                     {width, 0.0, 0.0}, color);
  if (points.size() < 2) {
    marker.action = visualization_msgs::Marker::DELETE;
    return;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    marker.points.push_back(toPoint(points[i]));
    if (fading) {
      auto& shade = marker.colors.emplace_back(toColor(color));
      shade.a *= static_cast<float>(i) / static_cast<float>(points.size() - 1);
    }
  }
}

void MarkerCanvas::tube(const std::string& part, const std::vector<Eigen::Vector3d>& centre_line,
                        double radius, const Color& color, int sides) {
  auto& marker = add(part, visualization_msgs::Marker::TRIANGLE_LIST, Eigen::Isometry3d::Identity(),
                     Eigen::Vector3d::Ones(), color);
  const auto rings = tubeRings(centre_line, radius, sides);
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    for (std::size_t side = 0; side < rings[i].size(); ++side) {
      const std::size_t next = (side + 1) % rings[i].size();
      for (const auto& corner : {rings[i][side], rings[i][next], rings[i + 1][next], rings[i][side],
                                 rings[i + 1][next], rings[i + 1][side]}) {
        marker.points.push_back(toPoint(corner));
      }
    }
  }
}

void MarkerCanvas::text(const std::string& part, const Eigen::Vector3d& centre, double height,
                        const std::string& lines, const Color& color) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = centre;
  auto& marker =
      add(part, visualization_msgs::Marker::TEXT_VIEW_FACING, pose, {0.0, 0.0, height}, color);
  marker.text = printableLines(lines);
  if (lines.empty()) {
    marker.action = visualization_msgs::Marker::DELETE;
  }
}

visualization_msgs::Marker deleteAllMarkers() {
  visualization_msgs::Marker marker;
  marker.header.frame_id = MarkerCanvas::kWorldFrame;
  marker.action = visualization_msgs::Marker::DELETEALL;
  return marker;
}

}  // namespace whirl_twin
