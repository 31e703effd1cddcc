#include "mechanics/rotors/shaft_element.h"

#include <cmath>

namespace whirl_twin {

namespace {

constexpr double kPi = 3.14159265358979323846;

/// One bending plane: deflection, rotation at the first node and at the second.
using PlaneMatrix = Eigen::Matrix4d;
using PlaneVector = Eigen::Vector4d;

struct GaussPoint {
  double place, weight;  ///< on [0, 1]
};
/// Four points: exact for the squares of cubics.
constexpr GaussPoint kGauss[] = {{0.0694318442029737124, 0.173927422568726929},
                                 {0.330009478207571868, 0.326072577431273071},
                                 {0.669990521792428132, 0.326072577431273071},
                                 {0.930568155797026288, 0.173927422568726929}};

PlaneVector deflection(double s, double length, double shear) {
  const double s2 = s * s;
  const double s3 = s2 * s;
  return PlaneVector(1.0 + shear * (1.0 - s) - 3.0 * s2 + 2.0 * s3,
                     length * (s * (1.0 + 0.5 * shear) - (2.0 + 0.5 * shear) * s2 + s3),
                     shear * s + 3.0 * s2 - 2.0 * s3,
                     length * (-0.5 * shear * s + (0.5 * shear - 1.0) * s2 + s3)) /
         (1.0 + shear);
}

PlaneVector rotation(double s, double length, double shear) {
  const double s2 = s * s;
  return PlaneVector(6.0 * (s2 - s) / length, 1.0 + shear - (4.0 + shear) * s + 3.0 * s2,
                     6.0 * (s - s2) / length, (shear - 2.0) * s + 3.0 * s2) /
         (1.0 + shear);
}

PlaneMatrix planeStiffness(double bending, double l, double shear) {
  PlaneMatrix k;
  k << 12.0, 6.0 * l, -12.0, 6.0 * l,                                   //
      6.0 * l, (4.0 + shear) * l * l, -6.0 * l, (2.0 - shear) * l * l,  //
      -12.0, -6.0 * l, 12.0, -6.0 * l,                                  //
      6.0 * l, (2.0 - shear) * l * l, -6.0 * l, (4.0 + shear) * l * l;
  return bending / ((1.0 + shear) * l * l * l) * k;
}

}  // namespace

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
  const double l = section.length;
  const double area = section.area();
  const double second_moment = section.secondMoment();
  const double bending = material.youngs_modulus * second_moment;
  double shear = 0.0;
  if (material.shear_deformation) {
    const double nu = material.youngs_modulus / (2.0 * material.shear_modulus) - 1.0;
    shear =
        12.0 * bending / (shearCoefficient(section, nu) * material.shear_modulus * area * l * l);
  }
  PlaneMatrix mass = PlaneMatrix::Zero();
  PlaneMatrix rotary = PlaneMatrix::Zero();
  for (const GaussPoint& point : kGauss) {
    const PlaneVector w = deflection(point.place, l, shear);
    const PlaneVector turn = rotation(point.place, l, shear);
    mass += point.weight * material.density * area * l * w * w.transpose();
    rotary += point.weight * material.density * second_moment * l * turn * turn.transpose();
  }
  const PlaneMatrix stiffness = planeStiffness(bending, l, shear);

  // Places of (x, beta) and (y, -alpha) in the element's coordinates.
  Eigen::Matrix<double, 4, 2 * kNodeCoordinates> in_x = decltype(in_x)::Zero();
  Eigen::Matrix<double, 4, 2 * kNodeCoordinates> in_y = decltype(in_y)::Zero();
  for (Eigen::Index node = 0; node < 2; ++node) {
    const Eigen::Index first = node * kNodeCoordinates;
    in_x(2 * node, first) = in_y(2 * node, first + 1) = 1.0;
    in_x(2 * node + 1, first + 3) = 1.0;
    in_y(2 * node + 1, first + 2) = -1.0;
  }
  const auto inBothPlanes = [&](const PlaneMatrix& m) -> ShaftElement::Matrix {
    return in_x.transpose() * m * in_x + in_y.transpose() * m * in_y;
  };
  ShaftElement element;
  element.mass = inBothPlanes(mass + rotary);
  element.stiffness = inBothPlanes(stiffness);
  // The polar moment is twice that about a diameter.
  const ShaftElement::Matrix polar = 2.0 * in_x.transpose() * rotary * in_y;
  element.gyroscopic = polar - polar.transpose();
  return element;
}

}  // namespace whirl_twin
