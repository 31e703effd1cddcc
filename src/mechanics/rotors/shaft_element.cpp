#include "mechanics/rotors/shaft_element.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

/// One bending plane: deflection, rotation at the first node and at the second.
using PlaneMatrix = Eigen::Matrix4d;
using PlaneVector = Eigen::Vector4d;

struct GaussPoint {
  double place, weight;  ///< on [0, 1]
};
/// Four points: exact for the squares of cubics.
constexpr std::array<GaussPoint, 4> kGauss = {{{0.0694318442029737124, 0.173927422568726929},
                                               {0.330009478207571868, 0.326072577431273071},
                                               {0.669990521792428132, 0.326072577431273071},
                                               {0.930568155797026288, 0.173927422568726929}}};
/// Of what is no polynomial the four points in each of so many parts.
constexpr int kTaperParts = 12;

/// Of a cross-section.
struct Stiffness {
  double bending = 0.0;  ///< [N m^2], EI
  double shear = 0.0;    ///< [N], kappa G A; 0: it does not shear
};
struct Inertia {
  double mass = 0.0;    ///< [kg/m]
  double rotary = 0.0;  ///< [kg m], about a diameter
};

ShaftSection sectionAt(const ShaftLayer& layer, double share) {
  return layer.section.tapers() ? layer.section.at(share) : layer.section;
}

Stiffness stiffnessAt(const std::vector<ShaftLayer>& layers, double share) {
  Stiffness sum;
  double shear_area = 0.0;  // sum of G A
  double poissons_ratio = 0.0;
  ShaftSection whole = sectionAt(layers.front(), share);
  for (const ShaftLayer& layer : layers) {
    if (!(layer.stiffness > 0.0)) {
      continue;
    }
    const ShaftSection section = sectionAt(layer, share);
    const ShaftMaterial& material = layer.material;
    sum.bending += layer.stiffness * material.youngs_modulus * section.secondMoment();
    const double nu = material.youngs_modulus / (2.0 * material.shear_modulus) - 1.0;
    const double own = layer.stiffness * material.shear_modulus * section.area();
    poissons_ratio = (poissons_ratio * shear_area + nu * own) / (shear_area + own);
    shear_area += own;
    whole.outer_diameter = std::max(whole.outer_diameter, section.outer_diameter);
    whole.inner_diameter = std::min(whole.inner_diameter, section.inner_diameter);
  }
  if (layers.front().material.shear_deformation) {
    sum.shear = shearCoefficient(whole, poissons_ratio) * shear_area;
  }
  return sum;
}

Inertia inertiaAt(const std::vector<ShaftLayer>& layers, double share) {
  Inertia sum;
  for (const ShaftLayer& layer : layers) {
    const ShaftSection section = sectionAt(layer, share);
    sum.mass += layer.material.density * section.area();
    sum.rotary += layer.material.density * section.secondMoment();
  }
  return sum;
}

/// Deflection, rotation, slope [1/m] and curvature of a point, by the coordinates of the plane.
struct Shapes {
  PlaneVector deflection, rotation, slope, curvature;
};

/// Of a uniform element.
Shapes uniformShapes(double s, double length, double shear) {
  const double s2 = s * s;
  const double s3 = s2 * s;
  const double by = 1.0 + shear;
  return {PlaneVector(1.0 + shear * (1.0 - s) - 3.0 * s2 + 2.0 * s3,
                      length * (s * (1.0 + 0.5 * shear) - (2.0 + 0.5 * shear) * s2 + s3),
                      shear * s + 3.0 * s2 - 2.0 * s3,
                      length * (-0.5 * shear * s + (0.5 * shear - 1.0) * s2 + s3)) /
              by,
          PlaneVector(6.0 * (s2 - s) / length, 1.0 + shear - (4.0 + shear) * s + 3.0 * s2,
                      6.0 * (s - s2) / length, (shear - 2.0) * s + 3.0 * s2) /
              by,
          PlaneVector((-shear - 6.0 * s + 6.0 * s2) / length,
                      1.0 + 0.5 * shear - (4.0 + shear) * s + 3.0 * s2,
                      (shear + 6.0 * s - 6.0 * s2) / length,
                      -0.5 * shear + (shear - 2.0) * s + 3.0 * s2) /
              by,
          PlaneVector(6.0 * (2.0 * s - 1.0) / length, 6.0 * s - 4.0 - shear,
                      6.0 * (1.0 - 2.0 * s) / length, 6.0 * s - 2.0 + shear) /
              (by * length)};
}

PlaneMatrix uniformStiffness(double bending, double l, double shear) {
  PlaneMatrix k;
  k << 12.0, 6.0 * l, -12.0, 6.0 * l,                                   //
      6.0 * l, (4.0 + shear) * l * l, -6.0 * l, (2.0 - shear) * l * l,  //
      -12.0, -6.0 * l, 12.0, -6.0 * l,                                  //
      6.0 * l, (2.0 - shear) * l * l, -6.0 * l, (4.0 + shear) * l * l;
  return bending / ((1.0 + shear) * l * l * l) * k;
}

