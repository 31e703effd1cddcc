#include "mechanics/rotors/moving_coordinates.h"

#include <algorithm>

#include "algebra/dense.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kFreePivot = 1.0e-12;  // a pivot of the stiffness scaled to unit diagonal
constexpr double kNoForce = 1.0e-9;     // of what the parts of a sum of forces come to

std::vector<Index> freeOf(Index n, const std::vector<HeldCoordinate>& held) {
  std::vector<Index> free;
  for (Index i = 0; i < n; ++i) {
    if (std::none_of(held.begin(), held.end(),
                     [i](const HeldCoordinate& one) { return one.held == i; })) {
      free.push_back(i);
    }
  }
  return free;
}

/// [n x moving], of the coordinates `light` that follow the others.
MatrixXd followingShapes(const MatrixXd& stiffness, const std::vector<Index>& light,
                         const std::vector<Index>& moving) {
  const auto n = static_cast<Index>(moving.size());
  MatrixXd shapes = MatrixXd::Zero(stiffness.rows(), n);
  for (Index k = 0; k < n; ++k) {
    shapes(moving[static_cast<std::size_t>(k)], k) = 1.0;
  }
  if (light.empty()) {
    return shapes;
  }
  const MatrixXd own = stiffness(light, light);
  const Eigen::VectorXd unit = own.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
  const Cholesky factor(unit.asDiagonal() * own * unit.asDiagonal());
  if (!unit.allFinite() || !factor.succeeded() ||
      !(factor.lower().diagonal().cwiseAbs2().minCoeff() > kFreePivot)) {
    throw InputError("a massless part of the rotor is not supported by springs");
  }
  const MatrixXd pulled = unit.asDiagonal() * MatrixXd(stiffness(light, moving));
  const MatrixXd follow = unit.asDiagonal() * factor.solveUpper(factor.solveLower(pulled));
  shapes(light, Eigen::all) = -follow;
  return shapes;
}

/// The coordinates `light` on which `rates` act although they follow the others.
std::vector<Index> resisted(const std::vector<MatrixXd>& rates, const MatrixXd& shapes,
                            const std::vector<Index>& light) {
  std::vector<Index> found;
  for (const Index i : light) {
    if (std::any_of(rates.begin(), rates.end(), [&](const MatrixXd& rate) {
          return (rate.row(i) * shapes).norm() >
                 kNoForce * (rate.row(i).cwiseAbs() * shapes.cwiseAbs()).norm();
        })) {
      found.push_back(i);
    }
  }
  return found;
}

}  // namespace

MatrixXd supportedShapes(Index n, const std::vector<HeldCoordinate>& held) {
  const std::vector<Index> free = freeOf(n, held);
  MatrixXd shapes = MatrixXd::Zero(n, static_cast<Index>(free.size()));
  for (std::size_t k = 0; k < free.size(); ++k) {
    shapes(free[k], static_cast<Index>(k)) = 1.0;
  }
  for (const HeldCoordinate& one : held) {
    if (one.to != HeldCoordinate::kGround) {
      shapes.row(one.held) = shapes.row(one.to);
    }
  }
  return shapes;
}

MovingCoordinates movingCoordinates(const MatrixXd& mass, const MatrixXd& stiffness,
                                    const std::vector<MatrixXd>& rates,
                                    const std::vector<bool>& acted,
                                    const std::vector<HeldCoordinate>& held) {
  const std::vector<Index> free = freeOf(mass.rows(), held);
  const MatrixXd supported = supportedShapes(mass.rows(), held);
  const auto in = [&](const MatrixXd& m) -> MatrixXd {
    return supported.transpose() * m * supported;
  };
  const MatrixXd inertia = in(mass);
  const MatrixXd spring = in(stiffness);
  std::vector<Index> moving, massive, light;
  for (Index k = 0; k < inertia.rows(); ++k) {
    const bool without = inertia.row(k).isZero(0.0);
    if (without && !acted[static_cast<std::size_t>(free[static_cast<std::size_t>(k)])]) {
      light.push_back(k);
      continue;
    }
    moving.push_back(k);
    if (without) {
      massive.push_back(k);
    }
  }
  std::vector<MatrixXd> others;
  if (!light.empty()) {
    std::transform(rates.begin(), rates.end(), std::back_inserter(others), in);
  }
  if (moving.size() == massive.size()) {
    throw InputError("no free coordinate has a mass");
  }
  MatrixXd shapes = followingShapes(spring, light, moving);
  for (std::vector<Index> more = resisted(others, shapes, light); !more.empty();
       more = resisted(others, shapes, light)) {
    for (const Index i : more) {
      light.erase(std::find(light.begin(), light.end(), i));
      massive.push_back(i);
      moving.insert(std::lower_bound(moving.begin(), moving.end(), i), i);
    }
    shapes = followingShapes(spring, light, moving);
  }
  const auto ofAll = [&](std::vector<Index> some) {
    for (Index& i : some) {
      i = free[static_cast<std::size_t>(i)];
    }
    return some;
  };
  return {ofAll(moving), ofAll(massive), supported * shapes};
}

}  // namespace whirl_twin
