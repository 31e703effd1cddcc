#include "studies/published_quantities.h"

#include <cmath>

#include "scene/signal_names.h"

namespace whirl_twin {

namespace {

using QuantityKind = PublishedQuantity::Kind;

double along(const Eigen::VectorXd& direction, const double* q) {
  return direction.dot(Eigen::Map<const Eigen::VectorXd>(q, direction.size()));
}

}  // namespace

std::map<std::string, PublishedQuantity> publishedQuantities(const BuiltScene& scene) {
  std::map<std::string, PublishedQuantity> all;
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    const BuiltSystem& system = *scene.systems[i];
    const std::string& name = system.spec.name;
    const std::vector<CoordinateInfo> coordinates = system.dynamics->coordinates();
    for (std::size_t k = 0; k < coordinates.size(); ++k) {
      const std::string& coordinate = coordinates[k].name;
      const std::string& unit = coordinates[k].unit;
      all.emplace(name + "." + coordinate,
                  PublishedQuantity{QuantityKind::kCoordinate, i, k, unit});
      all.emplace(name + "." + coordinate + "_rate",
                  PublishedQuantity{QuantityKind::kRate, i, k, unit + "/s"});
    }
    if (system.dynamics->isRotor()) {
      const std::vector<std::string> stations = publishedStations(name, *system.dynamics);
      for (std::size_t k = 0; k < stations.size(); ++k) {
        all.emplace(stations[k] + ".whirl.radius",
                    PublishedQuantity{QuantityKind::kRadius, i, k, "m"});
        all.emplace(stations[k] + ".whirl_radius",
                    PublishedQuantity{QuantityKind::kRadius, i, k, "m"});
        all.emplace(stations[k] + ".whirl.vibration",
                    PublishedQuantity{QuantityKind::kVibration, i, k, "m"});
        all.emplace(stations[k] + ".whirl.x", PublishedQuantity{QuantityKind::kX, i, k, "m"});
        all.emplace(stations[k] + ".whirl.y", PublishedQuantity{QuantityKind::kY, i, k, "m"});
      }
    }
    all.emplace(name + ".kinetic", PublishedQuantity{QuantityKind::kKinetic, i, 0, "J"});
    all.emplace(name + ".potential", PublishedQuantity{QuantityKind::kPotential, i, 0, "J"});
    all.emplace(name + ".energy", PublishedQuantity{QuantityKind::kEnergy, i, 0, "J"});
  }
  for (std::size_t i = 0; i < scene.scene.drives.size(); ++i) {
    const std::string& name = scene.scene.drives[i].name;
    all.emplace(name + ".speed", PublishedQuantity{QuantityKind::kSpeed, i, 0, "rad/s"});
    all.emplace(name + ".acceleration",
                PublishedQuantity{QuantityKind::kAcceleration, i, 0, "rad/s^2"});
  }
  return all;
}

QuantityReader::QuantityReader(const Twin& twin) : twin_(twin), record_(twin.layout().size) {
  for (const SharedSystem& system : twin.systems()) {
    stations_.push_back(system->dynamics->stations());
  }
}

void QuantityReader::look() {
  twin_.write(record_.data());
}

double QuantityReader::value(const PublishedQuantity& quantity) {
  const double* const record = record_.data();
  if (quantity.ofDrive()) {
    const ShaftView shaft = RecordLayout::shaft(record, quantity.owner);
    return quantity.kind == QuantityKind::kSpeed ? shaft.speed() : shaft.acceleration();
  }
  const SystemView view = twin_.layout().system(record, quantity.owner);
  switch (quantity.kind) {
    case QuantityKind::kCoordinate:
      return view.q()[quantity.place];
    case QuantityKind::kRate:
      return view.v()[quantity.place];
    case QuantityKind::kRadius:
    case QuantityKind::kVibration:
    case QuantityKind::kX:
    case QuantityKind::kY: {
      const Station& station = stations_[quantity.owner][quantity.place];
      const double x = along(station.along_x, view.q());
      const double y = along(station.along_y, view.q());
      return quantity.kind == QuantityKind::kX           ? x
             : quantity.kind == QuantityKind::kY         ? y
             : quantity.kind == QuantityKind::kVibration ? vibration(quantity, x, y)
                                                         : std::hypot(x, y);
    }
    default:
      return energy(quantity);
  }
}

double QuantityReader::vibration(const PublishedQuantity& quantity, double x, double y) {
  Vibration& vibration = vibrations_[{quantity.owner, quantity.place}];
  const std::int64_t step = RecordLayout::step(record_.data());
  if (vibration.step != step) {
    const double* const record = record_.data();
    const ShaftView shaft = RecordLayout::shaft(record, twin_.systems()[quantity.owner]->drive);
    state::WhirlState whirl;
    whirl.at.time = twin_.time();
    whirl.speed = shaft.speed();
    whirl.shaft_angle = shaft.angle().total();
    whirl.x = x;
    whirl.y = y;
    vibration.amplitude = vibration.followed.take(whirl);
    vibration.step = step;
  }
  return vibration.amplitude;
}

double QuantityReader::energy(const PublishedQuantity& quantity) const {
  const SystemView view = twin_.layout().system(record_.data(), quantity.owner);
  const BuiltSystem& system = *twin_.systems()[quantity.owner];
  const ShaftView shaft = RecordLayout::shaft(record_.data(), system.drive);
  const auto n = static_cast<Eigen::Index>(view.dof());
  const Energies energies = system.dynamics->energies(
      Eigen::Map<const Eigen::VectorXd>(view.q(), n),
      Eigen::Map<const Eigen::VectorXd>(view.v(), n),
      {twin_.time(), shaft.remainder(), shaft.speed(), shaft.acceleration()});
  return quantity.kind == QuantityKind::kKinetic     ? energies.kinetic
         : quantity.kind == QuantityKind::kPotential ? energies.potential
                                                     : energies.kinetic + energies.potential;
}

}  // namespace whirl_twin