/// Integrals of what bends from the first end, there fixed, to a point, per unit of the force and
/// the moment at the second end.
struct Flexibility {
  Eigen::Matrix2d at_point = Eigen::Matrix2d::Zero();     ///< deflection and rotation of the point
  Eigen::RowVector2d shear = Eigen::RowVector2d::Zero();  ///< its shear strain
  Eigen::RowVector2d curvature = Eigen::RowVector2d::Zero();  ///< [1/m]
};

Flexibility flexibility(const std::vector<ShaftLayer>& layers, double share) {
  const double length = layers.front().section.length;
  Flexibility f;
  const double part = share / kTaperParts;
  for (int i = 0; i < kTaperParts; ++i) {
    for (const GaussPoint& point : kGauss) {
      const double s = part * (i + point.place);
      const Stiffness here = stiffnessAt(layers, s);
      const double dz = part * length * point.weight;
      const Eigen::RowVector2d curvature(length * (1.0 - s) / here.bending, 1.0 / here.bending);
      f.at_point.row(0) += dz * length * (share - s) * curvature;
      f.at_point.row(1) += dz * curvature;
      if (here.shear > 0.0) {
        f.at_point(0, 0) += dz / here.shear;
      }
    }
  }
  const Stiffness here = stiffnessAt(layers, share);
  if (here.shear > 0.0) {
    f.shear(0) = 1.0 / here.shear;
  }
  f.curvature << length * (1.0 - share) / here.bending, 1.0 / here.bending;
  return f;
}

/// A plane of an element: shapes at any point, and its stiffness.
class Plane {
 public:
  explicit Plane(const std::vector<ShaftLayer>& layers)
      : layers_(layers), length_(layers.front().section.length) {
    tapers_ = std::any_of(layers.begin(), layers.end(),
                          [](const ShaftLayer& layer) { return layer.section.tapers(); });
    if (tapers_) {
      // The second end beside where it would be if the element did not bend.
      bends_ << -1.0, -length_, 1.0, 0.0, 0.0, -1.0, 0.0, 1.0;
      const Eigen::Matrix2d f = flexibility(layers, 1.0).at_point;
      end_stiffness_ << f(1, 1), -f(0, 1), -f(1, 0), f(0, 0);
      end_stiffness_ /= f(0, 0) * f(1, 1) - f(0, 1) * f(1, 0);
    } else {
      const Stiffness section = stiffnessAt(layers, 0.0);
      bending_ = section.bending;
      shear_ = section.shear > 0.0 ? 12.0 * bending_ / (section.shear * length_ * length_) : 0.0;
    }
  }

  bool tapers() const { return tapers_; }
  PlaneMatrix stiffness() const {
    return tapers_ ? PlaneMatrix(bends_.transpose() * end_stiffness_ * bends_)
                   : uniformStiffness(bending_, length_, shear_);
  }
  Shapes shapes(double share) const {
    if (!tapers_) {
      return uniformShapes(share, length_, shear_);
    }
    const Flexibility f = flexibility(layers_, share);
    const Eigen::Matrix<double, 2, 4> forces = end_stiffness_ * bends_;
    Eigen::Matrix<double, 2, 4> moved = f.at_point * forces;
    moved(0, 0) += 1.0;
    moved(0, 1) += share * length_;
    moved(1, 1) += 1.0;
    const PlaneVector rotation = moved.row(1).transpose();
    return {moved.row(0).transpose(), rotation, rotation + (f.shear * forces).transpose(),
            (f.curvature * forces).transpose()};
  }

 private:
  const std::vector<ShaftLayer>& layers_;
  double length_;
  bool tapers_ = false;
  double bending_ = 0.0, shear_ = 0.0;  // of a uniform one; P
  Eigen::Matrix<double, 2, 4> bends_;   // of one that tapers
  Eigen::Matrix2d end_stiffness_;
};

/// An element's matrices, of those of its planes.
class BothPlanes {
 public:
  using Matrix = ShaftElement::Matrix;

  BothPlanes() {
    for (Eigen::Index node = 0; node < 2; ++node) {
      const Eigen::Index first = node * kNodeCoordinates;
      in_x_(2 * node, first) = in_y_(2 * node, first + 1) = 1.0;
      in_x_(2 * node + 1, first + 3) = 1.0;
      in_y_(2 * node + 1, first + 2) = -1.0;
    }
  }
  Matrix each(const PlaneMatrix& m) const {
    return in_x_.transpose() * m * in_x_ + in_y_.transpose() * m * in_y_;
  }
  /// Of x in the first factor, y in the second, less the transposed.
  Matrix across(const PlaneMatrix& m) const {
    return in_x_.transpose() * m * in_y_ - in_y_.transpose() * m.transpose() * in_x_;
  }
  /// Of a torque, by the integral of curvature rotation^T.
  void addTorque(double torque, const PlaneMatrix& m, ShaftElement& element) const {
    const Matrix all = torque * (in_x_.transpose() * m * in_y_ - in_y_.transpose() * m * in_x_);
    element.of_loads += 0.5 * (all + all.transpose());
    element.circulatory += 0.5 * (all - all.transpose());
  }

