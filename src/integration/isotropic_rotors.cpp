#include "integration/isotropic_rotors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "integration/matrix_exponential.h"
#include "integration/simd_vector.h"

namespace whirl_twin {

namespace {

constexpr double kMaxPart = 2.0;  // rad, of shaft and whirl together
constexpr int kMaxPartsOfStep = 1000000;
constexpr std::size_t kAtATime = 64;  // parts: as many as are kept beside eight rotors

/// Gauss-Legendre on 0..1, order 12.
constexpr std::array<double, 6> kGaussNodes{0.033765242898423986094, 0.16939530676686774317,
                                            0.38069040695840154568,  0.61930959304159845432,
                                            0.83060469323313225683,  0.96623475710157601391};
constexpr std::array<double, 6> kGaussWeights{0.085662246189585172520, 0.18038078652406930378,
                                              0.23395696728634552369,  0.23395696728634552369,
                                              0.18038078652406930378,  0.085662246189585172520};

/// (w^2 - i a) e^(i theta) with e^(i theta) given.
std::complex<double> unbalanceForce(const ShaftMotion& shaft, std::complex<double> turn) noexcept {
  const double square = shaft.speed * shaft.speed;
  return {square * turn.real() + shaft.acceleration * turn.imag(),
          square * turn.imag() - shaft.acceleration * turn.real()};
}

/// Legendre polynomials P_0 ... P_5 at x in -1..1.
std::array<double, 6> legendrePolynomials(double x) noexcept {
  std::array<double, 6> p{1.0, x};
  for (std::size_t k = 2; k < p.size(); ++k) {
    const auto n = static_cast<double>(k);
    p[k] = ((2.0 * n - 1.0) * x * p[k - 1] - (n - 1.0) * p[k - 2]) / n;
  }
  return p;
}

/// [rad/s] of the whirl, or [1/s] of its decay.
double fastest(const std::vector<IsotropicRotor>& rotors) {
  double rate = 0.0;
  for (const IsotropicRotor& rotor : rotors) {
    rate = std::max({rate, std::sqrt(rotor.stiffness), rotor.damping});
  }
  return rate;
}

int partsFor(const std::vector<IsotropicRotor>& rotors, double h, double highest_speed) {
  const double parts = std::ceil(h * (fastest(rotors) + std::fabs(highest_speed)) / kMaxPart);
  return static_cast<int>(std::clamp(parts, 1.0, static_cast<double>(kMaxPartsOfStep)));
}

std::complex<double> markOf(const IsotropicRotor& rotor) {
  const double size = std::abs(rotor.eccentricity);
  return size > 0.0 ? rotor.eccentricity / size : 1.0;
}

bool anyBowed(const std::vector<IsotropicRotor>& rotors) {
  return std::any_of(rotors.begin(), rotors.end(),
                     [](const IsotropicRotor& rotor) { return rotor.bow_force != 0.0; });
}

}  // namespace

IsotropicRotors::IsotropicRotors(const std::vector<IsotropicRotor>& rotors, double h,
                                 double highest_speed, int finer)
    : count_(rotors.size()),
      parts_(finer * partsFor(rotors, h, highest_speed)),
      part_(h / parts_),
      limit_speed_(2.0 * kMaxPart / part_ - fastest(rotors)),
      bowed_(anyBowed(rotors)),
      later_(kAtATime),
      rotors_(rotors),
      frequencies_(rotors.size()),
      blocks_((rotors.size() + kLanes - 1) / kLanes) {
  for (std::size_t i = 0; i < count_; ++i) {
    frequencies_[i] = powerOfTwo(std::sqrt(rotors[i].stiffness));
    marks_.push_back(markOf(rotors[i]));
    prepare(blocks_[i / kLanes], i % kLanes, rotors[i]);
  }
  reset();
}

void IsotropicRotors::prepare(Block& block, std::size_t lane, const IsotropicRotor& rotor) const {
  const double frequency = powerOfTwo(std::sqrt(rotor.stiffness));
  Eigen::Matrix2d a;
  a << 0.0, frequency, -rotor.stiffness / frequency, -rotor.damping;
  const Eigen::Matrix2d increment = exponentialLessIdentity<2>(Eigen::Matrix2d(part_ * a));
  block.p_zz[lane] = increment(0, 0);
  block.p_zw[lane] = increment(0, 1);
  block.p_wz[lane] = increment(1, 0);
  block.p_ww[lane] = increment(1, 1);
  for (std::size_t k = 0; k < kNodes; ++k) {
    const Eigen::Matrix2d rest =
        exponentialLessIdentity<2>(Eigen::Matrix2d((1.0 - kGaussNodes[k]) * part_ * a));
    const double weight =
        kGaussWeights[k] * part_ / frequency * (bowed_ ? 1.0 : std::abs(rotor.eccentricity));
    block.to_z[k][lane] = weight * rest(0, 1);
    block.to_w[k][lane] = weight * (rest(1, 1) + 1.0);
  }
  const std::complex<double> mark = markOf(rotor);
  const std::complex<double> bow = rotor.bow_force * std::conj(mark);
  block.eccentricity[lane] = std::abs(rotor.eccentricity);
  block.bow_re[lane] = bow.real();
  block.bow_im[lane] = bow.imag();
  const std::complex<double> rest = rotor.load / rotor.stiffness * std::conj(mark);
  block.rest_re[lane] = rest.real();
  block.rest_im[lane] = rest.imag();
}

void IsotropicRotors::reset() noexcept {
  for (std::size_t i = 0; i < count_; ++i) {
    Block& block = blocks_[i / kLanes];
    const std::size_t lane = i % kLanes;
    const IsotropicRotor& rotor = rotors_[i];
    const std::complex<double> start = rotor.start * std::conj(marks_[i]);
    const std::complex<double> rate = rotor.start_rate * std::conj(marks_[i]);
    block.z_re[lane] = start.real() - block.rest_re[lane];
    block.z_im[lane] = start.imag() - block.rest_im[lane];
    block.w_re[lane] = rate.real() / frequencies_[i];
    block.w_im[lane] = rate.imag() / frequencies_[i];
    block.peak_square[lane] = std::norm(rotor.start);
  }
  waiting_ = 0;
}

void IsotropicRotors::step(const Drive& drive) noexcept {
  stepLater(drive);
  catchUp();
}

void IsotropicRotors::stepLater(const Drive& drive) noexcept {
  for (int i = 0; i < parts_; ++i) {
    const double offset = i * part_;
    const double sliver = ShaftNodes::kSliver * part_;
    const bool smooth = drive.nextCorner(offset + sliver) - offset > part_ - sliver;
    later_[waiting_] = smooth ? sampled(drive, offset) : projected(drive, offset);
    later_[waiting_].last = i + 1 == parts_;
    if (++waiting_ == later_.size()) {
      catchUp();
    }
  }
}

void IsotropicRotors::catchUp() noexcept {
  advance(blocks_.data(), blocks_.size(), later_.data(), waiting_, bowed_);
  waiting_ = 0;
}

IsotropicRotors::Forces IsotropicRotors::sampled(const Drive& drive, double offset) const noexcept {
  Forces forces;
  for (std::size_t k = 0; k < kNodes; ++k) {
    const ShaftMotion shaft = drive.at(offset + kGaussNodes[k] * part_);
    const std::complex<double> turn{std::cos(shaft.angle), std::sin(shaft.angle)};
    const std::complex<double> unbalance = unbalanceForce(shaft, turn);
    forces.unbalance.re[k] = unbalance.real();
    forces.unbalance.im[k] = unbalance.imag();
    forces.bow.re[k] = turn.real();
    forces.bow.im[k] = turn.imag();
  }
  return forces;
}

IsotropicRotors::Forces IsotropicRotors::projected(const Drive& drive,
                                                   double offset) const noexcept {
  ShaftNodes nodes;
  nodes.sample(drive, offset, part_);
  std::array<std::array<std::complex<double>, kNodes>, 2> coefficients{};
  for (const ShaftNode& node : nodes) {
    const std::array<double, kNodes> p = legendrePolynomials(2.0 * node.tau - 1.0);
    for (std::size_t j = 0; j < kNodes; ++j) {
      const double share = (2.0 * static_cast<double>(j) + 1.0) * node.weight * p[j];
      coefficients[0][j] += share * unbalanceForce(node.shaft, node.turn);
      coefficients[1][j] += share * node.turn;
    }
  }
  Forces forces;
  for (std::size_t k = 0; k < kNodes; ++k) {
    const std::array<double, kNodes> p = legendrePolynomials(2.0 * kGaussNodes[k] - 1.0);
    for (std::size_t j = 0; j < kNodes; ++j) {
      forces.unbalance.re[k] += p[j] * coefficients[0][j].real();
      forces.unbalance.im[k] += p[j] * coefficients[0][j].imag();
      forces.bow.re[k] += p[j] * coefficients[1][j].real();
      forces.bow.im[k] += p[j] * coefficients[1][j].imag();
    }
  }
  return forces;
}

/// Of the rotors of a block from `lane` on.
template <int lanes, bool bowed>
WHIRL_TWIN_INLINE void IsotropicRotors::advanceSome(Block& block, std::size_t lane,
                                                    const Forces* forces,
                                                    std::size_t parts) noexcept {
  using Some = typename Vector<lanes>::Type;
  const auto at = [lane](SimdVector& numbers) WHIRL_TWIN_FLAT -> Some& {
    return *reinterpret_cast<Some*>(reinterpret_cast<double*>(&numbers) + lane);
  };
  // In registers, where there are enough.
  Some z_re = at(block.z_re), z_im = at(block.z_im), w_re = at(block.w_re), w_im = at(block.w_im);
  Some peak_square = at(block.peak_square);
  const Some p_zz = at(block.p_zz), p_zw = at(block.p_zw);
  const Some p_wz = at(block.p_wz), p_ww = at(block.p_ww);
  const Some rest_re = at(block.rest_re), rest_im = at(block.rest_im);
  Some to_z[kNodes];
  Some to_w[kNodes];
  for (std::size_t k = 0; k < kNodes; ++k) {
    to_z[k] = at(block.to_z[k]);
    to_w[k] = at(block.to_w[k]);
  }
  for (std::size_t part = 0; part < parts; ++part) {
    const auto& [unbalance, bow, last] = forces[part];
    Some to_z_re{}, to_z_im{}, to_w_re{}, to_w_im{};
    for (std::size_t k = 0; k < kNodes; ++k) {
      to_z_re += to_z[k] * unbalance.re[k];
      to_z_im += to_z[k] * unbalance.im[k];
      to_w_re += to_w[k] * unbalance.re[k];
      to_w_im += to_w[k] * unbalance.im[k];
    }
    if (bowed) {
      Some bow_z_re{}, bow_z_im{}, bow_w_re{}, bow_w_im{};
      for (std::size_t k = 0; k < kNodes; ++k) {
        bow_z_re += to_z[k] * bow.re[k];
        bow_z_im += to_z[k] * bow.im[k];
        bow_w_re += to_w[k] * bow.re[k];
        bow_w_im += to_w[k] * bow.im[k];
      }
      const Some eccentricity = at(block.eccentricity);
      const Some bow_re = at(block.bow_re), bow_im = at(block.bow_im);
      to_z_re = eccentricity * to_z_re + bow_re * bow_z_re - bow_im * bow_z_im;
      to_z_im = eccentricity * to_z_im + bow_re * bow_z_im + bow_im * bow_z_re;
      to_w_re = eccentricity * to_w_re + bow_re * bow_w_re - bow_im * bow_w_im;
      to_w_im = eccentricity * to_w_im + bow_re * bow_w_im + bow_im * bow_w_re;
    }
    const Some by_z_re = p_zz * z_re + p_zw * w_re + to_z_re;
    const Some by_z_im = p_zz * z_im + p_zw * w_im + to_z_im;
    const Some by_w_re = p_wz * z_re + p_ww * w_re + to_w_re;
    const Some by_w_im = p_wz * z_im + p_ww * w_im + to_w_im;
    z_re += by_z_re;
    z_im += by_z_im;
    w_re += by_w_re;
    w_im += by_w_im;
    if (last) {
      const Some x = z_re + rest_re;
      const Some y = z_im + rest_im;
      const Some square = x * x + y * y;
      peak_square = square > peak_square ? square : peak_square;
    }
  }
  at(block.z_re) = z_re;
  at(block.z_im) = z_im;
  at(block.w_re) = w_re;
  at(block.w_im) = w_im;
  at(block.peak_square) = peak_square;
}

void IsotropicRotors::advance(Block* blocks, std::size_t count, const Forces* forces,
                              std::size_t parts, bool bowed) noexcept {
  inWidestVectors([&](auto lanes) WHIRL_TWIN_FLAT {
    constexpr int kSome = decltype(lanes)::value;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t lane = 0; lane < kLanes; lane += kSome) {
        if (bowed) {
          advanceSome<kSome, true>(blocks[i], lane, forces, parts);
        } else {
          advanceSome<kSome, false>(blocks[i], lane, forces, parts);
        }
      }
    }
  });
}

