#include "integration/batch_runge_kutta.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "integration/dormand_prince_8.h"
#include "integration/runge_kutta_4.h"
#include "integration/simd_vector.h"
#include "integration/sliver.h"

namespace whirl_twin {

namespace {

constexpr RungeKuttaTable kRungeKutta4{4,
                                       {0.0, 0.5, 0.5, 1.0},
                                       {{{}, {0.5}, {0.0, 0.5}, {0.0, 0.0, 1.0}}},
                                       {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0}};
constexpr RungeKuttaTable kDormandPrince8{dormand_prince::kStages, dormand_prince::kNodes,
                                          dormand_prince::kA, dormand_prince::kWeights};

struct Scaled {
  double factor;
  const double* numbers;
};

// Of `width` numbers, a multiple of eight.

/// out = from + sum of factor x numbers.
void addTerms(const double* from, const Scaled* terms, std::size_t count, std::size_t width,
              double* out) noexcept {
  inWidestVectors([&](auto lanes) WHIRL_TWIN_FLAT {
    using Some = typename Vector<decltype(lanes)::value>::Anywhere;
    for (std::size_t i = 0; i < width; i += decltype(lanes)::value) {
      Some sum = terms[0].factor * *reinterpret_cast<const Some*>(terms[0].numbers + i);
      for (std::size_t k = 1; k < count; ++k) {
        sum += terms[k].factor * *reinterpret_cast<const Some*>(terms[k].numbers + i);
      }
      *reinterpret_cast<Some*>(out + i) = *reinterpret_cast<const Some*>(from + i) + sum;
    }
  });
}

/// The same to a compensated sum.
void addTermsExactly(const Scaled* terms, std::size_t count, std::size_t width, double* high,
                     double* low) noexcept {
  inWidestVectors([&](auto lanes) WHIRL_TWIN_FLAT {
    using Some = typename Vector<decltype(lanes)::value>::Anywhere;
    for (std::size_t i = 0; i < width; i += decltype(lanes)::value) {
      Some corrected = *reinterpret_cast<const Some*>(low + i);
      for (std::size_t k = 0; k < count; ++k) {
        corrected += terms[k].factor * *reinterpret_cast<const Some*>(terms[k].numbers + i);
      }
      const Some before = *reinterpret_cast<const Some*>(high + i);
      const Some after = before + corrected;
      *reinterpret_cast<Some*>(high + i) = after;
      *reinterpret_cast<Some*>(low + i) = corrected - (after - before);
    }
  });
}

/// Keeps the largest magnitudes; false where a number is not finite.
bool keepPeaks(const double* q, const double* v, std::size_t width, double* peak) noexcept {
  double all = 0.0;
  inWidestVectors([&](auto lanes) WHIRL_TWIN_FLAT {
    using Some = typename Vector<decltype(lanes)::value>::Anywhere;
    Some off{};
    for (std::size_t i = 0; i < width; i += decltype(lanes)::value) {
      const Some now = *reinterpret_cast<const Some*>(q + i);
      const Some rate = *reinterpret_cast<const Some*>(v + i);
      const Some most = *reinterpret_cast<const Some*>(peak + i);
      const Some size = now < 0.0 ? -now : now;
      *reinterpret_cast<Some*>(peak + i) = size > most ? size : most;
      off += (now - now) + (rate - rate);  // no number where one of them is none
    }
    for (int i = 0; i < decltype(lanes)::value; ++i) {
      all += off[i];
    }
  });
  return all == 0.0;
}

}  // namespace

const RungeKuttaTable* rungeKuttaTable(const std::string& integrator) {
  return integrator == RungeKutta4::kName      ? &kRungeKutta4
         : integrator == DormandPrince8::kName ? &kDormandPrince8
                                               : nullptr;
}

BatchRungeKutta::BatchRungeKutta(std::unique_ptr<BatchEquations> equations,
                                 const RungeKuttaTable& method, double step, int substeps)
    : equations_(std::move(equations)),
      n_(equations_->dof()),
      stages_(method.stages),
      nodes_(method.nodes),
      substep_(step / substeps),
      substeps_(substeps),
      start_(2 * n_ * count()),
      state_(blocks() * kKinds * width()),
      stopped_(count()),
      rates_(stages_ * width()),
      accelerations_(stages_ * width()),
      sum_(width()) {
  for (std::size_t k = 0; k <= stages_; ++k) {
    const RungeKuttaTable::Row& row = k < stages_ ? method.a[k] : method.weights;
    for (std::size_t j = 0; j < stages_; ++j) {
      if (row[j] != 0.0) {
        terms_[k].factor[terms_[k].count] = row[j];
        terms_[k].stage[terms_[k].count++] = j;
      }
    }
  }
}

void BatchRungeKutta::put(std::size_t number, std::size_t lane, const double* q,
                          const double* v) noexcept {
  double* const all = block(number);
  for (std::size_t i = 0; i < n_; ++i) {
    const std::size_t place = i * kBlock + lane;
    all[kQ * width() + place] = q[i];
    all[kV * width() + place] = v[i];
    all[kQLow * width() + place] = 0.0;
    all[kVLow * width() + place] = 0.0;
    all[kPeak * width() + place] = std::fabs(q[i]);
  }
}

void BatchRungeKutta::set(std::size_t member, const double* q, const double* v) noexcept {
  double* const start = start_.data() + member * 2 * n_;
  std::copy_n(q, n_, start);
  std::copy_n(v, n_, start + n_);
  stopped_[member] = 0;
  const std::size_t number = member / kBlock;
  const bool last = member + 1 == count();
  for (std::size_t lane = member % kBlock; lane < (last ? kBlock : member % kBlock + 1); ++lane) {
    put(number, lane, q, v);
  }
}

void BatchRungeKutta::step(const Drive& drive, double time) noexcept {
  for (std::size_t number = 0; number < blocks(); ++number) {
    for (int i = 0; i < substeps_; ++i) {
      advance(number, drive, time, i * substep_, substep_);
    }
    double* const all = block(number);
    if (!keepPeaks(all, all + kV * width(), width(), all + kPeak * width())) {
      look(number);
    }
  }
}

/// In sub-steps if the drive has a breakpoint inside.
void BatchRungeKutta::advance(std::size_t number, const Drive& drive, double time, double offset,
                              double h) noexcept {
  const double sliver = kSliver * h;
  const double end = offset + h;
  if (!equations_->hasShaft() || drive.nextCorner(offset) >= end - sliver) {
    methodStep(number, drive, time, offset, h);
    return;
  }
  while (end - offset > sliver) {
    const double next = drive.nextCorner(offset);
    const double corner = next < end - sliver ? next : end;
    if (corner - offset > sliver) {
      methodStep(number, drive, time, offset, corner - offset);
    }
    // Just after the breakpoint, where the jerk (or acceleration) that follows holds.
    offset = std::nextafter(corner, 2.0 * end);
  }
}

void BatchRungeKutta::methodStep(std::size_t number, const Drive& drive, double time, double offset,
                                 double h) noexcept {
  double* const all = block(number);
  const auto scaled = [&](const Terms& terms, const std::vector<double>& numbers, Scaled* out) {
    for (std::size_t k = 0; k < terms.count; ++k) {
      out[k] = {h * terms.factor[k], numbers.data() + terms.stage[k] * width()};
    }
  };
  std::array<Scaled, RungeKuttaTable::kMaxStages> to_q;
  std::array<Scaled, RungeKuttaTable::kMaxStages> to_v;
  for (std::size_t k = 0; k < stages_; ++k) {
    const Terms& terms = terms_[k];
    const double* q = all + kQ * width();
    double* const v = rates_.data() + k * width();
    if (terms.count == 0) {
      std::copy_n(all + kV * width(), width(), v);
    } else {
      scaled(terms, rates_, to_q.data());
      scaled(terms, accelerations_, to_v.data());
      addTerms(q, to_q.data(), terms.count, width(), sum_.data());
      addTerms(all + kV * width(), to_v.data(), terms.count, width(), v);
      q = sum_.data();
    }
    EvaluationPoint<double> at{time + nodes_[k] * h + offset, 0.0, 0.0, 0.0};
    if (equations_->hasShaft()) {
      const ShaftMotion shaft = drive.at(offset + nodes_[k] * h);
      at = {at.time, shaft.angle, shaft.speed, shaft.acceleration};
    }
    equations_->accelerate(number, q, v, at, accelerations_.data() + k * width());
  }
  const Terms& terms = terms_[stages_];
  scaled(terms, rates_, to_q.data());
  scaled(terms, accelerations_, to_v.data());
  addTermsExactly(to_q.data(), terms.count, width(), all + kQ * width(), all + kQLow * width());
  addTermsExactly(to_v.data(), terms.count, width(), all + kV * width(), all + kVLow * width());
}

/// Diverged systems are marked as stopped; their slots restart from the initial state, which is not
/// reported.
void BatchRungeKutta::look(std::size_t number) noexcept {
  const double* const all = block(number);
  for (std::size_t lane = 0; lane < kBlock; ++lane) {
    bool finite = true;
    for (std::size_t place = lane; place < width(); place += kBlock) {
      finite = finite && std::isfinite(all[kQ * width() + place]) &&
               std::isfinite(all[kV * width() + place]);
    }
    if (!finite) {
      const std::size_t member = std::min(number * kBlock + lane, count() - 1);
      stopped_[member] = 1;
      const double* const start = start_.data() + member * 2 * n_;
      put(number, lane, start, start + n_);
    }
  }
}

}  // namespace whirl_twin