 private:
  // Places of (x, beta) and (y, -alpha) in the element's coordinates.
  Eigen::Matrix<double, 4, 2 * kNodeCoordinates> in_x_ = decltype(in_x_)::Zero();
  Eigen::Matrix<double, 4, 2 * kNodeCoordinates> in_y_ = decltype(in_y_)::Zero();
};

/// Calls `take` with quadrature points [0, 1] along an element and their weights [m].
template <class Take>
void alongElement(double length, bool tapers, const Take& take) {
  const int parts = tapers ? kTaperParts : 1;
  for (int i = 0; i < parts; ++i) {
    for (const GaussPoint& point : kGauss) {
      take((i + point.place) / parts, point.weight * length / parts);
    }
  }
}

}  // namespace

ShaftSection ShaftSection::at(double share) const {
  ShaftSection there = *this;
  there.outer_diameter += share * outer_growth;
  there.inner_diameter += share * inner_growth;
  there.outer_growth = there.inner_growth = 0.0;
  return there;
}

double ShaftSection::area() const {
  return 0.25 * kPi * (outer_diameter * outer_diameter - inner_diameter * inner_diameter);
}

double ShaftSection::secondMoment() const {
  return area() * (outer_diameter * outer_diameter + inner_diameter * inner_diameter) / 16.0;
}

double shearCoefficient(const ShaftSection& section, double nu) {
  const double ratio = section.inner_diameter / section.outer_diameter;
  const double m2 = ratio * ratio;
  const double ring = (1.0 + m2) * (1.0 + m2);
  return 6.0 * (1.0 + nu) * ring / ((7.0 + 6.0 * nu) * ring + (20.0 + 12.0 * nu) * m2);
}

ShaftElement shaftElement(const ShaftMaterial& material, const ShaftSection& section) {
  return shaftElement({{material, section}});
}

ShaftElement shaftElement(const std::vector<ShaftLayer>& layers, double axial_force,
                          double torque) {
  const Plane plane(layers);
  PlaneMatrix mass = PlaneMatrix::Zero();
  PlaneMatrix rotary = PlaneMatrix::Zero();
  PlaneMatrix of_axial_force = PlaneMatrix::Zero();
  PlaneMatrix turned = PlaneMatrix::Zero();
  alongElement(layers.front().section.length, plane.tapers(), [&](double share, double dz) {
    const Shapes at = plane.shapes(share);
    const Inertia inertia = inertiaAt(layers, share);
    mass += inertia.mass * dz * at.deflection * at.deflection.transpose();
    rotary += inertia.rotary * dz * at.rotation * at.rotation.transpose();
    of_axial_force += axial_force * dz * at.slope * at.slope.transpose();
    turned += dz * at.curvature * at.rotation.transpose();
  });
  const BothPlanes planes;
  ShaftElement element;
  element.mass = planes.each(mass + rotary);
  element.stiffness = planes.each(plane.stiffness());
  element.of_loads = planes.each(of_axial_force);
  planes.addTorque(torque, turned, element);
  // The polar moment is twice that about a diameter.
  element.gyroscopic = planes.across(2.0 * rotary);
  return element;
}

ShaftElement couplingElement(const ShaftCoupling& coupling, double length, double axial_force,
                             double torque) {
  const PlaneVector apart(-1.0, -0.5 * length, 1.0, -0.5 * length);  // of the arms in the middle
  const PlaneVector bend(0.0, -1.0, 0.0, 1.0);
  const PlaneVector turn(0.0, 0.5, 0.0, 0.5);
  const auto joint = [&](double across, double bending) -> PlaneMatrix {
    return across * apart * apart.transpose() + bending * bend * bend.transpose();
  };
  const PlaneVector arms(0.0, 1.0, 0.0, 1.0);
  const BothPlanes planes;
  ShaftElement element;
  element.mass = element.gyroscopic = ShaftElement::Matrix::Zero();
  element.stiffness = planes.each(joint(coupling.lateral_stiffness, coupling.bending_stiffness));
  element.damping = planes.each(joint(coupling.lateral_damping, coupling.bending_damping));
  element.of_loads = planes.each(0.5 * axial_force * length * PlaneMatrix(arms.asDiagonal()));
  planes.addTorque(torque, bend * turn.transpose(), element);
  return element;
}

ElementBody elementBody(const std::vector<ShaftLayer>& layers) {
  const double length = layers.front().section.length;
  ElementBody body;
  double moment = 0.0;
  double about_end = 0.0;
  // Of a cone the inertia of a slice is of the fourth power of its place: the points are exact.
  alongElement(length, false, [&](double share, double dz) {
    const Inertia inertia = inertiaAt(layers, share);
    const double z = share * length;
    body.mass += inertia.mass * dz;
    moment += inertia.mass * dz * z;
    about_end += (inertia.rotary + inertia.mass * z * z) * dz;
    body.polar_inertia += 2.0 * inertia.rotary * dz;
  });
  body.centre = body.mass > 0.0 ? moment / body.mass : 0.5 * length;
  body.transverse_inertia = about_end - moment * body.centre;
  return body;
}

}  // namespace whirl_twin