std::complex<double> IsotropicRotors::position(std::size_t rotor) const noexcept {
  const Block& block = blocks_[rotor / kLanes];
  const std::size_t lane = rotor % kLanes;
  return marks_[rotor] * std::complex<double>{block.z_re[lane] + block.rest_re[lane],
                                              block.z_im[lane] + block.rest_im[lane]};
}

std::complex<double> IsotropicRotors::rate(std::size_t rotor) const noexcept {
  const Block& block = blocks_[rotor / kLanes];
  const std::size_t lane = rotor % kLanes;
  return frequencies_[rotor] * marks_[rotor] *
         std::complex<double>{block.w_re[lane], block.w_im[lane]};
}

void IsotropicRotors::put(std::size_t rotor, const IsotropicRotors& others,
                          std::size_t other) noexcept {
  Block& to = blocks_[rotor / kLanes];
  const Block& from = others.blocks_[other / kLanes];
  const std::size_t lane = rotor % kLanes;
  const std::size_t there = other % kLanes;
  to.z_re[lane] = from.z_re[there];
  to.z_im[lane] = from.z_im[there];
  to.w_re[lane] = from.w_re[there];
  to.w_im[lane] = from.w_im[there];
}

double IsotropicRotors::peak(std::size_t rotor) const noexcept {
  return std::sqrt(blocks_[rotor / kLanes].peak_square[rotor % kLanes]);
}

}  // namespace whirl_twin
