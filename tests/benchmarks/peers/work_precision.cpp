#include "work_precision.h"

#include <time.h>

#include <algorithm>
#include <limits>
#include <map>

namespace whirl_twin::comparison {
namespace {

/// Settings that the first pass finds slower than the minimum by this factor are not timed again.
constexpr double kDearer = 1.5;
/// Not the first run beyond the budget ends a ladder: with too loose a tolerance some solvers are
/// slower than with a tighter one.
constexpr int kLastRuns = 3;

double cpuMilliseconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1.0e3 * static_cast<double>(now.tv_sec) + 1.0e-6 * static_cast<double>(now.tv_nsec);
}

/// A run that takes part in the rounds.
struct Candidate {
  std::unique_ptr<Run> run;
  Point* point;
  std::vector<double> cpu_ms, prepare_ms;
};

Curve explore(const ComparedScene& scene, const Contender& contender, const Effort& effort) {
  Curve curve;
  std::vector<double> out(scene.output.size());
  int beyond_budget = 0;
  for (std::size_t i = 0; i < contender.settings.size() && beyond_budget < kLastRuns;
       i += effort.stride) {
    Point point;
    point.setting = contender.settings[i];
    const std::unique_ptr<Run> run = contender.build(point.setting);
    run->prepare();
    const auto timed = [&] {
      const double start = cpuMilliseconds();
      const bool done = run->integrate(out.data());
      point.first_ms = cpuMilliseconds() - start;
      point.error = done ? relativeError(scene, out) : std::numeric_limits<double>::infinity();
    };
    timed();
    if (point.first_ms < effort.least_ms) {
      timed();  // now that caches are warm
    }
    curve.push_back(point);
    beyond_budget = point.first_ms > effort.budget_ms ? beyond_budget + 1 : 0;
  }
  return curve;
}

/// The first point from which on all meet the level.
std::size_t firstThatMeets(const Curve& curve, double level) {
  std::size_t first = curve.size();
  while (first > 0 && curve[first - 1].error <= level) {
    --first;
  }
  return first;
}

std::vector<Candidate> candidates(const Contender& contender, Curve& curve) {
  std::vector<bool> chosen(curve.size(), false);
  for (const double level : kLevels) {
    const std::size_t first = firstThatMeets(curve, level);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = first; i < curve.size(); ++i) {
      least = std::min(least, curve[i].first_ms);
    }
    for (std::size_t i = first; i < curve.size(); ++i) {
      chosen[i] = chosen[i] || curve[i].first_ms <= kDearer * least;
    }
  }
  std::vector<Candidate> all;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (chosen[i]) {
      all.push_back({contender.build(curve[i].setting), &curve[i], {}, {}});
    }
  }
  return all;
}

void time(Candidate& candidate, const Effort& effort, std::vector<double>& out) {
  const double before = cpuMilliseconds();
  candidate.run->prepare();
  const double start = cpuMilliseconds();
  candidate.prepare_ms.push_back(start - before);
  candidate.run->integrate(out.data());  // not counted: warms the caches
  int runs = 0;
  const double warm = cpuMilliseconds();
  double elapsed = 0.0;
  do {
    candidate.run->integrate(out.data());
    ++runs;
    elapsed = cpuMilliseconds() - warm;
  } while (elapsed < effort.least_ms);
  candidate.cpu_ms.push_back(elapsed / runs);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::vector<Curve> measure(const ComparedScene& scene, const Effort& effort) {
  std::vector<Curve> curves;
  for (const Contender& contender : scene.contenders) {
    curves.push_back(explore(scene, contender, effort));
  }
  std::vector<std::vector<Candidate>> all;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    all.push_back(candidates(scene.contenders[i], curves[i]));
  }
  std::vector<double> out(scene.output.size());
  for (int round = 0; round < effort.rounds; ++round) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (Candidate& candidate : all[(i + static_cast<std::size_t>(round)) % all.size()]) {
        time(candidate, effort, out);
      }
    }
  }
  for (std::vector<Candidate>& of_one : all) {
    for (Candidate& candidate : of_one) {
      candidate.point->cpu_ms = median(candidate.cpu_ms);
      candidate.point->prepare_ms = median(candidate.prepare_ms);
    }
  }
  return curves;
}

const Point* cheapest(const Curve& curve, double level, bool with_preparation) {
  const Point* best = nullptr;
  const auto cost = [&](const Point& point) {
    return point.cpu_ms + (with_preparation ? point.prepare_ms : 0.0);
  };
  for (std::size_t i = firstThatMeets(curve, level); i < curve.size(); ++i) {
    if (curve[i].cpu_ms > 0.0 && (best == nullptr || cost(curve[i]) < cost(*best))) {
      best = &curve[i];
    }
  }
  return best;
}

}  // namespace whirl_twin::comparison
