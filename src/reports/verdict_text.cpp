#include "reports/verdict_text.h"

#include <fmt/format.h>

#include <cmath>

namespace whirl_twin {

std::string defined(double x, const char* undefined) {
  return std::isnan(x) ? std::string(undefined) : fmt::format("{:.6g}", x);
}

std::string verdictText(Verdict verdict) {
  switch (verdict) {
    case Verdict::kAsymptoticallyStable:
      return "asymptotically stable";
    case Verdict::kMarginal:
      return "marginal: neither decays nor grows";
    case Verdict::kRepeatedImaginary:
      return "repeated imaginary roots: may grow with time";
    case Verdict::kUnstable:
      return "unstable";
    case Verdict::kUncertain:
      break;
  }
  return "uncertain: too near the stability boundary for the numerical precision";
}

std::string routhText(const RouthResult& routh) {
  return fmt::format("    roots           {} right, {} on the imaginary axis, {} left\n",
                     routh.right, routh.imaginary, routh.left) +
         (routh.first_column.empty()
              ? std::string()
              : fmt::format("    first column    {:.6g}\n", fmt::join(routh.first_column, "  ")));
}

std::string marginsText(double decay_rate, double damping_ratio, double log_decrement) {
  return fmt::format("    decay rate      {:.6g} 1/s\n", decay_rate) +
         fmt::format("    damping ratio   {}\n", defined(damping_ratio, "none: no motion")) +
         fmt::format("    log decrement   {}\n", defined(log_decrement, "none: no vibration"));
}

std::vector<std::string> separationConditions() {
  return {"AF = Nc / (N2 - N1), Nc the peak, N1 and N2 where the response is 0.707 of it",
          "AF < 2.5: critically damped, no margin is required",
          "N above Nc: (N - Nc)/N at least 17 (1 - 1/(AF - 1.5)) %, 16 % at most",
          "N below Nc: (Nc - N)/N at least 10 + 17 (1 - 1/(AF - 1.5)) %, 26 % at most",
          "API 617 and RP 684; check the clause against the edition in force"};
}

}  // namespace whirl_twin
