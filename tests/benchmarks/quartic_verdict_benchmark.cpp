// Time of the stability verdict of a quartic, with its margins, compared with Eigen's time for the
// eigenvalues alone and with the exact test: quartics of two coupled oscillators, the same for all.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <chrono>
#include <random>
#include <vector>

#include "analysis/linearized_motion.h"
#include "analysis/routh.h"
#include "analysis/stability_margins.h"

namespace {

constexpr int kQuartics = 256;
constexpr int kRounds = 20;  // of which the median counts

/// [us] each, of so many calls a round.
template <class Judge>
double cost(int calls, const Judge& judge) {
  std::vector<double> rounds;
  for (int round = 0; round < kRounds; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < calls; ++i) {
      judge(static_cast<std::size_t>(i % kQuartics));
    }
    const std::chrono::duration<double, std::micro> passed =
        std::chrono::steady_clock::now() - begin;
    rounds.push_back(passed.count() / calls);
  }
  std::sort(rounds.begin(), rounds.end());
  return rounds[rounds.size() / 2];
}

}  // namespace

int main() {
  using whirl_twin::judgeQuartic;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(0.2, 3.0);
  std::vector<std::array<double, 5>> quartics;
  std::vector<Eigen::Matrix4d> matrices;
  for (int i = 0; i < kQuartics; ++i) {
    const double p = number(random), q = number(random), r = number(random), t = number(random);
    quartics.push_back({1.0, p + r, q + t + p * r, p * t + q * r, q * t});
    Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();
    companion.bottomLeftCorner<3, 3>().setIdentity();
    for (int k = 0; k < 4; ++k) {
      companion(0, k) = -quartics.back()[static_cast<std::size_t>(k) + 1];
    }
    matrices.push_back(companion);
  }
  double sum = 0.0;  // prevents elimination by the compiler
  const double quick = cost(20000, [&](std::size_t i) {
    const whirl_twin::QuarticJudgement judgement = judgeQuartic(quartics[i]);
    sum +=
        judgement.right + judgement.decay_rate + whirl_twin::logDecrement(judgement.damping_ratio);
  });
  const double eigen = cost(5000, [&](std::size_t i) {
    const Eigen::EigenSolver<Eigen::Matrix4d> solver(matrices[i], false);
    sum += solver.eigenvalues()[0].real();
  });
  const double exact = cost(500, [&](std::size_t i) {
    const std::vector<double> coefficients(quartics[i].begin(), quartics[i].end());
    sum += whirl_twin::routh(coefficients).right;
  });
  fmt::print("| for a quartic | time | compared with Eigen |\n|---|---|---|\n");
  fmt::print("| verdict and margins, in double precision | {:.3f} us | {:.3g} times faster |\n",
             quick, eigen / quick);
  fmt::print("| Eigen's eigenvalues | {:.3f} us | |\n", eigen);
  fmt::print("| the exact test | {:.3f} us | {:.3g} |\n", exact, eigen / exact);
  return sum == 0.0 ? 1 : 0;
}
