#include "mechanics/local_elements.h"

#include <cmath>

#include "algebra/constants.h"
#include "mechanics/gradient.h"

namespace whirl_twin {

namespace {

constexpr double kWithinRoom = 0.1;  // a whirl that is large

/// Remaining clearance at an element (roomOf) and the length scale of its motion (lengthOf).
double roomOf(const CubicSpring&, const Eigen::Vector2d&) {
  return kInfinity;
}
double roomOf(const Rub&, const Eigen::Vector2d&) {
  return kInfinity;
}
double roomOf(const OilFilm& film, const Eigen::Vector2d& place) {
  return film.bearing.clearance - place.norm();
}
double lengthOf(const CubicSpring&) {
  return 0.0;
}
double lengthOf(const Rub& rub) {
  return kWithinRoom * rub.clearance;
}
double lengthOf(const OilFilm& film) {
  return kWithinRoom * film.bearing.clearance;
}

template <class Element>
double momentOf(const Element&, const PushedMotion<double>&) {
  return 0.0;
}
double momentOf(const Rub& rub, const PushedMotion<double>& at) {
  return rub.moment(at);
}

template <class Element>
class ElementLaw final : public NodalForceLaw {
 public:
  explicit ElementLaw(const Element& element) : element_(element) {}

  bool push(const LocalState& at, NodalForce& out) const noexcept override {
    if (!(roomOf(element_, {at.place[0], at.place[1]}) > 0.0)) {
      return false;
    }
    const FilmForce<double> force = element_.force(
        PushedMotion<double>{at.place[0], at.place[1], at.rate[0], at.rate[1], at.speed});
    out.force = {force.x, force.y};
    out.size = std::fabs(force.x) + std::fabs(force.y);
    return true;
  }

  LocalSlopes slopes(const LocalState& at) const noexcept override {
    using Dual = Gradient<double, 4>;
    const FilmForce<Dual> force =
        element_.force(PushedMotion<Dual>{Dual(at.place[0], 0), Dual(at.place[1], 1),
                                          Dual(at.rate[0], 2), Dual(at.rate[1], 3), at.speed});
    LocalSlopes slopes;
    slopes.stiffness << -force.x.slope[0], -force.x.slope[1], -force.y.slope[0], -force.y.slope[1];
    slopes.damping << -force.x.slope[2], -force.x.slope[3], -force.y.slope[2], -force.y.slope[3];
    return slopes;
  }

  double moment(const LocalState& at) const noexcept override {
    return momentOf(
        element_, PushedMotion<double>{at.place[0], at.place[1], at.rate[0], at.rate[1], at.speed});
  }

  double room(const Eigen::Vector2d& place) const noexcept override {
    return roomOf(element_, place);
  }
  double length() const override { return lengthOf(element_); }

 private:
  Element element_;
};

}  // namespace

std::shared_ptr<const NodalForceLaw> localLaw(const CubicSpring& spring) {
  return std::make_shared<ElementLaw<CubicSpring>>(spring);
}

std::shared_ptr<const NodalForceLaw> localLaw(const Rub& rub) {
  return std::make_shared<ElementLaw<Rub>>(rub);
}

std::shared_ptr<const NodalForceLaw> localLaw(const OilFilm& film) {
  return std::make_shared<ElementLaw<OilFilm>>(film);
}

}  // namespace whirl_twin
