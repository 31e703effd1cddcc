#include "integration/small_lu.h"

#include <cmath>
#include <utility>

namespace whirl_twin {

void factorizeSmall(double* a, std::size_t* rows, std::size_t size) noexcept {
  for (std::size_t k = 0; k < size; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < size; ++i) {
      if (std::fabs(a[i * size + k]) > std::fabs(a[pivot * size + k])) {
        pivot = i;
      }
    }
    rows[k] = pivot;
    double* const of_pivot = a + k * size;
    if (pivot != k) {
      for (std::size_t j = 0; j < size; ++j) {
        std::swap(of_pivot[j], a[pivot * size + j]);
      }
    }
    for (std::size_t i = k + 1; i < size; ++i) {
      double* const row = a + i * size;
      const double factor = row[k] / of_pivot[k];
      row[k] = factor;
      for (std::size_t j = k + 1; j < size; ++j) {
        row[j] -= factor * of_pivot[j];
      }
    }
  }
}

void solveSmall(const double* a, const std::size_t* rows, std::size_t size, double* b) noexcept {
  for (std::size_t k = 0; k < size; ++k) {
    std::swap(b[k], b[rows[k]]);
  }
  for (std::size_t i = 1; i < size; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      b[i] -= a[i * size + j] * b[j];
    }
  }
  for (std::size_t i = size; i-- > 0;) {
    for (std::size_t j = i + 1; j < size; ++j) {
      b[i] -= a[i * size + j] * b[j];
    }
    b[i] /= a[i * size + i];
  }
}

}  // namespace whirl_twin
